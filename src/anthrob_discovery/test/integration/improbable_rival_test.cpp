// A law that stands in for another one, and is dropped for that, must not keep the other one out.
#include <gtest/gtest.h>

#include <memory>

#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/effects/placed_effects.h"
#include "axis_recording.h"
#include "discover.h"
#include "report/discovery_summary.h"

namespace anthrob {
namespace discovery {
namespace {

constexpr double kMiddle = 0.1;    // [m]
constexpr double kSteepest = 3.0;  // [1/m]
/// [N] A stronger one and an offset together could be as steep as the true force.
constexpr double kStrongest = 8.0;

/// tau = force (1 + lean 3/m (q - 0.1 m))
class LeaningForce final : public JointTorque {
 public:
  LeaningForce(const JointModel& joint, double force, double lean)
      : position_(joint.position_offset),
        dof_(joint.velocity_offset),
        force_(force),
        slope_(force * lean * kSteepest) {}
  void add(const KinematicTree&, const std::vector<double>& q, double* tau) const override {
    tau[dof_] += force_ + slope_ * (q[position_] - kMiddle);
  }
  double energy(const std::vector<double>& q) const override {
    const double x = q[position_] - kMiddle;
    return -(force_ + 0.5 * slope_ * x) * x;
  }

 private:
  int position_, dof_;
  double force_, slope_;
};

EffectInfo describe() {
  EffectInfo i;
  i.id = "leaning_force";
  i.name = "Force that leans";
  i.description =
      "A force that may grow or fall along its axis, but not as steeply as the true one.";
  i.equation = "tau = force (1 + lean 3/m (q - 0.1 m))";
  i.source = "this test";
  i.where = "JOINT";
  i.seam = Seam::kJoints;
  i.stage = Stage::kComponents;
  i.channels = {"joint"};
  i.parameters = {
      {"force", "N", "forward positive", 0.0, 2.0, {-kStrongest, kStrongest}},
      {"lean", "1", "how steep", 0.0, 0.3, {-1.0, 1.0}, EffectParameter::kShape},
  };
  return i;
}

class Leaning final : public JointEffect {
 public:
  Leaning() : JointEffect(describe()) {}

 protected:
  void change(const EffectSetting& setting, ModelDraft& draft, JointModel& joint) const override {
    draft.robot.joint_torques.push_back(
        std::make_shared<LeaningForce>(joint, setting["force"], setting["lean"]));
  }
};

Answer ask_about(const std::vector<std::string>& effects) {
  // Only now: other tests of this program search without it.
  const EffectRegistration registration(std::make_unique<Leaning>());
  // Steeper than a leaning force may be, so that its best shape is at the end of its range.
  constexpr double kOffset = kStrongest, kStiffness = 2.0 * kOffset * kSteepest;
  Question question = axis_question(0.0, 0.0);
  question.train = {axis_recording(0.0, kOffset, 1, 203.5, kStiffness)};
  question.test = {axis_recording(0.0, kOffset, 2, 203.5, kStiffness)};
  question.effects = effects;
  const Evaluator evaluator(question.model_file, question.nuisances, question.step, 2);
  return discover(evaluator, question);
}

TEST(ImprobableRival, IsTriedInPlaceOfWhatWasDropped) {
  const Answer answer = ask_about({"leaning_force", "joint_offset_torque"});
  ASSERT_EQ(answer.search.improbable.size(), 1u) << summary(answer);
  EXPECT_EQ(answer.search.improbable[0].id, "leaning_force");
  EXPECT_EQ(answer.search.improbable[0].at_limit, "lean");
  ASSERT_EQ(answer.effects.size(), 1u) << summary(answer);
  EXPECT_EQ(answer.effects[0].id, "joint_offset_torque");
  EXPECT_NEAR(answer.effects[0].parameters.at(0).value, -8.0, 1.0);
}

TEST(ImprobableRival, WhatWasDroppedIsNotNamedAgain) {
  const Answer answer = ask_about({"leaning_force"});
  ASSERT_EQ(answer.search.improbable.size(), 1u) << summary(answer);
  EXPECT_TRUE(answer.effects.empty()) << summary(answer);
  EXPECT_EQ(answer.verdict, Verdict::kUnexplained);
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
