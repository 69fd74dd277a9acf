#pragma once

#include <map>
#include <string>

#include "anthrob_core/pose.h"

namespace anthrob {

/// Centres of ball joints in the child's frame [m], from a model file.
/// @throws BadInput if it cannot be read
std::map<std::string, Vec3> ball_centers(const std::string& model_file);

}  // namespace anthrob
