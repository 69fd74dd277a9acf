#pragma once

#include <string>
#include <vector>

#include "skeleton/urdf_file.h"

namespace anthrob {

/// Looks at the numbers of a URDF for those that no robot has, as in millimetres or degrees.
/// @param file one that urdfdom has read, so that its numbers are numbers
/// @return odd ones, one line each   @throws BadInput with one line about an impossible one
std::vector<std::string> odd_sizes(const UrdfFile& file);

}  // namespace anthrob
