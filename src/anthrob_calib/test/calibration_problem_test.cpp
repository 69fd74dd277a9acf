// The problem: how simulated runs are compared with recordings, what is left where.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numeric>

#include "anthrob_calib/calibration/extended_model.h"
#include "anthrob_calib/calibration/identifiability.h"
#include "anthrob_calib/calibration/problem.h"
#include "anthrob_calib/optimiser/optimiser.h"
#include "anthrob_calib/optimiser/problem_evaluator.h"
#include "anthrob_calib/report/calibration_report.h"
#include "anthrob_ecu/state_machine.h"
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

Problem problem_of(std::vector<MeasuredRun> runs, const std::string& parameters = kParameters) {
  const ConfigNode model = ConfigNode::load(kModelFile);
  ParameterSpace space(ConfigNode::parse(parameters, "c.yaml"), model);
  return {model, space, std::move(runs), {}, {}};
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

TEST(CalibrationReport, TellsRecordingsThatCannotBeSimulatedFromNone) {
  CalibrationOutcome outcome;
  EXPECT_NE(report_html(outcome).find("None were given (--validation)"), std::string::npos);
  outcome.held_out = true;
  outcome.doubt = "some results could not be computed: of numbers";
  const std::string page = report_html(outcome);
  EXPECT_EQ(page.find("None were given"), std::string::npos);
  EXPECT_NE(page.find("could not be simulated"), std::string::npos);
}

TEST(CalibrationReport, NamesWhatChangesNothingAlsoInBrief) {
  CalibrationOutcome outcome;
  outcome.parameters.resize(2);
  outcome.parameters[0].path = "joints.elbow.friction.viscous";
  outcome.parameters[1].path = "joints.elbow.friction.coulomb";
  outcome.best = {0.5, 0.5};
  for (ModelParameter& p : outcome.parameters) p.upper = 1.0;
  EXPECT_TRUE(untold(outcome).empty());  // by a search without derivatives
  EXPECT_EQ(report_html(outcome).find("<b>no</b>"), std::string::npos);
  outcome.sensitivity = {3.0, 1e-9};
  EXPECT_EQ(untold(outcome), std::vector<std::string>{"elbow.friction.coulomb"});
  const std::string page = report_html(outcome);
  const std::size_t name = page.find("elbow.friction.coulomb"), no = page.find("<b>no</b>");
  ASSERT_NE(name, std::string::npos);
  ASSERT_NE(no, std::string::npos);
  EXPECT_GT(no, name);
}

}  // namespace
}  // namespace calibration
}  // namespace anthrob
