// The arm, and what its simulation says of a test of its tendons.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "anthrob_sim/replay/replay.h"
#include "anthrob_sim/simulation.h"
#include "health/tendon_figures.h"

namespace anthrob {
namespace health {

inline std::shared_ptr<const RobotModel> believed_arm() {
  static const auto model = load_robot_model(ANTHROB_CONFIG_DIR "/anthrob/model_II.yaml");
  return model;
}

inline const TestProtocol& arm_protocol() {
  static const TestProtocol protocol(believed_arm(), Simulation(believed_arm()).configuration(),
                                     {});
  return protocol;
}

/// @param effects of the robot that is tested
inline Dataset tested(const std::vector<EffectInstance>& effects) {
  LoadOptions options;
  options.effects = effects;
  const auto robot = load_robot_model(ANTHROB_CONFIG_DIR "/anthrob/model_II.yaml", options);
  return replay(robot, arm_protocol().commands(), ReplayMode::kReference);
}

inline const Figure* figure_of(const std::vector<TendonFigures>& all, const std::string& muscle,
                               Quantity quantity) {
  for (const TendonFigures& tendon : all) {
    if (tendon.muscle != muscle) continue;
    for (const Figure& figure : tendon.figures) {
      if (figure.quantity == quantity) return &figure;
    }
  }
  return nullptr;
}

inline double value_of(const std::vector<TendonFigures>& all, const std::string& muscle,
                       Quantity quantity) {
  const Figure* figure = figure_of(all, muscle, quantity);
  return figure == nullptr ? NAN : figure->value;
}

}  // namespace health
}  // namespace anthrob
