#include "anthrob_reference/controller.h"

#include <algorithm>
#include <cmath>

#include "check.h"

namespace anthrob::reference {

Controller::Controller(const ControllerParameters& parameters) : parameters_(parameters) {
  require_positive("ECU period", parameters.period);
  require_not_negative("voltage limit", parameters.voltage_limit);
}

void Controller::command_voltage(double voltage) {
  require(std::isfinite(voltage), "finite voltage command", voltage);
  position_mode_ = false;
  reference_ = voltage;
}

void Controller::command_position(double position) {
  require(std::isfinite(position), "finite position command", position);
  position_mode_ = true;
  reference_ = position;
}

double Controller::update(double position, double speed, double force) const {
  double voltage = reference_;
  if (position_mode_) {
    voltage = parameters_.proportional * (reference_ - position) - parameters_.derivative * speed +
              parameters_.force_feedforward * force;
  }
  return std::clamp(voltage, -parameters_.voltage_limit, parameters_.voltage_limit);
}

}  // namespace anthrob::reference
