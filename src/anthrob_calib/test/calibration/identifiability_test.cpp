// Which parameters recordings tell, and how well.
#include "calibration/identifiability.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "optimiser/evaluator.h"
#include "rig_problem.h"

namespace anthrob {
namespace calibration {
namespace {

TEST(Identifiability, OnePostureDoesNotTellFourParameters) {
  // All trajectories begin at the same place, and only that is fitted.
  Weights weights;
  weights.path = weights.after = 0.0;
  const Problem problem = problem_of(runs_of(rig(), "trajectory", 1.0), kParameters, weights);
  const Identifiability known = examine(problem, problem.space().initial(), 0);
  EXPECT_FALSE(known.parameters[2].identifiable);
  EXPECT_FALSE(known.parameters[3].identifiable);
  for (const ParameterKnowledge& p : known.parameters) EXPECT_LE(p.sigma, 1.1 * p.prior_sigma);
  // The paths tell them all.
  const Problem whole = problem_of(runs_of(rig(), "trajectory", 1.0));
  for (const ParameterKnowledge& p : examine(whole, whole.space().initial(), 0).parameters) {
    EXPECT_TRUE(p.identifiable);
  }
}

TEST(Identifiability, IsJudgedByTheInterval) {
  for (const char* kind : {"equilibrium", "trajectory"}) {
    const Problem problem = problem_of(runs_of(rig(), kind, 1.0));
    const Point initial = problem.space().initial();
    const Identifiability known = examine(problem, initial, 0);
    for (std::size_t i = 0; i < initial.size(); ++i) {
      const ModelParameter& range = problem.space().parameters()[i];
      const identification::Estimate estimate = interval(known, i, initial[i]);
      const double most = kIdentifiableShare * identification::kNormal95 * range.range() /
                          std::sqrt(3.0);  // 2 * range / sqrt(12)
      EXPECT_EQ(known.parameters[i].identifiable, estimate.hi - estimate.lo < most) << kind << i;
      EXPECT_GE(estimate.lo, range.lower);
      EXPECT_LE(estimate.hi, range.upper);
    }
  }
}

TEST(Identifiability, TellsWhatEquilibriaCannot) {
  // The inductance of a motor moves no equilibrium.
  const Problem problem =
      problem_of(runs_of(rig(), "equilibrium", 1.0),
                 std::string(kParameters) +
                     "  - {path: actuators.motor.motor.inductance, unit: H, low: 2.0e-4, high: "
                     "4.0e-4, step: 1.0e-5}\n");
  const Identifiability known = examine(problem, problem.space().initial(), 3);
  EXPECT_TRUE(known.parameters[0].identifiable);
  EXPECT_TRUE(known.parameters[1].identifiable);
  EXPECT_FALSE(known.parameters[4].identifiable);
  ASSERT_FALSE(known.profiles.empty());
  EXPECT_EQ(known.profiles[0].parameter, 4u);
  for (const double fitness : known.profiles[0].fitness) {
    EXPECT_NEAR(fitness, known.profiles[0].fitness[0], 0.05 * known.profiles[0].fitness[0]);
  }
  EXPECT_EQ(equilibria_needed(40, 8, 3), 11);  // (5.13)
  EXPECT_EQ(equilibria_needed(7 * 4, 4, 3), 8);
  EXPECT_EQ(equilibria_needed(8, 2, 1), 6);  // a hinge
  EXPECT_EQ(equilibria_needed(8, 2, 0), 6);  // a rig without joints
}

TEST(Identifiability, ATendonThatIsJustTautTellsLittle) {
  // A flexor alone holds the arm; the extensor hangs through, however long it is.
  std::vector<MeasuredRun> runs;
  for (const double pull : {1.0, 2.0, 3.0}) {
    RecordingPlan p = plan(pull, -2.5, "equilibrium");
    p.force_noise = 0.2;
    p.seed = static_cast<std::uint64_t>(1000.0 * pull);
    runs.push_back(read_run(record_simulation(rig(), p), rig()));
    ASSERT_LT(std::abs(runs.back().after.force(0, 1)), 0.2);
  }
  const Problem problem = problem_of(runs, R"(
parameters:
  - {path: "muscles.*.rest_tendon_length", unit: m, range: 0.02, step: 0.001}
)");
  // The shortest at which it does not yet pull with more than the noise of its sensor.
  Point point = problem.space().initial();
  const auto tension = [&](double length) {
    point[1] = length;
    double most = 0.0;
    const auto all = simulate_runs(problem.build(point), runs, problem.options());
    for (std::size_t r = 0; r < runs.size(); ++r) {
      most = std::max(most, all[r].shown().force(0, 1) + runs[r].after.force(0, 1));
    }
    return most;
  };
  double taut = problem.space().parameters()[1].lower, slack = point[1];
  ASSERT_GT(tension(taut), 1.0);
  while (slack - taut > 1e-7 && !(tension(taut) > 0.05 && tension(taut) < 0.2)) {
    const double middle = 0.5 * (taut + slack);
    (tension(middle) > 0.1 ? taut : slack) = middle;
  }
  point[1] = taut;
  ASSERT_GT(tension(taut), 0.05);
  const Identifiability known = examine(problem, point, 2);
  EXPECT_TRUE(known.parameters[0].identifiable);
  EXPECT_FALSE(known.parameters[1].identifiable);
  ASSERT_EQ(known.profiles.size(), 1u);
  const Profile& profile = known.profiles.front();
  EXPECT_EQ(profile.parameter, 1u);
  EXPECT_LT(profile.fitness.back(), 1.2 * problem.fitness(point));  // longer: as good
}

}  // namespace
}  // namespace calibration
}  // namespace anthrob
