#pragma once

#include <cmath>

#include "anthrob_sim/skeleton/skeleton_model.h"

namespace anthrob {

/// What bristles remember.
struct BristleState {
  double bend;      ///< z, in units of the torque while sliding fast [1]
  double friction;  ///< of the last step, positive against positive motion [Nm or N]
};

/// Friction of a hinge or prismatic joint that bends before it slides:
///   tau = -torque (z + c dz/dt),  dz/dt = (v - |v| z / s) / distance,
///   s = 1 + (static_ratio - 1) exp(-(v / stribeck_velocity)^2),
///   c = damping / (1 + damping |v| / distance)
/// Source: Canudas de Wit, Olsson, Astrom, Lischinsky 1995, "A new model for control of systems
/// with friction" (LuGre); with s = 1 and c = 0 it is Dahl 1968, "A solid friction model".
///
/// With constant damping the law can create energy where friction falls with speed. It does not if
/// c |v| / distance stays below 4 s (Olsson 1996); here it stays below 1. Then no step creates
/// energy, however long, up to a static_ratio of 3.
///
/// Solved exactly for a constant speed within a step, with s of the speed at its beginning: the
/// Stribeck curve then gives a step no second solution.
class Bristle {
 public:
  /// @param step of the simulation [s]
  Bristle(const BristleModel& model, double step) : model_(model), step_(step) {}

  /// A step begins at this speed.
  void begin(double speed) {
    const double slow = speed / model_.stribeck_velocity;
    level_ = 1.0 + (model_.static_ratio - 1.0) * std::exp(-slow * slow);
  }
  /// z after a step that ends at a speed.
  double bend(double speed, double z) const {
    const double full = speed < 0.0 ? -level_ : level_;
    return full + (z - full) * left(speed);
  }
  /// Friction at the end of that step, positive against positive motion [Nm or N].
  double friction(double speed, double z) const {
    const double bent = bend(speed, z);
    return model_.torque * (bent + lag(speed) * (bent - z));
  }
  /// Its slope over speed [Nms or Ns]; negative while z is beyond s, or where damping falls.
  double slope(double speed, double z) const {
    const double side = speed < 0.0 ? -1.0 : 1.0;
    const double behind = lag(speed), per_speed = step_ / model_.distance;
    const double bending = (1.0 - side * z / level_) * left(speed) * per_speed;
    const double falling = side * behind * behind * (bend(speed, z) - z) * per_speed;
    return model_.torque * ((1.0 + behind) * bending - falling);
  }
  /// Friction without motion [Nm or N].
  double held(double z) const { return model_.torque * z; }
  /// The most that it can give back, by bending back to 0 [J]: the integral of torque z dq, slowly.
  double energy(double z) const {
    const double most = model_.static_ratio, share = std::abs(z) / most;
    return model_.torque * model_.distance * most * most * (share - std::log1p(share));
  }
  double torque() const { return model_.torque; }

 private:
  /// c over the step [1].
  double lag(double speed) const {
    return model_.damping / (1.0 + model_.damping * std::abs(speed) / model_.distance) / step_;
  }
  double left(double speed) const {
    return std::exp(-std::abs(speed) * step_ / (level_ * model_.distance));
  }

  BristleModel model_;
  double step_;
  double level_ = 1.0;  ///< s
};

}  // namespace anthrob
