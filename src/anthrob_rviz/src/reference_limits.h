#pragma once

#include <map>
#include <string>

#include "control_mode.h"

namespace anthrob {

/// From the lowest to the highest reference.
struct ReferenceRange {
  double low = 0.0;
  double high = 0.0;

  double clipped(double value) const;
  /// The range and the value in it.
  ReferenceRange with(double value) const;
};

/// How far the sliders go. A robot does not publish the limits of its model file, and refuses what
/// is beyond them; so these are ours, unless the parameters command_limits/* of the robot's
/// namespace say otherwise.
class ReferenceLimits {
 public:
  /// By default:
  ///  POSITION  -10 to 10 rad: 65 mm of Anthrob's tendons. Its postures need less than 5 rad, and
  ///            the model's +-30 rad would make each pixel a visible jump
  ///  FORCE     0 to 100 N: what Anthrob's weaker motors accept
  ///  VOLTAGE   -12 to 12 V: the supply
  ReferenceRange of(ControlMode mode) const { return ranges_.at(mode); }

  /// @param limit largest reference, > 0; the lowest one is its opposite, of FORCE zero
  void set(ControlMode mode, double limit);

 private:
  std::map<ControlMode, ReferenceRange> ranges_ = {{ControlMode::kPosition, {-10.0, 10.0}},
                                                   {ControlMode::kForce, {0.0, 100.0}},
                                                   {ControlMode::kVoltage, {-12.0, 12.0}}};
};

/// The parameter below command_limits/ with the limit of a mode: "position", "force", "voltage".
std::string limit_key(ControlMode mode);

}  // namespace anthrob
