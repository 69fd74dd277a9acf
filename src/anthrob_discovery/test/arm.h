#pragma once

#include <memory>
#include <string>
#include <vector>

#include "made_recording.h"

namespace anthrob {
namespace discovery {

/// Anthrob, model I, recorded with effects or without.
struct Arm {
  ConfigNode config = ConfigNode::load(ANTHROB_CONFIG_DIR "/anthrob/model_I.yaml");
  std::shared_ptr<const RobotModel> plain = build_robot_model(config);

  Dataset record(const std::vector<EffectInstance>& effects, std::uint64_t seed,
                 std::uint64_t noise) const {
    LoadOptions options;
    options.effects = effects;
    MadeRecording made;
    made.seed = seed;
    made.noise = noise;
    made.length = 8.0;
    return made.measure(build_robot_model(config, options), made.commands(plain));
  }
};

}  // namespace discovery
}  // namespace anthrob
