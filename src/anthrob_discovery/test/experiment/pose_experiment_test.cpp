// Poses of a hanging arm at rest, against its closed equation.
#include "experiment/pose_experiment.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "admission/admission.h"
#include "anthrob_core/errors.h"
#include "anthrob_sim/replay/replay.h"
#include "experiment/evaluator.h"
#include "experiment/poses.h"
#include "pose_bench.h"

namespace anthrob {
namespace discovery {
namespace {

/// What the model lacks in each pose, in order.
Differences lacking_in_poses(const std::string& model, const Dataset& recording,
                             const std::vector<EffectInstance>& effects = {}) {
  const Evaluator evaluator(model, {}, 0.001, 1);
  Variant variant;
  variant.effects = effects;
  return evaluator.compare({variant}, {make_experiment(*evaluator.model(), recording, {})}).front();
}

TEST(PoseExperiment, LacksWhatTheEquationOfRestSays) {
  PoseBench bench;
  bench.noise = 0.0;
  bench.hidden = 0.3;
  bench.coulomb = 0.2;
  bench.load = 0.5;
  const Dataset recording = bench.record(1);
  const auto model = load_robot_model(bench.model());
  const Dataset poses = ordered_poses(*model, recording, {});
  const std::vector<double> q = poses.series("axis/position").values,
                            side = poses.series("axis/direction").values;
  const Differences found = lacking_in_poses(model->file, recording);
  ASSERT_EQ(found.size(), 40);
  for (Eigen::Index i = 0; i < found.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    EXPECT_NEAR(found[i], -0.3 * std::sin(q[k]) - 0.2 * side[k], 5e-4) << q[k];
  }
  // With the law that is missing, nothing is left, also if it bends before it slides.
  const EffectInstance mass = {"payload", "rotor", {{"mass", 0.3 / 9.81 / PoseBench::kArm}}};
  const EffectInstance dry = {"joint_coulomb", "axis", {{"torque", 0.2}, {"static_ratio", 1.0}}},
                       bending = {
                           "joint_presliding", "axis", {{"torque", 0.2}, {"distance", 0.01}}};
  EXPECT_LT(lacking_in_poses(model->file, recording, {mass, dry}).cwiseAbs().maxCoeff(), 5e-4);
  EXPECT_LT(lacking_in_poses(model->file, recording, {mass, bending}).cwiseAbs().maxCoeff(), 5e-4);
}

TEST(PoseExperiment, LeavesFrictionARangeWithoutDirections) {
  PoseBench bench;
  bench.noise = 0.0;
  bench.coulomb = 0.2;
  bench.directions = false;
  const std::string model = bench.model();
  const Dataset recording = bench.record(1);
  const auto with = [&](const std::string& id, double torque) {
    EffectInstance effect{id, "axis", {{"torque", torque}}};
    if (id != "joint_presliding") effect.parameters["static_ratio"] = 1.0;
    return lacking_in_poses(model, recording, {effect}).cwiseAbs().maxCoeff();
  };
  EXPECT_NEAR(lacking_in_poses(model, recording).cwiseAbs().maxCoeff(), 0.2, 1e-3);
  for (const char* id : {"joint_coulomb", "joint_presliding", "joint_lugre"}) {
    EXPECT_NEAR(with(id, 0.15), 0.05, 1e-3) << id;
    EXPECT_EQ(with(id, 0.25), 0.0) << id;
  }
}

TEST(Poses, AreInOrderOfDirectionAndPositionAndStaySo) {
  const PoseBench bench;
  const auto model = load_robot_model(bench.model());
  Dataset recording = bench.record(1);
  recording.tables[0].columns[1].present[7] = 0;
  recording.tables[0].columns[3].present[8] = 0;
  std::vector<std::string> remarks;
  const Dataset poses = ordered_poses(*model, recording, {}, &remarks);
  const std::vector<double> q = poses.series("axis/position").values,
                            side = poses.series("axis/direction").values;
  ASSERT_EQ(q.size(), 39u);
  EXPECT_EQ(std::count(side.begin(), side.end(), 0.0), 1);
  for (std::size_t i = 1; i < q.size(); ++i) {
    EXPECT_TRUE(side[i - 1] < side[i] || (side[i - 1] == side[i] && q[i - 1] <= q[i])) << i;
  }
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_EQ(remarks[0].find("poses_1/joints.csv: 1 of 40 rows lack"), 0u) << remarks[0];
  const Dataset again = ordered_poses(*model, poses, {});
  EXPECT_EQ(again.series("axis/effort").values, poses.series("axis/effort").values);
  EXPECT_EQ(again.tables[0].t, poses.tables[0].t);
}

std::string refusal_of_poses(const Question& question) {
  try {
    admit(Evaluator(question.model_file, {}, 0.001, 1), question);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "not refused";
}

TEST(Poses, ThatCannotAnswerAreRefusedWithOneLine) {
  const PoseBench bench;
  const Question good = bench.question();
  EXPECT_EQ(refusal_of_poses(good), "not refused");
  const auto expect = [&](const std::string& part, auto change) {
    Question bad = good;
    change(bad.train[0]);
    const std::string line = refusal_of_poses(bad);
    EXPECT_NE(line.find(part), std::string::npos) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos);
  };
  expect("poses_1/joints.csv: row 3: axis/direction: 0.5: expected 1 (approached with growing",
         [](Dataset& d) { d.tables[0].columns[3].values[2] = 0.5; });
  expect("too few poses: 11", [](Dataset& d) {
    std::fill(d.tables[0].columns[0].present.begin() + 11, d.tables[0].columns[0].present.end(), 0);
  });
  expect("column 'axis/effort' is missing",
         [](Dataset& d) { d.tables[0].columns[1].name = "axis/velocity"; });
  expect("poses_1/other.csv: axis/load: expected it in joints.csv", [](Dataset& d) {
    Table other = d.tables[0];
    other.name = "other";
    other.columns = {d.tables[0].columns[2]};
    d.tables[0].columns.erase(d.tables[0].columns.begin() + 2);
    d.tables.push_back(other);
  });
  // Friction may be told at one place.
  Question one_place = good;
  for (double& q : one_place.train[0].tables[0].columns[0].values) q = 0.0;
  EXPECT_EQ(refusal_of_poses(one_place), "not refused");
  // A repeat is one of poses, too.
  Question repeated = good;
  repeated.repeats = {bench.record(1)};
  repeated.repeats[0].folder = "again";
  for (double& effort : repeated.repeats[0].tables[0].columns[1].values) effort += 1e-3;
  EXPECT_EQ(refusal_of_poses(repeated), "not refused");
  Question shorter = repeated;
  shorter.repeats[0].tables[0].columns[0].present[3] = 0;
  EXPECT_NE(refusal_of_poses(shorter).find("again: 39 complete poses: expected the 40 of poses_1"),
            std::string::npos)
      << refusal_of_poses(shorter);
  repeated.repeats[0].meta.kind = "trajectory";
  EXPECT_NE(
      refusal_of_poses(repeated).find("again: meta.yaml: kind: trajectory: expected equilibrium"),
      std::string::npos)
      << refusal_of_poses(repeated);
}

TEST(Poses, AreNotReplayedInTime) {
  const PoseBench bench;
  try {
    const Replay replay(load_robot_model(bench.model()), bench.record(1), ReplayMode::kReference);
    ADD_FAILURE();
  } catch (const BadInput& error) {
    EXPECT_NE(std::string(error.what()).find("poses_1: meta.yaml: kind: equilibrium"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
