#include "report/calibration_figures.h"

#include <algorithm>
#include <cmath>

#include "anthrob_recording/svg_figure.h"
#include "report/joint_unit.h"

namespace anthrob {
namespace calibration {

namespace {

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& v : values) v *= factor;
  return values;
}

std::vector<double> column(const Eigen::MatrixXd& m, Eigen::Index c, double factor) {
  std::vector<double> values;
  for (Eigen::Index row = 0; row < m.rows(); ++row) values.push_back(factor * m(row, c));
  return values;
}

/// Times of the first rows of a trajectory: those that were simulated.
std::vector<double> times_of(const Samples& samples, int rows) {
  return {samples.t.begin(), samples.t.begin() + rows};
}

/// Measured and simulated number of a hinge; ball joints are shown by their errors.
/// @param before null if that model could not be simulated
void add_joint_panels(SvgFigure& figure, const MeasuredRun& run, const RunDifferences* before,
                      const RunDifferences& after, const JointModel& joint) {
  const int rows = after.path.count();
  const std::vector<double> t = times_of(run.path, rows);
  const auto [scale, unit] = unit_of(joint);
  const std::string bracket = std::string(" [") + unit + "]";
  if (joint.type != JointType::kBall) {
    auto& panel = figure.add_panel("time [s]", joint.name + bracket);
    const Eigen::MatrixXd measured = run.path.q.topRows(rows);
    panel.lines.push_back({"robot", t, column(measured, joint.position_offset, scale), true});
    std::vector<double> simulated;
    for (int row = 0; row < rows; ++row) {
      simulated.push_back(scale * (measured(row, joint.position_offset) +
                                   after.path.posture(row, joint.velocity_offset)));
    }
    panel.lines.push_back({"simulation", t, simulated});
  } else {
    auto& panel = figure.add_panel("time [s]", joint.name + " error" + bracket);
    const char* const axes[] = {"x", "y", "z"};
    for (int k = 0; k < 3; ++k) {
      panel.lines.push_back(
          {axes[k], t, column(after.path.posture, joint.velocity_offset + k, scale)});
    }
  }
  auto& panel = figure.add_panel("time [s]", joint.name + " absolute error" + bracket);
  if (before) {
    panel.lines.push_back({"before", times_of(run.path, before->path.count()),
                           scaled(before->path.joint_error(joint), scale), true});
  }
  panel.lines.push_back({"after", t, scaled(after.path.joint_error(joint), scale)});
}

/// Fitness over evaluations, logarithmic.
std::string fitness_figure(const std::vector<Generation>& history) {
  SvgFigure figure("Fitness");
  auto& panel = figure.add_panel("evaluations", "log10 of fitness");
  std::vector<double> x, best, ever, mean;
  for (const Generation& g : history) {
    x.push_back(g.evaluations);
    best.push_back(std::log10(g.best));
    ever.push_back(std::log10(g.best_ever));
    mean.push_back(std::log10(g.mean));
  }
  panel.lines.push_back({"mean of generation", x, mean, true});
  panel.lines.push_back({"best of generation", x, best});
  panel.lines.push_back({"best so far", x, ever});
  return figure.render();
}

/// Joint and force errors of every run.
std::string run_error_figure(const BeforeAfter& both, const RobotModel& model,
                             const std::string& title) {
  SvgFigure figure(title);
  std::vector<double> x;
  for (std::size_t r = 0; r < both.runs.size(); ++r) x.push_back(static_cast<double>(r));
  const auto add = [&](const std::string& label, auto value_of) {
    auto& panel = figure.add_panel("run", label);
    for (const bool after : {false, true}) {
      const std::vector<RunDifferences>& runs = after ? both.after : both.before;
      if (runs.empty()) continue;
      std::vector<double> y;
      for (const RunDifferences& run : runs) {
        y.push_back(value_of(run_errors(run, model)));
      }
      SvgFigure::Line line{after ? "after" : "before", x, y};
      line.marks = after ? SvgFigure::Line::kFilled : SvgFigure::Line::kOpen;
      panel.lines.push_back(line);
    }
  };
  for (std::size_t j = 0; j < model.skeleton->joints.size(); ++j) {
    const JointModel& joint = model.skeleton->joints[j];
    const JointUnit unit = unit_of(joint);
    add(joint.name + " error [" + unit.name + "]",
        [j, unit](const MeanErrors& e) { return unit.scale * e.joints[j]; });
  }
  add("mean force error [N]", [](const MeanErrors& e) { return e.force; });
  return figure.render();
}

/// One trajectory over time. Needs `after`.
std::string trajectory_figure(const BeforeAfter& both, std::size_t r, const RobotModel& model) {
  const MeasuredRun& run = both.runs[r];
  SvgFigure figure(run.name);
  for (const JointModel& joint : model.skeleton->joints) {
    const RunDifferences* before = both.before.empty() ? nullptr : &both.before[r];
    add_joint_panels(figure, run, before, both.after[r], joint);
  }
  const Differences& after = both.after[r].path;
  const std::vector<double> t = times_of(run.path, after.count());
  auto& force = figure.add_panel("time [s]", "force error [N]");
  for (std::size_t m = 0; m < model.muscles.size(); ++m) {
    force.lines.push_back(
        {model.muscles[m].name, t, column(after.force, static_cast<Eigen::Index>(m), 1.0)});
  }
  if (after.actuator.cols() == 0) return figure.render();
  auto& actuator = figure.add_panel("time [s]", "actuator error [deg]");
  for (std::size_t m = 0; m < model.muscles.size(); ++m) {
    actuator.lines.push_back(
        {"", t, column(after.actuator, static_cast<Eigen::Index>(m), kDegrees)});
  }
  return figure.render();
}

std::string profile_figure(const Identifiability& identifiability,
                           const std::vector<ModelParameter>& parameters, double best_fitness) {
  SvgFigure figure("Fitness along the least identifiable parameters, the others adjusted");
  for (const Profile& profile : identifiability.profiles) {
    const ModelParameter& p = parameters[profile.parameter];
    auto& panel = figure.add_panel(p.name() + " [" + p.unit + "]", "fitness / best");
    std::vector<double> y;
    for (const double f : profile.fitness) y.push_back(f / best_fitness);
    panel.lines.push_back({"profile", profile.value, y});
  }
  return figure.render();
}

/// Shows the longest trajectory: this choice does not depend on the errors.
void add_runs(const BeforeAfter& both, const CalibrationOutcome& o, const std::string& which,
              const std::string& title, OutputFiles& files) {
  if (both.runs.empty()) return;
  if (both.runs.size() > 1) {
    files["figures/" + which + "_errors.svg"] = run_error_figure(both, *o.model, title);
  }
  const auto longest = std::max_element(
      both.runs.begin(), both.runs.end(),
      [](const MeasuredRun& a, const MeasuredRun& b) { return a.path.count() < b.path.count(); });
  if (!longest->is_trajectory || both.after.empty()) return;
  files["figures/" + which + "_trajectory.svg"] =
      trajectory_figure(both, static_cast<std::size_t>(longest - both.runs.begin()), *o.model);
}

}  // namespace

OutputFiles calibration_figures(const CalibrationOutcome& o) {
  OutputFiles files = {{"figures/fitness.svg", fitness_figure(o.history)}};
  add_runs(o.validation, o, "held_out", "Errors of held-out runs", files);
  add_runs(o.calibration, o, "fitted", "Errors of calibration runs", files);
  if (!o.identifiability.profiles.empty()) {
    files["figures/profiles.svg"] = profile_figure(o.identifiability, o.parameters, o.fitness);
  }
  return files;
}

const std::set<std::string>& kinds_of_figures() {
  static const std::set<std::string> kinds = {"fitness",       "held_out_errors",
                                              "fitted_errors", "held_out_trajectory",
                                              "profiles",      "fitted_trajectory"};
  return kinds;
}

}  // namespace calibration
}  // namespace anthrob
