#include "anthrob_driver/hardware.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include "anthrob_config/config_node.h"
#include "anthrob_ecu/gains.h"

namespace anthrob {
namespace driver {

namespace {

using ecu::Parameter;

constexpr double kLongestHome = 120.0;  // [s]
constexpr double kTick = 0.001;         // [s] of the units' control laws
/// Of a muscle of a model file (docs/files.md). What the simulator reads only must not hide a
/// misspelt `gains` from the driver.
const std::set<std::string> kMuscleKeys = {"actuator",
                                           "controller",
                                           "ecu",
                                           "eyelet_friction",
                                           "force_sensor_segment",
                                           "gains",
                                           "path",
                                           "rest_tendon_length",
                                           "spindle_radius",
                                           "spring",
                                           "surface_friction"};

std::string text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

std::string choose(const std::string& wanted, const std::string& otherwise) {
  return wanted.empty() ? otherwise : wanted;
}

std::string beside(const std::string& file, const std::string& name) {
  return (std::filesystem::path(file).parent_path() / name).string();
}

void set(MuscleHardware& muscle, Parameter parameter, double value, const ConfigNode& where) {
  const ecu::ParameterInfo& info = ecu::kParameters[static_cast<int>(parameter)];
  if (!muscle.parameters.set(parameter, value)) {
    where.fail_expected(std::string(info.name) + " in the range of the ECU, " + text(info.lowest) +
                        " to " + text(info.highest) + " " + info.unit);
  }
}

/// Gains and command limits, as the simulator has them: one entry of `controllers`.
void load_controller(const ConfigNode& node, MuscleHardware& muscle) {
  const auto gain = [&](const ConfigNode& from, const char* key, Parameter parameter,
                        const char* unit) {
    const ConfigNode value = from.at(key);
    set(muscle, parameter, value.as_number(Bounds::nonnegative(), unit), value);
  };
  gain(node, "voltage_limit", Parameter::kVoltageLimit, "V");
  if (node.has("period") && node.at("period").as_number(Bounds::positive(), "s") != kTick) {
    node.at("period").fail_expected(text(kTick) + " s, the period of the ECUs' control laws");
  }
  const ConfigNode position = node.at("position"), current = node.at("current"),
                   force = node.at("force"), limits = node.at("limits");
  gain(position, "proportional", Parameter::kPositionProportional, "V/rad");
  gain(position, "derivative", Parameter::kPositionDerivative, "Vs/rad");
  gain(position, "force_feedforward", Parameter::kPositionForceFeedforward, "V/N");
  gain(current, "proportional", Parameter::kCurrentProportional, "V/A");
  gain(current, "integral", Parameter::kCurrentIntegral, "V/(As)");
  gain(force, "proportional", Parameter::kForceProportional, "V/N");
  gain(force, "integral", Parameter::kForceIntegral, "V/(Ns)");
  gain(force, "derivative", Parameter::kForceDerivative, "Vs/rad");
  gain(force, "force_feedforward", Parameter::kForceForceFeedforward, "V/N");
  const double volts = muscle.parameters.get(Parameter::kVoltageLimit);
  const double radians = limits.number("position", Bounds::positive(), "rad");
  const double amperes = limits.number("current", Bounds::positive(), "A");
  const double newtons = limits.number("force", Bounds::nonnegative(), "N");
  muscle.limits.lowest = {-volts, -radians, -amperes, 0.0};
  muscle.limits.highest = {volts, radians, amperes, newtons};
}

/// What a muscle of a model file has otherwise than its controller's kind.
void load_gains(const ConfigNode& node, MuscleHardware& muscle) {
  for (const auto& [name, value] : node.entries()) {
    const ecu::ParameterInfo* gain = ecu::find_gain(name);
    if (!gain) value.fail("not a gain; expected a name such as position_proportional");
    set(muscle, gain->parameter, value.as_number(Bounds::nonnegative(), gain->unit), value);
  }
}

LinearSensor load_linear(const ConfigNode& node, const std::string& unit) {
  LinearSensor sensor;
  sensor.gain = node.number("gain", Bounds::any(), unit + "/count");
  if (sensor.gain == 0.0) node.at("gain").fail_expected("a number other than 0");
  sensor.offset = node.number("offset", Bounds::between(0.0, 4095.0), "count");
  return sensor;
}

/// What EncoderWatch wants to know: one entry of `actuators`.
void load_motor(const ConfigNode& node, MuscleHardware& muscle) {
  if (node.text("type") != "dc_motor") return;
  const ConfigNode motor = node.at("motor"), gear = node.at("gear"), stage = node.at("power_stage");
  muscle.resistance = motor.number("resistance", Bounds::positive(), "ohm") +
                      stage.number("resistance", Bounds::nonnegative(), "ohm");
  muscle.back_emf = motor.number("back_emf_constant", Bounds::positive(), "Vs/rad") *
                    gear.number("ratio", Bounds::positive(), "1");
}

/// Limits that the ECU watches, and its sensors: one entry of `units`.
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

/// Sensors of one muscle: one entry of the calibration file's `muscles`. Its controller is loaded.
void load_sensors(const ConfigNode& node, MuscleHardware& muscle) {
  muscle.current = load_linear(node.at("current"), "A");
  set(muscle, Parameter::kCurrentGain, muscle.current.gain, node.at("current"));
  set(muscle, Parameter::kCurrentOffset, muscle.current.offset, node.at("current"));
  const bool has_force = node.has("force");
  if (has_force) {
    muscle.force = load_linear(node.at("force"), "N");
    if (muscle.force.gain < 0.0) node.at("force").at("gain").fail_expected("a number > 0");
    set(muscle, Parameter::kForceGain, muscle.force.gain, node.at("force"));
    set(muscle, Parameter::kForceOffset, muscle.force.offset, node.at("force"));
  }
  const bool takes_forces = muscle.limits.highest[static_cast<int>(ecu::Mode::kForce)] > 0.0;
  muscle.limits.modes = {true, true, true, has_force && takes_forces};
}

/// `home` may ask nothing of a muscle that its unit does not stand. Others are not pulled.
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
  // Else a broken tendon would end `home` by its time, without being named.
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

/// A limit that its sensor cannot read is none.
void check_reach(const ConfigNode& unit, const char* key, double limit, double reach,
                 const std::string& muscle, const char* what) {
  if (limit <= reach) return;
  unit.at(key).fail_expected("at most " + text(reach) + " " + what +
                             ", the most that the sensor of " + muscle + " can read");
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

class Loader {
 public:
  Loader(const std::string& file, bool hand, const std::string& model)
      : config_(ConfigNode::load(file)),
        model_(ConfigNode::load(choose(model, beside(file, config_.text("model"))))),
        calibration_(ConfigNode::load(beside(file, config_.text("calibration")))),
        hand_(hand),
        own_model_(model.empty()) {
    hardware_.file = file;
  }

  Hardware load() {
    load_ecus();
    for (const auto& [name, node] : model_.at("muscles").entries()) {
      for (const auto& [key, value] : node.entries()) {
        if (!kMuscleKeys.count(key)) value.fail("unknown key");
      }
      if (!node.has("controller") || !node.has("ecu")) continue;
      // A model with the hand may be used without it.
      if (!hand_ && name.rfind("hand_", 0) == 0) continue;
      const std::string kind = node.text("controller");
      const bool of_hand = name.rfind("hand_", 0) == 0;
      const ConfigNode controller = model_.at("controllers").at(kind);
      add_muscle(name, node.text("ecu"), kind, controller,
                 of_hand ? calibration_.at("hand").at("muscles") : calibration_.at("muscles"),
                 node);
      controller.refuse_unknown_keys();
      if (node.has("actuator")) {
        load_motor(model_.at("actuators").at(node.text("actuator")), hardware_.muscles.back());
      }
    }
    load_hand();
    load_joints();
    load_home();
    load_tendons();
    finish();
    // Another model need not have all that is wired.
    if (!own_model_) return hardware_;
    config_.refuse_unknown_keys();
    calibration_.refuse_unknown_keys();
    return hardware_;
  }

 private:
  void load_ecus() {
    std::set<int> nodes;
    for (const auto& [name, node] : config_.at("ecus").entries()) {
      EcuHardware ecu;
      ecu.name = name;
      ecu.node = node.at("node").as_integer(1, ecu::kMaxNode);
      if (!nodes.insert(ecu.node).second) {
        node.at("node").fail(std::to_string(ecu.node) + ": another ECU has this node");
      }
      hardware_.ecus.push_back(ecu);
    }
  }

  int find_ecu(const std::string& name, const ConfigNode& where) const {
    for (std::size_t i = 0; i < hardware_.ecus.size(); ++i) {
      if (hardware_.ecus[i].name == name) return static_cast<int>(i);
    }
    where.fail("ecu " + name + ": not listed under ecus in " + config_.file());
  }

  void add_muscle(const std::string& name, const std::string& ecu_name, const std::string& kind,
                  const ConfigNode& controller, const ConfigNode& sensors,
                  const ConfigNode& where) {
    MuscleHardware muscle;
    muscle.name = muscle.limits.name = name;
    muscle.limits.ecu = ecu_name;
    muscle.ecu = find_ecu(ecu_name, where);
    EcuHardware& ecu = hardware_.ecus[static_cast<std::size_t>(muscle.ecu)];
    muscle.channel = static_cast<int>(ecu.muscles.size());
    if (muscle.channel >= ecu::kMusclesPerEcu) {
      where.fail(ecu_name + " already has " + std::to_string(ecu::kMusclesPerEcu) + " muscles");
    }
    ecu.muscles.push_back(static_cast<int>(hardware_.muscles.size()));
    load_controller(controller, muscle);
    if (where.has("gains")) load_gains(where.at("gains"), muscle);
    load_unit(config_.at("units").at(kind), muscle);
    load_sensors(sensors.at(name), muscle);
    check_limits(config_.at("units").at(kind), muscle);
    muscle.home_position = home_position(muscle);
    hardware_.muscles.push_back(muscle);
  }

  double home_position(const MuscleHardware& muscle) {
    const ConfigNode home = config_.at("home");
    const double low = muscle.parameters.get(Parameter::kPositionLow),
                 high = muscle.parameters.get(Parameter::kPositionHigh);
    if (home.has("positions") && home.at("positions").has(muscle.name)) {
      return home.at("positions").number(muscle.name, Bounds::between(low, high), "rad");
    }
    return 0.0;
  }

  /// One file serves with and without it.
  void ignore_zeros_of_the_hand() {
    const ConfigNode home = config_.at("home");
    if (!home.has("positions") || !config_.has("hand")) return;
    for (const auto& [name, node] : config_.at("hand").at("muscles").entries()) {
      if (home.at("positions").has(name)) home.at("positions").at(name).ignore();
    }
  }

  void load_hand() {
    if (!hand_) {
      for (const ConfigNode& part : {config_, calibration_}) {
        if (part.has("hand")) part.at("hand").ignore();
      }
      if (config_.at("units").has("hand")) config_.at("units").at("hand").ignore();
      ignore_zeros_of_the_hand();
      return;
    }
    if (!config_.has("hand"))
      config_.fail("key 'hand' is missing: this robot has no hand; start without hand:=true");
    const ConfigNode hand = config_.at("hand"), sensors = calibration_.at("hand");
    bool takes_controller = false;
    for (const auto& [name, node] : hand.at("muscles").entries()) {
      const bool in_model = std::any_of(hardware_.muscles.begin(), hardware_.muscles.end(),
                                        [&n = name](const auto& m) { return m.name == n; });
      const std::string ecu_name = node.text("ecu");
      if (!in_model) {
        takes_controller = true;
        add_muscle(name, ecu_name, "hand", hand.at("controller"), sensors.at("muscles"), node);
      }
    }
    if (!takes_controller) hand.at("controller").ignore();
    for (const auto& [name, node] : hand.at("touch").entries()) {
      TouchSensor touch;
      touch.name = name;
      touch.ecu = find_ecu(node.text("ecu"), node);
      touch.input = input(node, touch.ecu, name);
      const ConfigNode sensor = sensors.at("touch").at(name);
      touch.sensor.gain = sensor.number("gain", Bounds::positive(), "N");
      touch.sensor.threshold = sensor.number("threshold", Bounds::between(0.0, 4095.0), "count");
      hardware_.touch.push_back(touch);
    }
  }

  /// After the muscles. @param sensor that is wired there
  int input(const ConfigNode& node, int ecu_index, const std::string& sensor) {
    const int input = node.at("input").as_integer(0, ecu::kAnalogInputs - 1);
    EcuHardware& ecu = hardware_.ecus[static_cast<std::size_t>(ecu_index)];
    // The driver would not listen to it. Another model may have no muscles there.
    if (own_model_ && ecu.muscles.empty()) {
      node.at("ecu").fail(ecu.name + ": expected an ECU with muscles; " +
                          (hand_ ? "" : "without the hand ") + "this one has none");
    }
    const auto [other, first] = sensor_at_.try_emplace({ecu_index, input}, sensor);
    if (!first) {
      node.at("input").fail(std::to_string(input) + " of " + ecu.name + ": already used by " +
                            other->second);
    }
    ecu.analogs = std::max(ecu.analogs, input + 1);
    return input;
  }

  void load_joints() {
    if (!config_.has("joints")) return;
    for (const auto& [name, node] : config_.at("joints").entries()) {
      JointSensor joint;
      joint.joint = name;
      joint.ecu = find_ecu(node.text("ecu"), node);
      joint.input = input(node, joint.ecu, name);
      joint.sensor = load_linear(calibration_.at("joints").at(name), "rad");
      hardware_.joints.push_back(joint);
    }
  }

  void load_home() {
    const ConfigNode node = config_.at("home");
    HomeRoutine& home = hardware_.home;
    home.pretension = node.number("pretension", Bounds::positive(), "N");
    home.tolerance = node.number("tolerance", Bounds::positive(), "N");
    home.force_limit = node.number("force_limit", Bounds::positive(), "N");
    home.wind_speed = node.number("wind_speed", Bounds::positive(), "rad/s");
    home.travel_limit = node.number("travel_limit", Bounds::positive(), "rad");
    home.slip_drop = node.number("slip_drop", Bounds::fraction(), "1");
    home.settle_time = node.number("settle_time", Bounds::positive(), "s");
    home.time_limit = node.number("time_limit", Bounds::positive(), "s");
    if (home.force_limit <= home.pretension) {
      node.at("force_limit").fail_expected("more than pretension");
    }
    // A tendon grips from half of it on, and is held from four fifths on.
    if (home.tolerance >= 0.5 * home.pretension) {
      node.at("tolerance").fail_expected("less than half of pretension");
    }
    if (home.slip_drop <= 0.2) node.at("slip_drop").fail_expected("more than 0.2");
    if (home.time_limit > kLongestHome) {
      node.at("time_limit").fail_expected("at most " + text(kLongestHome) + " s");
    }
    if (home.settle_time >= home.time_limit) {
      node.at("settle_time").fail_expected("less than time_limit");
    }
    for (const MuscleHardware& muscle : hardware_.muscles) check_home(node, home, muscle);
  }

  /// What is not given is taken from `home`.
  void load_tendons() {
    const HomeRoutine& home = hardware_.home;
    TendonLimits& tendons = hardware_.tendons;
    tendons.loaded = 4.0 * home.pretension;
    tendons.slack = (1.0 - home.slip_drop) * home.pretension;
    // A limb that was moved by hand leaves more slack than an arm that hangs at rest.
    tendons.travel = 2.0 * home.travel_limit;
    if (!config_.has("tendons")) return;
    const ConfigNode node = config_.at("tendons");
    const auto take = [&](const char* key, const char* unit, double& value) {
      if (node.has(key)) value = node.number(key, Bounds::nonnegative(), unit);
    };
    take("loaded", "N", tendons.loaded);
    take("slack", "N", tendons.slack);
    take("travel", "rad", tendons.travel);
    if (tendons.loaded > 0.0 && tendons.loaded <= tendons.slack) {
      node.fail("loaded: " + text(tendons.loaded) + " N: expected 0, or more than slack, " +
                text(tendons.slack) + " N");
    }
  }

  /// Units without muscles, such as the hand's when it is off, are not waited for.
  void finish() {
    std::vector<EcuHardware> used;
    std::vector<int> new_index(hardware_.ecus.size(), -1);
    for (std::size_t e = 0; e < hardware_.ecus.size(); ++e) {
      if (hardware_.ecus[e].muscles.empty()) {
        hardware_.idle_nodes.push_back(hardware_.ecus[e].node);
        continue;
      }
      new_index[e] = static_cast<int>(used.size());
      used.push_back(hardware_.ecus[e]);
    }
    hardware_.ecus = used;
    for (auto& m : hardware_.muscles) m.ecu = new_index[static_cast<std::size_t>(m.ecu)];
    for (auto& j : hardware_.joints) j.ecu = new_index[static_cast<std::size_t>(j.ecu)];
    for (auto& t : hardware_.touch) t.ecu = new_index[static_cast<std::size_t>(t.ecu)];
    for (std::size_t e = 0; e < hardware_.ecus.size(); ++e) {
      update_configuration(hardware_, static_cast<int>(e));
    }
  }

  ConfigNode config_, model_, calibration_;
  bool hand_, own_model_;
  Hardware hardware_;
  std::map<std::pair<int, int>, std::string> sensor_at_;  ///< by ECU and input
};

}  // namespace

std::vector<ecu::MuscleChannel> Hardware::channels() const {
  std::vector<ecu::MuscleChannel> channels;
  for (const MuscleHardware& muscle : muscles) channels.push_back(muscle.limits);
  return channels;
}

Hardware load_hardware(const std::string& file, bool hand, const std::string& model) {
  return Loader(file, hand, model).load();
}

void update_configuration(Hardware& hardware, int index) {
  EcuHardware& unit = hardware.ecus[static_cast<std::size_t>(index)];
  ecu::ParameterSet sets[ecu::kMusclesPerEcu];
  int count = 0;
  for (const int m : unit.muscles) {
    sets[count++] = hardware.muscles[static_cast<std::size_t>(m)].parameters;
  }
  unit.configuration = ecu::configuration_checksum(sets, count);
}

bool has_hand(const std::string& file) {
  return ConfigNode::load(file).has("hand");
}

std::string difference(const Hardware& a, const Hardware& b) {
  for (std::size_t m = 0; m < std::max(a.muscles.size(), b.muscles.size()); ++m) {
    if (m >= a.muscles.size()) return b.muscles[m].name + ": an additional muscle";
    const MuscleHardware& left = a.muscles[m];
    if (m >= b.muscles.size() || left.name != b.muscles[m].name) return left.name + ": missing";
    const MuscleHardware& right = b.muscles[m];
    if (left.limits.ecu != right.limits.ecu || left.channel != right.channel) {
      return left.name + ": another ECU or channel";
    }
    for (int p = 0; p < ecu::kParameterCount; ++p) {
      if (left.parameters.raw(p) != right.parameters.raw(p)) {
        return left.name + ": another value of " + ecu::kParameters[p].name;
      }
    }
    const bool same_limits = left.limits.modes == right.limits.modes &&
                             left.limits.lowest == right.limits.lowest &&
                             left.limits.highest == right.limits.highest;
    if (!same_limits) return left.name + ": other command limits";
  }
  return "";
}

}  // namespace driver
}  // namespace anthrob
