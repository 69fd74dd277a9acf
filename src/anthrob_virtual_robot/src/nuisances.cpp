#include "nuisances.h"

#include "places.h"

namespace anthrob::virtual_robot {

NuisanceRanges NuisanceRanges::load(const ConfigNode& node) {
  NuisanceRanges ranges;
  ranges.rest_tendon_length = node.number("rest_tendon_length", Bounds::nonnegative(), "m");
  ranges.spindle_radius = node.number("spindle_radius", Bounds::nonnegative(), "m");
  ranges.path_point = node.number("path_point", Bounds::nonnegative(), "m");
  const ConfigNode viscous = node.at("viscous");
  ranges.viscous_low = viscous.number("low", Bounds::positive(), "1");
  ranges.viscous_high = viscous.number("high", Bounds::positive(), "1");
  return ranges;
}

reference::ArmParameters miscalibrated(const reference::ArmParameters& arm,
                                       const NuisanceRanges& ranges, Random random) {
  reference::ArmParameters result = arm;
  const auto error = [&](double range) { return random.uniform(-range, range); };
  for (reference::MuscleParameters& muscle : result.muscles) {
    muscle.rest_tendon_length += error(ranges.rest_tendon_length);
    muscle.spindle_radius += error(ranges.spindle_radius);
    Eigen::Vector3d& point = muscle.path[leaving_segment(muscle)].position;
    for (int k = 0; k < 3; ++k) point(k) += error(ranges.path_point);
  }
  for (auto* joint : {&result.skeleton.shoulder_friction, &result.skeleton.elbow_friction}) {
    joint->viscous *= random.log_uniform(ranges.viscous_low, ranges.viscous_high);
  }
  return result;
}

}  // namespace anthrob::virtual_robot
