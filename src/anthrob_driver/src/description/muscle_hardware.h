#pragma once

#include <optional>
#include <string>

#include "anthrob_core/config_node.h"
#include "anthrob_driver/hardware.h"

namespace anthrob {
namespace driver {

// What load_hardware reads for one muscle, and what it checks. All of these throw BadInput.

constexpr double kTick = 0.001;  ///< [s] of the units' control laws

std::string text(double value);

/// Gains and command limits, as the simulator has them.
/// @param node one entry of `controllers`   @param period [s] if `node` need not name it
/// @param own the muscle's entry, whose `gains` override those of `node`
void load_controller(const ConfigNode& node, std::optional<double> period, const ConfigNode& own,
                     MuscleHardware& muscle);

/// Limits that the ECU watches, and its sensors.
/// @param node one entry of `units`
void load_unit(const ConfigNode& node, MuscleHardware& muscle);

/// Sensors of one muscle, after load_controller.
/// @param node one entry of the calibration file's `muscles`
void load_sensors(const ConfigNode& node, MuscleHardware& muscle);

/// Refuses limits of a unit that the sensors of this muscle cannot measure, after load_sensors.
/// @param unit one entry of `units`
void check_limits(const ConfigNode& unit, const MuscleHardware& muscle);

/// What EncoderWatch has to know of the motor.
/// @param node one entry of `actuators`
void load_motor(const ConfigNode& node, MuscleHardware& muscle);

/// The home routine must stay within each unit's limits. Muscles without force sensor are not
/// pulled and so not checked.
/// @param node `home` of hardware.yaml
void check_home(const ConfigNode& node, const HomeRoutine& home, const MuscleHardware& muscle);

/// @param unit of the sensor's value
/// @param offset where it may be [count]
LinearSensor load_linear(const ConfigNode& node, const std::string& unit, const Bounds& offset);

}  // namespace driver
}  // namespace anthrob
