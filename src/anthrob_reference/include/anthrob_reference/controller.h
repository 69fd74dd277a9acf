#pragma once

#include "anthrob_reference/parameters.h"

namespace anthrob::reference {

/// One muscle's channel of an ECU. Both modes clip to the voltage limit. Starts at 0 V.
class Controller final {
 public:
  explicit Controller(const ControllerParameters& parameters);

  void command_voltage(double voltage);
  void command_position(double position);
  /// Voltage to hold until the next tick [V], from sensed position [rad], speed [rad/s], force [N].
  double update(double position, double speed, double force) const;

  double period() const { return parameters_.period; }

 private:
  ControllerParameters parameters_;
  bool position_mode_ = false;
  double reference_ = 0.0;
};

}  // namespace anthrob::reference
