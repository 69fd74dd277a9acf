#include "experiment/axis_experiment.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "anthrob_calib/resume/fingerprint.h"
#include "anthrob_sim/simulation.h"

namespace anthrob {
namespace discovery {

namespace {

/// Position and velocity at `time` by a parabola through the samples around it.
std::pair<double, double> motion_at(const Series& series, double time, const AxisOptions& options) {
  const double half_width = options.smoothing;
  const auto first = std::lower_bound(series.t.begin(), series.t.end(), time - half_width);
  const auto last = std::upper_bound(series.t.begin(), series.t.end(), time + half_width);
  auto from = first - series.t.begin(), to = last - series.t.begin();
  const auto size = static_cast<std::ptrdiff_t>(series.t.size());
  while (to - from < options.fewest_samples && (from > 0 || to < size)) {
    if (from > 0) --from;
    if (to < size) ++to;
  }
  Eigen::MatrixXd basis(to - from, 3);
  Eigen::VectorXd values(to - from);
  // From the first value on, so that a small motion far from zero keeps its digits.
  const double origin = series.values[static_cast<std::size_t>(from)];
  for (auto i = from; i < to; ++i) {
    const double dt = series.t[static_cast<std::size_t>(i)] - time;
    basis.row(i - from) << 1.0, dt, dt * dt;
    values[i - from] = series.values[static_cast<std::size_t>(i)] - origin;
  }
  const Eigen::VectorXd parabola = basis.colPivHouseholderQr().solve(values);
  return {origin + parabola[0], parabola[1]};
}

/// Where positions are missing longer than a parabola may bridge: begin and end of each hole [s].
std::vector<std::pair<double, double>> holes_of(const Series& series, double end,
                                                const AxisOptions& options) {
  std::vector<double> periods;
  for (std::size_t i = 1; i < series.t.size(); ++i) {
    periods.push_back(series.t[i] - series.t[i - 1]);
  }
  if (periods.empty()) return {{0.0, end}};
  const auto middle = periods.begin() + static_cast<std::ptrdiff_t>(periods.size() / 2);
  std::nth_element(periods.begin(), middle, periods.end());
  const double longest = std::max(2.0 * options.smoothing, options.most_periods * *middle);
  std::vector<std::pair<double, double>> holes;
  const auto add = [&](double from, double to) {
    if (to - from > longest) holes.emplace_back(from, to);
  };
  add(0.0, series.t.front());
  for (std::size_t i = 1; i < series.t.size(); ++i) add(series.t[i - 1], series.t[i]);
  add(series.t.back(), end);
  return holes;
}

}  // namespace

AxisExperiment::AxisExperiment(const RobotModel& model, const Dataset& recording,
                               const AxisOptions& options, const ReplayScope& scope)
    : options_(options), step_(model.step) {
  name_ = recording.folder;
  steps_per_bin_ = static_cast<std::size_t>(std::lround(scope.bin / step_));
  if (steps_per_bin_ == 0) {
    throw BadInput("--dt " + std::to_string(step_) + ": expected a step of at most " +
                   std::to_string(scope.bin) +
                   " s, the length of the bins in which a driven axis is compared");
  }
  bin_ = static_cast<double>(steps_per_bin_) * step_;
  const auto& joints = model.skeleton->joints;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (joints[j].driven) add_axis(static_cast<int>(j), joints[j], recording, scope.seconds);
  }
  fingerprint_ =
      resume::Fingerprint().add(recording).add(bin_).add(static_cast<std::uint64_t>(bins_)).value();
  if (bins_ < options_.fewest_bins) {
    throw BadInput(recording.folder + ": too short: expected at least " +
                   std::to_string(options_.fewest_bins) + " bins of " + std::to_string(bin_) +
                   " s");
  }
  measure_inertia(model);
}

void AxisExperiment::add_axis(int index, const JointModel& joint, const Dataset& recording,
                              double longest) {
  const Series position = recording.series(joint.name + "/position");
  if (position.empty()) {
    throw BadInput(recording.folder + ": column '" + joint.name +
                   "/position' is missing: expected the measured motion of a driven joint");
  }
  const double length = seconds(recording.end() - recording.begin());
  if (duration_ == 0.0) {
    duration_ = std::min(longest, length);
    bins_ = static_cast<std::size_t>(std::floor(duration_ / bin_ + 1e-9));
  }
  Axis axis{index,
            {},
            {},
            {},
            recording.series(joint.name + "/effort"),
            recording.series(joint.name + "/load")};
  if (axis.effort.empty()) {
    throw BadInput(recording.folder + ": column '" + joint.name +
                   "/effort' is missing: expected the measured effort of a driven joint");
  }
  for (std::size_t edge = 0; edge <= bins_; ++edge) {
    const auto [q, u] = motion_at(position, static_cast<double>(edge) * bin_, options_);
    axis.position.push_back(q);
    axis.velocity.push_back(u);
  }
  const bool hinge = joint.type == JointType::kHinge;
  channels_.push_back({joint.name, "effort", hinge ? "Nm" : "N", 0, present_.size(), bins_});
  present_.insert(present_.end(), bins_, 1);
  // A bin needs the motion at its begin and at its end, each from the samples around it.
  for (const auto& [from, to] : holes_of(position, length, options_)) {
    for (std::size_t b = 0; b < bins_; ++b) {
      const double begin = static_cast<double>(b) * bin_ - options_.smoothing;
      const bool outside = begin >= to || begin + bin_ + 2.0 * options_.smoothing <= from;
      if (!outside) present_[channels_.back().offset + b] = 0;
    }
  }
  axes_.push_back(std::move(axis));
}

void AxisExperiment::measure_inertia(const RobotModel& model) {
  Simulation sim(std::make_shared<RobotModel>(model));
  for (std::size_t b = 0; b < bins_; ++b) {
    place(sim, b);
    sim.step();
    for (Axis& axis : axes_) {
      const JointModel& joint = model.skeleton->joints[static_cast<std::size_t>(axis.joint)];
      axis.inertia.push_back(
          sim.tree().mass_matrix()(joint.velocity_offset, joint.velocity_offset));
    }
  }
}

void AxisExperiment::place(Simulation& sim, std::size_t edge) const {
  const SkeletonModel& skeleton = *sim.model().skeleton;
  std::vector<double> u(static_cast<std::size_t>(skeleton.velocity_count), 0.0);
  Snapshot snapshot = sim.snapshot();
  for (const Axis& axis : axes_) {
    const JointModel& joint = skeleton.joints[static_cast<std::size_t>(axis.joint)];
    snapshot.q[static_cast<std::size_t>(joint.position_offset)] = axis.position[edge];
    u[static_cast<std::size_t>(joint.velocity_offset)] = axis.velocity[edge];
  }
  sim.tree().place(snapshot.q, u, snapshot.bodies);
  sim.restore(snapshot);
}

void AxisExperiment::compare(const std::shared_ptr<const RobotModel>& model, Starts&,
                             float* out) const {
  Simulation sim(model);
  const auto split = static_cast<std::size_t>(std::lround(step_ / model->step));
  const auto steps = steps_per_bin_ * split;
  struct Input {
    const Axis* axis;
    HeldSeries effort, load;
  };
  std::vector<Input> inputs;
  for (const Axis& axis : axes_) {
    inputs.push_back({&axis, HeldSeries(axis.effort), HeldSeries(axis.load)});
  }
  for (std::size_t b = 0; b < bins_; ++b) {
    place(sim, b);
    for (std::size_t s = 0; s < steps; ++s) {
      const double time = (static_cast<double>(b * steps + s)) * model->step + 1e-9;
      for (Input& input : inputs) {
        if (input.effort.advance(time)) {
          sim.apply_effort(input.axis->joint, input.axis->effort.acting_at(time));
        }
        if (!input.axis->load.empty() && input.load.advance(time)) {
          sim.apply_load(input.axis->joint, input.axis->load.acting_at(time));
        }
      }
      sim.step();
    }
    for (std::size_t a = 0; a < axes_.size(); ++a) {
      const Axis& axis = axes_[a];
      const std::size_t at = channels_[a].offset + b;
      if (!present_[at]) {
        out[at] = 0.0f;
        continue;
      }
      const int dof = model->skeleton->joints[static_cast<std::size_t>(axis.joint)].velocity_offset;
      const double error =
          sim.tree().velocities()[static_cast<std::size_t>(dof)] - axis.velocity[b + 1];
      out[at] = static_cast<float>(error * axis.inertia[b] / bin_);
    }
  }
}

}  // namespace discovery
}  // namespace anthrob
