#include "watch/winding_temperature_model.h"

#include <cmath>

namespace anthrob {
namespace driver {

void WindingTemperatureModel::step(double current, double now) {
  if (!known()) return;
  const double elapsed = begun_ ? now - last_ : 0.0;
  last_ = now;
  begun_ = true;
  if (!(elapsed > 0.0)) return;
  const double share = elapsed > kLongestGap ? 0.0 : current / nominal_;
  const double end = share * share;
  rise_ = end + (rise_ - end) * std::exp(-elapsed / time_constant_);
}

double WindingTemperatureModel::time_to_cool() const {
  return rise_ > kCool ? time_constant_ * std::log(rise_ / kCool) : 0.0;
}

}  // namespace driver
}  // namespace anthrob
