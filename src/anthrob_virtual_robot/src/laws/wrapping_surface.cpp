#include "laws/laws.h"

namespace anthrob::virtual_robot {
namespace {

void put_surface(const Hidden& h, std::size_t index, reference::ArmParameters* arm) {
  reference::MuscleParameters& muscle = arm->muscles[index];
  const std::size_t k = crossing_segment(muscle);
  reference::PathEntry surface;
  surface.body = muscle.path[k + 1].body;
  const bool elbow = surface.body == reference::Body::kForearm;
  surface.cylinder = reference::CylinderShape{
      elbow ? Eigen::Vector3d(-1.0, 0.0, 0.0) : Eigen::Vector3d::UnitY(), h["radius"]};
  muscle.path.insert(muscle.path.begin() + static_cast<std::ptrdiff_t>(k) + 1, surface);
  if (muscle.ring_segment > static_cast<int>(k)) ++muscle.ring_segment;
  if (muscle.sensor_segment > static_cast<int>(k)) ++muscle.sensor_segment;
}

/// A tendon as long as is relaxed at rest with the surface.
void cut_to_length(const Hidden& h, std::size_t index, reference::ArmParameters* arm) {
  reference::ArmParameters with = *arm;
  put_surface(h, index, &with);
  arm->muscles[index].rest_tendon_length +=
      reference::Arm(with).muscle(index).length - reference::Arm(*arm).muscle(index).length;
}

}  // namespace

// The cylinder of model II for the same muscle: along the humerus at the shoulder, about the axis
// of the elbow; the tendon of a surface's muscle is as long as is relaxed at rest with it.
HiddenLaw wrapping_surface() {
  HiddenLaw law;
  law.id = "wrapping_surface";
  law.law = "cylinder, the reference arm's own closed form; rest length as with the surface";
  law.sizes = {};
  law.places = muscle_places;
  law.draw = [](const reference::ArmParameters& arm, const std::string& place,
                Random* random) -> Parameters {
    for (const auto& muscle : arm.muscles) {
      if (muscle.name != place) continue;
      const std::size_t k = crossing_segment(muscle);
      const bool elbow = muscle.path[k + 1].body == reference::Body::kForearm;
      // No larger than what leaves the insertion outside.
      const Eigen::Vector3d p = muscle.path[k + 1].position;
      const double distance = elbow ? std::hypot(p.y(), p.z()) : std::hypot(p.x(), p.z());
      const double largest = std::min(elbow ? 0.018 : 0.024, 0.98 * distance);
      return {{"radius", random->uniform(0.85, 1.0) * largest}};
    }
    throw std::invalid_argument(place + ": no such muscle");
  };
  law.ordinary = [](const Hidden& h, Draft* draft) {
    if (h["radius"] != 0.0) cut_to_length(h, draft->muscle(h.place), &draft->arm);
  };
  law.build = [](const Hidden& h, Draft* draft) {
    if (h["radius"] == 0.0) return;
    cut_to_length(h, draft->muscle(h.place), &draft->arm);
    put_surface(h, draft->muscle(h.place), &draft->arm);
  };
  return law;
}

}  // namespace anthrob::virtual_robot
