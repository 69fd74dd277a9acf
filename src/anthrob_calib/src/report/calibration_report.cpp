#include "report/calibration_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "anthrob_calib/report/html.h"
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

std::string row(const std::vector<std::string>& cells, const char* tag = "td") {
  std::string out = "<tr>";
  for (const std::string& cell : cells)
    out += std::string("<") + tag + ">" + cell + "</" + tag + ">";
  return out + "</tr>\n";
}

std::string error_table(const BeforeAfter& both, const RobotModel& model) {
  std::vector<std::string> head = {""};
  for (const JointModel& joint : model.skeleton->joints) {
    head.push_back(joint.name + " [" + unit_of(joint).name + "]");
  }
  head.push_back("force [N]");
  std::string out = "<table>" + row(head, "th");
  for (const bool after : {false, true}) {
    const std::vector<RunDifferences>& runs = after ? both.after : both.before;
    std::vector<std::string> cells = {after ? "after" : "before"};
    if (runs.empty()) {
      cells.resize(head.size(), "not simulated");
      out += row(cells);
      continue;
    }
    const MeanErrors errors = mean_errors(runs, model);
    for (std::size_t j = 0; j < errors.joints.size(); ++j) {
      cells.push_back(text(unit_of(model.skeleton->joints[j]).scale * errors.joints[j], "%.2f"));
    }
    cells.push_back(text(errors.force, "%.2f"));
    out += row(cells);
  }
  return out + "</table>\n";
}

std::string errors_section(const BeforeAfter& both, const RobotModel& model,
                           const std::string& title) {
  std::string out = error_table(both, model);
  if (both.runs.size() > 1) out += run_error_figure(both, model, title);
  out += "<p>Runs: ";
  for (std::size_t r = 0; r < both.runs.size(); ++r) {
    out += (r ? ", " : "") + std::to_string(r) + " " + escaped(both.runs[r].name);
  }
  out += "</p>\n";
  // Shows the longest trajectory: this choice does not depend on the errors.
  const auto longest = std::max_element(
      both.runs.begin(), both.runs.end(),
      [](const MeasuredRun& a, const MeasuredRun& b) { return a.path.count() < b.path.count(); });
  if (longest->is_trajectory && !both.after.empty()) {
    out += trajectory_figure(both, static_cast<std::size_t>(longest - both.runs.begin()), model);
  }
  return out;
}

std::string interval_text(const CalibrationOutcome& o, std::size_t parameter) {
  const identification::Estimate estimate =
      interval(o.identifiability, parameter, o.best[parameter]);
  return text(estimate.lo, "%.6g") + " ... " + text(estimate.hi, "%.6g");
}

std::string parameter_table(const CalibrationOutcome& o) {
  std::string out = "<table>" + row({"parameter", "unit", "range", "before", "after", "sigma",
                                     "95 % interval", "identifiable", "at a bound"},
                                    "th");
  const std::vector<std::string> nothing = insensitive_parameters(o);
  for (std::size_t i = 0; i < o.parameters.size(); ++i) {
    const ModelParameter& p = o.parameters[i];
    const bool known = !o.identifiability.parameters.empty();
    const bool told = !std::count(nothing.begin(), nothing.end(), p.name());
    out += row({escaped(p.name()), p.unit, text(p.lower) + " ... " + text(p.upper),
                text(p.initial, "%.6g"), text(o.best[i], "%.6g"),
                known ? text(o.identifiability.parameters[i].sigma, "%.2g") : "",
                known && !is_at_bound(o, i) ? interval_text(o, i) : "",
                !known                                         ? (told ? "" : "<b>no</b>")
                : o.identifiability.parameters[i].identifiable ? "yes"
                                                               : "<b>no</b>",
                is_at_bound(o, i) ? "yes" : ""});
  }
  return out + "</table>\n";
}

std::string identifiability_section(const CalibrationOutcome& o) {
  const Identifiability& id = o.identifiability;
  if (id.parameters.empty()) return "";
  const auto told = std::count_if(id.parameters.begin(), id.parameters.end(),
                                  [](const ParameterKnowledge& k) { return k.identifiable; });
  std::string out =
      "<h2>Identifiability</h2>\n<p>" + std::to_string(told) + " of " +
      std::to_string(id.parameters.size()) +
      " parameters are identifiable: the data leave them less than " +
      text(100 * kIdentifiableShare) +
      " % of the standard deviation that their range allows. This is computed from the derivatives "
      "of all differences at the best point; the remaining differences are taken as noise (" +
      text(kDegrees * id.posture_noise) + " deg, " + text(id.force_noise) + " N). ";
  if (!o.calibration.runs.empty() && !o.calibration.runs.front().is_trajectory) {
    out += "Equilibria needed by (5.13): " +
           std::to_string(equilibria_needed(static_cast<int>(o.parameters.size()),
                                            static_cast<int>(o.model->muscles.size()),
                                            o.model->skeleton->velocity_count)) +
           ", given: " + std::to_string(o.calibration.runs.size()) + ".";
  }
  out += "</p>\n<p>Singular values of the derivatives with respect to steps, largest first: ";
  for (const double s : id.singular_values) out += text(s, "%.2g") + " ";
  std::vector<std::size_t> order(id.flattest.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::abs(id.flattest[a]) > std::abs(id.flattest[b]);
  });
  out += "</p>\n<p>Least identifiable direction, in steps: ";
  for (std::size_t k = 0; k < std::min<std::size_t>(5, order.size()); ++k) {
    out += (k ? ", " : "") + text(id.flattest[order[k]], "%+.2f") + " " +
           escaped(o.parameters[order[k]].name());
  }
  out += "</p>\n" + parameter_table(o);
  if (!id.profiles.empty()) out += profile_figure(id, o.parameters, o.fitness);
  return out;
}

std::string drives_section(const CalibrationOutcome& o) {
  if (o.drives.size() < 2) return "";
  std::string out = "<h2>Simulation with other inputs (section 8.3)</h2>\n<table>" +
                    row({"input of the actuators", "posture rms [deg]", "force rms [N]",
                         "largest actuator difference [deg]"},
                        "th");
  for (const DriveErrors& d : o.drives) {
    out += row({d.drive, std::isfinite(d.posture) ? text(kDegrees * d.posture, "%.2f") : "",
                text(d.force, "%.2f"), text(kDegrees * d.actuator, "%.2f")});
  }
  return out + "</table>\n";
}

/// "12.3", or "not simulated" if the model could not be simulated.
std::string error_text(const std::vector<RunDifferences>& runs, double error) {
  return runs.empty() ? "not simulated" : text(error, "%.2f");
}

MeanErrors errors_of(const std::vector<RunDifferences>& runs, const RobotModel& model) {
  return runs.empty() ? MeanErrors{std::vector<double>(model.skeleton->joints.size()), 0.0}
                      : mean_errors(runs, model);
}

/// The mean errors in one sentence: on the held-out recordings, if there are any.
std::string headline(const CalibrationOutcome& o) {
  const bool held_out = !o.validation.after.empty();
  const BeforeAfter& both = held_out ? o.validation : o.calibration;
  if (both.after.empty()) return "";  // they could not be simulated; the doubt says why
  const MeanErrors before = errors_of(both.before, *o.model);
  const MeanErrors after = errors_of(both.after, *o.model);
  std::string out = held_out ? "On held-out recordings" : "On the recordings that were fitted";
  out += ", the mean errors are ";
  for (std::size_t j = 0; j < after.joints.size(); ++j) {
    const JointModel& joint = o.model->skeleton->joints[j];
    const auto [scale, unit] = unit_of(joint);
    out += "<b>" + text(scale * after.joints[j], "%.2f") + " " + unit +
           "</b> (before: " + error_text(both.before, scale * before.joints[j]) + ") at " +
           escaped(joint.name) + ", ";
  }
  return "<p class=\"headline\">" + out + "and <b>" + text(after.force, "%.2f") +
         " N</b> (before: " + error_text(both.before, before.force) + ") of muscle forces.</p>\n";
}

std::string name_of(const std::string& file) {
  return escaped(std::filesystem::path(file).filename().string());
}

}  // namespace

std::string report_html(const CalibrationOutcome& o) {
  std::string out =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta "
      "charset=\"utf-8\"><title>Calibration</title>\n"
      "<style>body{font-family:sans-serif;max-width:60em;margin:2em auto}"
      "table{border-collapse:collapse;margin:1em 0}td,th{border:1px solid #ccc;padding:2px 8px;"
      "text-align:right}td:first-child{text-align:left}"
      ".headline{font-size:1.2em;border-left:6px solid #1f77b4;padding:.5em 1em;background:#f5f9fd}"
      "</style></head><body>\n<h1>Calibration of " +
      name_of(o.model_file) + "</h1>\n" + headline(o) + "<p>" + name_of(o.config_file) + ", " +
      o.optimiser.method + ", seed " + std::to_string(o.optimiser.seed) + ", " +
      std::to_string(o.evaluations) + " evaluations; " + o.reason + ". Fitness " +
      text(o.fitness_before) + " before, " + text(o.fitness) + " after.</p>\n";
  if (!o.doubt.empty()) out += "<p><b>" + escaped(o.doubt) + "</b></p>\n";
  out += "<h2>Held-out recordings</h2>\n";
  if (o.validation.runs.empty()) {
    out += o.held_out ? "<p>They could not be simulated, see above.</p>\n"
                      : "<p>None were given (--validation), so it is not known how well the "
                        "model predicts other motions.</p>\n";
  } else {
    out += errors_section(o.validation, *o.model, "Errors of held-out runs");
  }
  if (!o.calibration.runs.empty()) {
    out += "<h2>Recordings of the calibration</h2>\n" +
           errors_section(o.calibration, *o.model, "Errors of calibration runs");
  }
  out += "<h2>Search</h2>\n" + fitness_figure(o.history);
  out += o.identifiability.parameters.empty() ? "<h2>Parameters</h2>\n" + parameter_table(o)
                                              : identifiability_section(o);
  return out + drives_section(o) + "</body></html>\n";
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
