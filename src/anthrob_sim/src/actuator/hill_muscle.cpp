#include "actuator/hill_muscle.h"

#include <algorithm>
#include <cmath>

namespace anthrob {

namespace {
// Thelen 2003, young adult values.
constexpr double kShapeWidth = 0.45;    // gamma of the active force-length curve
constexpr double kPassiveStrain = 0.6;  // strain at which passive force reaches F_0
constexpr double kPassiveShape = 5.0;   // k_PE
constexpr double kCurvature = 0.25;     // A_f of the force-velocity hyperbola
constexpr double kLengthening = 1.4;    // largest force when lengthened, in F_0
constexpr double kMinActivation = 0.01;
constexpr double kShortest = 0.2;  // of the optimal length
}  // namespace

double HillMuscle::force_length(double length) {
  const double x = length - 1.0;
  return std::exp(-x * x / kShapeWidth);
}

double HillMuscle::passive_force(double length) {
  if (length <= 1.0) return 0.0;
  return std::expm1(kPassiveShape * (length - 1.0) / kPassiveStrain) / std::expm1(kPassiveShape);
}

double HillMuscle::force_velocity(double v) {
  if (v <= 0.0) return v <= -1.0 ? 0.0 : (1.0 + v) / (1.0 - v / kCurvature);
  const double slope = (2.0 + 2.0 / kCurvature) / (kLengthening - 1.0);
  return (1.0 + kLengthening * slope * v) / (1.0 + slope * v);
}

double HillMuscle::force_velocity_slope(double v) {
  if (v <= 0.0) {
    if (v <= -1.0) return 0.0;
    const double d = 1.0 - v / kCurvature;
    return (1.0 + 1.0 / kCurvature) / (d * d);
  }
  const double slope = (2.0 + 2.0 / kCurvature) / (kLengthening - 1.0);
  const double d = 1.0 + slope * v;
  return slope * (kLengthening - 1.0) / (d * d);
}

void HillMuscle::place(double position, StateView state) const {
  state.as<State>() = {kMinActivation, 1.0 - position, 0.0};
}

void HillMuscle::impose(double position, double velocity, double, StateView state) const {
  auto& s = state.as<State>();
  s.length = 1.0 - position;
  s.velocity = -velocity / p_.max_velocity;
}

double HillMuscle::solve_velocity(double force, const State& s) const {
  // Force grows strictly with velocity: Newton, kept inside a bracket.
  const double active = s.activation * force_length(s.length);
  const double target = force / p_.max_force - passive_force(s.length);
  double low = -2.0, high = 2.0, v = std::clamp(s.velocity, low, high);
  for (int i = 0; i < 30; ++i) {
    const double error = active * force_velocity(v) + p_.damping * v - target;
    if (std::abs(error) < 1e-12) break;
    (error > 0.0 ? high : low) = v;
    const double slope = active * force_velocity_slope(v) + p_.damping;
    v -= error / slope;
    if (v <= low || v >= high) v = 0.5 * (low + high);
  }
  return v;
}

void HillMuscle::advance(double input, double load, StateView state) const {
  auto& s = state.as<State>();
  const double excitation = std::clamp(input, 0.0, 1.0);
  const double pace = 0.5 + 1.5 * s.activation;
  const double time =
      excitation > s.activation ? p_.activation_time * pace : p_.deactivation_time / pace;
  s.activation = std::max(kMinActivation,
                          s.activation + (excitation - s.activation) * -std::expm1(-step_ / time));
  const double way = step_ * p_.max_velocity;
  // An element shortened to a fifth of its optimal length has nothing left to pull with and stands.
  s.velocity = std::max(solve_velocity(load, s), (kShortest - s.length) / way);
  s.length = std::max(kShortest, s.length + way * s.velocity);
}

Actuator::Readout HillMuscle::read(StateView state) const {
  const auto& s = state.as<State>();
  return {1.0 - s.length, -s.velocity * p_.max_velocity, 0.0};
}

double HillMuscle::tendon_length(StateView state) const {
  return p_.rest_tendon_length + (state.as<State>().length - 1.0) * p_.optimal_length;
}

double HillMuscle::winding_speed(StateView state) const {
  return -state.as<State>().velocity * p_.max_velocity * p_.optimal_length;
}

double HillMuscle::position_for(double tendon_length) const {
  return (p_.rest_tendon_length - tendon_length) / p_.optimal_length;
}

double HillMuscle::highest_position() const {
  return 1.0 - kShortest;
}

double HillMuscle::holding_input(double position, double load) const {
  const double length = 1.0 - position;
  return std::clamp((load / p_.max_force - passive_force(length)) / force_length(length), 0.0, 1.0);
}

std::shared_ptr<const Actuator> HillMuscle::load(const ConfigNode& kind, const ConfigNode& muscle,
                                                 double step) {
  Parameters p;
  p.max_force = kind.number("max_force", Bounds::positive(), "N");
  p.optimal_length = kind.number("optimal_length", Bounds::positive(), "m");
  p.max_velocity = kind.number("max_velocity", Bounds::positive(), "1/s");
  p.activation_time = kind.number("activation_time", Bounds::positive(), "s");
  p.deactivation_time = kind.number("deactivation_time", Bounds::positive(), "s");
  p.damping = kind.number("damping", Bounds::positive(), "1");
  p.rest_tendon_length = read_rest_tendon_length(muscle);
  return std::make_shared<HillMuscle>(p, step);
}

}  // namespace anthrob
