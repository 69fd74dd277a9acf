#include "laws/laws.h"

namespace anthrob::virtual_robot {
HiddenLaw gravity_tilt() {
  HiddenLaw law;
  law.id = "gravity_tilt";
  law.law = "as in the catalogue";
  law.sizes = {"angle"};
  law.places = level_axes;
  law.draw = [](const auto&, const auto&, Random* random) -> Parameters {
    return {{"angle", 0.04 * random->sign()}};
  };
  law.build = [](const Hidden& h, Draft* draft) {
    if (h["angle"] == 0.0) return;
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(h.place[0] - 'x');
    auto& gravity = draft->arm.skeleton.gravity_W;
    gravity = Eigen::AngleAxisd(-h["angle"], axis) * gravity;
  };
  return law;
}

}  // namespace anthrob::virtual_robot
