#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "anthrob_driver/emulation/plant.h"
#include "anthrob_driver/hardware.h"
#include "anthrob_sim/simulation.h"

namespace anthrob {

/// The simulator's physics behind emulated ECUs: the boards' voltages drive its motors, and the
/// boards' sensors read its state (as changed by the model's effects on sensors). Muscles that the
/// model lacks stand still, and pads that it lacks read no force (such as those of a hand).
class SimulatorPlant final : public driver::Plant {
 public:
  /// @throws BadInput if the model's step does not divide a millisecond, or if an effect of the
  /// model delays commands, which is impossible here: commands come from the boards' firmware
  SimulatorPlant(std::shared_ptr<const RobotModel> model, const driver::Hardware& hardware);

  Muscle muscle(std::size_t muscle) const override;
  double joint(std::size_t joint) const override;
  double touch(std::size_t pad) const override;
  void drive(std::size_t muscle, double voltage) override;
  void advance() override;

  const Simulation& simulation() const { return simulation_; }
  Simulation& simulation() { return simulation_; }

 private:
  Simulation simulation_;
  int steps_;  ///< of the simulation in a millisecond
  // Indices in the model, by those of the hardware; none: the model lacks it.
  std::vector<std::optional<int>> muscles_, joints_;
  std::vector<std::optional<std::size_t>> pads_;
};

}  // namespace anthrob
