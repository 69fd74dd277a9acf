#pragma once

#include "anthrob_sim/simulation.h"
#include "experiment/axis_motion.h"
#include "experiment/experiment.h"

namespace anthrob {
namespace discovery {

/// A recording of driven joints. Nothing pulls such a joint back to its recorded position, so that
/// a replay would drift away because of any small error. Instead, the simulation is moved as the
/// joint was measured to move, under the measured effort and load. The effort that it lacks to do
/// so by itself (Simulation::lacking_effort()), averaged over each bin, is compared with nothing:
///   difference = mass matrix * acceleration + friction + gravity + stops - effort - load  [Nm, N]
/// Where friction may hold the joint, its effort is a range, and so is that mean: the difference is
/// what of it is left beyond zero.
///
/// The inertial effort of joints in ReplayScope::hidden_inertia is multiplied by the factor, not
/// below 0, that leaves least: these recordings do not tell the inertia, and the given one must not
/// stand in for what is missing.
///
/// Bins next to a hole in the positions that no polynomial may bridge are not compared.
class AxisExperiment final : public Experiment {
 public:
  AxisExperiment(const RobotModel& model, const Dataset& recording, const AxisOptions& options,
                 const ReplayScope& scope);

  void compare(const std::shared_ptr<const RobotModel>& model, const Starts& starts,
               float* out) const override;

 private:
  struct Axis {
    int joint;
    bool hidden_inertia;
    AxisMotion motion;
    Series effort, load;
  };
  /// Means over one bin.
  struct Lacking {
    double inertial = 0.0, low = 0.0, high = 0.0;
  };
  /// A simulation on its way along the measured motion.
  class Walk;

  /// @param index of the joint   @param longest part of the recording to take [s]
  void add_axis(int index, const JointModel& joint, const Dataset& recording, double longest);
  void write_differences(const Axis& axis, std::size_t offset, const std::vector<Lacking>& bins,
                         float* out) const;

  AxisOptions options_;
  double step_;
  std::size_t bins_ = 0, steps_per_bin_;
  std::vector<Axis> axes_;
};

}  // namespace discovery
}  // namespace anthrob
