#include "description/muscle_hardware.h"

#include <algorithm>
#include <sstream>

#include "anthrob_ecu/model_file.h"

namespace anthrob {
namespace driver {

namespace {

using ecu::Parameter;

void set(MuscleHardware& muscle, Parameter parameter, double value, const ConfigNode& where) {
  const ecu::ParameterInfo& info = ecu::kParameters[static_cast<int>(parameter)];
  if (!muscle.parameters.set(parameter, value)) {
    where.fail_expected(std::string(info.name) + " in the range of the ECU, " + text(info.lowest) +
                        " to " + text(info.highest) + " " + info.unit);
  }
}

/// A limit beyond the sensor's range would never trigger.
void check_reach(const ConfigNode& unit, const char* key, double limit, double reach,
                 const std::string& muscle, const char* what) {
  if (limit <= reach) return;
  unit.at(key).fail_expected("at most " + text(reach) + " " + what +
                             ", the most that the sensor of " + muscle + " can read");
}

/// The unit would clip a reference beyond its own limits without a word, or stop for it.
void narrow_to_unit(MuscleHardware& muscle) {
  const auto narrow = [&](ecu::Mode mode, double lowest, double highest) {
    const auto m = static_cast<std::size_t>(mode);
    muscle.limits.lowest[m] = std::max(muscle.limits.lowest[m], lowest);
    muscle.limits.highest[m] = std::min(muscle.limits.highest[m], highest);
  };
  const auto limit = [&](Parameter p) { return muscle.parameters.get(p); };
  narrow(ecu::Mode::kPosition, limit(Parameter::kPositionLow), limit(Parameter::kPositionHigh));
  narrow(ecu::Mode::kCurrent, -limit(Parameter::kCurrentLimit), limit(Parameter::kCurrentLimit));
  narrow(ecu::Mode::kForce, 0.0, limit(Parameter::kForceLimit));
}

}  // namespace

std::string text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

void load_controller(const ConfigNode& node, std::optional<double> period, const ConfigNode& own,
                     MuscleHardware& muscle) {
  ecu::ControllerKind kind = ecu::read_controller(node, period);
  ecu::read_gains(own, kind.settings);
  if (kind.settings.period != kTick) {
    node.at("period").fail_expected(text(kTick) + " s, the period of the ECUs' control laws");
  }
  set(muscle, Parameter::kVoltageLimit, kind.settings.voltage_limit, node.at("voltage_limit"));
  for (const ecu::ParameterInfo& gain : ecu::kParameters) {
    const double* value = ecu::gain_of(kind.settings, gain.parameter);
    if (value) set(muscle, gain.parameter, *value, node);
  }
  const double volts = muscle.parameters.get(Parameter::kVoltageLimit);
  muscle.limits.lowest = {-volts, -kind.largest_position, -kind.largest_current, 0.0};
  muscle.limits.highest = {volts, kind.largest_position, kind.largest_current, kind.largest_force};
}

LinearSensor load_linear(const ConfigNode& node, const std::string& unit, const Bounds& offset) {
  LinearSensor sensor;
  sensor.gain = node.number("gain", Bounds::any(), unit + "/count");
  if (sensor.gain == 0.0) node.at("gain").fail_expected("a number other than 0");
  sensor.offset = node.number("offset", offset, "count");
  return sensor;
}

void load_motor(const ConfigNode& node, MuscleHardware& muscle) {
  if (node.text("type") != "dc_motor") return;
  const ConfigNode motor = node.at("motor"), gear = node.at("gear"), stage = node.at("power_stage");
  muscle.resistance = motor.number("resistance", Bounds::positive(), "ohm") +
                      stage.number("resistance", Bounds::nonnegative(), "ohm");
  const double ratio = gear.number("ratio", Bounds::positive(), "1");
  muscle.winch.back_emf = motor.number("back_emf_constant", Bounds::positive(), "Vs/rad") * ratio;
  muscle.winch.inertia =
      motor.number("rotor_inertia", Bounds::positive(), "kg m^2") * ratio * ratio;
}

void load_unit(const ConfigNode& node, MuscleHardware& muscle) {
  const auto limit = [&](const char* key, Parameter parameter, const char* unit) {
    const ConfigNode value = node.at(key);
    set(muscle, parameter, value.as_number(Bounds::positive(), unit), value);
  };
  limit("current_limit", Parameter::kCurrentLimit, "A");
  limit("force_limit", Parameter::kForceLimit, "N");
  limit("speed_limit", Parameter::kSpeedLimit, "rad/s");
  limit("temperature_limit", Parameter::kTemperatureLimit, "deg C");
  limit("position_rate", Parameter::kPositionRate, "rad/s");
  limit("force_rate", Parameter::kForceRate, "N/s");
  limit("encoder_scale", Parameter::kEncoderScale, "rad/count");
  muscle.encoder_scale = muscle.parameters.get(Parameter::kEncoderScale);
  const ConfigNode range = node.at("position_range");
  const auto ends = range.items();
  if (ends.size() != 2) range.fail_expected("two numbers [lowest, highest] [rad]");
  set(muscle, Parameter::kPositionLow, ends[0].as_number(Bounds::any(), "rad"), ends[0]);
  set(muscle, Parameter::kPositionHigh, ends[1].as_number(Bounds::any(), "rad"), ends[1]);
  const double low = muscle.parameters.get(Parameter::kPositionLow),
               high = muscle.parameters.get(Parameter::kPositionHigh);
  if (!(low < high)) {
    range.fail(text(low) + " to " + text(high) + " rad: expected [lowest, highest]");
  }
  if (low > 0.0 || high < 0.0) {
    range.fail(text(low) + " to " + text(high) +
               " rad: expected a range with 0 in it: an ECU counts from 0 when it is switched on");
  }
  const int order = node.at("filter_order").as_integer(0, ecu::kMaxFilterOrder);
  set(muscle, Parameter::kFilterOrder, order, node.at("filter_order"));
  if (!node.has("nominal_current") && !node.has("thermal_time_constant")) return;
  muscle.nominal_current = node.number("nominal_current", Bounds::positive(), "A");
  muscle.thermal_time_constant = node.number("thermal_time_constant", Bounds::positive(), "s");
}

void load_sensors(const ConfigNode& node, MuscleHardware& muscle) {
  muscle.current = load_linear(node.at("current"), "A", Bounds::between(0.0, 4095.0));
  set(muscle, Parameter::kCurrentGain, muscle.current.gain, node.at("current"));
  set(muscle, Parameter::kCurrentOffset, muscle.current.offset, node.at("current"));
  const bool has_force = node.has("force");
  if (has_force) {
    muscle.force = load_linear(node.at("force"), "N", Bounds::between(0.0, ecu::kHighestCount));
    if (muscle.force.gain < 0.0) node.at("force").at("gain").fail_expected("a number > 0");
    set(muscle, Parameter::kForceGain, muscle.force.gain, node.at("force"));
    set(muscle, Parameter::kForceOffset, muscle.force.offset, node.at("force"));
  }
  const bool takes_forces = muscle.limits.highest[static_cast<int>(ecu::Mode::kForce)] > 0.0;
  muscle.limits.modes = {true, true, true, has_force && takes_forces};
  narrow_to_unit(muscle);
}

void check_home(const ConfigNode& node, const HomeRoutine& home, const MuscleHardware& muscle) {
  if (!muscle.parameters.has_force_sensor()) return;
  const auto limit = [&](Parameter p) { return muscle.parameters.get(p); };
  const auto at_most = [&](const char* key, double value, double most, const std::string& what) {
    if (value > most) {
      node.at(key).fail_expected("at most " + text(most) + " " + what + " of " + muscle.name);
    }
  };
  at_most("wind_speed", home.wind_speed, 0.5 * limit(Parameter::kSpeedLimit),
          "rad/s, half of speed_limit");
  // Otherwise the time limit would end home before the broken tendon is identified.
  const double rate = limit(Parameter::kPositionRate);
  const double furthest = std::min(home.wind_speed, rate) * home.time_limit;
  if (home.travel_limit >= furthest) {
    const std::string speed =
        rate < home.wind_speed ? "position_rate of " + muscle.name : "wind_speed";
    node.at("travel_limit")
        .fail_expected("less than " + text(furthest) + " rad, " + speed + " x time_limit");
  }
  // After power-up a unit counts from 0, and winds in no further than its range goes.
  at_most("travel_limit", home.travel_limit, limit(Parameter::kPositionHigh),
          "rad, the end of position_range");
  at_most("force_limit", home.force_limit, limit(Parameter::kForceLimit), "N, force_limit");
}

void check_limits(const ConfigNode& unit, const MuscleHardware& muscle) {
  constexpr double kLargestCount = 4095.0;
  const LinearSensor &current = muscle.current, &force = muscle.force;
  const double either_way = std::min(current.offset, kLargestCount - current.offset);
  check_reach(unit, "current_limit", muscle.parameters.get(Parameter::kCurrentLimit),
              current.gain * either_way, muscle.name, "A");
  if (!muscle.parameters.has_force_sensor()) return;
  check_reach(unit, "force_limit", muscle.parameters.get(Parameter::kForceLimit),
              force.gain * (ecu::kHighestCount - force.offset), muscle.name, "N");
}

}  // namespace driver
}  // namespace anthrob
