#include "calibration/calibrate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "anthrob_calib/resume/fingerprint.h"
#include "anthrob_recording/dataset.h"
#include "anthrob_sim/core/errors.h"

namespace anthrob {
namespace calibration {

namespace {

/// Version of the comparison, part of the fingerprint of a journal. Increase it with every change.
constexpr int kComparison = 7;

void add(const std::vector<double>& values, resume::Fingerprint& fingerprint) {
  fingerprint.add(values.data(), values.size() * sizeof(double));
}

void add(const Samples& samples, resume::Fingerprint& fingerprint) {
  add(samples.t, fingerprint);
  for (const Eigen::MatrixXd* values : {&samples.q, &samples.force, &samples.position}) {
    fingerprint.add(values->data(), static_cast<std::size_t>(values->size()) * sizeof(double));
  }
}

void add(const MeasuredRun& run, resume::Fingerprint& fingerprint) {
  add(run.start, fingerprint);
  fingerprint.add(run.settle).add(run.lead);
  for (const Command& command : run.commands) {
    fingerprint.add(command.t);
    add(command.reference, fingerprint);
  }
  for (const Samples* samples : {&run.before, &run.path, &run.after}) add(*samples, fingerprint);
}

/// Refuses held-out runs that are also among those to fit, whatever their names.
void keep_apart(const std::vector<MeasuredRun>& validation, const std::string& validation_folder,
                const std::vector<MeasuredRun>& runs, const std::string& folder) {
  // The recording is the same, or what is fitted of it: a copy may lack columns.
  const auto used_of = [](const MeasuredRun& run) {
    resume::Fingerprint fingerprint;
    add(run, fingerprint);
    return fingerprint.value();
  };
  for (const MeasuredRun& run : validation) {
    const auto same = std::find_if(runs.begin(), runs.end(), [&](const MeasuredRun& fitted) {
      return run.content == fitted.content || used_of(run) == used_of(fitted);
    });
    if (same == runs.end()) continue;
    throw BadInput(validation_folder + ": " + run.name + " is the same recording as " + same->name +
                   " of " + folder +
                   ", which is fitted; expected other recordings for --validation");
  }
}

/// Entries of a list are found by their index, and in another model the same index may be another
/// point of the path. So the value before the calibration must equal that of this model.
/// @param given values in the file of the calibrated model, by path
/// @param own value in this model
void require_same_place(const nlohmann::json& given, const std::string& path, double own,
                        const std::string& file, const ConfigNode& model) {
  const bool in_list = path.find(".path.") != std::string::npos;
  if (!in_list || !given.contains(path) || !given[path].is_number()) return;
  const double then = given[path].get<double>();
  if (then == own) return;
  throw BadInput(file + ": " + path + ": was calibrated from " + exact_text(then) + ", but " +
                 model.file() + " has " + exact_text(own) +
                 " there; expected the result of a model whose path has the same points");
}

/// Takes over the numbers of an earlier calibration that also exist in this model.
/// @param own the model file without them
void take_over(const std::string& file, const ConfigNode& own, ConfigNode& model,
               std::map<std::string, double>& numbers) {
  std::ifstream in(file);
  if (!in || !std::filesystem::is_regular_file(file)) {
    throw BadInput(file + ": cannot be read; expected the result.json of a calibration");
  }
  const auto json = nlohmann::json::parse(in, nullptr, false);
  if (json.is_discarded() || !json.contains("overrides") || !json["overrides"].is_object()) {
    throw BadInput(file + ": not the result of a calibration; expected a map 'overrides'");
  }
  int taken = 0;
  for (const auto& [path, value] : json["overrides"].items()) {
    if (!value.is_number()) throw BadInput(file + ": overrides: " + path + ": expected a number");
    double before = 0.0;
    try {
      before = number_at(own, path);
    } catch (const BadInput&) {
      continue;  // a part that this model has not
    }
    require_same_place(json.value("given", nlohmann::json::object()), path, before, file, own);
    model.set_number(path, value.get<double>());
    numbers[path] = value.get<double>();
    ++taken;
  }
  if (taken == 0) throw BadInput(file + ": none of its overrides exists in " + model.file());
}

/// Rest and motion as long as the robot's.
SimulationOptions as_recorded() {
  SimulationOptions options;
  options.settle = options.motion = HUGE_VAL;
  return options;
}

/// Mean square of the errors of joints that turn [rad^2]; NaN if all slide.
double turning_square(const Differences& differences, const SkeletonModel& skeleton) {
  double sum = 0.0;
  int count = 0;
  for (const JointModel& joint : skeleton.joints) {
    if (joint.type == JointType::kPrismatic) continue;
    for (const double error : differences.joint_error(joint)) sum += error * error;
    count += differences.count();
  }
  return sum / count;
}

DriveErrors errors_with(Drive drive, const char* name, const Problem& problem, const Point& best,
                        const std::vector<MeasuredRun>& runs, const Stop& stop) {
  SimulationOptions options = as_recorded();
  options.drive = drive;
  DriveErrors errors{name};
  const auto model = problem.build(best);
  const auto all = simulate_runs(model, runs, options, stop);
  for (const RunDifferences& run : all) {
    errors.posture +=
        turning_square(run.shown(), *model->skeleton) / static_cast<double>(all.size());
    errors.force += run.shown().force_square() / static_cast<double>(all.size());
    if (run.shown().actuator.size() > 0) {
      errors.actuator = std::max(errors.actuator, run.shown().actuator.cwiseAbs().maxCoeff());
    }
  }
  errors.posture = std::sqrt(errors.posture);
  errors.force = std::sqrt(errors.force);
  return errors;
}

/// CalibrationOutcome::moves_on, from the replays in full length.
double moves_on(const Problem& problem, const CalibrationOutcome& outcome, const Stop& stop) {
  std::vector<RunDifferences> moved = outcome.calibration.after;
  if (moved.empty() || problem.runs().front().is_trajectory) return 0.0;
  const auto early =
      simulate_runs(problem.build(outcome.best), problem.runs(), outcome.simulation, stop);
  double sum = 0.0;
  for (std::size_t r = 0; r < moved.size(); ++r) {
    moved[r].after.posture -= early[r].after.posture;
    moved[r].after.force -= early[r].after.force;
    sum += moved[r].fitness(outcome.weights);
  }
  return sum / static_cast<double>(moved.size());
}

std::vector<DriveErrors> compare_drives(const Problem& problem, const Point& best,
                                        const std::vector<MeasuredRun>& runs, const Stop& stop) {
  std::vector<DriveErrors> errors;
  const auto add_drive = [&](Drive drive, const char* name) {
    errors.push_back(errors_with(drive, name, problem, best, runs, stop));
  };
  add_drive(Drive::kReferences, "commanded references");
  const bool measured = std::all_of(runs.begin(), runs.end(), [](const MeasuredRun& run) {
    return run.is_trajectory && run.after.position.cols() > 0;
  });
  if (!measured) return errors;
  add_drive(Drive::kFinalPositions, "final actuator positions as references");
  add_drive(Drive::kSampledPositions, "every sampled actuator position");
  return errors;
}

}  // namespace

CalibrationInput CalibrationInput::read(CalibrationConfig config, const Recordings& data,
                                        const Recordings& validation,
                                        const std::vector<std::string>& start) {
  const ConfigNode own = ConfigNode::load(config.model_file);
  ConfigNode model = own.clone();
  std::map<std::string, double> started;
  for (const std::string& file : start) take_over(file, own, model, started);
  const auto robot = build_robot_model(model);
  CalibrationInput input{std::move(config), model, std::move(started), {}, {}};
  input.runs = read_runs(data.list, robot);
  input.config.check(input.runs, data.from);
  input.validation = read_runs(validation.list, robot);
  keep_apart(input.validation, validation.from, input.runs, data.from);
  return input;
}

Problem CalibrationInput::problem() const {
  return {model, ParameterSpace(config.node, model), runs, config.weights, config.simulation};
}

std::string CalibrationInput::fingerprint() const {
  resume::Fingerprint fingerprint;
  fingerprint.add(config.node.at("parameters").to_yaml());
  if (config.node.has("shares")) fingerprint.add(config.node.at("shares").to_yaml());
  fingerprint.add(resume::model_fingerprint(model));
  const Weights& w = config.weights;
  const OptimiserSettings& o = config.optimiser;
  add({w.posture, w.force, w.before, w.path, w.after, config.simulation.settle,
       config.simulation.motion, static_cast<double>(o.parents), static_cast<double>(o.offspring),
       o.target, static_cast<double>(o.seed)},
      fingerprint);
  fingerprint.add(o.method).add(&kComparison, sizeof(kComparison));
  for (const MeasuredRun& run : runs) add(run, fingerprint);
  char digits[20];
  std::snprintf(digits, sizeof(digits), "%016llx",
                static_cast<unsigned long long>(fingerprint.value()));
  return digits;
}

CalibrationOutcome conclude(const CalibrationInput& input, const Problem& problem,
                            const Journal& journal, const std::string& reason, bool thorough,
                            const Stop& stop) {
  CalibrationOutcome outcome;
  outcome.config_file = input.config.file;
  outcome.model_file = input.config.model_file;
  outcome.optimiser = input.config.optimiser;
  outcome.weights = input.config.weights;
  outcome.simulation = input.config.simulation;
  outcome.parameters = problem.space().parameters();
  const Point initial = problem.space().initial();
  outcome.fitness_before = problem.fitness(initial);
  outcome.fitness = journal.best_fitness();
  outcome.best = journal.best();
  // Not every optimiser evaluates the start, and the result must not be worse than that.
  if (outcome.best.empty() || outcome.fitness_before < outcome.fitness) {
    outcome.best = initial;
    outcome.fitness = outcome.fitness_before;
  }
  outcome.model = problem.build(outcome.best);
  outcome.overrides = input.started;
  for (const auto& [path, value] : problem.space().overrides(outcome.best)) {
    outcome.overrides[path] = value;
  }
  const ConfigNode own = ConfigNode::load(input.config.model_file);
  for (const auto& [path, value] : outcome.overrides) outcome.given[path] = number_at(own, path);
  outcome.reason = reason;
  outcome.evaluations = journal.evaluations();
  outcome.history = journal.history();
  outcome.held_out = !input.validation.empty();
  constexpr int kProfiles = 3;
  // A simulation may fail with the start values, over the full length, on other runs, or with other
  // inputs. That does not affect the result of the search.
  std::set<std::string> failures;
  const auto doubt = [&](const std::string& what) {
    outcome.doubt += (outcome.doubt.empty() ? "" : "; ") + what;
  };
  const auto attempt = [&](const auto& work) {
    try {
      work();
    } catch (const NumericalFailure& error) {
      const bool first = failures.empty();
      if (!failures.insert(error.what()).second) return;
      doubt((first ? "some results could not be computed: " : "") + std::string(error.what()));
    }
  };
  const auto replay = [&](const std::vector<MeasuredRun>& runs, BeforeAfter& both) {
    if (runs.empty()) return;
    const auto simulate = [&](const Point& point, std::vector<RunDifferences>& differences) {
      attempt([&] {
        differences = simulate_runs(problem.build(point), runs, as_recorded(), stop);
        both.runs = runs;
      });
    };
    simulate(initial, both.before);
    if (outcome.best == initial) {
      both.after = both.before;
    } else {
      simulate(outcome.best, both.after);
    }
  };
  try {
    replay(problem.runs(), outcome.calibration);
    replay(input.validation, outcome.validation);
    attempt([&] { outcome.moves_on = moves_on(problem, outcome, stop); });
    if (const auto early = too_early(outcome)) doubt(*early);
    if (!thorough) return outcome;
    attempt([&] {
      outcome.identifiability = examine(problem, outcome.best, kProfiles, [&] {
        if (stop()) throw Interrupted();
      });
      if (outcome.identifiability.noise_is_doubtful) {
        doubt(
            "the parameters could follow nearly all noise, because the recordings are few or the "
            "remaining differences change slowly: its size, and with it the parameters' errors, "
            "are hardly known");
      }
    });
    attempt([&] { outcome.drives = compare_drives(problem, outcome.best, problem.runs(), stop); });
  } catch (const Interrupted&) {
    outcome.interrupted = true;
    const bool has_errors = !outcome.identifiability.parameters.empty();
    doubt(has_errors ? "interrupted before the replays of actuator positions"
          : thorough ? "interrupted before the errors of the parameters were computed"
                     : "interrupted before the errors on all recordings were computed");
  }
  return outcome;
}

}  // namespace calibration
}  // namespace anthrob
