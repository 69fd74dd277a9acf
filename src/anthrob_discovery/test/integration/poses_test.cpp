// What is missing of an arm of which only poses at rest are known.
#include <gtest/gtest.h>

#include <algorithm>

#include "pose_bench.h"
#include "report/discovery_report.h"
#include "report/discovery_summary.h"

namespace anthrob {
namespace discovery {
namespace {

Answer ask_of_poses(Question question) {
  if (question.effects.empty()) {
    question.effects = {"joint_coulomb", "joint_offset_torque", "payload", "effort_gain"};
  }
  const Evaluator evaluator(question.model_file, question.nuisances, question.step, 2);
  return discover(evaluator, question);
}

const FoundParameter* parameter_of_answer(const Answer& answer, const std::string& id,
                                          const std::string& name) {
  for (const FoundEffect& effect : answer.effects) {
    for (const FoundParameter& p : effect.parameters) {
      if (effect.id == id && p.name == name) return &p;
    }
  }
  return nullptr;
}

/// Poses of two kinds: as they are, and under a known load.
Question with_load(PoseBench bench) {
  Question question = bench.question();
  bench.load = 1.5;
  question.train.push_back(bench.record(3));
  question.test.push_back(bench.record(4));
  return question;
}

/// The same with a known weight, which the recording says. The model lists it, so it is not looked
/// for.
Question with_weight(PoseBench bench) {
  bench.weighed = true;
  Question question = bench.question();
  question.effects = {"joint_coulomb", "joint_offset_torque", "effort_gain"};
  bench.known = 1.5;
  question.train.push_back(bench.record(3));
  question.test.push_back(bench.record(4));
  return question;
}

TEST(Poses, TellFrictionByDirection) {
  PoseBench bench;
  bench.coulomb = 0.15;
  const Answer answer = ask_of_poses(bench.question());
  ASSERT_EQ(answer.verdict, Verdict::kEffectsFound) << summary(answer);
  ASSERT_EQ(answer.effects.size(), 1u) << summary(answer);
  EXPECT_EQ(answer.effects[0].id, "joint_coulomb") << summary(answer);
  EXPECT_EQ(answer.effects[0].shows_in, "axis/effort_at_rest");
}

TEST(Poses, TellAHiddenMassFromAWrongTorqueConstantUnderAKnownLoad) {
  PoseBench heavier;
  heavier.hidden = 0.4;
  const Answer mass = ask_of_poses(with_load(heavier));
  ASSERT_EQ(mass.effects.size(), 1u) << summary(mass);
  EXPECT_EQ(mass.effects[0].id, "payload") << summary(mass);
  ASSERT_NE(parameter_of_answer(mass, "payload", "mass"), nullptr);
  EXPECT_NEAR(parameter_of_answer(mass, "payload", "mass")->value, 0.4 / 9.81 / PoseBench::kArm,
              0.05);

  PoseBench stronger;
  stronger.gain = 1.2;
  const Answer gain = ask_of_poses(with_load(stronger));
  ASSERT_EQ(gain.effects.size(), 1u) << summary(gain);
  EXPECT_EQ(gain.effects[0].id, "effort_gain") << summary(gain);
  ASSERT_NE(parameter_of_answer(gain, "effort_gain", "gain"), nullptr);
  EXPECT_NEAR(parameter_of_answer(gain, "effort_gain", "gain")->value, 1.2, 0.02);
}

TEST(Poses, OfARobotWithAKnownWeightAreThoseOfTheHeavierRobot) {
  EXPECT_EQ(ask_of_poses(with_weight({})).verdict, Verdict::kNoMissingEffect);
  PoseBench stronger;
  stronger.gain = 1.2;
  const Answer answer = ask_of_poses(with_weight(stronger));
  ASSERT_EQ(answer.effects.size(), 1u) << summary(answer);
  EXPECT_EQ(answer.effects[0].id, "effort_gain") << summary(answer);
  ASSERT_NE(parameter_of_answer(answer, "effort_gain", "gain"), nullptr);
  EXPECT_NEAR(parameter_of_answer(answer, "effort_gain", "gain")->value, 1.2, 0.02);
}

TEST(Poses, AndMotionsAreFittedTogether) {
  PoseBench bench;
  bench.coulomb = 0.15;
  DrivenBench moving;
  moving.inertia = 0.05;
  moving.gravity = bench.weight;
  moving.coulomb = 0.15;
  moving.noise = 0.02;
  Question question = bench.question();
  question.train.push_back(moving.record(5));
  question.test.push_back(moving.record(6));
  const Answer answer = ask_of_poses(question);
  ASSERT_EQ(answer.verdict, Verdict::kEffectsFound) << summary(answer);
  EXPECT_EQ(answer.effects[0].id, "joint_coulomb") << summary(answer);
  ASSERT_NE(parameter_of_answer(answer, "joint_coulomb", "torque"), nullptr);
  EXPECT_NEAR(parameter_of_answer(answer, "joint_coulomb", "torque")->value, 0.15, 0.02);
  EXPECT_TRUE(answer.scales.count("axis/effort"));
  EXPECT_TRUE(answer.scales.count("axis/effort_at_rest"));
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
