// Recordings of robots that were not the same.
#include "experiment/evaluator.h"

#include <gtest/gtest.h>

#include "admission/admission.h"
#include "anthrob_core/errors.h"
#include "driven_bench.h"

namespace anthrob {
namespace discovery {
namespace {

/// Twice the weight at the same inertia, as its recording says.
Dataset record_of_a_heavier_one(DrivenBench bench) {
  bench.gravity *= 2.0;
  Dataset recording = bench.record(2);
  recording.meta.model = {{"gravity.2", -2.0 * 9.81}};
  return recording;
}

TEST(Evaluator, SimulatesEachRecordingWithItsOwnNumbers) {
  DrivenBench bench;
  bench.inertia = 0.02;
  bench.gravity = 0.5;
  const Evaluator evaluator(bench.model(), {}, 0.001, 1);
  ReplayScope scope;
  scope.bin = 0.05;
  const auto compare = [&](const Dataset& recording, const Variant& variant) {
    // Beside one of the robot as it is, which must not change what the other one is.
    const Experiments both = {make_experiment(*evaluator.model(), bench.record(1), {}, scope),
                              make_experiment(*evaluator.model(), recording, {}, scope)};
    const Differences all = evaluator.compare({variant}, both).front();
    EXPECT_LT(all.head(static_cast<Eigen::Index>(both[0]->size())).norm() /
                  std::sqrt(static_cast<double>(both[0]->size())),
              0.05);
    return Differences(all.tail(static_cast<Eigen::Index>(both[1]->size())));
  };
  const Dataset heavier = record_of_a_heavier_one(bench);
  Dataset unsaid = heavier;
  unsaid.meta.model.clear();
  const auto rms = [](const Differences& d) {
    return d.norm() / std::sqrt(static_cast<double>(d.size()));
  };
  const Differences known = compare(heavier, {});
  EXPECT_LT(rms(known), 0.02);
  EXPECT_GT(rms(compare(unsaid, {})), 0.2);
  // Effects add to it: an offset takes its share of the effort.
  Variant pushed;
  pushed.effects = {{"joint_offset_torque", "axis", {{"torque", 0.03}}}};
  const Differences more = compare(heavier, pushed) - known;
  EXPECT_NEAR(std::abs(more.mean()), 0.03, 1e-3);
}

TEST(Evaluator, RefusesNumbersThatTheModelLacks) {
  DrivenBench bench;
  Question question = bench.question();
  const auto refusal = [&] {
    try {
      admit(Evaluator(question.model_file, {}, 0.001, 1), question);
    } catch (const BadInput& error) {
      return std::string(error.what());
    }
    return std::string("not refused");
  };
  EXPECT_EQ(refusal(), "not refused");
  question.test[0].meta.model = {{"joints.axis.mass", 2.0}};
  EXPECT_NE(refusal().find("bench_2: meta.yaml: model.joints.axis.mass: 2: expected"),
            std::string::npos)
      << refusal();
  question.test[0].meta.model = {{"joints.axis.friction.viscous", -2.0}};
  EXPECT_NE(refusal().find("bench_2: meta.yaml: model: "), std::string::npos) << refusal();
  question.test[0].meta.model = {};
  question.repeats = {bench.record(1)};
  question.repeats[0].folder = "again";
  for (std::size_t i = 0; i < question.repeats[0].tables[0].t.size(); ++i) {
    question.repeats[0].tables[0].columns[1].values[i] += 1e-5 * static_cast<double>(i % 7);
  }
  question.repeats[0].meta.model = {{"joints.axis.friction.viscous", 2.0}};
  EXPECT_NE(refusal().find("again: meta.yaml: model: differs"), std::string::npos) << refusal();
}

TEST(Evaluator, RemarksOnNumbersOfARecording) {
  DrivenBench bench;
  Question question = bench.question();
  question.test[0].meta.model = {{"joints.axis.friction.viscous", 0.002}};
  const Admission admitted = admit(Evaluator(question.model_file, {}, 0.001, 1), question);
  EXPECT_TRUE(std::any_of(admitted.remarks.begin(), admitted.remarks.end(), [](const auto& line) {
    return line.find("bench_2: simulated with") == 0 &&
           line.find("joints.axis.friction.viscous 0.002") != std::string::npos;
  }));
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
