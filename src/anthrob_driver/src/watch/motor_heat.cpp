#include "anthrob_driver/watch/motor_heat.h"

#include <cmath>

namespace anthrob {
namespace driver {

void MotorHeat::step(double current, double now) {
  if (!known()) return;
  const double elapsed = begun_ ? now - last_ : 0.0;
  last_ = now;
  begun_ = true;
  if (!(elapsed > 0.0)) return;
  const double share = elapsed > kLongestGap ? 0.0 : current / nominal_;
  const double end = share * share;
  heat_ = end + (heat_ - end) * std::exp(-elapsed / time_constant_);
}

double MotorHeat::time_to_cool() const {
  return heat_ > kCool ? time_constant_ * std::log(heat_ / kCool) : 0.0;
}

}  // namespace driver
}  // namespace anthrob
