#pragma once

#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
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

/// A file as it was when it was read.
struct MeshFile {
  std::string stamp;  ///< path, size and hash of the content
  TriangleMesh mesh;
  std::optional<std::string> reason;  ///< why it cannot be used, if it cannot
};

/// The mesh files of a robot, each opened once. Thread-safe.
class MeshFiles {
 public:
  /// Reads the file if it is new.
  std::shared_ptr<const MeshFile> get(const std::string& path) const;
  /// The same for the `file` of a surface's description.
  std::shared_ptr<const MeshFile> get(const ConfigNode& file) const;

 private:
  mutable std::mutex mutex_;
  mutable std::map<std::string, std::shared_ptr<const MeshFile>> files_;
};

struct MeshPoints {
  std::vector<Vec3> points;          ///< in the link's frame [m]
  std::vector<std::string> remarks;  ///< one line for each oddity of the file
};

/// The points that a wrapping surface described by `{file: , scale: , offset: , part: }` is the
/// hull of. `part` keeps what lies on one side of each of its planes.
/// @throws BadInput if the mesh is unreadable, has a size that no bone has, or is cut away
MeshPoints load_mesh_points(const ConfigNode& node, const MeshFiles& files = {});

}  // namespace anthrob
