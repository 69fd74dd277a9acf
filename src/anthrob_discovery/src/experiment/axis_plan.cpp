#include "experiment/axis_plan.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

#include "experiment/axis_motion.h"

namespace anthrob {
namespace discovery {

namespace {

/// One axis in all recordings, in bins.
struct BinnedAxis {
  std::vector<std::vector<double>> effort, acceleration, velocity, position;  ///< by recording
  std::vector<std::vector<char>> moves;
};

/// Mean of what is held between samples, less what acts before the first.
double mean_effort(const Series& series, double from, double to, double period) {
  if (series.empty()) return 0.0;
  const int points = std::clamp(static_cast<int>(std::ceil((to - from) / period)), 1, 400);
  double sum = 0.0;
  for (int i = 0; i < points; ++i) {
    sum += series.acting_at(from + (to - from) * (i + 0.5) / points);
  }
  return sum / points;
}

BinnedAxis binned(const std::string& joint, const std::vector<Dataset>& recordings, double bin,
                  const AxisOptions& options) {
  BinnedAxis axis;
  for (const Dataset& recording : recordings) {
    const Series position = recording.series(joint + "/position"),
                 effort = recording.series(joint + "/effort"),
                 load = recording.series(joint + "/load");
    std::vector<double> u, a, v, q;
    std::vector<char> moves;
    const double length = seconds(recording.end() - recording.begin());
    const auto bins = static_cast<std::size_t>(std::floor(length / bin + 1e-9));
    if (position.t.size() > 2 && !effort.empty() && bins > 0) {
      const AxisMotion motion(position, bin, bins, options);
      const double period = std::max(1e-4, usual_period(effort));
      for (std::size_t b = 0; b < bins; ++b) {
        const double from = static_cast<double>(b) * bin;
        u.push_back(mean_effort(effort, from, from + bin, period) +
                    mean_effort(load, from, from + bin, period));
        a.push_back(motion.mean_acceleration(b));
        v.push_back(motion.mean_velocity(b));
        q.push_back(0.5 * (motion.position_at_edge(b) + motion.position_at_edge(b + 1)));
        moves.push_back(motion.moves(b) ? 1 : 0);
      }
    }
    axis.effort.push_back(u);
    axis.acceleration.push_back(a);
    axis.velocity.push_back(v);
    axis.position.push_back(q);
    axis.moves.push_back(moves);
  }
  return axis;
}

/// Rms of the inertial effort over that of the effort, while it moves.
double inertial_share(const BinnedAxis& axis, double inertia) {
  double inertial = 0.0, all = 0.0;
  for (std::size_t r = 0; r < axis.effort.size(); ++r) {
    for (std::size_t b = 0; b < axis.effort[r].size(); ++b) {
      if (!axis.moves[r][b]) continue;
      inertial += std::pow(inertia * axis.acceleration[r][b], 2);
      all += axis.effort[r][b] * axis.effort[r][b];
    }
  }
  return all > 0.0 ? std::sqrt(inertial / all) : 0.0;
}

/// What a plain axis explains of its effort while it moves: inertia, dry and viscous friction, an
/// offset and, of a hinge, weight.
struct Inertia {
  double value = 0.0;  ///< [kg m^2, kg]
  double error = 0.0;  ///< its standard error
  double share = 0.0;  ///< rms of the inertial effort over that of the effort, while it moves
};

Inertia estimated(const BinnedAxis& axis, bool hinge, const AxisOptions& options) {
  const Eigen::Index columns = hinge ? 6 : 4;
  std::vector<Eigen::VectorXd> rows;
  std::vector<double> efforts;
  for (std::size_t r = 0; r < axis.effort.size(); ++r) {
    for (std::size_t b = 0; b < axis.effort[r].size(); ++b) {
      if (!axis.moves[r][b]) continue;
      Eigen::VectorXd row(columns);
      row.head(4) << axis.acceleration[r][b], std::copysign(1.0, axis.velocity[r][b]),
          axis.velocity[r][b], 1.0;
      if (hinge) row.tail(2) << std::sin(axis.position[r][b]), std::cos(axis.position[r][b]);
      rows.push_back(row);
      efforts.push_back(axis.effort[r][b]);
    }
  }
  Inertia found;
  if (rows.size() < options.fewest_bins) return found;
  const auto count = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd basis(count, columns);
  for (Eigen::Index i = 0; i < count; ++i) basis.row(i) = rows[static_cast<std::size_t>(i)];
  const Eigen::Map<const Eigen::VectorXd> effort(efforts.data(), count);
  // In units of their own size, so that none is lost beside another.
  Eigen::VectorXd size = basis.colwise().norm().transpose();
  for (double& s : size) s = s > 0.0 ? s : 1.0;
  const Eigen::MatrixXd scaled = basis * size.cwiseInverse().asDiagonal();
  const Eigen::VectorXd fit = scaled.colPivHouseholderQr().solve(effort);
  found.value = std::max(0.0, fit[0] / size[0]);
  const double scatter = (scaled * fit - effort).squaredNorm() / static_cast<double>(count);
  // Motion in one direction does not tell dry friction from an offset: no inverse, but this.
  found.error = std::sqrt(scatter) / size[0] *
                scaled.completeOrthogonalDecomposition().pseudoInverse().row(0).norm();
  found.share = inertial_share(axis, found.value);
  return found;
}

struct Scatter {
  double logarithm = 0.0;
  double error = 0.0;  ///< standard error of the logarithm
};

/// Scatter of an effort about a smooth curve, from third differences within motions; nothing if
/// there are too few.
std::optional<Scatter> scatter_of(const BinnedAxis& axis, double inertia,
                                  const AxisOptions& options) {
  std::vector<double> third;
  for (std::size_t r = 0; r < axis.effort.size(); ++r) {
    const auto rest = [&](std::size_t b) {
      return axis.effort[r][b] - inertia * axis.acceleration[r][b];
    };
    for (std::size_t b = 3; b < axis.effort[r].size(); ++b) {
      const auto& moves = axis.moves[r];
      if (!(moves[b] && moves[b - 1] && moves[b - 2] && moves[b - 3])) continue;
      third.push_back(std::abs(rest(b) - 3.0 * rest(b - 1) + 3.0 * rest(b - 2) - rest(b - 3)));
    }
  }
  if (third.size() < options.fewest_bins) return std::nullopt;
  const auto middle = third.begin() + static_cast<std::ptrdiff_t>(third.size() / 2);
  std::nth_element(third.begin(), middle, third.end());
  if (!(*middle > 0.0)) return std::nullopt;
  // Of normal noise, by the median of its sizes.
  return Scatter{std::log(1.4826 * *middle / std::sqrt(20.0)),
                 1.17 / std::sqrt(static_cast<double>(third.size()))};
}

/// Lengths to choose from, whole sampling periods where these are long.
std::vector<double> lengths_of_bins(const RobotModel& model, const std::vector<Dataset>& recordings,
                                    const AxisOptions& options) {
  double period = 0.0;  // the slowest
  for (const JointModel& joint : model.skeleton->joints) {
    if (!joint.driven) continue;
    for (const Dataset& recording : recordings) {
      period = std::max({period, usual_period(recording.series(joint.name + "/position")),
                         usual_period(recording.series(joint.name + "/effort"))});
    }
  }
  std::vector<double> lengths;
  const double least = std::max(options.shortest_bin, period);
  for (double length = options.longest_bin; length > 0.999 * least;
       length /= options.ratio_of_bins) {
    double whole = length;
    if (period > 0.0) whole = std::round(length / period) * period;
    if (!lengths.empty() && whole > 0.999 * lengths.back()) continue;
    lengths.push_back(whole);
  }
  if (lengths.empty()) lengths.push_back(least);
  return lengths;
}

/// All driven joints in bins of one length.
struct PlannedBins {
  double length = 0.0;  ///< [s]
  std::vector<BinnedAxis> axes;
  std::vector<Inertia> inertias;  ///< as these bins show them
};

PlannedBins planned(const RobotModel& model, const std::vector<Dataset>& recordings, double length,
                    const AxisOptions& options) {
  PlannedBins plan;
  plan.length = length;
  for (const JointModel& joint : model.skeleton->joints) {
    if (!joint.driven) continue;
    plan.axes.push_back(binned(joint.name, recordings, length, options));
    plan.inertias.push_back(estimated(plan.axes.back(), joint.type == JointType::kHinge, options));
  }
  return plan;
}

/// Where long bins tell an inertia, it is that of the shorter ones, too: there, noise of the
/// acceleration hides it, and would not count against them.
void share_inertias(std::vector<PlannedBins>& plans, const AxisOptions& options) {
  for (std::size_t a = 0; !plans.empty() && a < plans.front().axes.size(); ++a) {
    const Inertia* told = nullptr;
    for (PlannedBins& plan : plans) {
      Inertia& own = plan.inertias[a];
      if (told) {
        own.value = told->value;
        own.share = inertial_share(plan.axes[a], own.value);
      } else if (own.value > options.inertia_told * own.error) {
        told = &own;
      }
    }
  }
}

/// What scatters in each second, of all axes.
struct PlanScore {
  double value = 0.0;  ///< logarithm
  double error = 0.0;  ///< its standard error
};

std::optional<PlanScore> score_of(const PlannedBins& plan, const std::vector<Inertia>& inertias,
                                  const AxisOptions& options) {
  std::optional<PlanScore> score;
  for (std::size_t a = 0; a < plan.axes.size(); ++a) {
    const auto scatter = scatter_of(plan.axes[a], inertias[a].value, options);
    if (!scatter) continue;
    if (!score) score.emplace();
    score->value += scatter->logarithm + 0.5 * std::log(plan.length);
    score->error = std::hypot(score->error, scatter->error);
  }
  return score;
}

/// Begins and ends of motions, each of which is in one bin, for each bin that moves.
double mixed_share(const PlannedBins& plan) {
  std::size_t moving = 0, mixed = 0;
  for (const BinnedAxis& axis : plan.axes) {
    for (const std::vector<char>& moves : axis.moves) {
      for (std::size_t b = 0; b < moves.size(); ++b) {
        moving += moves[b] ? 1 : 0;
        mixed += b > 0 && moves[b] != moves[b - 1] ? 1 : 0;
      }
    }
  }
  return moving > 0 ? static_cast<double>(mixed) / static_cast<double>(moving) : 0.0;
}

std::vector<int> joints_of_hidden_inertia(const RobotModel& model, const PlannedBins& plan,
                                          const AxisOptions& options) {
  std::vector<int> hidden;
  std::size_t axis = 0;
  for (std::size_t j = 0; j < model.skeleton->joints.size(); ++j) {
    if (!model.skeleton->joints[j].driven) continue;
    if (plan.inertias[axis++].share < options.inertia_shows.value) {
      hidden.push_back(static_cast<int>(j));
    }
  }
  return hidden;
}

}  // namespace

AxisPlan plan_axes(const RobotModel& model, const std::vector<Dataset>& recordings,
                   const AxisOptions& options) {
  const std::vector<double> lengths = lengths_of_bins(model, recordings, options);
  std::vector<PlannedBins> plans;
  for (const double length : lengths) plans.push_back(planned(model, recordings, length, options));
  share_inertias(plans, options);
  // Longest first: a shorter one must be better, not only as good.
  std::size_t chosen = 0;
  for (std::size_t i = 1; i < plans.size(); ++i) {
    const auto best = score_of(plans[chosen], plans[chosen].inertias, options),
               score = score_of(plans[i], plans[i].inertias, options);
    if (score && (!best || score->value < best->value - options.clearly_better)) chosen = i;
  }
  // But in long bins, rest and motion mix: then one that is about as good, for the same inertia.
  const std::vector<Inertia> inertias = plans[chosen].inertias;
  const auto best = score_of(plans[chosen], inertias, options);
  for (std::size_t i = chosen; best && i < plans.size(); ++i) {
    const auto score = score_of(plans[i], inertias, options);
    if (!score || score->value > best->value + best->error) continue;
    chosen = i;
    if (mixed_share(plans[i]) <= options.most_mixed.value) break;
  }
  return {lengths[chosen], joints_of_hidden_inertia(model, plans[chosen], options)};
}

std::vector<std::string> remarks_on_plan(const RobotModel& model, const AxisPlan& plan) {
  std::vector<std::string> remarks;
  for (const int joint : plan.hidden_inertia) {
    remarks.push_back(model.skeleton->joints[static_cast<std::size_t>(joint)].name +
                      ": its effort hardly depends on its acceleration; these recordings do not "
                      "tell its inertia, and that of the model does not count");
  }
  return remarks;
}

}  // namespace discovery
}  // namespace anthrob
