// Parameters of components from recordings of the rigs.
#include <filesystem>
#include <iostream>
#include <set>
#include <type_traits>

#include "anthrob_core/errors.h"
#include "anthrob_recording/bag.h"
#include "anthrob_recording/page.h"
#include "anthrob_sim/tool.h"
#include "identification/ecu_report.h"
#include "identification/eyelet_report.h"
#include "identification/ring_report.h"

namespace anthrob {
namespace {

using namespace identification;

struct Arguments {
  std::vector<std::string> recordings;
  std::string out;
};

template <class Recording>
std::vector<Recording> read_all(const std::vector<std::string>& paths) {
  std::vector<Recording> list;
  std::set<std::filesystem::path> taken;
  for (const std::string& path : paths) {
    // Rings are told apart by what they are, wherever their recordings lie.
    const bool known = !taken.insert(std::filesystem::weakly_canonical(path)).second;
    if (known && !std::is_same_v<Recording, RingRecording>) {
      throw BadInput(path + ": given twice; expected each recording once");
    }
    list.push_back(Recording::read(load_recording(path)));
  }
  return list;
}

/// Says which rings no model fits.
int judge(const std::vector<RingResult>& rings) {
  int status = tool::kDone;
  for (const RingResult& ring : rings) {
    if (ring.has_fit()) continue;
    std::cerr << "anthrob_identify: " << ring.ring << ": no model fits; report.json says why\n";
    status = tool::kFailed;
  }
  return status;
}

/// The others refuse what they cannot fit.
template <class Result>
int judge(const Result&) {
  return tool::kDone;
}

/// Reads all input, and checks that the output can be written, before it computes anything.
/// @param own files that this command writes in some runs only: those of an earlier run do not
/// belong to the new report
template <class Recording, class Identify, class Report, class Summary>
int identify(const Arguments& arguments, Identify fit, Report report, Summary summary,
             const std::vector<std::string>& own = {}) {
  auto recordings = read_all<Recording>(arguments.recordings);
  require_writable(arguments.out);
  const auto result = fit(std::move(recordings));
  const OutputFiles files = report(result);
  write_files(arguments.out, files);
  for (const std::string& name : own) {
    if (!files.count(name)) std::filesystem::remove(std::filesystem::path(arguments.out) / name);
  }
  std::cout << summary(result);
  const int status = judge(result);
  const std::filesystem::path out = arguments.out;
  write_page("identification", (out / "report.json").string(), (out / "report.html").string());
  return status;
}

CLI::App* add_command(CLI::App& app, const std::string& name, const std::string& description,
                      Arguments& arguments) {
  CLI::App* command = app.add_subcommand(name, description);
  command->add_option("REC", arguments.recordings, "recordings, as dataset folders")->required();
  command->add_option("--out", arguments.out, "folder for parameters, report and figures")
      ->required();
  return command;
}

}  // namespace
}  // namespace anthrob

int main(int argc, char** argv) {
  using namespace anthrob;
  CLI::App app(
      "Identifies parameters of components from recordings of the test rigs "
      "(docs/calibration.md). Writes YAML to paste into a model file, report.html, report.json "
      "and figures.",
      "anthrob_identify");
  app.require_subcommand(1);
  Arguments arguments;
  const CLI::App* see = add_command(
      app, "see", "rubber rings on the stretcher: Zener and Wiechert models", arguments);
  const CLI::App* eyelet = add_command(
      app, "eyelet", "line, eyelet and weight: kinetic friction, pulling and relaxing", arguments);
  add_command(app, "ecu", "power stage with load resistors: series resistance", arguments);
  return tool::run(app, argc, argv, [&]() -> int {
    if (see->parsed()) {
      return identify<RingRecording>(arguments, identify_rings, report_rings, summary_of_rings,
                                     {"springs.yaml"});
    }
    if (eyelet->parsed()) {
      return identify<EyeletRecording>(arguments, identify_eyelet, report_eyelet,
                                       summary_of_eyelet);
    }
    return identify<LoadRecording>(arguments, identify_ecu, report_ecu, summary_of_ecu);
  });
}
