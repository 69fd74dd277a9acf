#include "outside/outside.h"

namespace anthrob::virtual_robot {

const std::vector<HiddenLaw>& outside_laws() {
  static const std::vector<HiddenLaw> laws{
      quadratic_drag(),  torque_ripple(),     shoulder_hardening(), periodic_push(),
      gusts(),           sticking_with_age(), warming_ring(),       slipping_knot(),
      one_bad_tooth(),   weak_above_angle(),  command_slew(),       stale_samples(),
      motor_induction(), elbow_microphone(),  force_compression()};
  return laws;
}

}  // namespace anthrob::virtual_robot
