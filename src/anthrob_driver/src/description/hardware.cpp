#include "anthrob_driver/hardware.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "anthrob_core/config_node.h"
#include "anthrob_ecu/model_file.h"
#include "description/muscle_hardware.h"

namespace anthrob {
namespace driver {

namespace {

using ecu::Parameter;

constexpr double kLongestHome = 120.0;  // [s]

/// The file that a key names, in the folder of the file that has the key.
std::string beside(const ConfigNode& config, const std::string& key) {
  const ConfigNode name = config.at(key);
  const std::filesystem::path folder = std::filesystem::path(config.file()).parent_path();
  const std::string path = (folder / name.as_text()).string();
  if (!std::filesystem::is_regular_file(path)) name.fail_expected("a file beside this one");
  return path;
}

class Loader {
 public:
  Loader(const std::string& file, bool hand, const std::optional<std::string>& model)
      : config_(ConfigNode::load(file)),
        model_(ConfigNode::load(model ? *model : beside(config_, "model"))),
        calibration_(ConfigNode::load(beside(config_, "calibration"))),
        hand_(hand),
        own_model_(!model) {
    hardware_.file = file;
  }

  Hardware load() {
    load_ecus();
    refuse_drives();
    for (const auto& [name, node] : model_.at("muscles").entries()) {
      ecu::check_muscle(node);
      if (!node.has("controller") || !node.has("ecu")) {
        const bool wired = calibration_.has("muscles") && calibration_.at("muscles").has(name);
        if (wired && own_model_) {
          node.fail("expected keys 'controller' and 'ecu': its sensors are in " +
                    calibration_.file());
        }
        continue;
      }
      // A model with the hand may be used without it.
      if (!hand_ && name.rfind("hand_", 0) == 0) continue;
      const std::string kind = node.text("controller");
      const bool of_hand = name.rfind("hand_", 0) == 0;
      if (!model_.has("controllers") || !model_.at("controllers").has(kind)) {
        node.at("controller").fail_expected("the name of an entry of 'controllers'");
      }
      const ConfigNode controller = model_.at("controllers").at(kind);
      add_muscle(name, node.text("ecu"), kind, controller, {},
                 of_hand ? calibration_.at("hand").at("muscles") : calibration_.at("muscles"),
                 node);
      controller.refuse_unknown_keys();
      if (node.has("actuator")) {
        load_motor(model_.at("actuators").at(node.text("actuator")), hardware_.muscles.back());
        hardware_.muscles.back().winch.radius =
            node.number_or("spindle_radius", 0.0, Bounds::positive(), "m");
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

  void refuse_drives() const {
    if (!model_.has("joints")) return;
    for (const auto& [name, node] : model_.at("joints").entries()) {
      if (!node.has("drive")) continue;
      node.at("drive").fail(
          "expected a model without drives: no motor unit moves a joint by itself");
    }
  }

  int find_ecu(const std::string& name, const ConfigNode& where) const {
    for (std::size_t i = 0; i < hardware_.ecus.size(); ++i) {
      if (hardware_.ecus[i].name == name) return static_cast<int>(i);
    }
    where.fail("ecu " + name + ": not listed under ecus in " + config_.file());
  }

  /// @param period [s] of a controller that need not name it
  void add_muscle(const std::string& name, const std::string& ecu_name, const std::string& kind,
                  const ConfigNode& controller, std::optional<double> period,
                  const ConfigNode& sensors, const ConfigNode& where) {
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
    load_controller(controller, period, where, muscle);
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
      const auto in_model = std::find_if(hardware_.muscles.begin(), hardware_.muscles.end(),
                                         [&n = name](const auto& m) { return m.name == n; });
      const std::string ecu_name = node.text("ecu");
      if (in_model == hardware_.muscles.end()) {
        takes_controller = true;
        add_muscle(name, ecu_name, "hand", hand.at("controller"), kTick, sensors.at("muscles"),
                   node);
      } else if (in_model->limits.ecu != ecu_name) {
        node.at("ecu").fail_expected(in_model->limits.ecu + ", as in " + model_.file());
      }
    }
    if (!takes_controller) hand.at("controller").ignore();
    for (const auto& [name, node] : hand.at("touch").entries()) {
      TouchSensor touch;
      touch.name = name;
      touch.ecu = find_ecu(node.text("ecu"), node);
      touch.input = input(node, *touch.ecu, name);
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
                          (hand_ || !config_.has("hand") ? "" : "without the hand ") +
                          "this one has none");
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
      joint.input = input(node, *joint.ecu, name);
      // A joint need not be able to reach the angle of zero counts.
      joint.sensor = load_linear(calibration_.at("joints").at(name), "rad", Bounds::any());
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
    // With nothing left of the pretension, no tendon would ever be slack.
    if (home.slip_drop >= 1.0) node.at("slip_drop").fail_expected("less than 1");
    home.settle_time = node.number("settle_time", Bounds::positive(), "s");
    home.time_limit = node.number("time_limit", Bounds::positive(), "s");
    if (home.force_limit <= home.pretension + home.tolerance) {
      node.at("force_limit").fail_expected("more than pretension and tolerance together");
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
    std::vector<std::optional<int>> new_index(hardware_.ecus.size());
    for (std::size_t e = 0; e < hardware_.ecus.size(); ++e) {
      if (hardware_.ecus[e].muscles.empty()) {
        hardware_.idle_nodes.push_back(hardware_.ecus[e].node);
        continue;
      }
      new_index[e] = static_cast<int>(used.size());
      used.push_back(hardware_.ecus[e]);
    }
    hardware_.ecus = used;
    for (auto& m : hardware_.muscles) m.ecu = *new_index[static_cast<std::size_t>(m.ecu)];
    for (auto& j : hardware_.joints) j.ecu = new_index[static_cast<std::size_t>(*j.ecu)];
    for (auto& t : hardware_.touch) t.ecu = new_index[static_cast<std::size_t>(*t.ecu)];
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

Hardware load_hardware(const std::string& file, bool hand,
                       const std::optional<std::string>& model) {
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

std::optional<std::string> difference(const Hardware& a, const Hardware& b) {
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
  return std::nullopt;
}

}  // namespace driver
}  // namespace anthrob
