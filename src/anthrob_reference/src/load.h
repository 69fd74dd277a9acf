#pragma once

#include <string>

#include "anthrob_reference/parameters.h"

namespace anthrob::reference {

/// Reads a model file and the skeleton it names. `extends: other.yaml` (relative to the file)
/// merges maps recursively and replaces everything else.
/// @throws std::runtime_error naming file and key, if a key is missing or misspelt, or if it needs
///   something that this model has no equation for
ArmParameters load_arm(const std::string& model_file);

/// Fills frames, masses, elbow axis and elbow range from a URDF with the links base, humerus and
/// forearm; the rest of SkeletonParameters (shoulder centre, friction, gravity) is left alone.
void load_robot(const std::string& urdf_file, SkeletonParameters* skeleton);

}  // namespace anthrob::reference
