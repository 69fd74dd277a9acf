#include "report/calibration_figures.h"

#include <algorithm>

#include "report/run_figures.h"
#include "report/search_figures.h"

namespace anthrob {
namespace calibration {

namespace {

/// The longest trajectory, whatever its errors, and the worst one.
void add_runs(const BeforeAfter& both, const CalibrationOutcome& o, const std::string& which,
              const std::string& title, OutputFiles& files) {
  if (both.runs.empty()) return;
  if (both.runs.size() > 1) {
    files["figures/" + which + "_errors.svg"] = errors_figure(both, *o.model, title);
  }
  const auto longest = std::max_element(
      both.runs.begin(), both.runs.end(),
      [](const MeasuredRun& a, const MeasuredRun& b) { return a.path.count() < b.path.count(); });
  if (!longest->is_trajectory || both.after.empty()) return;
  const auto shown = static_cast<std::size_t>(longest - both.runs.begin());
  files["figures/" + which + "_trajectory.svg"] = trajectory_figure(both, shown, *o.model);
  const auto worst = worst_trajectory(both, *o.model);
  if (!worst || *worst == shown) return;
  files["figures/" + which + "_worst.svg"] = trajectory_figure(both, *worst, *o.model);
}

}  // namespace

OutputFiles calibration_figures(const CalibrationOutcome& o) {
  OutputFiles files = {{"figures/fitness.svg", fitness_figure(o.history)}};
  add_runs(o.validation, o, "held_out", "Errors of held-out runs", files);
  add_runs(o.calibration, o, "fitted", "Errors of calibration runs", files);
  if (!o.identifiability.parameters.empty()) {
    files["figures/identifiability.svg"] = identifiability_figure(o.identifiability, o.parameters);
  }
  if (!o.identifiability.profiles.empty()) {
    files["figures/profiles.svg"] = profile_figure(o.identifiability, o.parameters, o.fitness);
  }
  return files;
}

const std::set<std::string>& kinds_of_figures() {
  static const std::set<std::string> kinds = {
      "fitness",           "held_out_errors", "fitted_errors", "held_out_trajectory", "profiles",
      "fitted_trajectory", "held_out_worst",  "fitted_worst",  "identifiability"};
  return kinds;
}

}  // namespace calibration
}  // namespace anthrob
