#include "report/run_figures.h"

#include <algorithm>
#include <cmath>
#include <optional>

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

/// Measured and simulated quaternion of a ball joint.
void add_orientation(SvgFigure& figure, const MeasuredRun& run, const RunDifferences& after,
                     const JointModel& joint) {
  const int rows = after.path.count();
  const std::vector<double> t = times_of(run.path, rows);
  auto& panel = figure.add_panel("time [s]", joint.name + " [1]");
  const Eigen::MatrixXd measured = run.path.q.topRows(rows);
  Eigen::MatrixXd simulated(rows, 4);
  for (int row = 0; row < rows; ++row) {
    const Eigen::RowVector4d q = measured.block<1, 4>(row, joint.position_offset);
    const Vec3 turn = after.path.posture.block<1, 3>(row, joint.velocity_offset).transpose();
    const double angle = turn.norm();
    const Quat by = angle > 0.0 ? Quat(Eigen::AngleAxisd(angle, turn / angle)) : Quat::Identity();
    const Quat there = Quat(q[0], q[1], q[2], q[3]).normalized() * by;
    simulated.row(row) << there.w(), there.x(), there.y(), there.z();
  }
  const char* const names[] = {"w", "x", "y", "z"};
  for (int k = 0; k < 4; ++k) {
    SvgFigure::Line robot{std::string(names[k]) + " robot", t,
                          column(measured, joint.position_offset + k, 1.0), true, k};
    panel.lines.push_back(robot);
    panel.lines.push_back(
        {std::string(names[k]) + " simulation", t, column(simulated, k, 1.0), false, k});
  }
}

/// Measured and simulated.
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
    add_orientation(figure, run, after, joint);
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

using Line = SvgFigure::Line;

/// Of a row of Samples::q: how far it is from rest, over all joints.
double away_from_rest(const RobotModel& model, const Eigen::MatrixXd& q, Eigen::Index row) {
  double sum = 0.0;
  for (const JointModel& joint : model.skeleton->joints) {
    const Eigen::Index at = joint.position_offset;
    if (joint.type != JointType::kBall) {
      sum += std::abs(q(row, at));
    } else {
      sum += 2.0 * std::atan2(q.block<1, 3>(row, at + 1).norm(), std::abs(q(row, at)));
    }
  }
  return sum;
}

/// A trajectory that ends nearer to rest than it began: E_x -> E_0.
bool returns(const MeasuredRun& run, const RobotModel& model) {
  const Eigen::MatrixXd& q = run.path.q;
  return run.is_trajectory && q.rows() > 1 &&
         away_from_rest(model, q, q.rows() - 1) < away_from_rest(model, q, 0);
}

/// From the error before to that after, where both are known, with a mark at the one after.
struct Dumbbells {
  std::vector<double> before, after;  ///< by run; empty: not simulated

  std::vector<Line> lines(const std::vector<bool>& back) const {
    Line open{"before", {}, {}}, away{"after", {}, {}}, home{"after, back to rest", {}, {}};
    open.marks = Line::kOpen, away.marks = home.marks = Line::kFilled;
    open.colour = 10, away.colour = 0, home.colour = 1;
    for (std::size_t r = 0; r < std::max(before.size(), after.size()); ++r) {
      const auto x = static_cast<double>(r);
      const double old = r < before.size() ? before[r] : NAN;
      if (r < before.size()) open.x.push_back(x), open.y.push_back(old);
      if (r >= after.size()) continue;
      Line& line = back[r] ? home : away;
      line.x.push_back(x), line.y.push_back(after[r]);
      line.low.push_back(std::min(old, after[r])), line.high.push_back(std::max(old, after[r]));
    }
    std::vector<Line> all;
    for (const Line& line : {away, home, open}) {
      if (!line.x.empty()) all.push_back(line);
    }
    if (after.size() > 1) {
      double mean = 0.0;
      for (const double error : after) mean += error / static_cast<double>(after.size());
      Line level{
          "mean after", {0.0, static_cast<double>(after.size()) - 1.0}, {mean, mean}, true, 0};
      all.push_back(level);
    }
    return all;
  }
};

/// Mean over muscles, with a stroke from the least to the largest.
Line force_line(const std::string& label, const std::vector<RunDifferences>& runs) {
  Line line{label, {}, {}};
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const std::vector<double> errors = runs[r].shown().force_errors();
    if (errors.empty()) continue;
    double mean = 0.0;
    for (const double error : errors) mean += error / static_cast<double>(errors.size());
    line.x.push_back(static_cast<double>(r)), line.y.push_back(mean);
    line.low.push_back(*std::min_element(errors.begin(), errors.end()));
    line.high.push_back(*std::max_element(errors.begin(), errors.end()));
  }
  return line;
}

}  // namespace

std::string errors_figure(const BeforeAfter& both, const RobotModel& model,
                          const std::string& title) {
  SvgFigure figure(title);
  std::vector<bool> back;
  std::vector<std::string> names;
  for (const MeasuredRun& run : both.runs) {
    back.push_back(returns(run, model));
    names.push_back(run.name);
  }
  const auto add = [&](const std::string& label) -> SvgFigure::Panel& {
    auto& panel = figure.add_panel("", label);
    panel.names = names;
    panel.from_zero = true;
    return panel;
  };
  for (std::size_t j = 0; j < model.skeleton->joints.size(); ++j) {
    const JointUnit unit = unit_of(model.skeleton->joints[j]);
    Dumbbells joint;
    for (const RunDifferences& run : both.before) {
      joint.before.push_back(unit.scale * run_errors(run, model).joints[j]);
    }
    for (const RunDifferences& run : both.after) {
      joint.after.push_back(unit.scale * run_errors(run, model).joints[j]);
    }
    add(model.skeleton->joints[j].name + " error [" + unit.name + "]").lines = joint.lines(back);
  }
  if (model.muscles.empty()) return figure.render();
  Line after = force_line("after: least, mean, largest", both.after);
  Line before = force_line("before: mean", both.before);
  after.marks = Line::kFilled, before.marks = Line::kOpen;
  after.colour = 0, before.colour = 10;
  before.low.clear(), before.high.clear();
  auto& panel = add("force errors of muscles [N]");
  for (const Line& line : {after, before}) {
    if (!line.x.empty()) panel.lines.push_back(line);
  }
  return figure.render();
}

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

std::optional<std::size_t> worst_trajectory(const BeforeAfter& both, const RobotModel& model) {
  if (both.after.empty()) return std::nullopt;
  const MeanErrors mean = mean_errors(both.after, model);
  std::optional<std::size_t> worst;
  double most = -1.0;
  for (std::size_t r = 0; r < both.runs.size(); ++r) {
    if (!both.runs[r].is_trajectory) continue;
    const MeanErrors own = run_errors(both.after[r], model);
    for (std::size_t j = 0; j < own.joints.size(); ++j) {
      const double error = mean.joints[j] > 0.0 ? own.joints[j] / mean.joints[j] : 0.0;
      if (error > most) most = error, worst = r;
    }
  }
  return worst;
}

}  // namespace calibration
}  // namespace anthrob
