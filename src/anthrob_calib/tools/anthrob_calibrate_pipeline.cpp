// Calibrates a model in stages, each searched twice.
#include <chrono>
#include <filesystem>
#include <iostream>
#include <thread>

#include "anthrob_core/command_line.h"
#include "anthrob_core/config_node.h"
#include "anthrob_core/errors.h"
#include "anthrob_core/files.h"
#include "anthrob_core/folder_lock.h"
#include "anthrob_core/progress_lines.h"
#include "anthrob_core/text.h"
#include "jobs/job.h"
#include "jobs/pipeline.h"

namespace {

using namespace anthrob;
namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kPeriod(100);  // between two looks at a run

struct Arguments {
  std::string pipeline, out;
  std::uint64_t seed = 1;
  std::int64_t jobs = 0;
};

/// Tells how far a run is while it lasts, and interrupts it where this program is interrupted.
jobs::JobResult run_to_its_end(const jobs::Pipeline& pipeline, tool::Progress& progress) {
  jobs::Job job(pipeline.command());
  std::string stage, best;
  bool interrupted = false;
  for (;;) {
    const auto result = job.update();
    const jobs::JobProgress& now = job.progress();
    if (now.stage != stage) tool::progress_lines::stage(*pipeline.name() + ": " + now.stage);
    if (now.best != best) tool::progress_lines::best(*pipeline.name() + ": " + now.best);
    stage = now.stage;
    best = now.best;
    progress.update(pipeline.share(result ? 1.0 : now.share));
    if (result) return *result;
    if (tool::interrupted() && !interrupted) job.interrupt();
    interrupted = tool::interrupted();
    std::this_thread::sleep_for(kPeriod);
  }
}

int run(const Arguments& arguments) {
  const std::string out = place_of(arguments.out).string();
  std::vector<jobs::Stage> stages = jobs::load_stages(arguments.pipeline);
  std::vector<std::string> read = jobs::files_of(stages);
  append(extended_files(arguments.pipeline), read);
  require_kept(out, {"model.yaml", "pipeline.json"}, read);
  tool::interrupted();  // listens from now on
  require_writable(out);
  fs::create_directories(out);
  const FolderLock lock(out);
  jobs::Pipeline pipeline(std::move(stages), out, arguments.seed, arguments.jobs);
  tool::Progress progress("calibrating");
  while (pipeline.name()) {
    const jobs::JobResult result = run_to_its_end(pipeline, progress);
    if (tool::interrupted() || result.exit_code == tool::kInterrupted) {
      std::cerr << "anthrob_calibrate_pipeline: interrupted in " << *pipeline.name()
                << "; run the same command again to continue\n";
      return tool::kInterrupted;
    }
    const std::string wrong = *pipeline.name() + ": " + result.error;
    if (result.exit_code == tool::kBadInput) throw BadInput(wrong);
    if (!result.success) throw std::runtime_error(wrong);
    pipeline.finish(result.headline);
    std::cout << pipeline.summary() << std::flush;
  }
  write_files(out, pipeline.files());
  tool::progress_lines::headline(pipeline.headline());
  std::cout << pipeline.headline() << "\n";
  return tool::kDone;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Calibrates a model in stages by anthrob_calibrate: each starts from the result of the one "
      "before, is searched twice, and the better result is kept. After an interruption, the same "
      "command continues.",
      "anthrob_calibrate_pipeline");
  Arguments arguments;
  app.add_option("--pipeline", arguments.pipeline,
                 "file that lists the stages (docs/calibration.md)")
      ->required();
  app.add_option("--out", arguments.out, "folder for model.yaml, pipeline.json and all stages")
      ->required();
  app.add_option("--seed", arguments.seed,
                 "seed of the first search of each stage; the second has the next one")
      ->capture_default_str()
      ->check(CLI::Range(1, 2147483646));
  app.add_option("--jobs", arguments.jobs, "threads (default: all)")->check(CLI::Range(1, 1024));
  return tool::run(app, argc, argv, [&] { return run(arguments); });
}
