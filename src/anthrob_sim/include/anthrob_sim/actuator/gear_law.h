#pragma once

#include <memory>

#include "anthrob_core/config_node.h"

namespace anthrob {

/// How losses in the gear change the load that the motor feels.
class GearLaw {
 public:
  /// Torques at the gear output [Nm].
  struct Load {
    double torque;    ///< slows winding in, speeds up winding out
    double friction;  ///< >= 0: opposes motion, holds at rest
  };

  virtual ~GearLaw() = default;
  /// @param torque f r_S of the tendon [Nm]   @param velocity of the output [rad/s]   @param
  /// current [A]
  virtual Load load(double torque, double velocity, double current) const = 0;

  virtual double efficiency() const = 0;
  /// The same law with another efficiency, in (0, 1].
  virtual std::shared_ptr<const GearLaw> with_efficiency(double efficiency) const = 0;
};

/// `{law: current_sign | load_direction, efficiency:, ...}`
std::shared_ptr<const GearLaw> make_gear_law(const ConfigNode& node);

/// The thesis's smooth efficiency (4.13): the gear is driven forward if velocity and current have
/// one sign.
///   rho = eta + (1/eta - eta) (tanh(-kappa omega i - xi) + 1) / 2,   load = torque / rho
/// Where the motor helps a load that already runs down, this law creates energy (Table 4.1, row 3).
class CurrentSignGear final : public GearLaw {
 public:
  /// @param efficiency eta in (0, 1]   @param steepness kappa [1/W]   @param shift xi [1]
  CurrentSignGear(double efficiency, double steepness, double shift)
      : efficiency_(efficiency), steepness_(steepness), shift_(shift) {}
  Load load(double torque, double velocity, double current) const override;
  double efficiency() const override { return efficiency_; }
  std::shared_ptr<const GearLaw> with_efficiency(double efficiency) const override {
    return std::make_shared<CurrentSignGear>(efficiency, steepness_, shift_);
  }

 private:
  double efficiency_, steepness_, shift_;
};

/// Efficiency by the direction in which the load moves, which never creates energy: torque / eta to
/// wind in, torque eta to run down, anything between at rest. The same as dry friction in
/// proportion to the load.
class LoadDirectionGear final : public GearLaw {
 public:
  explicit LoadDirectionGear(double efficiency) : efficiency_(efficiency) {}
  Load load(double torque, double velocity, double current) const override;
  double efficiency() const override { return efficiency_; }
  std::shared_ptr<const GearLaw> with_efficiency(double efficiency) const override {
    return std::make_shared<LoadDirectionGear>(efficiency);
  }

 private:
  double efficiency_;
};

}  // namespace anthrob
