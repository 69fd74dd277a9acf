#include "experiment/axis_experiment.h"

#include <algorithm>
#include <cmath>

#include "anthrob_calib/resume/fingerprint.h"
#include "experiment/hidden_inertia.h"

namespace anthrob {
namespace discovery {

AxisExperiment::AxisExperiment(const RobotModel& model, const Dataset& recording,
                               const AxisOptions& options, const ReplayScope& scope)
    : options_(options), step_(model.step) {
  name_ = recording.folder;
  known_numbers_ = recording.meta.model;
  steps_per_bin_ = static_cast<std::size_t>(std::lround(scope.bin / step_));
  if (step_ > scope.bin * (1.0 + 1e-9)) {
    throw BadInput("--dt " + std::to_string(step_) + ": expected a step of at most " +
                   std::to_string(scope.bin) +
                   " s, the length of the bins in which a driven axis is compared");
  }
  bin_ = static_cast<double>(steps_per_bin_) * step_;
  hidden_inertia_ = scope.hidden_inertia;
  const auto& joints = model.skeleton->joints;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (joints[j].driven) add_axis(static_cast<int>(j), joints[j], recording, scope.seconds);
  }
  resume::Fingerprint fingerprint;
  fingerprint.add(recording).add(bin_).add(static_cast<std::uint64_t>(bins_));
  for (const int joint : hidden_inertia_) fingerprint.add(static_cast<std::uint64_t>(joint));
  fingerprint_ = fingerprint.value();
  if (bins_ < options_.fewest_bins) {
    throw BadInput(recording.folder + ": too short: expected at least " +
                   std::to_string(options_.fewest_bins) + " bins of " + std::to_string(bin_) +
                   " s");
  }
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
  const bool hidden = std::count(hidden_inertia_.begin(), hidden_inertia_.end(), index) > 0;
  Axis axis{index, hidden, AxisMotion(position, bin_, bins_, options_),
            recording.series(joint.name + "/effort"), recording.series(joint.name + "/load")};
  if (axis.effort.empty()) {
    throw BadInput(recording.folder + ": column '" + joint.name +
                   "/effort' is missing: expected the measured effort of a driven joint, or zeros "
                   "if it was let go");
  }
  const bool hinge = joint.type == JointType::kHinge;
  channels_.push_back({joint.name, "effort", hinge ? "Nm" : "N", 0, present_.size(), bins_});
  present_.insert(present_.end(), bins_, 1);
  // A bin needs the motion at its begin and at its end, each from the samples around it.
  const double around = options_.smoothing.value * bin_;
  for (const auto& [from, to] : holes_of(position, length, bin_, options_)) {
    for (std::size_t b = 0; b < bins_; ++b) {
      const double begin = static_cast<double>(b) * bin_ - around;
      const bool outside = begin >= to || begin + bin_ + 2.0 * around <= from;
      if (!outside) present_[channels_.back().offset + b] = 0;
    }
  }
  for (std::size_t b = 0; b < bins_; ++b) {
    telling_.push_back(present_[channels_.back().offset + b] && axis.motion.moves(b) ? 1 : 0);
  }
  axes_.push_back(std::move(axis));
}

class AxisExperiment::Walk {
 public:
  Walk(const std::shared_ptr<const RobotModel>& model, const std::vector<Axis>& axes)
      : sim_(model), step_(model->step), q_(sim_.configuration()) {
    for (const Axis& axis : axes) {
      inputs_.push_back({&axis, HeldSeries(axis.effort), HeldSeries(axis.load)});
    }
    // Two steps before the begin: the first moves off, the second has no acceleration.
    put(-2.0 * step_);
    sim_.place(q_, {});
    for (const double time : {-step_, 0.0}) {
      put(time);
      sim_.imposed_posture().impose(q_);
      sim_.step();
    }
  }

  /// Takes the next step, and adds what it lacks to the sums of one bin each.
  void step(const std::vector<Lacking*>& sums) {
    const double begin = static_cast<double>(steps_) * step_ + 1e-9;
    for (Input& input : inputs_) {
      const Axis& axis = *input.axis;
      if (input.effort.advance(begin)) {
        sim_.apply_effort(axis.joint, axis.effort.acting_at(begin));
      }
      if (!axis.load.empty() && input.load.advance(begin)) {
        sim_.apply_load(axis.joint, axis.load.acting_at(begin));
      }
    }
    put(static_cast<double>(++steps_) * step_);
    sim_.imposed_posture().impose(q_);
    sim_.step();
    for (std::size_t a = 0; a < inputs_.size(); ++a) {
      const Axis& axis = *inputs_[a].axis;
      const auto lacking = sim_.lacking_effort(axis.joint, axis.motion.rest_speed());
      sums[a]->inertial += lacking.inertial;
      sums[a]->low += lacking.range.low;
      sums[a]->high += lacking.range.high;
    }
  }

 private:
  struct Input {
    const Axis* axis;
    HeldSeries effort, load;
  };

  /// Measured positions half a step after a time: the change of velocity in a step is then that
  /// of the time in which its effort acts.
  void put(double time) {
    for (const Input& input : inputs_) {
      const JointModel& joint =
          sim_.model().skeleton->joints[static_cast<std::size_t>(input.axis->joint)];
      q_[static_cast<std::size_t>(joint.position_offset)] =
          input.axis->motion.position(time + 0.5 * step_);
    }
  }

  Simulation sim_;
  double step_;
  std::vector<double> q_;
  std::vector<Input> inputs_;
  std::size_t steps_ = 0;
};

void AxisExperiment::compare(const std::shared_ptr<const RobotModel>& model, const Starts&,
                             float* out) const {
  Walk walk(model, axes_);
  const auto split = static_cast<std::size_t>(std::lround(step_ / model->step));
  const auto steps = steps_per_bin_ * split;
  std::vector<std::vector<Lacking>> lacking(axes_.size(), std::vector<Lacking>(bins_));
  std::vector<Lacking*> sums(axes_.size());
  for (std::size_t b = 0; b < bins_; ++b) {
    for (std::size_t a = 0; a < axes_.size(); ++a) sums[a] = &lacking[a][b];
    for (std::size_t s = 0; s < steps; ++s) walk.step(sums);
    for (Lacking* sum : sums) {
      sum->inertial /= static_cast<double>(steps);
      sum->low /= static_cast<double>(steps);
      sum->high /= static_cast<double>(steps);
    }
  }
  for (std::size_t a = 0; a < axes_.size(); ++a) {
    write_differences(axes_[a], channels_[a].offset, lacking[a], out);
  }
}

void AxisExperiment::write_differences(const Axis& axis, std::size_t offset,
                                       const std::vector<Lacking>& bins, float* out) const {
  double more = 0.0;
  if (axis.hidden_inertia) {
    std::vector<InertialBin> measured;
    for (std::size_t b = 0; b < bins_; ++b) {
      if (!present_[offset + b]) continue;
      measured.push_back({bins[b].inertial, bins[b].low, bins[b].high});
    }
    more = best_factor(measured, options_) - 1.0;
  }
  for (std::size_t b = 0; b < bins_; ++b) {
    const double inertial = more * bins[b].inertial;
    out[offset + b] =
        present_[offset + b]
            ? static_cast<float>(beyond_zero(bins[b].low + inertial, bins[b].high + inertial))
            : 0.0f;
  }
}

}  // namespace discovery
}  // namespace anthrob
