#pragma once

#include "anthrob_sim/simulation.h"
#include "experiment/experiment.h"

namespace anthrob {
namespace discovery {

/// A recording of driven joints. Nothing pulls such a joint back to its recorded position, so that
/// a replay would drift away because of any small error. Instead, the simulation of every bin
/// starts from the measured motion and runs under the measured effort. The difference of velocity
/// at the end of the bin, times the inertia of the given model, divided by the length of the bin,
/// is the effort that the model is missing [N or Nm].
///
/// Positions and velocities at the edges of bins come from parabolas through the measured positions
/// around them (AxisOptions). Bins next to a hole in the positions that no parabola may bridge are
/// not compared.
class AxisExperiment final : public Experiment {
 public:
  AxisExperiment(const RobotModel& model, const Dataset& recording, const AxisOptions& options,
                 const ReplayScope& scope);

  void compare(const std::shared_ptr<const RobotModel>& model, Starts& starts,
               float* out) const override;

 private:
  struct Axis {
    int joint;
    std::vector<double> position, velocity;  ///< at the bins' edges
    std::vector<double> inertia;             ///< by bin
    Series effort, load;
  };

  /// @param index of the joint   @param longest part of the recording to take [s]
  void add_axis(int index, const JointModel& joint, const Dataset& recording, double longest);
  /// Of the given model, at every bin.
  void measure_inertia(const RobotModel& model);
  /// Gives the simulation the measured motion at the edge of a bin.
  void place(Simulation& sim, std::size_t edge) const;

  AxisOptions options_;
  double step_;
  std::size_t bins_, steps_per_bin_;
  std::vector<Axis> axes_;
};

}  // namespace discovery
}  // namespace anthrob
