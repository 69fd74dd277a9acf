#pragma once

#include <Eigen/Core>
#include <memory>

#include "anthrob_core/config_node.h"
#include "anthrob_sim/actuator/actuator.h"

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

/// Brushed DC motor, gear and spindle (4.1)-(4.12); l_T = rest_tendon_length - spindle_radius *
/// position.
///
/// The thesis takes ten Runge-Kutta steps a millisecond. With voltage and load held over the step
/// the equations are linear, so the step is one precomputed affine map, exact for any step.
class DcMotor final : public GearedMotor {
 public:
  struct Parameters {
    double resistance;                ///< R_A + power stage [ohm], > 0
    double inductance;                ///< L_A [H], > 0
    double torque_constant;           ///< K_T [Nm/A], > 0
    double back_emf_constant;         ///< K_E [Vs/rad], > 0
    double inertia;                   ///< J_M + J_G at the motor shaft [kg m^2], > 0
    double ratio;                     ///< N [1], > 0
    double friction_torque;           ///< dry friction at the motor shaft [Nm], >= 0
    double spindle_radius;            ///< r_S, tendon included [m], > 0
    double rest_tendon_length;        ///< l_T0 [m]
    double voltage_limit;             ///< largest useful input [V]
    double winding_resistance = 0.0;  ///< share of the winding in `resistance` [ohm]
  };

  DcMotor(const Parameters& parameters, std::shared_ptr<const GearLaw> gear, double step);

  std::size_t state_size() const override { return state_size_of<State>(); }
  void place(double position, StateView state) const override;
  void impose(double position, double velocity, double load, StateView state) const override;
  void advance(double input, double load, StateView state) const override {
    advance_with(input, load, 0.0, state);
  }
  void advance_with(double input, double load, double torque, StateView state) const override;
  Readout read(StateView state) const override;
  double tendon_length(StateView state) const override;
  double winding_speed(StateView state) const override;
  double position_for(double tendon_length) const override;
  double holding_input(double position, double load) const override;
  double input_low() const override { return -p_.voltage_limit; }
  double input_high() const override { return p_.voltage_limit; }

  const Parameters& parameters() const { return p_; }
  const std::shared_ptr<const GearLaw>& gear() const { return gear_; }
  double conductance() const override { return stuck_gain_; }
  double inertia() const override { return p_.inertia; }
  double ratio() const override { return p_.ratio; }
  double spindle_radius() const override { return p_.spindle_radius; }

  static std::shared_ptr<const Actuator> load(const ConfigNode& kind, const ConfigNode& muscle,
                                              double step);
  static std::shared_ptr<const Actuator> build(const ConfigNode& kind, double spindle_radius,
                                               double rest_tendon_length, double step);

 private:
  struct State {
    double current;   ///< [A]
    double velocity;  ///< omega_G [rad/s]
    double position;  ///< theta_G [rad]
  };
  /// Step from (current, velocity) and (voltage, torque) to (current, velocity, position change).
  using Map = Eigen::Matrix<double, 3, 4>;

  void advance_with_friction(double input, const GearLaw::Load& load, State& s) const;
  void apply(double input, double torque, State& s) const;

  Parameters p_;
  std::shared_ptr<const GearLaw> gear_;
  double step_;
  Map map_;
  double stuck_keep_, stuck_gain_;  ///< current over one step with the shaft held
};

}  // namespace anthrob
