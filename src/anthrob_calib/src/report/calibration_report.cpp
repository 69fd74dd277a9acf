#include "report/calibration_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "anthrob_core/text.h"
#include "report/calibration_figures.h"
#include "report/joint_unit.h"

namespace anthrob {
namespace calibration {

namespace {

std::string text(double value, const char* format = "%.4g") {
  if (!std::isfinite(value)) return "invalid";
  char out[40];
  std::snprintf(out, sizeof(out), format, value);
  return out;
}

/// "12.3", or "not simulated" if the model could not be simulated.
std::string error_text(const std::vector<RunDifferences>& runs, double error) {
  return runs.empty() ? "not simulated" : text(error, "%.2f");
}

MeanErrors errors_of(const std::vector<RunDifferences>& runs, const RobotModel& model) {
  return runs.empty() ? MeanErrors{std::vector<double>(model.skeleton->joints.size()), 0.0}
                      : mean_errors(runs, model);
}

/// "muscles.flexor.spindle_radius (at the end of its range)", of every parameter with which
/// something is wrong.
std::vector<std::string> doubtful_parameters(const CalibrationOutcome& o) {
  const std::vector<std::string> nothing = insensitive_parameters(o);
  std::vector<std::string> list;
  for (std::size_t i = 0; i < o.parameters.size(); ++i) {
    const std::string name = o.parameters[i].name();
    const bool insensitive = std::count(nothing.begin(), nothing.end(), name) > 0;
    const bool examined = !o.identifiability.parameters.empty();
    if (is_at_bound(o, i)) {
      list.push_back(name + " (at the end of its range)");
    } else if (insensitive || (examined && !o.identifiability.parameters[i].identifiable)) {
      list.push_back(name + " (not identifiable)");
    }
  }
  return list;
}

/// So many are named in one line.
constexpr std::size_t kNamed = 5;

}  // namespace

std::string headline(const CalibrationOutcome& o, bool searched) {
  const std::string errors = "fitness " + text(o.fitness_before) + " -> " + text(o.fitness);
  if (!searched) return "not searched to the end: " + errors;
  if (o.fitness >= o.fitness_before) return "no better than the start: " + errors;
  std::vector<std::string> doubtful = doubtful_parameters(o);
  if (doubtful.empty()) return "usable: " + errors;
  const std::size_t count = doubtful.size();
  doubtful.resize(std::min(count, kNamed));
  const std::string more = count > kNamed ? " and " + std::to_string(count - kNamed) + " more" : "";
  return "look at these parameters: " + joined(doubtful) + more + "; " + errors;
}

OutputFiles report_files(const CalibrationOutcome& o) {
  OutputFiles files = calibration_figures(o);
  files["result.json"] = result_json(o, files);
  return files;
}

std::string summary(const CalibrationOutcome& o) {
  std::string out = "fitness " + text(o.fitness_before) + " -> " + text(o.fitness) + " (" +
                    o.reason + ", " + std::to_string(o.evaluations) + " evaluations)\n";
  const auto line = [&](const char* what, const BeforeAfter& both) {
    if (both.runs.empty()) return;
    const MeanErrors before = errors_of(both.before, *o.model);
    const MeanErrors after = errors_of(both.after, *o.model);
    out += std::string(what) + ":";
    for (std::size_t j = 0; j < before.joints.size(); ++j) {
      const JointModel& joint = o.model->skeleton->joints[j];
      const auto [scale, unit] = unit_of(joint);
      out += " " + joint.name + " " + error_text(both.before, scale * before.joints[j]) + " -> " +
             error_text(both.after, scale * after.joints[j]) + " " + unit + ",";
    }
    out += " force " + error_text(both.before, before.force) + " -> " +
           error_text(both.after, after.force) + " N\n";
  };
  line("held out", o.validation);
  line("calibration", o.calibration);
  return out;
}

}  // namespace calibration
}  // namespace anthrob
