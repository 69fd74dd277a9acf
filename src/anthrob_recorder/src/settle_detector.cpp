#include "settle_detector.h"

#include <cmath>

namespace anthrob {

SettleDetector::SettleDetector(std::shared_ptr<const RobotModel> model,
                               const SettleOptions& options)
    : model_(std::move(model)), options_(options) {}

void SettleDetector::start(double time) {
  anchored_ = false;
  anchor_time_ = time;
}

bool SettleDetector::moved(const RobotMeasurement& measured) const {
  const double turn = options_.actuator_velocity * options_.window;
  for (std::size_t m = 0; m < measured.muscles.size(); ++m) {
    if (std::abs(measured.muscles[m].position - anchor_.muscles[m].position) > turn) return true;
  }
  for (const JointModel& joint : model_->skeleton->joints) {
    if (joint_distance(joint, measured.q, anchor_.q) > options_.joint_velocity * options_.window)
      return true;
  }
  return false;
}

bool SettleDetector::step(const RobotMeasurement& measured, double time) {
  if (!anchored_ || moved(measured)) {
    anchor_ = measured;
    anchor_time_ = time;
    anchored_ = true;
    return false;
  }
  return time - anchor_time_ >= options_.window;
}

}  // namespace anthrob
