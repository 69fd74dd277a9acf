#include "anthrob_reference/ring.h"

#include <algorithm>
#include <cmath>

#include "check.h"

namespace anthrob::reference {

Ring::Ring(const RingParameters& parameters)
    : rest_length_(parameters.rest_length),
      modulus_(parameters.modulus),
      arm_modulus_(parameters.arm_modulus),
      relaxation_time_(parameters.relaxation_time),
      area_(parameters.quantity * parameters.strands * M_PI / 4.0 * parameters.section_diameter *
            parameters.section_diameter) {
  require_positive("ring rest length", rest_length_);
  require_positive("ring modulus", modulus_);
  require_not_negative("ring arm modulus", arm_modulus_);
  require_positive("ring relaxation time", relaxation_time_);
  require_positive("ring cross section", area_);
}

double Ring::strain(double gap) const {
  return std::max(0.0, gap - rest_length_) / rest_length_;
}

double Ring::force(double strain, double y) const {
  return area_ * std::max(0.0, (modulus_ + arm_modulus_) * strain - y);
}

double Ring::rate(double strain, double y) const {
  return (arm_modulus_ * strain - y) / relaxation_time_;
}

}  // namespace anthrob::reference
