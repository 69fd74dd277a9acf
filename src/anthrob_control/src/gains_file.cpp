#include "anthrob_control/gains_file.h"

#include <cstdio>
#include <cstdlib>
#include <vector>

#include "anthrob_ecu/parameters.h"
#include "anthrob_sim/core/errors.h"
#include "anthrob_sim/recording/dataset.h"

namespace anthrob {

namespace {

/// The shortest text that the units hold as this.
std::string short_text(double value) {
  char text[32];
  for (int digits = 6; digits <= 9; ++digits) {
    std::snprintf(text, sizeof(text), "%.*g", digits, value);
    if (std::strtof(text, nullptr) == static_cast<float>(value)) break;
  }
  return text;
}

/// One gain of a model's controller as the file gets it: the model's number, unless another is
/// held.
std::string gain_text(ecu::ControllerSettings model, ecu::Parameter gain,
                      const std::map<std::string, double>& held) {
  const double own = *ecu::gain_of(model, gain);
  const auto found = held.find(ecu::kParameters[static_cast<std::size_t>(gain)].name);
  const bool same =
      found == held.end() || static_cast<float>(found->second) == static_cast<float>(own);
  return same ? exact_text(own) : short_text(found->second);
}

bool differs(const MuscleModel& muscle, const std::map<std::string, double>& held) {
  ecu::ControllerSettings settings = muscle.controller;
  for (const ecu::ParameterInfo& info : ecu::kParameters) {
    const double* own = ecu::gain_of(settings, info.parameter);
    if (own && gain_text(settings, info.parameter, held) != exact_text(*own)) return true;
  }
  return false;
}

std::string controller_text(const MuscleModel& muscle, const std::map<std::string, double>& held) {
  using ecu::Parameter;
  const ecu::ControllerSettings& c = muscle.controller;
  const auto gain = [&](Parameter parameter) { return gain_text(c, parameter, held); };
  return "    period: " + exact_text(c.period) +
         "\n    voltage_limit: " + exact_text(c.voltage_limit) +
         "\n    limits: {position: " + exact_text(muscle.limits.position) +
         ", current: " + exact_text(muscle.limits.current) +
         ", force: " + exact_text(muscle.limits.force) +
         "}\n    position: {proportional: " + gain(Parameter::kPositionProportional) +
         ", derivative: " + gain(Parameter::kPositionDerivative) +
         ", force_feedforward: " + gain(Parameter::kPositionForceFeedforward) +
         "}\n    current: {proportional: " + gain(Parameter::kCurrentProportional) +
         ", integral: " + gain(Parameter::kCurrentIntegral) +
         "}\n    force: {proportional: " + gain(Parameter::kForceProportional) +
         ", integral: " + gain(Parameter::kForceIntegral) +
         ", derivative: " + gain(Parameter::kForceDerivative) +
         ", force_feedforward: " + gain(Parameter::kForceForceFeedforward) + "}\n";
}

}  // namespace

std::string gains_file(const RobotModel& model, const HeldGains& held, const std::string& extends) {
  std::map<std::string, std::string> names;  // of controllers, by their text
  std::string controllers, muscles;
  for (const auto& [name, gains] : held) {
    const int index = model.find_muscle(name);
    if (index < 0 || !model.muscles[static_cast<std::size_t>(index)].has_controller) {
      throw BadInput(model.file + ": no muscle '" + name + "' with a controller, as the robot has");
    }
  }
  for (const MuscleModel& muscle : model.muscles) {
    const auto found = held.find(muscle.name);
    if (found == held.end() || !differs(muscle, found->second)) continue;
    const std::string text = controller_text(muscle, found->second);
    const auto [entry, added] = names.emplace(text, "tuned_" + std::to_string(names.size() + 1));
    if (added) controllers += "  " + entry->second + ":\n" + text;
    muscles += "  " + muscle.name + ": {controller: " + entry->second + "}\n";
  }
  if (muscles.empty()) return "";
  return "# Gains as the robot held them.\nextends: \"" + extends + "\"\n\ncontrollers:\n" +
         controllers + "\nmuscles:\n" + muscles;
}

}  // namespace anthrob
