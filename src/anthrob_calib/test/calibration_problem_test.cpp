// The problem: how simulated runs are compared with recordings, what is left where.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <random>

#include "anthrob_calib/calibration/calibrate.h"
#include "anthrob_calib/calibration/difference_stack.h"
#include "anthrob_calib/calibration/extended_model.h"
#include "anthrob_calib/calibration/identifiability.h"
#include "anthrob_calib/calibration/problem.h"
#include "anthrob_calib/optimiser/journal.h"
#include "anthrob_calib/optimiser/optimiser.h"
#include "anthrob_calib/optimiser/problem_evaluator.h"
#include "anthrob_calib/report/calibration_report.h"
#include "anthrob_ecu/state_machine.h"
#include "anthrob_sim/core/errors.h"
#include "anthrob_sim/recording/unanswered.h"
#include "two_muscle_rig.h"

namespace anthrob {
namespace calibration {
namespace {

const char* const kParameters = R"(
parameters:
  - {path: "muscles.*.rest_tendon_length", unit: m, range: 0.006, step: 0.001}
  - {path: "muscles.*.spindle_radius", unit: m, low: 0.006, high: 0.0075, step: 0.0002}
)";

std::vector<MeasuredRun> runs_of(const std::shared_ptr<const RobotModel>& truth,
                                 const std::string& kind, double noise = 0.0) {
  std::vector<MeasuredRun> runs;
  int k = 0;
  for (const double shift : {-2.0, -1.0, 0.5, 1.0, 2.0}) {
    RecordingPlan p = plan(1.5 + shift, 1.5 - shift, kind);
    p.angle_noise = 0.01 * noise;
    p.force_noise = 0.2 * noise;
    p.seed = static_cast<std::uint64_t>(++k);
    runs.push_back(read_run(record_simulation(truth, p), rig()));
  }
  return runs;
}

Problem problem_of(std::vector<MeasuredRun> runs, const std::string& parameters = kParameters,
                   const Weights& weights = {}, const SimulationOptions& options = {}) {
  const ConfigNode model = ConfigNode::load(kModelFile);
  ParameterSpace space(ConfigNode::parse(parameters, "c.yaml"), model);
  return {model, space, std::move(runs), weights, options};
}

/// Rest and motion as long as the robot's: differences are noise only.
SimulationOptions as_recorded() {
  SimulationOptions options;
  options.settle = options.motion = 5.0;
  return options;
}

TEST(RunDifferences, AreMeansOfSquares) {
  Differences d;
  d.joints = 2;
  d.posture.resize(2, 4);
  d.posture << 0.3, 0.0, 0.4, 0.1, 0.0, 0.0, 0.0, -0.1;
  d.force.resize(2, 2);
  d.force << 1.0, -3.0, 0.0, 2.0;
  EXPECT_NEAR(d.posture_square(), (0.25 + 0.01 + 0.01) / 4.0, 1e-15);
  EXPECT_NEAR(d.force_square(), 14.0 / 4.0, 1e-15);
  Weights w;
  EXPECT_NEAR(d.fitness(w), 0.0675 + 1e-4 * 3.5, 1e-15);
  RunDifferences run{{}, {}, d};
  EXPECT_DOUBLE_EQ(run.fitness(w), d.fitness(w));
  run.path = d;
  run.before = d;
  run.before.posture *= 2.0;
  w.before = 2.0;
  EXPECT_NEAR(run.fitness(w), (2.0 * run.before.fitness(w) + 2.0 * d.fitness(w)) / 4.0, 1e-15);
  std::vector<double> r;
  run.append_residuals(w, 0.5, r);
  EXPECT_NEAR(std::inner_product(r.begin(), r.end(), r.begin(), 0.0), 0.5 * run.fitness(w), 1e-15);
}

TEST(RunDifferences, BallJointsByAngularDistance) {
  SkeletonModel skeleton;
  JointModel ball;
  ball.type = JointType::kBall;
  skeleton.joints = {ball};
  const Quat a(Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized()));
  const Quat b = a * Quat(Eigen::AngleAxisd(3.0, Vec3::UnitY()));
  const double from[] = {a.w(), a.x(), a.y(), a.z()};
  const double to[] = {-b.w(), -b.x(), -b.y(), -b.z()};
  double row[3];
  posture_row(skeleton, from, to, row);
  EXPECT_NEAR(row[0], 0.0, 1e-12);
  EXPECT_NEAR(row[1], 3.0, 1e-12);
  posture_row(skeleton, from, from, row);
  EXPECT_EQ(Vec3(row[0], row[1], row[2]).norm(), 0.0);
}

TEST(Chains, OneRunLeadsToTheOther) {
  MeasuredRun out, back, alone;
  out.start = {0.0}, out.commands = {{0.0, {1.0}}};
  back.start = {1.0}, back.commands = {{0.0, {0.0}}};
  alone.start = {7.0}, alone.commands = {{0.0, {0.0}}};
  const auto chains = chains_of({back, out, out, alone});
  ASSERT_EQ(chains.size(), 3u);
  EXPECT_EQ(chains[0].runs, (std::vector<int>{1, 0}));
  EXPECT_EQ(chains[1].runs, (std::vector<int>{2}));
  EXPECT_EQ(chains[2].runs, (std::vector<int>{3}));
  EXPECT_TRUE(chains[0].from_home);
  EXPECT_FALSE(chains[2].from_home);
}

TEST(Chains, APairBeginsWithTheRunThatComesFirst) {
  MeasuredRun out, back;
  out.start = {1.0}, out.commands = {{0.0, {0.0}}};
  back.start = {0.0}, back.commands = {{0.0, {1.0}}};
  const auto chains = chains_of({out, back});
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_EQ(chains[0].runs, (std::vector<int>{0, 1}));
  EXPECT_TRUE(chains[0].from_home);
}

TEST(Chains, DoNotDependOnTheOrderOfTheRuns) {
  const auto run = [](double from, double to) {
    MeasuredRun result;
    result.start = {from}, result.commands = {{0.0, {to}}};
    return result;
  };
  using Ways = std::vector<std::pair<double, double>>;
  std::vector<MeasuredRun> runs = {run(0, 1), run(1, 2), run(2, 3), run(0, 4),
                                   run(4, 0), run(0, 5), run(7, 8), run(8, 9)};
  const std::vector<Ways> expected = {
      {{0, 1}, {1, 2}, {2, 3}}, {{0, 4}, {4, 0}}, {{0, 5}}, {{7, 8}, {8, 9}}};
  std::mt19937 random(1);
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<Ways> found;
    for (const Chain& chain : chains_of(runs)) {
      found.emplace_back();
      for (const int r : chain.runs) {
        found.back().emplace_back(runs[r].start[0], runs[r].commands.back().reference[0]);
      }
      EXPECT_EQ(chain.from_home, found.back().front().first == 0.0);
    }
    std::sort(found.begin(), found.end());
    ASSERT_EQ(found, expected) << trial;
    std::shuffle(runs.begin(), runs.end(), random);
  }
}

TEST(Chains, OnesThatGoInCirclesBeginSomewhere) {
  MeasuredRun home, out, back;
  home.start = {0.0}, home.commands = {{0.0, {5.0}}};
  out.start = {1.0}, out.commands = {{0.0, {2.0}}};
  back.start = {2.0}, back.commands = {{0.0, {1.0}}};
  const auto chains = chains_of({home, out, back});
  ASSERT_EQ(chains.size(), 2u);
  EXPECT_EQ(chains[1].runs, (std::vector<int>{1, 2}));
  EXPECT_FALSE(chains[1].from_home);
}

TEST(SimulateRuns, StopWhereTheyAreAsked) {
  const std::vector<MeasuredRun> runs = runs_of(rig(), "trajectory");
  SimulationOptions options;
  options.settle = options.motion = 5.0;
  std::atomic<int> asked{0};
  simulate_runs(rig(), runs, options, [&] {
    ++asked;
    return false;
  });
  const int all = asked;
  EXPECT_GT(all, static_cast<int>(runs.size()));  // at rest and in each run
  for (const int last : {1, all}) {
    asked = 0;
    EXPECT_THROW(simulate_runs(rig(), runs, options, [&] { return ++asked >= last; }), Interrupted);
    EXPECT_LE(asked, all);
  }
}

TEST(SimulateRuns, EachRestsAsLongAsItsRobotDid) {
  std::vector<MeasuredRun> runs;
  for (const double settle : {0.2, 2.0, 0.7}) {  // rings go on relaxing
    RecordingPlan p = plan(3.0, 0.0, "equilibrium");
    p.settle = settle;
    runs.push_back(read_run(record_simulation(rig(), p), rig()));
  }
  SimulationOptions options;
  options.settle = options.motion = 5.0;
  for (const RunDifferences& run : simulate_runs(rig(), runs, options)) {
    EXPECT_LT(run.shown().posture.norm(), 1e-7);
    EXPECT_LT(run.shown().force.norm(), 1e-5);
  }
}

TEST(SimulateRuns, AReturnBeginsWhereImposedPositionsEnded) {
  RecordingPlan out = plan(4.0, -1.0, "trajectory"), other = plan(2.0, 0.0, "trajectory");
  RecordingPlan back = out;
  std::swap(back.from, back.to);
  std::vector<MeasuredRun> runs;
  for (const RecordingPlan& p : {out, other, back}) {
    runs.push_back(read_run(record_simulation(rig(), p), rig()));
  }
  SimulationOptions options;
  options.settle = options.motion = 5.0;
  options.drive = Drive::kSampledPositions;
  const auto differences = simulate_runs(rig(), runs, options);
  ASSERT_GT(differences[2].before.posture.size(), 0);
  EXPECT_LT(differences[2].before.posture.norm(), 0.02);
}

TEST(Problem, IsZeroAtTheTruthAndResidualsAddUp) {
  for (const char* kind : {"equilibrium", "trajectory"}) {
    const Problem problem = problem_of(runs_of(rig(), kind));
    std::vector<double> values = problem.space().initial();
    // What is left comes from means over time against single instants.
    EXPECT_LT(problem.fitness(values), 1e-6) << kind;
    values[0] += 0.002;
    const double fitness = problem.fitness(values);
    EXPECT_GT(fitness, 1e-4) << kind;
    const std::vector<double> r = problem.residuals(values);
    EXPECT_NEAR(std::inner_product(r.begin(), r.end(), r.begin(), 0.0), fitness, 1e-12);
    EXPECT_EQ(problem.fitness(values), fitness);
  }
}

TEST(Problem, AnImpossibleRobotIsInvalid) {
  const Problem problem = problem_of(
      runs_of(rig(), "equilibrium"),
      "parameters: [{path: muscles.flexor.path.2.cylinder.radius, unit: m, low: 0.001, high: 0.2, "
      "step: 0.001}]");
  EXPECT_TRUE(std::isfinite(problem.fitness(problem.space().initial())));
  EXPECT_TRUE(std::isinf(problem.fitness({0.15})));  // the insertion would lie inside
  EXPECT_TRUE(problem.residuals({0.15}).empty());
}

TEST(ParameterSpace, SharesFollowWhatTheyAreSharesOf) {
  const ConfigNode model = ConfigNode::load(kModelFile);
  const ParameterSpace space(ConfigNode::parse(R"(
parameters: [{path: joints.hinge.friction.static, unit: Nm, low: 0.0, high: 0.2, step: 0.01}]
shares: [{path: joints.hinge.friction.kinetic, of: joints.hinge.friction.static, low: 0.0, high: 1.0, step: 0.1}]
)",
                                               "c.yaml"),
                             model);
  EXPECT_NEAR(space.initial()[1], 0.8, 1e-12);
  const auto overrides = space.overrides({0.04, 0.5});
  EXPECT_DOUBLE_EQ(overrides.at("joints.hinge.friction.static"), 0.04);
  EXPECT_DOUBLE_EQ(overrides.at("joints.hinge.friction.kinetic"), 0.02);
}

TEST(ParameterSpace, NothingIsAShareOfAShare) {
  const auto error_of = [](const std::string& shares) -> std::string {
    const std::string text = R"(
parameters: [{path: joints.hinge.friction.viscous, unit: Nms, low: 0.0, high: 0.2, step: 0.01}]
shares:
)" + shares;
    try {
      ParameterSpace(ConfigNode::parse(text, "c.yaml"), ConfigNode::load(kModelFile));
    } catch (const BadInput& error) {
      return error.what();
    }
    return "";
  };
  const std::string numbers = ", low: 0.0, high: 100.0, step: 0.1}\n";
  const std::string kinetic =
      "  - {path: joints.hinge.friction.kinetic, of: joints.hinge.friction.viscous" + numbers;
  const std::string of_kinetic =
      "  - {path: joints.hinge.friction.static, of: joints.hinge.friction.kinetic" + numbers;
  const std::string of_itself =
      "  - {path: joints.hinge.friction.static, of: joints.hinge.friction.static" + numbers;
  EXPECT_EQ(error_of(kinetic), "");
  EXPECT_EQ(error_of(of_kinetic + kinetic),
            "c.yaml:4: shares.0.of: joints.hinge.friction.kinetic: expected the path of a number "
            "that is not a share itself");
  EXPECT_NE(error_of(kinetic + of_kinetic).find("shares.1.of: "), std::string::npos);
  EXPECT_NE(error_of(of_itself).find("shares.0.of: "), std::string::npos);
}

TEST(ParameterSpace, AnEntryThatNoListHasIsSaid) {
  const ConfigNode model = ConfigNode::load(kModelFile);
  for (const char* entry : {"99", "99999999999999999999999", "-1", "x", "1x"}) {
    try {
      number_at(model, std::string("muscles.flexor.path.") + entry + ".point.0");
      ADD_FAILURE() << entry;
    } catch (const BadInput& error) {
      EXPECT_NE(std::string(error.what()).find(std::string("has no entry ") + entry),
                std::string::npos)
          << error.what();
    }
  }
}

TEST(ParameterSpace, SharesHaveNoOtherKeys) {
  const ConfigNode config = ConfigNode::parse(R"(
parameters: [{path: joints.hinge.friction.static, unit: Nm, low: 0.0, high: 0.2, step: 0.01}]
shares:
  - {path: joints.hinge.friction.kinetic, of: joints.hinge.friction.static, low: 0.0, high: 1.0,
     step: 0.1, range: 0.1}
)",
                                              "c.yaml");
  config.ignore();  // as a configuration does before
  try {
    ParameterSpace(config, ConfigNode::load(kModelFile));
    ADD_FAILURE() << "accepted";
  } catch (const BadInput& error) {
    EXPECT_STREQ(error.what(), "c.yaml:5: shares.0.range: unknown key");
  }
}

TEST(ExtendedModel, ReadsBackAsTheSameRobot) {
  const std::string folder =
      (std::filesystem::temp_directory_path() / ("extended_" + std::to_string(getpid()))).string();
  std::filesystem::create_directories(folder);
  for (const char* name : {"/two_muscle_rig/model_II.yaml", "/anthrob/model_III_tier1.yaml"}) {
    const std::string base = ANTHROB_CONFIG_DIR + std::string(name);
    const bool rig_model = base.find("rig") != std::string::npos;
    const std::map<std::string, double> overrides =
        rig_model ? std::map<std::string, double>{{"muscles.flexor.path.2.cylinder.radius", 0.0171},
                                                  {"muscles.extensor.spindle_radius", 0.00677},
                                                  {"joints.hinge.friction.viscous", 0.0213}}
                  : std::map<std::string, double>{
                        {"muscles.posterior_deltoid.path.3.mesh.offset.1", 0.0003}};
    const ConfigNode model = ConfigNode::load(base);
    std::ofstream(folder + "/model.yaml")
        << extended_model_text(model, base, overrides, folder, "By a test.");
    const ConfigNode extended = ConfigNode::load(folder + "/model.yaml");
    for (const auto& [path, value] : overrides) EXPECT_EQ(number_at(extended, path), value) << path;
    EXPECT_NO_THROW(build_robot_model(extended));
  }
  std::filesystem::remove_all(folder);
}

TEST(ExtendedModel, NamesFilesWhateverTheirFoldersAreCalled) {
  namespace fs = std::filesystem;
  const fs::path root = fs::temp_directory_path() / ("named_" + std::to_string(getpid()));
  for (const char* name : {"run #2: a", "[one], 'two' & \"three\"", "back\\slash", "- {x}"}) {
    const fs::path robot = root / name;
    fs::create_directories(robot);
    fs::copy(ANTHROB_CONFIG_DIR "/anthrob", robot, fs::copy_options::recursive);
    const std::string base = (robot / "model_III_tier1.yaml").string();
    fs::create_directories(root / "out");
    const std::string file = (root / "out/model.yaml").string();
    std::ofstream(file) << extended_model_text(
        ConfigNode::load(base), base, {{"muscles.posterior_deltoid.path.3.mesh.offset.1", 0.0003}},
        (root / "out").string(), "By a test.");
    EXPECT_NO_THROW(load_robot_model(file)) << name;
    fs::remove_all(root);
  }
}

TEST(Calibration, LeastSquaresFindsForgottenParameters) {
  const std::vector<double> truth = {0.3635, 0.3668, 0.0068, 0.0066};
  const Problem blank = problem_of({});
  Problem problem = problem_of(runs_of(blank.build(truth), "equilibrium"));
  ProblemEvaluator evaluator(problem);
  OptimiserSettings settings;
  settings.method = "least_squares";
  settings.generations = 20;
  const SearchResult result =
      make_optimiser(settings)->minimise(search_variables(problem.space()), evaluator);
  EXPECT_LT(result.fitness, 1e-6);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_NEAR(result.best[i], truth[i], i < 2 ? 2e-4 : 4e-5) << i;
  }
}

TEST(DifferenceStack, ListsWhatTheFitMinimises) {
  Weights uneven;
  uneven.before = 2.0, uneven.path = 0.5, uneven.after = 0.0;
  for (const Weights& weights : {Weights{}, uneven}) {
    for (const char* kind : {"equilibrium", "trajectory"}) {
      const Problem problem = problem_of(runs_of(rig(), kind, 1.0), kParameters, weights);
      Point point = problem.space().initial();
      point[0] += 0.001;
      DifferenceStack stack(problem, [] {});
      const std::vector<double> list = stack.describe(point);
      EXPECT_EQ(list, problem.residuals(point)) << kind;
      EXPECT_EQ(stack.residuals({point}).front(), list) << kind;
      EXPECT_NEAR(std::inner_product(list.begin(), list.end(), list.begin(), 0.0),
                  problem.fitness(point), 1e-12);
      ASSERT_EQ(stack.rows.size(), list.size());
      for (const DifferenceStack::Row& row : stack.rows) {
        EXPECT_GE(row.instant, 0);
        EXPECT_LT(row.instant, stack.instants);
      }
    }
  }
}

/// Rows of the means, those before the runs and those after.
std::vector<DifferenceStack::Row> means_of(const Problem& problem, const Point& point) {
  DifferenceStack stack(problem, [] {});
  stack.describe(point);
  std::vector<DifferenceStack::Row> means;
  for (const DifferenceStack::Row& row : stack.rows) {
    if (!row.is_typical) means.push_back(row);
  }
  return means;
}

TEST(DifferenceStack, MeansHaveLessOfTheNoiseThatChanges) {
  const Problem problem =
      problem_of(runs_of(rig(), "trajectory", 1.0), kParameters, {}, as_recorded());
  const auto means = means_of(problem, problem.space().initial());
  ASSERT_EQ(means.size(), 5u * 2u * 3u);  // before and after: one joint, two muscles
  for (const DifferenceStack::Row& row : means) {
    // Of 21 measurements, without a memory.
    EXPECT_GT(row.deviation, 0.9 / std::sqrt(21.0));
    EXPECT_LT(row.deviation, 0.5);
    EXPECT_EQ(row.repetition, 1.0);
    EXPECT_FALSE(row.related.empty());
    for (const auto& [other, covariance] : row.related) {
      EXPECT_GT(covariance, 0.0);
      EXPECT_LE(covariance, 1.0);
    }
  }
}

TEST(DifferenceStack, NoiseDoesNotHideHowLongErrorsLast) {
  const Problem problem =
      problem_of(runs_of(rig(), "trajectory", 1.0), kParameters, {}, as_recorded());
  const auto repetition_at = [&](double shift) {
    Point point = problem.space().initial();
    point[0] += shift;
    DifferenceStack stack(problem, [] {});
    stack.describe(point);
    return stack.repetition;
  };
  for (const double noise_only : repetition_at(0.0)) EXPECT_LT(noise_only, 2.0);
  // An error of the angle about as large as its noise, which stays for all of the path.
  EXPECT_GT(repetition_at(0.0005)[DifferenceStack::kPosture], 20.0);
}

TEST(DifferenceStack, MeansKeepErrorsThatStay) {
  const Problem problem = problem_of(runs_of(rig(), "trajectory"));
  Point point = problem.space().initial();
  point[0] += 0.003;
  for (const DifferenceStack::Row& row : means_of(problem, point)) {
    EXPECT_GT(row.deviation, 0.7);
    EXPECT_GT(row.related.size(), 20u);
  }
}

TEST(DifferenceStack, MeansAreTheNoiseWhereNoPathIsFitted) {
  Weights ends;
  ends.path = 0.0;
  const Problem problem = problem_of(runs_of(rig(), "trajectory", 1.0), kParameters, ends);
  DifferenceStack stack(problem, [] {});
  stack.describe(problem.space().initial());
  int typical = 0;
  for (const DifferenceStack::Row& row : stack.rows) {
    EXPECT_EQ(row.is_typical, row.weight > 0.0);
    EXPECT_EQ(row.deviation, 1.0);
    typical += row.is_typical ? 1 : 0;
  }
  EXPECT_EQ(typical, 5 * 2 * 3);
}

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
  EXPECT_EQ(equilibria_needed(40, 8), 11);  // (5.13)
  EXPECT_EQ(equilibria_needed(7 * 4, 4), 8);
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

/// What follows a search, with a stop that fails as a simulation does.
class Conclusion : public testing::Test {
 protected:
  Conclusion()
      : folder_(std::filesystem::temp_directory_path() /
                ("conclusion_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
    LoadOptions truth;
    truth.overrides = {{"muscles.flexor.rest_tendon_length", kTruth}};
    record_simulation(load_robot_model(kModelFile, truth), plan(2.0, 0.0, "trajectory"))
        .save((folder_ / "data/T1").string());
    std::ofstream((folder_ / "c.yaml").string())
        << "model: " << kModelFile << "\nrecordings: trajectories\n"
        << "simulate: {settle: 0.5, motion: 0.5}\n"
        << "optimiser: {method: evolution_strategy, parents: 2, offspring: 8, generations: 5, "
           "seed: 3}\n"
        << "parameters:\n  - {path: muscles.flexor.rest_tendon_length, unit: m, range: 0.006, "
           "step: 0.001}\n";
  }
  ~Conclusion() override { std::filesystem::remove_all(folder_); }

  /// @param found whether the search has found the truth
  CalibrationOutcome conclude_after(bool found, const Stop& stop) const {
    const auto input =
        CalibrationInput::read(CalibrationConfig::load((folder_ / "c.yaml").string()),
                               (folder_ / "data").string(), "", {});
    const Problem problem = input.problem();
    ProblemEvaluator evaluator(problem);
    Journal journal(evaluator, Journal::Options());
    if (found) journal.fitness(std::vector<Point>{Point{kTruth}});
    return conclude(input, problem, journal, "", false, stop);
  }

  static constexpr double kTruth = 0.3625;
  std::filesystem::path folder_;
};

TEST_F(Conclusion, OneModelThatCannotBeSimulatedTakesNothingFromTheOther) {
  int asked = 0;
  const CalibrationOutcome outcome = conclude_after(true, [&] {
    if (++asked == 1) throw NumericalFailure(1.0, "body x", "not finite");
    return false;
  });
  EXPECT_LT(outcome.fitness, outcome.fitness_before);
  EXPECT_TRUE(outcome.calibration.before.empty());
  ASSERT_EQ(outcome.calibration.runs.size(), 1u);
  ASSERT_EQ(outcome.calibration.after.size(), 1u);
  EXPECT_LT(outcome.calibration.after[0].path.posture.norm(), 0.1);
  EXPECT_NE(outcome.doubt.find("body x"), std::string::npos) << outcome.doubt;
}

TEST_F(Conclusion, WhatFailsTwiceIsSaidOnce) {
  const CalibrationOutcome outcome =
      conclude_after(true, []() -> bool { throw NumericalFailure(1.0, "body x", "not finite"); });
  EXPECT_TRUE(outcome.calibration.runs.empty());
  const std::size_t first = outcome.doubt.find("body x");
  ASSERT_NE(first, std::string::npos) << outcome.doubt;
  EXPECT_EQ(outcome.doubt.find("body x", first + 1), std::string::npos) << outcome.doubt;
}

TEST_F(Conclusion, TheSameModelIsSimulatedOnce) {
  int once = 0, twice = 0;
  const CalibrationOutcome same = conclude_after(false, [&] { return ++once < 0; });
  const CalibrationOutcome other = conclude_after(true, [&] { return ++twice < 0; });
  EXPECT_GT(once, 0);
  EXPECT_EQ(twice, 2 * once);
  ASSERT_EQ(same.calibration.after.size(), 1u);
  EXPECT_EQ(same.calibration.after[0].path.posture, same.calibration.before[0].path.posture);
  EXPECT_FALSE(other.interrupted);
}

TEST_F(Conclusion, KeepsWhatItHasWhenItIsInterrupted) {
  int asked = 0, all = 0;
  conclude_after(true, [&] { return ++all < 0; });
  const CalibrationOutcome outcome = conclude_after(true, [&] { return ++asked >= all; });
  EXPECT_TRUE(outcome.interrupted);
  EXPECT_EQ(outcome.calibration.before.size(), 1u);
  EXPECT_TRUE(outcome.calibration.after.empty());
  EXPECT_NE(outcome.doubt.find("interrupted before the errors on all recordings"),
            std::string::npos)
      << outcome.doubt;
}

TEST(CalibrationReport, TellsRecordingsThatCannotBeSimulatedFromNone) {
  CalibrationOutcome outcome;
  EXPECT_NE(report_html(outcome).find("None were given (--validation)"), std::string::npos);
  outcome.held_out = true;
  outcome.doubt = "some results could not be computed: of numbers";
  const std::string page = report_html(outcome);
  EXPECT_EQ(page.find("None were given"), std::string::npos);
  EXPECT_NE(page.find("could not be simulated"), std::string::npos);
}

TEST(CalibrationReport, HasTheErrorsOfParametersWhereNoRecordingCouldBeReplayed) {
  CalibrationOutcome outcome;
  outcome.parameters.resize(1);
  outcome.parameters[0].path = "joints.elbow.friction.viscous";
  outcome.parameters[0].upper = 1.0;
  outcome.best = {0.5};
  outcome.identifiability.parameters = {{0.01, 0.3, 10.0, true}};
  outcome.identifiability.singular_values = Eigen::VectorXd::Ones(1);
  outcome.identifiability.flattest = {1.0};
  EXPECT_NE(report_html(outcome).find("1 of 1 parameters are identifiable"), std::string::npos);
}

TEST(CalibrationReport, HasWhatOneOfTheModelsDoes) {
  CalibrationOutcome outcome;
  outcome.model = rig();
  outcome.held_out = true;
  outcome.validation.runs = runs_of(rig(), "trajectory");
  outcome.validation.after = simulate_runs(rig(), outcome.validation.runs, {});
  outcome.calibration.runs = outcome.validation.runs;
  outcome.calibration.before = outcome.validation.after;
  const std::string page = report_html(outcome);
  EXPECT_NE(page.find("On held-out recordings"), std::string::npos);
  EXPECT_NE(page.find("(before: not simulated)"), std::string::npos);
  EXPECT_NE(summary(outcome).find("force not simulated -> "), std::string::npos);
  EXPECT_NE(summary(outcome).find("-> not simulated N"), std::string::npos);
  const auto json = nlohmann::json::parse(result_json(outcome));
  for (const auto& [part, missing, present] : {std::array{"validation", "before", "after"},
                                               std::array{"calibration", "after", "before"}}) {
    EXPECT_TRUE(json[part]["mean"][missing].is_null()) << part;
    EXPECT_TRUE(json[part]["mean"][present]["force_N"].is_number()) << part;
    EXPECT_TRUE(json[part]["runs"][0][missing].is_null()) << part;
    EXPECT_TRUE(json[part]["runs"][0][present].is_object()) << part;
  }
}

TEST(CalibrationReport, NamesWhatChangesNothingAlsoInBrief) {
  CalibrationOutcome outcome;
  outcome.parameters.resize(2);
  outcome.parameters[0].path = "joints.elbow.friction.viscous";
  outcome.parameters[1].path = "joints.elbow.friction.coulomb";
  outcome.best = {0.5, 0.5};
  for (ModelParameter& p : outcome.parameters) p.upper = 1.0;
  EXPECT_TRUE(insensitive_parameters(outcome).empty());  // by a search without derivatives
  EXPECT_EQ(report_html(outcome).find("<b>no</b>"), std::string::npos);
  outcome.sensitivity = {3.0, 1e-9};
  EXPECT_EQ(insensitive_parameters(outcome), std::vector<std::string>{"elbow.friction.coulomb"});
  const std::string page = report_html(outcome);
  const std::size_t name = page.find("elbow.friction.coulomb"), no = page.find("<b>no</b>");
  ASSERT_NE(name, std::string::npos);
  ASSERT_NE(no, std::string::npos);
  EXPECT_GT(no, name);
}

}  // namespace
}  // namespace calibration
}  // namespace anthrob
