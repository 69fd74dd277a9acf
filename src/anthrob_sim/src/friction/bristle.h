#pragma once

#include <cmath>

namespace anthrob {

/// Friction of a hinge or prismatic joint that bends before it slides:
///   tau = -torque z,  dz/dq = (1 - sign(dq/dt) z) / distance
/// Source: Dahl 1968, "A solid friction model" (exponent 1). Solved exactly for a constant speed
/// within a step.
struct Bristle {
  double torque;    ///< at full bend [Nm or N], >= 0
  double distance;  ///< after which 63 % of the bend is there [rad or m], > 0
  double step;      ///< of the simulation [s]

  /// z after a step at a speed.
  double bend(double speed, double z) const {
    const double side = speed < 0.0 ? -1.0 : 1.0;
    return side + (z - side) * left(speed);
  }
  /// Friction at the end of that step, positive against positive motion [Nm or N].
  double friction(double speed, double z) const { return torque * bend(speed, z); }
  /// Its slope over speed [Nms or Ns], >= 0.
  double slope(double speed, double z) const {
    const double side = speed < 0.0 ? -1.0 : 1.0;
    return torque * (1.0 - side * z) * left(speed) * step / distance;
  }
  /// The most that it can give back, by bending back to 0 [J]: the integral of torque z dq.
  double energy(double z) const {
    return torque * distance * (std::abs(z) - std::log1p(std::abs(z)));
  }

 private:
  double left(double speed) const { return std::exp(-std::abs(speed) * step / distance); }
};

}  // namespace anthrob
