// Laws of a driven joint that none of the ordinary parameters is: each is hidden in recordings made
// here by their equation, and named.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "anthrob_core/random.h"
#include "axis_rows.h"
#include "discover.h"
#include "report/discovery_summary.h"

namespace anthrob {
namespace discovery {
namespace {

constexpr double kRecordingStep = 2e-5;  // [s]

/// A force against the motion: of position, velocity, and the way since the last call.
using HiddenForce = std::function<double(double q, double v, double dq)>;

/// m a = u - viscous v - force, with the numbers of the driven axis, pulled to and fro for 8 s
/// around the middle of its way by an effort that is held over a millisecond.
Dataset law_recording(const HiddenForce& force, std::uint64_t seed) {
  AxisRows made("axis", "driven_axis");
  const CounterRandom random(seed, 9);
  const double mass = 95.1, viscous = 203.5, middle = 0.15;
  const double first = 150.0 + 50.0 * random.uniform(1), second = 2.0 + 3.0 * random.uniform(2);
  const int rows = 8000, per_row = static_cast<int>(std::lround(1e-3 / kRecordingStep));
  double q = middle, v = 0.0, dq = 0.0;
  for (int row = 0; row < rows; ++row) {
    const double t = 1e-3 * row;
    const double u =
        first * std::sin(1.7 * t) + 0.5 * first * std::sin(second * t) - 2000.0 * (q - middle);
    made.add(t, q + 2e-7 * random.normal(100 + static_cast<std::uint64_t>(row)), u);
    for (int i = 0; i < per_row; ++i) {
      v += kRecordingStep / mass * (u - viscous * v - force(q, v, dq));
      dq = kRecordingStep * v;
      q += dq;
    }
  }
  return made.data();
}

/// @param force makes one for each recording, as a force may remember
Answer ask_about(const std::function<HiddenForce()>& force) {
  Question question;
  question.model_file = ANTHROB_CONFIG_DIR "/driven_axis/model_I.yaml";
  question.nuisances = ordinary_parameters(question.model_file);
  question.train = {law_recording(force(), 1)};
  question.test = {law_recording(force(), 2)};
  question.max_effects = 2;
  const Evaluator evaluator(question.model_file, question.nuisances, question.step, 2);
  return discover(evaluator, question);
}

double value_of(const FoundEffect& effect, const std::string& name) {
  for (const FoundParameter& p : effect.parameters) {
    if (p.name == name) return p.value;
  }
  ADD_FAILURE() << "no " << name;
  return 0.0;
}

TEST(JointLaws, QuadraticDragIsNamed) {
  const double drag = 3000.0;
  const Answer answer =
      ask_about([&] { return [=](double, double v, double) { return drag * std::abs(v) * v; }; });
  ASSERT_EQ(answer.verdict, Verdict::kEffectsFound) << summary(answer);
  EXPECT_EQ(answer.effects[0].id, "joint_quadratic_drag") << summary(answer);
  EXPECT_NEAR(value_of(answer.effects[0], "drag"), drag, 0.1 * drag);
}

TEST(JointLaws, FrictionThatBendsIsNamed) {
  const double torque = 30.0, distance = 0.004;
  const Answer answer = ask_about([&] {
    return [=, z = 0.0](double, double, double dq) mutable {
      z += dq / distance * (1.0 - std::copysign(z, dq * z));
      return torque * z;
    };
  });
  ASSERT_EQ(answer.verdict, Verdict::kEffectsFound) << summary(answer);
  EXPECT_EQ(answer.effects[0].id, "joint_presliding") << summary(answer);
  EXPECT_NEAR(value_of(answer.effects[0], "torque"), torque, 0.1 * torque);
  EXPECT_NEAR(value_of(answer.effects[0], "distance"), distance, 0.2 * distance);
}

TEST(JointLaws, RippleIsNamedWithItsPeriods) {
  const auto wave = [](double number, double q) { return std::sin(2.0 * M_PI * number * q + 0.3); };
  const Answer answer = ask_about([&] {
    return [=](double q, double, double) { return 20.0 * wave(41.0, q) + 10.0 * wave(83.0, q); };
  });
  ASSERT_EQ(answer.verdict, Verdict::kEffectsFound) << summary(answer);
  const FoundEffect& ripple = answer.effects[0];
  ASSERT_EQ(ripple.id, "joint_ripple") << summary(answer);
  EXPECT_NEAR(value_of(ripple, "periods_1"), 41.0, 0.5);
  EXPECT_NEAR(value_of(ripple, "periods_2"), 83.0, 1.0);
  EXPECT_NEAR(std::hypot(value_of(ripple, "sine_1"), value_of(ripple, "cosine_1")), 20.0, 2.0);
  EXPECT_NEAR(std::hypot(value_of(ripple, "sine_2"), value_of(ripple, "cosine_2")), 10.0, 1.5);
}

TEST(JointLaws, RippleIsNotLookedForWhereNothingRepeats) {
  Question question;
  question.model_file = ANTHROB_CONFIG_DIR "/driven_axis/model_I.yaml";
  question.nuisances = ordinary_parameters(question.model_file);
  const HiddenForce none = [](double, double, double) { return 0.0; };
  question.train = {law_recording(none, 1)};
  question.test = {law_recording(none, 2)};
  question.effects = {"joint_ripple"};
  const Evaluator evaluator(question.model_file, question.nuisances, question.step, 2);
  const Answer answer = discover(evaluator, question);
  EXPECT_EQ(answer.verdict, Verdict::kNoMissingEffect) << summary(answer);
  ASSERT_FALSE(answer.remarks.empty());
  EXPECT_EQ(answer.remarks.front().find("joint_ripple @ axis: not looked for"), 0u)
      << answer.remarks.front();
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
