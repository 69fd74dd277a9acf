#include "tube.h"

#include <cmath>

namespace anthrob {

namespace {

constexpr double kOnePlace = 1e-6;           // [m] no tendon shows more of a robot
constexpr double kSharpestMitre = -0.5;      // cosine of the turn
constexpr double kTurn = 6.283185307179586;  // [rad]

std::vector<Vec3> without_doubles(const std::vector<Vec3>& points) {
  std::vector<Vec3> line;
  for (const Vec3& point : points) {
    if (line.empty() || (point - line.back()).norm() > kOnePlace) line.push_back(point);
  }
  return line;
}

Vec3 any_perpendicular(const Vec3& direction) {
  int smallest = 0;
  direction.cwiseAbs().minCoeff(&smallest);
  return direction.cross(Vec3::Unit(smallest)).normalized();
}

/// The part of a vector across a direction, as a unit vector.
Vec3 across(const Vec3& vector, const Vec3& direction) {
  return (vector - direction * vector.dot(direction)).normalized();
}

/// Grows a tube from its first point on. `spoke_` is across the current piece and turns no more
/// than the line does, so that the tube is not twisted.
class TubeBuilder {
 public:
  TubeBuilder(double radius, int sides) : radius_(radius), sides_(sides) {}

  void begin(const Vec3& point, const Vec3& direction) {
    spoke_ = any_perpendicular(direction);
    add_vertex(point, -direction);
    add_rim(point, direction, -direction);
    close(0, 1, false);
    add_ring(point, direction, direction, direction);
  }

  void bend(const Vec3& point, const Vec3& in, const Vec3& out) {
    if (in.dot(out) < kSharpestMitre) {
      add_ring(point, in, in, in);
      spoke_ = across(spoke_, out);
      add_ring(point, out, out, out);
    } else {
      add_ring(point, in, (in + out).normalized(), out);
      spoke_ = across(mitred(spoke_, in, (in + out).normalized()), out);
    }
  }

  void end(const Vec3& point, const Vec3& direction) {
    add_ring(point, direction, direction, direction);
    const std::uint32_t rim = size();
    add_rim(point, direction, direction);
    add_vertex(point, direction);
    close(size() - 1, rim, true);
  }

  TubeMesh take() { return std::move(mesh_); }

 private:
  /// Where a line along `in`, through the end of a spoke, meets the plane across `plane`.
  static Vec3 mitred(const Vec3& spoke, const Vec3& in, const Vec3& plane) {
    return spoke - in * (spoke.dot(plane) / in.dot(plane));
  }

  Vec3 spoke(int side, const Vec3& direction) const {
    const double angle = kTurn * side / sides_;
    return std::cos(angle) * spoke_ + std::sin(angle) * direction.cross(spoke_);
  }

  void add_vertex(const Vec3& position, const Vec3& normal) {
    mesh_.positions.push_back(position);
    mesh_.normals.push_back(normal);
  }

  std::uint32_t size() const { return static_cast<std::uint32_t>(mesh_.positions.size()); }

  void add_ring(const Vec3& point, const Vec3& in, const Vec3& plane, const Vec3& out) {
    const std::uint32_t ring = size();
    for (int side = 0; side < sides_; ++side) {
      const Vec3 before = spoke(side, in);
      const Vec3 corner = mitred(before, in, plane);
      add_vertex(point + radius_ * corner, (before + across(corner, out)).normalized());
    }
    if (has_ring_) join(last_ring_, ring);
    last_ring_ = ring, has_ring_ = true;
  }

  void join(std::uint32_t a, std::uint32_t b) {
    const auto n = static_cast<std::uint32_t>(sides_);
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t j = (i + 1) % n;
      mesh_.indices.insert(mesh_.indices.end(), {a + i, a + j, b + j, a + i, b + j, b + i});
    }
  }

  void add_rim(const Vec3& point, const Vec3& direction, const Vec3& outward) {
    for (int side = 0; side < sides_; ++side) {
      add_vertex(point + radius_ * spoke(side, direction), outward);
    }
  }

  /// Triangles between the middle of a flat end and its rim.
  void close(std::uint32_t middle, std::uint32_t rim, bool ahead) {
    const auto n = static_cast<std::uint32_t>(sides_);
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = rim + i, b = rim + (i + 1) % n;
      mesh_.indices.insert(mesh_.indices.end(), {middle, ahead ? a : b, ahead ? b : a});
    }
  }

  double radius_;
  int sides_;
  Vec3 spoke_ = Vec3::UnitX();
  std::uint32_t last_ring_ = 0;
  bool has_ring_ = false;
  TubeMesh mesh_;
};

}  // namespace

TubeMesh tube(const std::vector<Vec3>& points, double radius, int sides) {
  const std::vector<Vec3> line = without_doubles(points);
  if (line.size() < 2) return {};
  std::vector<Vec3> directions;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    directions.push_back((line[i + 1] - line[i]).normalized());
  }
  TubeBuilder builder(radius, sides);
  builder.begin(line.front(), directions.front());
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    builder.bend(line[i], directions[i - 1], directions[i]);
  }
  builder.end(line.back(), directions.back());
  return builder.take();
}

}  // namespace anthrob
