#include "actuator/ligament.h"

namespace anthrob {

std::shared_ptr<const Actuator> Ligament::load(const ConfigNode&, const ConfigNode& muscle,
                                               double) {
  return std::make_shared<Ligament>(read_rest_tendon_length(muscle));
}

}  // namespace anthrob
