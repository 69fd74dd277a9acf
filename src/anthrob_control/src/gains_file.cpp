#include "gains_file.h"

#include <cstdio>
#include <cstdlib>

#include "anthrob_core/errors.h"
#include "anthrob_ecu/parameters.h"

namespace anthrob {

namespace {

/// The shortest text that gives the same float 32, which the units hold.
std::string short_text(double value) {
  char text[32];
  for (int digits = 6; digits <= 9; ++digits) {
    std::snprintf(text, sizeof(text), "%.*g", digits, value);
    if (std::strtof(text, nullptr) == static_cast<float>(value)) break;
  }
  return text;
}

/// The gains that differ from the model's, as a YAML map without braces.
std::string differing(const MuscleModel& muscle, const std::map<std::string, double>& held) {
  ecu::ControllerSettings own = muscle.controller;
  std::string text;
  for (const ecu::ParameterInfo& info : ecu::kParameters) {
    const double* gain = ecu::gain_of(own, info.parameter);
    const auto found = held.find(info.name);
    if (!gain || found == held.end()) continue;
    if (static_cast<float>(found->second) == static_cast<float>(*gain)) continue;
    text += (text.empty() ? "" : ", ") + std::string(info.name) + ": " + short_text(found->second);
  }
  return text;
}

}  // namespace

std::string gains_file(const RobotModel& model, const HeldGains& held, const std::string& extends) {
  for (const auto& [name, gains] : held) {
    const int index = model.find_muscle(name);
    if (index < 0 || !model.muscles[static_cast<std::size_t>(index)].has_controller) {
      throw BadInput(model.file + ": has no muscle '" + name +
                     "' with a controller; expected the model that the robot was started with "
                     "(model_NAME_hand.yaml if with the hand)");
    }
  }
  std::string muscles;
  for (const MuscleModel& muscle : model.muscles) {
    const auto found = held.find(muscle.name);
    const std::string gains = found == held.end() ? "" : differing(muscle, found->second);
    if (!gains.empty()) muscles += "  " + muscle.name + ": {gains: {" + gains + "}}\n";
  }
  const std::string head =
      muscles.empty() ? "# The robot held the gains of this model when this file was saved.\n"
                      : "# Gains that the robot held when this file was saved.\n";
  return head + "extends: \"" + extends + "\"\n" +
         (muscles.empty() ? "" : "\nmuscles:\n" + muscles);
}

}  // namespace anthrob
