#include "anthrob_control/approach.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace anthrob {

namespace {

/// Longest step [s]; after a longer pause the motion continues from where it was.
constexpr double kLongestStep = 0.1;

}  // namespace

Approach::Approach(std::shared_ptr<const RobotModel> model, double speed)
    : model_(std::move(model)), speed_(speed), reference_(model_->muscles.size(), 0.0) {
  if (!(speed > 0.0)) throw std::invalid_argument("Approach: speed: expected > 0 rad/s");
}

void Approach::begin() {
  phase_ = Phase::kNotBegun;
}

void Approach::start_where(const RobotMeasurement& measured) {
  for (std::size_t m = 0; m < reference_.size(); ++m) {
    const MuscleModel& muscle = model_->muscles[m];
    if (!muscle.has_controller) continue;
    const double limit = muscle.limits.position;  // a reference beyond it would be refused
    reference_[m] = std::clamp(measured.muscles[m].position, -limit, limit);
  }
  phase_ = Phase::kUnderWay;
}

const std::vector<double>& Approach::step(const std::vector<double>& wanted,
                                          const RobotMeasurement& measured, double dt) {
  if (phase_ == Phase::kNotBegun) start_where(measured);
  double farthest = 0.0;
  for (std::size_t m = 0; m < reference_.size(); ++m) {
    if (!model_->muscles[m].has_controller) continue;
    farthest = std::max(farthest, std::abs(wanted[m] - reference_[m]));
  }
  const double way = speed_ * std::min(dt, kLongestStep);
  if (arrived() || farthest <= way) {
    phase_ = Phase::kArrived;
    reference_ = wanted;
    return reference_;
  }
  for (std::size_t m = 0; m < reference_.size(); ++m) {
    reference_[m] += way / farthest * (wanted[m] - reference_[m]);
  }
  return reference_;
}

}  // namespace anthrob
