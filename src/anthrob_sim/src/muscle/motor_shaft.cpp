#include "muscle/motor_shaft.h"

#include <algorithm>
#include <cmath>

#include "core/rising_root.h"

namespace anthrob {

namespace {

// Squares of the angle by which the vibration of a shaft advances in a step [rad^2]: below the
// first it is soft, above the second stiff. Explicit steps are unstable from 4.
constexpr double kSoft = 0.1, kStiff = 0.4;
/// Between a motor and a joint that are both held by friction, the shaft gives by this share of
/// what the joint's inertia would, so that its torque is determined.
constexpr double kHeld = 1e-6;
constexpr double kTolerance = 1e-11;  ///< of speeds [rad/s, m/s]
constexpr double kWider = 30.0;       ///< from one bracket to the next
constexpr int kMostBrackets = 100;    ///< where speeds are no numbers, there is none

}  // namespace

double MotorShaft::speed_under(double torque) {
  std::copy(before_.begin(), before_.end(), after_.begin());
  const StateView after(after_.data());
  if (motion_.imposed) {
    const double length = motor_.tendon_length(after);
    motor_.impose(motion_.position, motion_.velocity, torque, after);
    return (length - motor_.tendon_length(after)) / step_;
  }
  motor_.advance(motion_.input, torque, after);
  return motor_.winding_speed(after);
}

void MotorShaft::prepare(StateView state, const Motion& motion, double twist, double torque,
                         double inertia, double velocity) {
  std::copy_n(state.data(), motor_.state_size(), before_.begin());
  motion_ = motion;
  twist_ = twist;
  inertia_ = inertia;
  implicit_ = 1.0;
  if (std::isfinite(transmission_.stiffness)) {
    const double probe = inertia_ / step_;
    const double motor = std::max(0.0, speed_under(0.0) - speed_under(probe)) / probe;
    const double angle = transmission_.stiffness * step_ * (motor + step_ / inertia_);
    implicit_ = std::clamp((angle - kSoft) / (kStiff - kSoft), 0.0, 1.0);
  }
  last_ = torque_ = torque;
  // The joint's position leads by half a step's way, as its velocity is that of the step's end.
  twist_ += 0.5 * implicit_ * step_ * velocity;
}

double MotorShaft::parting(double torque, double free, double response) {
  // All divided by k h, so that a rigid shaft is the limit.
  const double compliance = 1.0 / (transmission_.stiffness * step_);
  const double damping = transmission_.damping * compliance;
  const double of_motor = 0.5 + 0.5 * implicit_ + damping, of_joint = implicit_ + damping;
  return twist_ / step_ + of_motor * speed_under(torque) - of_joint * (free + response * torque) -
         compliance * torque - kHeld * step_ / inertia_ * (torque - last_);
}

double MotorShaft::solve(double free, double response) {
  const double before = torque_;
  const double play = 0.5 * transmission_.backlash / step_;
  double offset = 0.0;
  if (play > 0.0) {
    const double loose = parting(0.0, free, response);
    if (std::abs(loose) <= play) {
      torque_ = 0.0;
      return torque_ - before;
    }
    offset = std::copysign(play, loose);
  }
  const auto excess = [&](double torque) { return offset - parting(torque, free, response); };

  // A bracket around the root of a rising function, from the last torque outwards.
  double near = torque_, value = excess(near);
  double reach = 1e-4 * std::abs(near) + 1e-5 * inertia_ / step_;
  double far = near, far_value = value;
  for (int i = 0; i < kMostBrackets && (far_value > 0.0) == (value > 0.0) && value != 0.0; ++i) {
    near = far, value = far_value;
    far = near - std::copysign(reach, value);
    far_value = excess(far);
    reach *= kWider;
  }
  if (value != 0.0) {
    const bool up = far > near;
    torque_ = rising_root(excess, up ? near : far, up ? far : near, kTolerance);
  }
  return torque_ - before;
}

}  // namespace anthrob
