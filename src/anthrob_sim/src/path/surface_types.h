#pragma once

#include <memory>
#include <string>

#include "anthrob_core/config_node.h"
#include "anthrob_sim/path/wrapping_surface.h"
#include "path/mesh_file.h"

namespace anthrob {

/// Builds the surface that one entry of a muscle's path describes, e.g. `{cylinder: {...}}`.
/// @param X_BL from the link frame, in which the file gives the surface, to the body's frame
/// @param files of meshes, which it opens if they are new
std::shared_ptr<const WrappingSurface> make_wrapping_surface(const std::string& type,
                                                             const ConfigNode& node,
                                                             const Pose& X_BL,
                                                             const MeshFiles& files);
/// Names of all known types, for messages: "sphere, cylinder".
std::string wrapping_surface_types();

}  // namespace anthrob
