// Parameters are forgotten and found again; intervals have to cover the truth as often as they say.
// A few seeds as a rule; ANTHROB_SEEDS=20 is the campaign of studies/measurements.md, with the arm,
// too.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "anthrob_sim/statics/equilibrium.h"
#include "calibration/identifiability.h"
#include "calibration/problem_evaluator.h"
#include "campaign.h"
#include "optimiser/optimiser.h"
#include "simulated_recordings.h"

namespace anthrob {
namespace calibration {
namespace {

/// A robot, what of it is forgotten, and where it goes.
struct Trial {
  std::string model_file, parameters;
  std::vector<double> home;
  std::vector<std::vector<double>> references;
  double duration = 1.0;  ///< of a run after its command, recorded and simulated alike [s]
  std::string kind = "equilibrium";
  bool last_is_blind = true;  ///< nothing tells the last parameter
};

Trial rig_trial() {
  Trial trial{std::string(ANTHROB_CONFIG_DIR) + "/two_muscle_rig/model_II.yaml",
              R"(parameters:
  - {path: "muscles.*.rest_tendon_length", unit: m, range: 0.006, step: 0.001}
  - {path: "muscles.*.spindle_radius", unit: m, range: 0.0005, step: 0.0001}
  - {path: actuators.motor.motor.inductance, unit: H, low: 2.0e-4, high: 4.0e-4, step: 1.0e-5}
)",
              {1.5, 1.5},
              {}};
  for (const double shift : {-1.8, 0.6, 1.5}) {
    for (const double pull : {1.2, 2.0}) trial.references.push_back({pull + shift, pull - shift});
  }
  return trial;
}

/// The same from trajectories: paths and the postures at rest before and after them, weighted
/// alike.
Trial rig_path_trial() {
  Trial trial = rig_trial();
  trial.parameters = R"(parameters:
  - {path: "muscles.*.rest_tendon_length", unit: m, range: 0.006, step: 0.001}
  - {path: "muscles.*.spindle_radius", unit: m, range: 0.0005, step: 0.0001}
)";
  trial.kind = "trajectory";
  trial.last_is_blind = false;
  return trial;
}

/// Tier 1, model I: rest lengths and spindle radii of eight muscles, 17 equilibria.
Trial arm_trial() {
  const std::string folder = std::string(ANTHROB_CONFIG_DIR) + "/anthrob/";
  Trial trial{folder + "model_I_tier1.yaml",
              R"(parameters:
  - {path: "muscles.*.rest_tendon_length", unit: m, range: 0.006, step: 0.001}
  - {path: "muscles.*.spindle_radius", unit: m, range: 0.0005, step: 0.0001}
  - {path: actuators.unit_a.motor.inductance, unit: H, low: 4.0e-5, high: 8.0e-5, step: 1.0e-6}
)",
              {},
              {},
              1.5};
  Simulation sim(load_robot_model(trial.model_file));
  const ConfigNode file = ConfigNode::load(folder + "equilibria_tier1.yaml");
  for (const ConfigNode& posture : file.at("postures").items()) {
    std::vector<double> q;
    for (const ConfigNode& x : posture.at("joints").at("shoulder").items()) {
      q.push_back(x.as_number(Bounds::any(), "1"));
    }
    trial.references.push_back(find_equilibrium(sim, q).reference);
  }
  trial.home = trial.references.front();
  return trial;
}

/// Counts over seeds and parameters.
struct Tally {
  int identifiable = 0, covered = 0, unidentifiable = 0, flat = 0;
  int blind = 0;         ///< seeds in which what no posture tells was called identifiable
  double worst = 0.0;    ///< error of an identifiable parameter, in sigmas
  double squares = 0.0;  ///< of those errors
};

/// Whether the fitness hardly rises on one side.
bool is_flat(const Profile& profile) {
  const auto& f = profile.fitness;
  const double least = *std::min_element(f.begin(), f.end());
  return std::min(f.front(), f.back()) < 1.2 * least;
}

void run_seed(const Trial& trial, std::uint64_t seed, Tally& tally) {
  const ConfigNode model = ConfigNode::load(trial.model_file);
  const ParameterSpace space(ConfigNode::parse(trial.parameters, "trial"), model);
  const CounterRandom random(seed, 99);
  std::vector<double> truth;
  for (std::size_t i = 0; i < space.size(); ++i) {
    const ModelParameter& p = space.parameters()[i];
    truth.push_back(p.lower + p.range() * (0.15 + 0.7 * random.uniform(i)));
  }
  const SimulationOptions options{2.0, 2.0};
  const Problem blank(model, space, {}, {}, options);
  const auto robot = blank.build(truth), plain = load_robot_model(trial.model_file);
  std::vector<MeasuredRun> runs;
  for (const auto& references : trial.references) {
    RecordingPlan plan;
    plan.from = trial.home;
    plan.to = references;
    plan.settle = options.settle - plan.lead;  // rings go on relaxing: the same time for both
    plan.duration = trial.duration;
    plan.kind = trial.kind;
    plan.angle_noise = 0.0035;  // motion capture
    plan.force_noise = 0.3;
    plan.seed = 1000 * seed + runs.size();
    runs.push_back(read_run(record_simulation(robot, plan), plain));
  }
  const Problem problem(model, space, runs, {}, options);
  ProblemEvaluator evaluator(problem);
  OptimiserSettings settings;
  settings.method = "least_squares";
  settings.generations = 60;
  const Point best =
      make_optimiser(settings)->minimise(search_variables(problem.space()), evaluator).best;
  const Identifiability known = examine(problem, best, static_cast<int>(truth.size()));
  tally.blind += trial.last_is_blind && known.parameters.back().identifiable ? 1 : 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const ParameterKnowledge& k = known.parameters[i];
    if (!k.identifiable) {
      ++tally.unidentifiable;
      continue;
    }
    ++tally.identifiable;
    const identification::Estimate estimate = interval(known, i, best[i]);
    const double error = std::abs(best[i] - truth[i]) / estimate.sigma;
    tally.covered += estimate.lo <= truth[i] && truth[i] <= estimate.hi ? 1 : 0;
    EXPECT_LT(error, 5.0) << i;
    EXPECT_LT(estimate.hi - estimate.lo, 1.2 * k.prior_sigma) << i;  // 0.3 of its range's interval
    tally.worst = std::max(tally.worst, error);
    tally.squares += error * error;
  }
  for (const Profile& profile : known.profiles) tally.flat += is_flat(profile) ? 1 : 0;
}

void recover(const char* name, const Trial& trial, int seeds) {
  Tally tally;
  for (int seed = 1; seed <= seeds; ++seed) {
    run_seed(trial, seed, tally);
    std::printf("seed %d: covered %d of %d, worst %.1f sigma\n", seed, tally.covered,
                tally.identifiable, tally.worst);
    fflush(stdout);
  }
  std::printf("| %s | %d | %d of %d (%.1f %%) | %.1f sigma | %d of %d |\n", name, seeds,
              tally.covered, tally.identifiable, 100.0 * tally.covered / tally.identifiable,
              tally.worst, tally.flat, tally.unidentifiable);
  EXPECT_EQ(tally.blind, 0);
  EXPECT_GT(tally.identifiable, 2 * tally.unidentifiable);  // caution costs little
  EXPECT_EQ(tally.flat, tally.unidentifiable);
  // Intervals are as wide as they have to be, and no wider; a few parameters scatter.
  const double score = std::sqrt(tally.squares / tally.identifiable);
  std::printf("errors in sigmas, root mean square: %.2f\n", score);
  EXPECT_GT(score, seeds < 20 ? 0.3 : 0.6);
  EXPECT_LT(score, seeds < 20 ? 2.0 : 1.5);
  EXPECT_GE(tally.covered, 0.75 * tally.identifiable);
  if (seeds < 20) return;
  EXPECT_GE(tally.covered, 0.90 * tally.identifiable);
  EXPECT_LE(tally.covered, 0.99 * tally.identifiable);
}

TEST(Recovery, OfTheTwoMuscleRig) {
  recover("two_muscle_rig II", rig_trial(), seed_count(1));
}

TEST(Recovery, OfTheTwoMuscleRigFromTrajectories) {
  recover("two_muscle_rig II, trajectories", rig_path_trial(), seed_count(4));
}

TEST(Recovery, OfTheShoulder) {
  if (!std::getenv("ANTHROB_SEEDS")) GTEST_SKIP() << "part of the campaign";
  recover("anthrob I, tier 1", arm_trial(), seed_count(0));
}

}  // namespace
}  // namespace calibration
}  // namespace anthrob
