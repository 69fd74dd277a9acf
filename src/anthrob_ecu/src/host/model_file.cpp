#include "anthrob_ecu/model_file.h"

#include <set>
#include <string>

#include "anthrob_ecu/gains.h"
#include "anthrob_ecu/parameters.h"

namespace anthrob {
namespace ecu {

namespace {

/// The driver reads only some of them, but a misspelt `gains` must not pass for a key of the
/// simulator.
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

double gain_value(const ConfigNode& node, const ParameterInfo& gain) {
  return node.as_number(Bounds::between(gain.lowest, gain.highest), gain.unit);
}

}  // namespace

ControllerKind read_controller(const ConfigNode& node, std::optional<double> period) {
  ControllerKind kind;
  ControllerSettings& settings = kind.settings;
  settings.period =
      period && !node.has("period") ? *period : node.number("period", Bounds::positive(), "s");
  settings.voltage_limit = node.number("voltage_limit", Bounds::positive(), "V");
  for (const ParameterInfo& gain : kParameters) {
    if (!gain.live) continue;
    // A gain SECTION_KEY is `key` of the map `section`.
    const std::string name = gain.name;
    const std::size_t end = name.find('_');
    const ConfigNode value = node.at(name.substr(0, end)).at(name.substr(end + 1));
    *gain_of(settings, gain.parameter) = gain_value(value, gain);
  }
  const ConfigNode limits = node.at("limits");
  kind.largest_position = limits.number("position", Bounds::positive(), "rad");
  kind.largest_current = limits.number("current", Bounds::positive(), "A");
  kind.largest_force = limits.number("force", Bounds::nonnegative(), "N");
  return kind;
}

void read_gains(const ConfigNode& muscle, ControllerSettings& settings) {
  if (!muscle.has("gains")) return;
  for (const auto& [name, value] : muscle.at("gains").entries()) {
    const ParameterInfo* gain = find_gain(name);
    if (!gain) value.fail("unknown gain; expected a name such as position_proportional");
    *gain_of(settings, gain->parameter) = gain_value(value, *gain);
  }
}

void check_muscle(const ConfigNode& muscle) {
  // A copy, because entries() marks keys as read, and the simulator still has to find those that it
  // did not read, such as `spindle_radius` of a ligament.
  for (const auto& [key, value] : muscle.clone().entries()) {
    if (!kMuscleKeys.count(key)) value.fail("unknown key");
  }
  if (muscle.has("gains") && !muscle.has("controller")) {
    muscle.at("gains").fail("only a muscle with a controller has gains");
  }
}

}  // namespace ecu
}  // namespace anthrob
