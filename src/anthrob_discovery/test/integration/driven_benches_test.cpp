// Light driven axes, with slow and fast rows and coarse encoders: what is missing is named by its
// effort, whatever inertia the model states.
#include <gtest/gtest.h>

#include <algorithm>

#include "driven_bench.h"
#include "report/discovery_summary.h"

namespace anthrob {
namespace discovery {
namespace {

Answer ask(Question question) {
  question.effects = {"joint_coulomb", "joint_offset_torque", "joint_viscous", "payload"};
  const Evaluator evaluator(question.model_file, question.nuisances, question.step, 2);
  return discover(evaluator, question);
}

double size_of(const Answer& answer, const std::string& id, const std::string& parameter) {
  for (const FoundEffect& effect : answer.effects) {
    if (effect.id != id) continue;
    for (const FoundParameter& p : effect.parameters) {
      if (p.name == parameter) return p.value;
    }
  }
  return 0.0;
}

bool names(const Answer& answer, const std::string& id) {
  return std::any_of(answer.effects.begin(), answer.effects.end(),
                     [&](const FoundEffect& effect) { return effect.id == id; });
}

/// Its inertial effort is a tenth of its friction.
DrivenBench light(double friction) {
  DrivenBench bench;
  bench.coulomb = friction;
  bench.inertia = 0.02 * friction;
  bench.viscous = 0.05 * friction;
  bench.noise = 0.05 * friction;
  return bench;
}

TEST(DrivenBench, FrictionOfALightAxisIsNamedWhateverInertiaIsGiven) {
  DrivenBench bench = light(3e-3);
  bench.rate = 100.0;
  bench.bits = 14;
  for (const double factor : {0.01, 1000.0}) {
    const Answer answer = ask(bench.question(factor));
    ASSERT_EQ(answer.verdict, Verdict::kEffectsFound) << factor << "\n" << summary(answer);
    EXPECT_EQ(answer.effects[0].id, "joint_coulomb") << factor << "\n" << summary(answer);
    EXPECT_NEAR(size_of(answer, "joint_coulomb", "torque"), 3e-3, 0.2e-3) << factor;
    EXPECT_FALSE(names(answer, "payload")) << factor << "\n" << summary(answer);
  }
}

TEST(DrivenBench, FrictionIsMeasuredFromSlowRowsAndByCoarseEncoders) {
  for (const auto& [rate, bits] :
       {std::pair(25.0, 12), std::pair(25.0, 18), std::pair(1000.0, 12), std::pair(1000.0, 20)}) {
    DrivenBench bench = light(0.4);
    bench.rate = rate;
    bench.bits = bits;
    const Answer answer = ask(bench.question());
    ASSERT_FALSE(answer.effects.empty()) << rate << " " << bits << "\n" << summary(answer);
    EXPECT_EQ(answer.effects[0].id, "joint_coulomb") << summary(answer);
    EXPECT_NEAR(size_of(answer, "joint_coulomb", "torque"), 0.4, 0.03) << rate << " " << bits;
  }
}

/// Its inertial effort is twenty times its friction.
TEST(DrivenBench, FrictionOfAHeavyAxisIsNoPayload) {
  DrivenBench bench;
  bench.inertia = 50.0;
  bench.coulomb = 8.0;
  bench.viscous = 2.0;
  bench.noise = 0.5;
  bench.rate = 1000.0;
  bench.bits = 20;
  const Answer answer = ask(bench.question());
  ASSERT_FALSE(answer.effects.empty()) << summary(answer);
  EXPECT_EQ(answer.effects[0].id, "joint_coulomb") << summary(answer);
  EXPECT_NEAR(size_of(answer, "joint_coulomb", "torque"), 8.0, 0.8) << summary(answer);
  EXPECT_FALSE(names(answer, "payload")) << summary(answer);
}

/// Of machines larger and smaller than any arm: a law has no size of its own.
TEST(DrivenBench, SizesAreFoundOverNineDecades) {
  for (const double unit : {1e-5, 1e4}) {
    DrivenBench bench;
    bench.inertia = 0.02 * unit;
    bench.viscous = 0.05 * unit;
    bench.noise = 0.02 * unit;
    bench.gravity = 0.1 * unit;
    bench.rate = 100.0;
    Question question = bench.question();
    bench.coulomb = unit;
    question.train = {bench.record(1)};
    question.test = {bench.record(2)};
    const Answer answer = ask(question);
    ASSERT_FALSE(answer.effects.empty()) << unit << "\n" << summary(answer);
    EXPECT_EQ(answer.effects[0].id, "joint_coulomb") << unit << "\n" << summary(answer);
    EXPECT_NEAR(size_of(answer, "joint_coulomb", "torque"), unit, 0.1 * unit) << unit;

    // A mass where that of the model is, 0.1 m from the axis.
    bench.coulomb = 0.0;
    const double mass = 2.0 * bench.gravity / 9.81 / 0.1;
    bench.gravity *= 3.0;
    bench.inertia += mass * 0.1 * 0.1;
    question.train = {bench.record(1)};
    question.test = {bench.record(2)};
    const Answer loaded = ask(question);
    ASSERT_FALSE(loaded.effects.empty()) << unit << "\n" << summary(loaded);
    EXPECT_EQ(loaded.effects[0].id, "payload") << unit << "\n" << summary(loaded);
    EXPECT_NEAR(size_of(loaded, "payload", "mass"), mass, 0.3 * mass) << unit;
  }
}

TEST(DrivenBench, NothingIsNamedWhereNothingIsMissing) {
  DrivenBench bench = light(0.4);
  bench.coulomb = 0.0;
  bench.viscous = 0.2;
  for (const auto& [rate, bits] : {std::pair(25.0, 16), std::pair(500.0, 12)}) {
    bench.rate = rate;
    bench.bits = bits;
    const Answer answer = ask(bench.question());
    EXPECT_EQ(answer.verdict, Verdict::kNoMissingEffect) << rate << "\n" << summary(answer);
  }
}

TEST(DrivenBench, AFitBelowWhatNoiseLeavesCannotTell) {
  DrivenBench bench = light(0.4);
  Question question = bench.question();
  bench.noise *= 12.0;  // of another, worse amplifier
  question.repeats = {bench.record(1)};
  question.repeats[0].folder = "repeat";
  const Answer answer = ask(question);
  EXPECT_EQ(answer.verdict, Verdict::kCannotTell) << summary(answer);
  EXPECT_TRUE(answer.effects.empty());
  EXPECT_TRUE(answer.extended.effects.empty());
  EXPECT_TRUE(std::any_of(answer.remarks.begin(), answer.remarks.end(), [](const auto& line) {
    return line.find("these recordings cannot tell") != std::string::npos;
  }));
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
