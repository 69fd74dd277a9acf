#include "anthrob_sim/actuator/ligament.h"

namespace anthrob {

std::shared_ptr<const Actuator> Ligament::load(const ConfigNode&, const ConfigNode& muscle,
                                               double) {
  return std::make_shared<Ligament>(muscle.number("rest_tendon_length", Bounds::positive(), "m"));
}

}  // namespace anthrob
