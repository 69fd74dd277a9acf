#pragma once

#include <cmath>

#include "anthrob_sim/simulation.h"
#include "support.h"

namespace anthrob {
namespace testing_support {

inline std::shared_ptr<const RobotModel> anthrob_model(
    const std::string& model, double step = 1e-3, std::map<std::string, double> overrides = {}) {
  return load_robot_model(config("anthrob/model_" + model + ".yaml"), {step, std::move(overrides)});
}

inline void excite(Simulation& sim) {
  for (int m = 0; m < static_cast<int>(sim.muscle_count()); ++m) {
    sim.command(m, ecu::Mode::kPosition, 0.4 + 0.1 * m);
  }
}

/// A motion of all joints, at times [s].
inline std::vector<double> swing(double t) {
  const Quat shoulder(Eigen::AngleAxisd(0.4 * std::sin(3.0 * t), Vec3(0.6, 0.0, 0.8)));
  return {shoulder.w(), shoulder.x(), shoulder.y(), shoulder.z(), 0.8 + 0.5 * std::cos(4.0 * t)};
}

}  // namespace testing_support
}  // namespace anthrob
