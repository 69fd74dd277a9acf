#pragma once

#include "anthrob_sim/actuator/actuator.h"

namespace anthrob {

/// Hill-type contractile element, CALIPER's second actuator family. Together with the series
/// elastic element as its tendon it is the damped-equilibrium muscle of Millard et al. (J Biomech
/// Eng 135, 2013), with Thelen's curves (J Biomech Eng 125, 2003), all normalised to optimal length
/// and maximal force:
///   F / F_0 = a f_L(l) f_V(v) + f_P(l) + beta v,       v = dl/dt / v_max
///   da/dt = (u - a) / tau(u, a)
/// The element's length enters the chain as tendon length: l_T = rest_tendon_length + l - l_opt.
/// Position is the shortening (l_opt - l) / l_opt; the input is the excitation u in [0, 1].
class HillMuscle final : public Actuator {
 public:
  struct Parameters {
    double max_force;           ///< F_0 [N], > 0
    double optimal_length;      ///< l_opt [m], > 0
    double max_velocity;        ///< v_max in optimal lengths per second, > 0
    double activation_time;     ///< [s], > 0
    double deactivation_time;   ///< [s], > 0
    double damping;             ///< beta [1], > 0
    double rest_tendon_length;  ///< [m]
  };

  HillMuscle(const Parameters& parameters, double step) : p_(parameters), step_(step) {}

  std::size_t state_size() const override { return state_size_of<State>(); }
  void place(double position, StateView state) const override;
  void impose(double position, double velocity, double load, StateView state) const override;
  void advance(double input, double load, StateView state) const override;
  Readout read(StateView state) const override;
  double tendon_length(StateView state) const override;
  double winding_speed(StateView state) const override;
  double position_for(double tendon_length) const override;
  double highest_position() const override;
  double holding_input(double position, double load) const override;
  double input_low() const override { return 0.0; }
  double input_high() const override { return 1.0; }

  /// The curves, normalised; length in optimal lengths, velocity in v_max, lengthening positive.
  static double force_length(double length);
  static double passive_force(double length);
  static double force_velocity(double velocity);
  static double force_velocity_slope(double velocity);

  static std::shared_ptr<const Actuator> load(const ConfigNode& kind, const ConfigNode& muscle,
                                              double step);

 private:
  struct State {
    double activation;  ///< a in [0.01, 1]
    double length;      ///< in optimal lengths
    double velocity;    ///< in v_max, lengthening positive
  };

  double solve_velocity(double force, const State& s) const;

  Parameters p_;
  double step_;
};

}  // namespace anthrob
