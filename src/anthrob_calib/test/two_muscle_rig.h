#pragma once

#include <memory>
#include <string>

#include "simulated_recordings.h"

namespace anthrob {
namespace calibration {

inline const std::string kModelFile =
    std::string(ANTHROB_CONFIG_DIR) + "/two_muscle_rig/model_II.yaml";

inline std::shared_ptr<const RobotModel> rig() {
  static const auto model = load_robot_model(kModelFile);
  return model;
}

inline RecordingPlan plan(double flexor, double extensor, const std::string& kind) {
  RecordingPlan p;
  p.from = {1.0, 1.0};
  p.to = {flexor, extensor};
  p.kind = kind;
  return p;
}

}  // namespace calibration
}  // namespace anthrob
