#pragma once

#include <string>
#include <vector>

#include "anthrob_sim/skeleton/skeleton_model.h"

namespace anthrob {

/// What load_urdf() reads, and what is odd about the file.
struct UrdfRobot {
  SkeletonModel skeleton;
  std::vector<std::string> remarks;  ///< one line each
};

/// @throws BadInput as load_urdf()
UrdfRobot read_urdf(const std::string& file, bool collisions);

}  // namespace anthrob
