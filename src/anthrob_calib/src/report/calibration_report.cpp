#include "report/calibration_report.h"

#include <cmath>
#include <cstdio>

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

}  // namespace

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
