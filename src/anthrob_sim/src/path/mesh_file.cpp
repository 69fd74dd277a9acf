#include "path/mesh_file.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <tuple>

#include "path/collada_check.h"

namespace anthrob {

namespace {

/// No bone is smaller or larger [m]: a mesh that is was drawn in other units.
constexpr double kSmallest = 0.002, kLargest = 3.0;
constexpr std::size_t kMostFacets = 2000000;

std::string count_of(std::size_t n, const std::string& what) {
  return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

/// Vertices by place, so that facets that touch share them.
class Welder {
 public:
  explicit Welder(TriangleMesh& mesh) : mesh_(mesh) {}
  int index_of(const aiVector3D& p) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      throw std::runtime_error("holds a coordinate that is not a finite number");
    }
    const auto [it, is_new] =
        known_.emplace(std::make_tuple(p.x, p.y, p.z), static_cast<int>(mesh_.vertices.size()));
    if (is_new) mesh_.vertices.emplace_back(p.x, p.y, p.z);
    return it->second;
  }

 private:
  TriangleMesh& mesh_;
  std::map<std::tuple<ai_real, ai_real, ai_real>, int> known_;
};

using Polygon = std::vector<Vec3>;

/// What of a convex polygon lies on one side of a plane.
Polygon cut(const Polygon& polygon, const Vec3& point, const Vec3& normal) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double ha = normal.dot(a - point), hb = normal.dot(b - point);
    if (ha >= 0.0) kept.push_back(a);
    if ((ha < 0.0) != (hb < 0.0)) kept.push_back(a + ha / (ha - hb) * (b - a));
  }
  return kept;
}

/// Corners of what the planes of `part` leave of the facets.
std::vector<Vec3> cut(const TriangleMesh& mesh, const ConfigNode& part) {
  std::vector<std::pair<Vec3, Vec3>> planes;
  for (const ConfigNode& plane : part.items()) {
    planes.emplace_back(plane.at("point").as_vector3("m"), plane.at("normal").as_vector3("1"));
    if (!(planes.back().second.norm() > 1e-9)) {
      plane.at("normal").fail_expected("a vector that is not zero");
    }
  }
  std::vector<Vec3> points;
  for (const auto& facet : mesh.facets) {
    Polygon polygon;
    for (const int v : facet) polygon.push_back(mesh.vertices[v]);
    for (const auto& [point, normal] : planes) polygon = cut(polygon, point, normal);
    points.insert(points.end(), polygon.begin(), polygon.end());
  }
  if (points.size() < 4) part.fail("no part of the mesh lies on that side of the planes");
  return points;
}

void check_size(const ConfigNode& node, const std::vector<Vec3>& points) {
  Vec3 lo = points.front(), hi = lo;
  for (const Vec3& p : points) lo = lo.cwiseMin(p), hi = hi.cwiseMax(p);
  const double size = (hi - lo).norm();
  if (size >= kSmallest && size <= kLargest) return;
  char text[160];
  std::snprintf(
      text, sizeof(text), "mesh is %g m across; expected %g to %g m%s", size, kSmallest, kLargest,
      size > kLargest && size < 1e3 * kLargest ? " (drawn in millimetres? then set scale: 0.001)"
                                               : "");
  node.at("file").fail(text);
}

/// What a file holds now: a path may get another content, and content another path.
std::string stamp_of(const std::string& path) {
  std::string content;  // no file, or a folder, has a message of its own
  if (std::filesystem::is_regular_file(path)) {
    std::ifstream in(path, std::ios::binary);
    content.assign(std::istreambuf_iterator<char>(in), {});
  }
  std::ostringstream stamp;
  stamp << path << content.size() << " " << std::hash<std::string>()(content);
  return stamp.str();
}

/// Parsing takes much longer than reading: programs that load a robot again get the same mesh.
std::shared_ptr<const MeshFile> parsed(const std::string& path) {
  constexpr std::size_t kCapacity = 256;
  static std::mutex mutex;
  static std::map<std::string, std::shared_ptr<const MeshFile>> known;
  auto file = std::make_shared<MeshFile>();
  file->stamp = stamp_of(path);
  {
    const std::lock_guard<std::mutex> lock(mutex);
    const auto same = known.find(file->stamp);
    if (same != known.end()) return same->second;
  }
  try {
    file->mesh = read_mesh(path);
  } catch (const std::runtime_error& error) {
    file->reason = error.what();
    return file;
  }
  const std::lock_guard<std::mutex> lock(mutex);
  if (known.size() >= kCapacity) known.clear();
  known.emplace(file->stamp, file);
  return file;
}

bool is_collada(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension == ".dae" || extension == ".xml";
}

}  // namespace

TriangleMesh read_mesh(const std::string& file) {
  if (!std::filesystem::exists(file)) throw std::runtime_error("no such file");
  if (!std::filesystem::is_regular_file(file)) throw std::runtime_error("not a file");
  if (std::filesystem::file_size(file) == 0) throw std::runtime_error("the file is empty");
  if (is_collada(file)) {
    if (const auto fault = fault_of_collada(file)) throw std::runtime_error(*fault);
  }
  Assimp::Importer importer;
  // As RViz draws it: vertices as the file has them, whichever axis it calls the upper one.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* scene =
      importer.ReadFile(file, aiProcess_Triangulate | aiProcess_PreTransformVertices);
  if (scene == nullptr) {
    std::string reason = importer.GetErrorString();
    for (char& c : reason) c = c == '\n' ? ' ' : c;
    throw std::runtime_error("not a mesh that can be read: " + reason);
  }
  TriangleMesh mesh;
  Welder welder(mesh);
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& part = *scene->mMeshes[m];
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices != 3) continue;  // points and lines
      std::array<int, 3> corners{};
      for (int i = 0; i < 3; ++i) corners[i] = welder.index_of(part.mVertices[face.mIndices[i]]);
      mesh.facets.push_back(corners);
    }
  }
  if (mesh.facets.empty()) throw std::runtime_error("holds no triangles");
  if (mesh.facets.size() > kMostFacets) {
    throw std::runtime_error("holds " + count_of(mesh.facets.size(), "facet") +
                             "; expected at most " + std::to_string(kMostFacets));
  }
  return mesh;
}

std::vector<std::string> mesh_oddities(const TriangleMesh& mesh) {
  std::map<std::pair<int, int>, int> sides;  // directed
  std::size_t empty = 0;
  double volume = 0.0;
  for (const auto& f : mesh.facets) {
    const Vec3 &a = mesh.vertices[f[0]], &b = mesh.vertices[f[1]], &c = mesh.vertices[f[2]];
    if (f[0] == f[1] || f[1] == f[2] || f[2] == f[0] || (b - a).cross(c - a).norm() == 0.0) {
      ++empty;
      continue;
    }
    volume += a.dot(b.cross(c)) / 6.0;
    for (int i = 0; i < 3; ++i) ++sides[{f[i], f[(i + 1) % 3]}];
  }
  std::size_t open = 0, crowded = 0, flipped = 0;
  for (const auto& [ends, count] : sides) {
    const auto other = sides.find({ends.second, ends.first});
    const int back = other == sides.end() ? 0 : other->second;
    if (count + back > 2) {
      crowded += ends.first < ends.second || back == 0;
    } else if (count == 2) {
      ++flipped;
    } else if (back == 0) {
      ++open;
    }
  }
  std::vector<std::string> list;
  if (empty > 0) list.push_back(count_of(empty, "facet") + " without area");
  if (open > 0) list.push_back(count_of(open, "open edge"));
  if (crowded > 0) list.push_back(count_of(crowded, "edge") + " of more than two facets");
  if (flipped > 0)
    list.push_back(count_of(flipped, "edge") + " between facets that face opposite ways");
  if (open == 0 && crowded == 0 && flipped == 0 && volume < 0.0)
    list.push_back("facets face inwards");
  return list;
}

std::shared_ptr<const MeshFile> MeshFiles::get(const std::string& path) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  auto& file = files_[path];
  if (!file) file = parsed(path);
  return file;
}

std::shared_ptr<const MeshFile> MeshFiles::get(const ConfigNode& file) const {
  return get((std::filesystem::path(file.file()).parent_path() / file.as_text()).string());
}

MeshPoints load_mesh_points(const ConfigNode& node, const MeshFiles& files) {
  const ConfigNode file = node.at("file");
  const std::shared_ptr<const MeshFile> source = files.get(file);
  if (source->reason) file.fail(file.as_text() + ": " + *source->reason);
  TriangleMesh mesh = source->mesh;
  const double scale = node.number_or("scale", 1.0, Bounds::positive(), "1");
  for (Vec3& p : mesh.vertices) p *= scale;
  check_size(node, mesh.vertices);
  MeshPoints result;
  result.points = node.has("part") ? cut(mesh, node.at("part")) : mesh.vertices;
  const Vec3 offset = node.has("offset") ? node.at("offset").as_vector3("m") : Vec3(Vec3::Zero());
  for (Vec3& p : result.points) p += offset;
  for (const std::string& oddity : mesh_oddities(mesh)) {
    result.remarks.push_back(file.file() + ": " + file.path() + ": " + file.as_text() + ": " +
                             oddity + "; its convex hull is used anyway");
  }
  return result;
}

}  // namespace anthrob
