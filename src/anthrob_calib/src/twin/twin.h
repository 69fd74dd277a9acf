#pragma once

#include <memory>
#include <vector>

#include "anthrob_sim/simulation.h"
#include "twin/channels.h"
#include "twin/feed.h"
#include "twin/twin_options.h"

namespace anthrob {
namespace twin {

/// What was measured over one step of the twins, the same for all of them.
struct StepInputs {
  struct OfMuscle {
    bool enabled = false;  ///< its unit follows references
    ecu::Mode mode = ecu::Mode::kVoltage;
    double reference = kNotMeasured, voltage = kNotMeasured;
    double position = kNotMeasured;                 ///< at the beginning, as the sensor reads it
    double from = kNotMeasured, to = kNotMeasured;  ///< what a late sensor reads later on
  };
  std::vector<OfMuscle> muscles;
  std::vector<Wrench> pushes;  ///< of links, from outside
  std::vector<double> q;       ///< at the end, as sensors read it
  std::vector<double> effort;  ///< of driven joints; NaN: not measured
};

/// A copy of the model that is fed with one part of what is measured. Deterministic.
class Twin {
 public:
  /// @param model as measurements are compared with it: without noise and counts
  Twin(std::shared_ptr<const RobotModel> model, Feed feed, const TwinOptions& options);

  Feed feed() const { return feed_; }
  Simulation& sim() { return sim_; }
  const Simulation& sim() const { return sim_; }

  /// Takes over a state that has settled; what was imposed is released.
  void start(const Snapshot& settled);
  /// @throws NumericalFailure, and BadInput for inputs that nobody can have measured
  void step(const StepInputs& inputs);
  /// What its sensors read now, by Channel::value.
  void read(const Channels& channels, std::vector<double>& values) const;

 private:
  void command(int muscle, const StepInputs::OfMuscle& input);
  void apply_voltage(int muscle, const StepInputs::OfMuscle& input);

  Simulation sim_;
  Feed feed_;
  std::vector<double> pull_;  ///< by muscle, 0: none [V/rad]
};

/// Puts a simulation where the robot was measured, and lets springs relax there.
/// @param q, positions as the sensors read them   @param imposed whether all joints were measured
/// @throws as Simulation::place() and step()
Snapshot settle(Simulation& sim, const std::vector<double>& q, const std::vector<double>& positions,
                bool imposed, const TwinOptions& options);

}  // namespace twin
}  // namespace anthrob
