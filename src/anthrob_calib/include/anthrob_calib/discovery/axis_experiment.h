#pragma once

#include "anthrob_calib/discovery/experiment.h"
#include "anthrob_sim/simulation.h"

namespace anthrob {
namespace discovery {

/// A recording of driven joints. Nothing holds such a robot where it was, so a replay drifts away
/// from whatever small error there is. Instead every bin starts from the measured motion, runs
/// under the measured effort, and is judged by the velocity at its end: the difference, times the
/// inertia the given model sees, over the length of the bin, is the effort that the model lacks.
///
/// Motion comes from the positions by local parabolas over +-kSmoothing.
class AxisExperiment final : public Experiment {
 public:
  static constexpr double kSmoothing = 0.006;  ///< [s]

  AxisExperiment(const RobotModel& model, const Dataset& recording,
                 const ExperimentOptions& options);

  void compare(const std::shared_ptr<const RobotModel>& model, Starts& starts,
               float* out) const override;

 private:
  struct Axis {
    int joint;
    std::vector<double> position, velocity;  ///< at the bins' edges
    std::vector<double> inertia;             ///< by bin
    Series effort, load;
  };

  void place(Simulation& sim, std::size_t edge) const;

  double step_;
  std::size_t bins_, steps_per_bin_;
  std::vector<Axis> axes_;
};

}  // namespace discovery
}  // namespace anthrob
