// A joint that was let go: a pendulum that swings out, by its equation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "axis_rows.h"
#include "discover.h"
#include "driven_bench.h"
#include "report/discovery_summary.h"

namespace anthrob {
namespace discovery {
namespace {

/// I a = -m g l sin q - viscous v - coulomb sign v, from rest at `q`, rows at 200 Hz for 8 s.
Dataset swing(const DrivenBench& bench, double q, std::uint64_t seed) {
  constexpr double kStep = 5e-5;  // [s]
  AxisRows rows("swing_" + std::to_string(seed), "bench");
  const CounterRandom random(seed, 5);
  double v = 0.0;
  for (int row = 0; row < 1600; ++row) {
    rows.add(0.005 * row, q + 1e-3 * random.normal(static_cast<std::uint64_t>(row)), 0.0);
    for (int i = 0; i < 100; ++i) {
      const double pull = -bench.gravity * std::sin(q);
      if (v == 0.0 && std::abs(pull) <= bench.coulomb) continue;  // friction holds it
      const double along = v != 0.0 ? v : pull;
      const double torque = pull - bench.viscous * v - std::copysign(bench.coulomb, along);
      const double next = v + kStep * torque / bench.inertia;
      v = v * next < 0.0 ? 0.0 : next;
      q += kStep * v;
    }
  }
  return rows.data();
}

Answer ask_about_swings(bool repeated) {
  DrivenBench bench;
  bench.inertia = 0.015, bench.viscous = 0.01, bench.gravity = 0.74, bench.coulomb = 0.02;
  Question question;
  question.model_file = bench.model();
  question.nuisances = ordinary_parameters(question.model_file);
  question.train = {swing(bench, 1.2, 1), swing(bench, -0.8, 2)};
  question.test = {swing(bench, 1.7, 3)};
  if (repeated) question.repeats = {swing(bench, 1.2, 4)};
  const Evaluator evaluator(question.model_file, question.nuisances, question.step, 2);
  return discover(evaluator, question);
}

long remarks_with(const Answer& answer, const std::string& words) {
  return std::count_if(
      answer.remarks.begin(), answer.remarks.end(),
      [&](const std::string& remark) { return remark.find(words) != std::string::npos; });
}

TEST(FreeDecay, TellsTheFrictionOfAJointThatWasLetGo) {
  const Answer answer = ask_about_swings(true);
  ASSERT_EQ(answer.verdict, Verdict::kEffectsFound) << summary(answer);
  EXPECT_EQ(answer.effects[0].id, "joint_coulomb") << summary(answer);
  EXPECT_NEAR(answer.effects[0].parameters[0].value, 0.02, 0.002) << summary(answer);
  EXPECT_EQ(remarks_with(answer, "taken as one that was let go"), 4);
}

// The missing effort turns about with every swing, as noise would.
TEST(FreeDecay, WithoutARepetitionItDoesNotSayThatNothingIsMissing) {
  const Answer answer = ask_about_swings(false);
  EXPECT_EQ(answer.verdict, Verdict::kCannotTell) << summary(answer);
  EXPECT_EQ(remarks_with(answer, "less than noise leaves"), 1) << summary(answer);
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
