// Where do a model and recordings disagree, and which physical effect is missing?
#include <chrono>
#include <filesystem>
#include <iostream>
#include <thread>

#include "anthrob_calib/hosts/mpi_session.h"
#include "anthrob_calib/resume/fingerprint.h"
#include "anthrob_core/config_node.h"
#include "anthrob_core/files.h"
#include "anthrob_core/progress_lines.h"
#include "anthrob_recording/bag.h"
#include "anthrob_recording/page.h"
#include "anthrob_recording/unanswered.h"
#include "anthrob_sim/tool.h"
#include "loop/closed_loop.h"
#include "output_folder.h"
#include "report/discovery_figures.h"
#include "report/discovery_report.h"
#include "report/discovery_summary.h"
#include "report/model_text.h"
#include "report/options_json.h"
#include "report/progress.h"
#include "report/separating_files.h"
#include "stage_share.h"

namespace {

using namespace anthrob;

std::vector<Dataset> load_all(const CLI::App& app, const std::vector<std::string>& names) {
  std::vector<Dataset> recordings;
  for (const std::string& name : names) {
    recordings.push_back(load_recording(name));
    tool::say(app, recordings.back().remarks);
    leave_out_unanswered(recordings.back());
  }
  return recordings;
}

/// What was recorded in the loop. @return names of the folders
std::vector<std::string> save_from(std::size_t first, const std::vector<Dataset>& recordings,
                                   const std::string& out) {
  std::vector<std::string> names;
  for (std::size_t i = first; i < recordings.size(); ++i) {
    recordings[i].save(out + "/" + recordings[i].folder);
    names.push_back(recordings[i].folder);
  }
  return names;
}

struct Arguments {
  discovery::Question question;
  std::vector<std::string> train, test, repeats;  ///< names of recordings
  std::vector<std::string> numbers;               ///< NAME=NUMBER of options
  std::string out, calibration, robot_file;
  std::uint64_t program = 0;  ///< fingerprint of this build
};

void add_options(CLI::App& app, Arguments& a) {
  discovery::Question& question = a.question;
  question.jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  app.add_option("--model", question.model_file, "model to examine")
      ->required()
      ->transform(anthrob::tool::model_or_file());
  app.add_option("--train", a.train, "recordings that are fitted: bags or dataset folders")
      ->required();
  app.add_option("--test", a.test,
                 "held-out recordings: they only judge and are never fitted; use other motions")
      ->required();
  app.add_option(
      "--repeat", a.repeats,
      "further runs of the commands of the first --train recording, to measure the noise "
      "(default: none; the noise is estimated as if it were white)");
  app.add_option("--out", a.out, "folder for report.html, report.json and model.yaml")->required();
  app.add_option(
         "--effects", question.effects,
         "search only for these effects: ID,ID (default: all; anthrob_effects lists the ids)")
      ->delimiter(',');
  app.add_option(
         "--max-effects", question.max_effects,
         "name at most this many effects (default: " + std::to_string(question.max_effects) + ")")
      ->check(CLI::Range(0, 20));
  app.add_option("--jobs", question.jobs, "threads (default: all cores)")
      ->check(CLI::Range(1, 1024));
  app.add_option("--seed", question.seed,
                 "seed of the resampling, on which probabilities and intervals depend")
      ->capture_default_str()
      ->check(anthrob::tool::within(0.0, 1e12));
  app.add_option("--calibration", a.calibration,
                 "file that lists the ordinary parameters, which are fitted all the time (default: "
                 "calibration.yaml beside the model or beside the one that it extends)");
  app.add_option("--dt", question.step, "step of the simulations [s]")
      ->capture_default_str()
      ->check(anthrob::tool::within(1e-5, 0.1));
  app.add_option(
         "--option", a.numbers,
         "one of the numbers that decide, in place of its default (docs/discovery_method.md; "
         "may be given several times)")
      ->type_name("NAME=NUMBER")
      ->allow_extra_args(false);
  app.add_option(
         "--close-the-loop", a.robot_file,
         "if the robot is itself a simulation: MODEL is the model file of that simulated robot; "
         "it is recorded to tell rivals apart, and the search is repeated")
      ->type_name("MODEL")
      ->transform(anthrob::tool::model_or_file());
}

/// Refuses an output folder in which what is written would overwrite what is read.
void keep_inputs(const Arguments& a) {
  std::vector<std::string> read = extended_files(a.question.model_file);
  std::vector<std::string> written = {"model.yaml"};
  if (!a.robot_file.empty()) {
    for (const std::string& file : extended_files(a.robot_file)) read.push_back(file);
    for (const auto* group : {&a.train, &a.test, &a.repeats}) {
      for (const std::string& name : *group) {
        const std::filesystem::path folder = place_of(name);
        const bool has_slash = folder.filename().empty();
        read.push_back((has_slash ? folder.parent_path() : folder).string());
      }
    }
    for (const std::string& name : discovery::loop_recordings(a.question.options.loop))
      written.push_back(name);
  }
  require_kept(a.out, written, read);
  require_writable(a.out);
}

void load_question(const CLI::App& app, Arguments& a) {
  discovery::Question& question = a.question;
  for (const std::string& assignment : a.numbers) {
    question.options = discovery::with_option(question.options, assignment);
  }
  std::vector<std::string> remarks;
  question.calibration_file = calibration_file_of(question.model_file, a.calibration).value_or("");
  question.nuisances = ordinary_parameters(question.model_file, a.calibration, &remarks);
  question.simulated_robot_file = a.robot_file;
  question.model_fingerprint = resume::model_fingerprint(ConfigNode::load(question.model_file));
  tool::say(app, remarks);
  question.train = load_all(app, a.train);
  question.test = load_all(app, a.test);
  question.repeats = load_all(app, a.repeats);
}

/// Of the program, and of the numbers that decide what is simulated and compared.
std::uint64_t simulation_fingerprint(const Arguments& a) {
  resume::Fingerprint fingerprint;
  fingerprint.add(a.program);
  const auto options = discovery::options_json(a.question.options);
  for (const char* stage : {"admission", "measurement", "experiment"}) {
    fingerprint.add(options.at(stage).dump());
  }
  return fingerprint.value();
}

void say_what_is_continued(const discovery::Journal& journal, const std::string& out) {
  if (journal.inherited() > 0) {
    std::cerr << "continuing with " << journal.inherited()
              << " simulations of an interrupted run\n";
  } else if (journal.begun_anew()) {
    std::cerr << out
              << "/journal.bin: belongs to another model, --dt, --calibration or build of the "
              << "program; everything is simulated again, and replaces it\n";
  }
}

/// The recordings of the question are saved, too, as far as the loop made them.
/// @param runtime [s]
void write_answer(const discovery::Answer& answer, const discovery::Evaluator& evaluator,
                  const Arguments& a, double runtime) {
  const discovery::Question& question = a.question;
  OutputFiles files = separating_files(answer, *evaluator.model());
  files.merge(report_files(answer, question, runtime, evaluator.model().get()));
  files["model.yaml"] = model_text(answer, evaluator, question, a.out);
  write_files(a.out, files);
  remove_other_figures(a.out, discovery::kinds_of_figures(), files);
  discovery::remove_other_protocols(a.out, files);
  std::vector<std::string> made = save_from(a.train.size(), question.train, a.out);
  for (const std::string& name : save_from(a.test.size(), question.test, a.out)) {
    made.push_back(name);
  }
  if (!a.robot_file.empty()) discovery::remove_other_recordings(a.out, made, question.options.loop);
}

/// Reads the question in every process.
void load_together(const CLI::App& app, Arguments& a, const hosts::MpiSession& session) {
  session.in_all([&] {
    if (session.rank() == 0) keep_inputs(a);
    load_question(app, a);
  });
  const discovery::Question& question = a.question;
  resume::Fingerprint read;
  read.add(question.model_fingerprint);
  for (const ModelParameter& p : question.nuisances) read.add(p.path);
  read.add(discovery::options_json(question.options).dump());
  for (const auto* group : {&question.train, &question.test, &question.repeats}) {
    for (const Dataset& recording : *group) read.add(recording);
  }
  if (!session.all_have(resume::fingerprint_text(read.value()))) {
    throw BadInput(question.model_file +
                   ": the processes read different models or recordings: expected the same on all "
                   "hosts");
  }
  if (!session.all_have(resume::fingerprint_text(a.program))) {
    throw BadInput(
        "the processes run different builds of this program; expected the same build on all hosts");
  }
}

int run(const CLI::App& app, Arguments& a, const hosts::MpiSession& session) {
  const auto start = std::chrono::steady_clock::now();
  discovery::Question& question = a.question;
  load_together(app, a, session);
  tool::interrupted();

  std::unique_ptr<tool::Progress> bar;
  discovery::Evaluator evaluator(question.model_file, question.nuisances, question.step,
                                 question.jobs);
  evaluator.share_with(session);
  discovery::Journal* journal = nullptr;
  if (session.rank() == 0) {
    journal = &evaluator.keep_journal(a.out + "/journal.bin", simulation_fingerprint(a));
    say_what_is_continued(*journal, a.out);
  }
  std::size_t simulated = 0;  // before this stage
  evaluator.on_progress([&](const discovery::Batch& batch) {
    const std::size_t now = evaluator.simulated() - simulated;
    if (bar) bar->show(discovery::progress_text(bar->elapsed(), now, batch));
    return !tool::interrupted();
  });
  discovery::Observer observer;
  std::size_t stages = 0;  // that have begun
  observer.progress = [&](const std::string& what) {
    bar.reset();
    std::cerr << what << "\n";
    tool::progress_lines::stage(what);
    const double share = discovery::share_of_stages(stages++, question.max_effects);
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    tool::progress_lines::share(
        share, share > 0.0 ? std::optional(spent.count() * (1.0 - share) / share) : std::nullopt);
    simulated = evaluator.simulated();
    bar = std::make_unique<tool::Progress>("  running");
    return !tool::interrupted();
  };
  observer.candidate = tool::progress_lines::best;
  observer.comment = [](const std::string& line) { std::cerr << line << "\n"; };
  try {
    const discovery::Answer answer =
        a.robot_file.empty()
            ? discover(evaluator, question, observer)
            : discover_in_a_loop(evaluator, question, load_robot_model(a.robot_file), observer);
    bar.reset();
    if (session.rank() > 0) return tool::kDone;
    const std::chrono::duration<double> runtime = std::chrono::steady_clock::now() - start;
    write_answer(answer, evaluator, a, runtime.count());
    journal->remove();
    tool::progress_lines::headline(headline(answer));
    std::cout << summary(answer);
    write_page("discovery", a.out + "/report.json", a.out + "/report.html");
    return tool::kDone;
  } catch (const discovery::Interrupted&) {
    bar.reset();
    std::cerr << "anthrob_discover: interrupted; run the same command again to continue\n";
    if (session.size() > 1) session.abort(tool::kInterrupted);
    return tool::kInterrupted;
  } catch (const std::exception& error) {
    if (session.size() == 1) throw;
    bar.reset();
    std::cerr << "anthrob_discover: " << error.what() << "\n";
    session.abort(tool::kFailed);  // the others wait for this one
  }
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  // Before MPI loads what it likes: a search begun on several hosts may go on without it.
  arguments.program = resume::program_fingerprint();
  const hosts::MpiSession session(&argc, &argv);
  if (session.rank() > 0) std::cerr.rdbuf(nullptr);  // one process speaks for all
  if (const auto remark = session.remark_on_processors()) {
    std::cerr << "anthrob_discover: " << *remark << "\n";
  }
  CLI::App app(
      "Finds the physical effects that a model of a recorded robot is missing. Uses all threads of "
      "this host; mpirun adds hosts.",
      "anthrob_discover");
  add_options(app, arguments);
  return tool::run(app, argc, argv, [&] { return run(app, arguments, session); });
}
