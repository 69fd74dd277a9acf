#include "places.h"

#include <stdexcept>

namespace anthrob::virtual_robot {

using reference::ArmParameters;

std::vector<std::string> muscle_places(const ArmParameters& arm) {
  std::vector<std::string> list;
  for (const auto& muscle : arm.muscles) list.push_back(muscle.name);
  return list;
}

std::vector<std::string> muscle_places_and_all(const ArmParameters& arm) {
  std::vector<std::string> list = muscle_places(arm);
  list.push_back("all");
  return list;
}

std::vector<std::string> joint_places(const ArmParameters&) {
  return {"shoulder", "elbow"};
}

std::vector<std::string> elbow_only(const ArmParameters&) {
  return {"elbow"};
}

std::vector<std::string> shoulder_only(const ArmParameters&) {
  return {"shoulder"};
}

std::vector<std::string> global_place(const ArmParameters&) {
  return {"global"};
}

std::vector<std::string> world_axes(const ArmParameters&) {
  return {"x", "y", "z"};
}

std::vector<std::string> level_axes(const ArmParameters&) {
  return {"x", "y"};
}

std::vector<std::string> bodies(const ArmParameters&) {
  return {"humerus", "forearm"};
}

std::vector<std::string> muscle_pairs(const ArmParameters& arm) {
  std::vector<std::string> list;
  for (const auto& to : arm.muscles) {
    for (const auto& from : arm.muscles) {
      if (to.name != from.name) list.push_back(to.name + "/" + from.name);
    }
  }
  return list;
}

std::size_t crossing_segment(const reference::MuscleParameters& muscle) {
  for (std::size_t k = muscle.path.size() - 1; k-- > 0;) {
    if (muscle.path[k].body != muscle.path[k + 1].body) return k;
  }
  throw std::invalid_argument(muscle.name + " crosses no joint");
}

std::size_t leaving_segment(const reference::MuscleParameters& muscle) {
  for (std::size_t k = 0; k + 1 < muscle.path.size(); ++k) {
    if (muscle.path[k].body != muscle.path[k + 1].body) return k;
  }
  throw std::invalid_argument(muscle.name + " crosses no joint");
}

std::vector<std::string> landing_points(const ArmParameters& arm) {
  std::vector<std::string> list;
  for (const auto& muscle : arm.muscles) {
    for (std::size_t k = leaving_segment(muscle) + 1; k < muscle.path.size(); ++k) {
      if (muscle.path[k].cylinder) continue;
      for (const char* axis : {"/x", "/y", "/z"}) {
        list.push_back(muscle.name + "/" + std::to_string(k) + axis);
      }
    }
  }
  return list;
}

}  // namespace anthrob::virtual_robot
