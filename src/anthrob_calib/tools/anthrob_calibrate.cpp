// Calibrates a model against recordings.
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <optional>
#include <thread>

#include "anthrob_calib/calibration/extended_model.h"
#include "anthrob_calib/hosts/mpi_session.h"
#include "anthrob_calib/resume/fingerprint.h"
#include "anthrob_core/config_node.h"
#include "anthrob_core/files.h"
#include "anthrob_core/progress_lines.h"
#include "anthrob_core/text.h"
#include "anthrob_recording/bag.h"
#include "anthrob_recording/page.h"
#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/tool.h"
#include "calibration/calibrate.h"
#include "calibration/problem_evaluator.h"
#include "optimiser/mpi_evaluator.h"
#include "report/calibration_figures.h"
#include "report/calibration_report.h"

namespace anthrob {
namespace {

using namespace calibration;
namespace fs = std::filesystem;

struct Arguments {
  std::string config, data, validation, model, out, method;
  std::vector<std::string> start;
  bool resume = false, evaluate = false, brief = false;
  int jobs = 0, generations = 0;
  std::int64_t seed = -1;
  std::uint64_t program = 0;  ///< fingerprint of this build
};

CalibrationConfig configure(const Arguments& arguments) {
  CalibrationConfig config = CalibrationConfig::load(arguments.config);
  if (arguments.model.empty()) {
    config.require_model();
  } else {
    config.model_file = arguments.model;
  }
  if (!arguments.method.empty()) config.optimiser.method = arguments.method;
  if (arguments.generations > 0) config.optimiser.generations = arguments.generations;
  if (arguments.seed >= 0) config.optimiser.seed = static_cast<std::uint64_t>(arguments.seed);
  config.optimiser.check(config.node.at("optimiser"));
  return config;
}

std::string model_text(const Arguments& arguments, const CalibrationInput& input,
                       const std::map<std::string, double>& overrides, const std::string& remark) {
  return extended_model_text(ConfigNode::load(input.config.model_file), input.config.model_file,
                             overrides, arguments.out, remark);
}

/// Of the search alone. model.yaml itself has its errors beside it, in result.json, or it is none.
constexpr const char* kFoundModel = "model.yaml.partial";

/// Writes what was found before the remaining computations, which may fail or be interrupted.
void keep_model(const Arguments& arguments, const CalibrationInput& input, const Problem& problem,
                const Point& best) {
  std::map<std::string, double> overrides = input.started;
  for (const auto& [path, value] : problem.space().overrides(best)) overrides[path] = value;
  const char* const remark =
      "Found by anthrob_calibrate, which did not come to the errors before and after.";
  write_files(arguments.out, {{kFoundModel, model_text(arguments, input, overrides, remark)}});
}

void write(const Arguments& arguments, const CalibrationInput& input,
           const CalibrationOutcome& outcome) {
  OutputFiles files = report_files(outcome);
  files["model.yaml"] = model_text(arguments, input, outcome.overrides,
                                   "Calibrated by anthrob_calibrate. result.json and report.html "
                                   "have the errors before and after.");
  write_files(arguments.out, files);
  fs::remove(fs::path(arguments.out) / kFoundModel);
  remove_other_figures(arguments.out, kinds_of_figures(), files);
}

void write_html(const Arguments& arguments) {
  const fs::path out = arguments.out;
  write_page("calibration", (out / "result.json").string(), (out / "report.html").string());
}

/// Refuses to overwrite the journal of an earlier search (without --resume, or by --evaluate), and
/// to resume where there is none, before any folder is made.
void keep_earlier_search(const Arguments& arguments) {
  const fs::path journal = fs::path(arguments.out) / "journal.txt";
  if (!fs::exists(journal)) {
    if (!arguments.resume) return;
    throw BadInput(journal.string() +
                   ": does not exist; expected the journal of an interrupted run");
  }
  if (arguments.evaluate) {
    throw BadInput(journal.string() +
                   ": belongs to an earlier search; expected another --out for --evaluate");
  }
  if (arguments.resume) return;
  throw BadInput(
      journal.string() +
      ": belongs to an earlier search; expected --resume to continue it, or another --out");
}

/// Refuses an --out whose files are inputs: the model, what it extends, --start.
void keep_input(const Arguments& arguments, const std::string& model_file) {
  std::vector<std::string> read = extended_files(model_file);
  for (const std::string& file : extended_files(arguments.config)) read.push_back(file);
  for (const std::string& file : arguments.start) {
    read.push_back(place_of(file).string());
  }
  require_kept(arguments.out, {"model.yaml", kFoundModel, "result.json"}, read);
}

/// This build, with the libraries of effects that the model has loaded.
std::uint64_t program_of(const Arguments& arguments) {
  return resume::program_fingerprint(arguments.program, effect_library_files());
}

/// @param from folder of recordings, or one of them; empty: none
Recordings recordings_of(const std::string& from) {
  return {from, from.empty() ? std::vector<Dataset>() : load_recordings(from)};
}

/// Reads the input in every process.
CalibrationInput read_together(const Arguments& arguments, const hosts::MpiSession& session) {
  std::optional<CalibrationInput> input;
  session.in_all([&] {
    CalibrationConfig config = configure(arguments);
    input.emplace(CalibrationInput::read(std::move(config), recordings_of(arguments.data),
                                         recordings_of(arguments.validation), arguments.start));
    if (session.rank() > 0) return;
    keep_earlier_search(arguments);
    keep_input(arguments, input->config.model_file);
    require_writable(arguments.out);
  });
  if (!session.all_have(input->fingerprint())) {
    throw BadInput(arguments.config +
                   ": the processes read different configurations, models or recordings: expected "
                   "the same on all hosts");
  }
  if (!session.all_have(std::to_string(program_of(arguments)))) {
    throw BadInput(
        "the processes run different builds of this program; expected the same build on all hosts");
  }
  return std::move(*input);
}

void say_remarks(const CLI::App& app, const CalibrationInput& input) {
  for (const auto* runs : {&input.runs, &input.validation}) {
    for (const MeasuredRun& run : *runs) tool::say(app, run.remarks);
  }
}

Journal::Options journal_options(const Arguments& arguments, const CalibrationInput& input) {
  Journal::Options options;
  if (!arguments.evaluate) options.file = (fs::path(arguments.out) / "journal.txt").string();
  options.fingerprint = input.fingerprint();
  options.resume = arguments.resume;
  options.batch = input.config.optimiser.offspring;
  options.stop = tool::interrupted;
  options.program = program_of(arguments);
  return options;
}

/// Parameters that the recordings do not determine, or not within their range, and errors that
/// could not be computed.
void say_doubts(const CalibrationOutcome& outcome, bool searched) {
  for (std::size_t i = 0; searched && i < outcome.parameters.size(); ++i) {
    if (!is_at_bound(outcome, i)) continue;
    const ModelParameter& p = outcome.parameters[i];
    std::cerr << "anthrob_calibrate: " << p.name() << ": ended at the end of its range ("
              << outcome.best[i] << " " << p.unit << "); expected a wider range, or something else "
              << "is wrong with the model\n";
  }
  for (const std::string& name : insensitive_parameters(outcome)) {
    std::cerr << "anthrob_calibrate: " << name
              << ": not identifiable from these recordings (it changes nothing "
              << "in them, or values beside it make no valid robot)\n";
  }
  if (!outcome.doubt.empty()) std::cerr << "anthrob_calibrate: " << outcome.doubt << "\n";
}

/// @param complete whether the search was not interrupted
/// @return exit status
int say_how_it_ended(const Arguments& arguments, const CalibrationInput& input,
                     const CalibrationOutcome& outcome, bool complete) {
  if (complete && !arguments.evaluate && !std::isfinite(outcome.fitness)) {
    std::cerr << "anthrob_calibrate: " << input.config.model_file
              << ": no set of parameters could be simulated over the recordings; replay them with "
                 "anthrob_replay to see where the simulation fails\n";
    return tool::kFailed;
  }
  if (complete && !outcome.interrupted) return tool::kDone;
  if (arguments.evaluate) {
    std::cerr << "anthrob_calibrate: interrupted; the errors that were computed are in "
              << arguments.out << "\n";
  } else {
    std::cerr << "anthrob_calibrate: interrupted; the best result so far is in " << arguments.out
              << "; --resume continues the search\n";
  }
  return tool::kInterrupted;
}

/// Of all that is computed: what comes after the search takes as long again, unless it is brief.
double share_of_search(const Arguments& arguments) {
  return arguments.brief ? 0.9 : 0.5;
}

int calibrate(const CLI::App& app, const Arguments& arguments, const hosts::MpiSession& session) {
  const CalibrationInput input = read_together(arguments, session);
  say_remarks(app, input);
  const Problem problem = input.problem();
  ProblemEvaluator local(problem);
  if (session.rank() > 0) {
    serve(session, local);
    return tool::kDone;
  }
  MpiEvaluator everywhere(session, local);
  const OptimiserSettings& settings = input.config.optimiser;
  tool::Progress progress("calibrating");
  const double expected = settings.evaluations(problem.space().size());
  const Journal* known = nullptr;
  double best = HUGE_VAL;

  Journal::Options options = journal_options(arguments, input);
  options.progress = [&](int done) {
    progress.update(share_of_search(arguments) * std::min(1.0, done / expected));
    if (known->best_fitness() < best) {
      best = known->best_fitness();
      tool::progress_lines::best("fitness " + short_number(best));
    }
  };
  fs::create_directories(arguments.out);
  Journal journal(everywhere, options);
  known = &journal;
  if (journal.outdated()) {
    std::cerr << "anthrob_calibrate: " << options.file
              << ": written by another build of the program; its evaluations are repeated\n";
  }
  if (journal.remark()) tool::say(app, {*journal.remark()});
  problem.build(problem.space().initial());  // a start that cannot be built has its own message

  std::string reason = arguments.evaluate ? "no search, --evaluate" : "interrupted";
  SearchResult found;
  bool complete = false;
  try {
    if (!arguments.evaluate) {
      tool::progress_lines::stage("searching");
      found = make_optimiser(settings)->minimise(search_variables(problem.space()), journal);
      reason = found.reason;
    }
    complete = true;
  } catch (const Interrupted&) {
  }
  journal.save();
  // conclude() takes its time; nothing worse than the start may lie there if it is cut off.
  if (!journal.best().empty() &&
      journal.best_fitness() < problem.fitness(problem.space().initial())) {
    keep_model(arguments, input, problem, journal.best());
  }
  const bool thorough = complete && !arguments.evaluate && !arguments.brief;
  // The errors of what an interrupted search has found are computed all the same.
  tool::progress_lines::stage("computing the errors");
  if (complete) tool::progress_lines::share(share_of_search(arguments), std::nullopt);
  const Stop stop = complete ? Stop(tool::interrupted) : Stop([] { return false; });
  CalibrationOutcome outcome = conclude(input, problem, journal, reason, thorough, stop);
  outcome.sensitivity = found.sensitivity;
  write(arguments, input, outcome);
  tool::progress_lines::headline(headline(outcome, complete && !arguments.evaluate));
  std::cout << summary(outcome);
  say_doubts(outcome, complete && !arguments.evaluate);
  const int status = say_how_it_ended(arguments, input, outcome, complete);
  if (status == tool::kDone) journal.forget_residuals();
  write_html(arguments);
  return status;
}

void add_options(CLI::App& app, Arguments& a) {
  app.add_option("--config", a.config,
                 "configuration: parameters, weights, optimiser (docs/calibration.md)")
      ->required();
  app.add_option("--data", a.data, "folder of recordings to fit")->required();
  app.add_option("--validation", a.validation,
                 "folder of held-out recordings: evaluated, never fitted");
  app.add_option("--out", a.out, "folder for model.yaml, result.json, report.html")->required();
  app.add_option("--model", a.model, "model, instead of the configuration's")
      ->transform(tool::model_or_file());
  app.add_option("--start", a.start, "result.json of earlier calibrations to start from");
  auto* resume = app.add_flag("--resume", a.resume, "continue an interrupted search");
  app.add_flag("--evaluate", a.evaluate, "no search: only compute the errors of the given model")
      ->excludes(resume);
  app.add_flag("--brief", a.brief,
               "leave out the errors of parameters and the replays of actuator positions");
  app.add_option("--jobs", a.jobs, "threads (default: all)")->check(CLI::Range(1, 1024));
  app.add_option("--optimiser", a.method, "search method, instead of the configuration's")
      ->check(CLI::IsMember(OptimiserSettings::methods()));
  app.add_option(
         "--generations", a.generations,
         "number of generations, instead of the configuration's; for least_squares the "
         "largest number of finite-difference Jacobians, each of one evaluation per parameter")
      ->check(CLI::Range(1, 1000000));
  app.add_option("--seed", a.seed, "seed of the random numbers, instead of the configuration's")
      ->check(CLI::Range(0, 2147483647));
}

}  // namespace
}  // namespace anthrob

int main(int argc, char** argv) {
  using namespace anthrob;
  Arguments arguments;
  // Before MPI loads what it likes: a search begun on several hosts may go on without it.
  arguments.program = resume::program_fingerprint();
  const hosts::MpiSession session(&argc, &argv);
  tool::interrupted();                               // listens from now on; rank 0 decides
  if (session.rank() > 0) std::cerr.rdbuf(nullptr);  // one process speaks for all
  if (const auto remark = session.remark_on_processors()) {
    std::cerr << "anthrob_calibrate: " << *remark << "\n";
  }
  CLI::App app(
      "Calibrates a model against recordings: fits parameters within their ranges so that the "
      "simulated robot moves as the recorded one did. Uses all threads of this host; mpirun adds "
      "hosts.",
      "anthrob_calibrate");
  add_options(app, arguments);
  return tool::run(app, argc, argv, [&] {
    const int jobs =
        arguments.jobs > 0 ? arguments.jobs : static_cast<int>(std::thread::hardware_concurrency());
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(std::max(1, jobs)));
    return calibrate(app, arguments, session);
  });
}
