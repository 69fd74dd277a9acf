#pragma once

#include <array>
#include <string>
#include <vector>

#include "anthrob_core/config_node.h"
#include "anthrob_core/pose.h"

namespace anthrob {

/// Triangles of a mesh; corners at the same place are one vertex.
struct TriangleMesh {
  std::vector<Vec3> vertices;  ///< [m]
  std::vector<std::array<int, 3>> facets;
};

/// Reads STL, OBJ, COLLADA and what else assimp knows, with the file's own transforms.
/// @throws std::runtime_error with a reason if the file cannot be read or holds no triangles, or
/// numbers that are not finite
TriangleMesh read_mesh(const std::string& file);

/// Defects of a mesh that do not affect its convex hull: holes, edges of more than two facets,
/// facets that face inwards or have no area. One phrase each; empty if there are none.
std::vector<std::string> mesh_oddities(const TriangleMesh& mesh);

struct MeshPoints {
  std::vector<Vec3> points;          ///< in the link's frame [m]
  std::vector<std::string> remarks;  ///< one line for each oddity of the file
};

/// The points that a wrapping surface described by `{file: , scale: , offset: , part: }` is the
/// hull of. `part` keeps what lies on one side of each of its planes.
/// @throws BadInput if the mesh is unreadable, has a size that no bone has, or is cut away
MeshPoints load_mesh_points(const ConfigNode& node);

}  // namespace anthrob
