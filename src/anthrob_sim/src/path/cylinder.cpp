#include "path/cylinder.h"

#include <algorithm>
#include <cmath>

namespace anthrob {

namespace {
Vec3 from_plane(double u, double v, double height) {
  return {v, height, u};
}
}  // namespace

/// The plane is (z, x), right-handed about y.
struct Cylinder::Polar {
  double u, v, height, distance;

  explicit Polar(const Vec3& p_C)
      : u(p_C.z()), v(p_C.x()), height(p_C.y()), distance(std::max(1e-12, std::hypot(u, v))) {}

  double angle_to(const Polar& b) const { return std::atan2(u * b.v - v * b.u, u * b.u + v * b.v); }
  Vec3 ray() const { return from_plane(u / distance, v / distance, 0.0); }
  /// The point moved along its ray.
  Vec3 at_distance(double d) const { return from_plane(0.0, 0.0, height) + d * ray(); }
};

void Cylinder::initialise(const Vec3& before, const Vec3& after, StateView state) const {
  const Polar p1(X_BC_.to_local(before)), p2(X_BC_.to_local(after));
  circle_.initialise(p1.angle_to(p2), p1.distance, p2.distance, state.as<CircleWrap::State>());
}

void Cylinder::wrap(const Vec3& before, const Vec3& after, StateView state,
                    WrapContact& contact) const {
  auto& memory = state.as<CircleWrap::State>();
  const Polar p1(X_BC_.to_local(before)), p2(X_BC_.to_local(after));
  if (memory.side == 0.0 && circle_.segment_is_clear(p1.u, p1.v, p2.u, p2.v)) {
    set_straight(before, after, X_BC_.p, contact);
    return;
  }
  const CircleWrap::Result w = circle_.update(p1.angle_to(p2), p1.distance, p2.distance, memory);
  const bool inside = w.penetration > 0.0;
  if (w.touching) {
    follow(w, p1, p2, contact);
  } else if (inside) {
    set_straight(X_BC_ * p1.at_distance(w.lift1.distance), X_BC_ * p2.at_distance(w.lift2.distance),
                 X_BC_.p, contact);
  } else {
    set_straight(before, after, X_BC_.p, contact);
  }
  contact.penetration = w.penetration;
  if (inside) {
    pull_inside(w, X_BC_.R * p1.ray(), X_BC_.R * p2.ray(), X_BC_.R.col(1), before, after, contact);
  }
}

void Cylinder::follow(const CircleWrap::Result& w, const Polar& p1, const Polar& p2,
                      WrapContact& contact) const {
  // Unit vectors from the axis to the tangent points: the points' own, turned towards each other.
  const double s1 = w.side * w.sin1, s2 = -w.side * w.sin2;
  const double u1 = p1.u / p1.distance, v1 = p1.v / p1.distance;
  const double u2 = p2.u / p2.distance, v2 = p2.v / p2.distance;
  const double ua = w.cos1 * u1 - s1 * v1, va = w.cos1 * v1 + s1 * u1;
  const double ub = w.cos2 * u2 - s2 * v2, vb = w.cos2 * v2 + s2 * u2;

  // Unrolled (4.30), (4.31): one slope along the axis per length in the plane.
  const double r = w.radius;
  const double arc = r * w.alpha;
  const double planar = w.b1 + arc + w.b2;
  const double slope = (p2.height - p1.height) / planar;
  const double stretch = std::sqrt(1.0 + slope * slope);

  contact.touching = true;
  contact.entry = X_BC_ * from_plane(r * ua, r * va, p1.height + slope * w.b1);
  contact.exit = X_BC_ * from_plane(r * ub, r * vb, p2.height - slope * w.b2);
  contact.direction_in = X_BC_.R * (from_plane(-w.side * va, w.side * ua, slope) / stretch);
  contact.direction_out = X_BC_.R * (from_plane(-w.side * vb, w.side * ub, slope) / stretch);
  contact.pull_in = contact.direction_in;
  contact.pull_out = contact.direction_out;
  contact.length_in = w.b1 * stretch;
  contact.length_on = arc * stretch;
  contact.length_out = w.b2 * stretch;
  contact.turning = w.alpha / stretch;  // a helix bends less: curvature 1 / (r stretch^2)
  contact.wrap_angle = w.alpha;
  contact.half_turns = static_cast<int>(w.alpha / M_PI);
}

void Cylinder::trace(const WrapContact& contact, std::vector<Vec3>& points) const {
  const Vec3 entry = X_BC_.to_local(contact.entry), exit = X_BC_.to_local(contact.exit);
  // About y, from z towards x; the side is that of the tangent at the entry.
  const Vec3 tangent = X_BC_.R.transpose() * contact.direction_in;
  const double side = entry.z() * tangent.x() - entry.x() * tangent.z() >= 0.0 ? 1.0 : -1.0;
  const double start = std::atan2(entry.x(), entry.z());
  // Both are the cylinder's, but for a point inside.
  const double first = std::hypot(entry.x(), entry.z()), last = std::hypot(exit.x(), exit.z());
  const int pieces = 1 + static_cast<int>(contact.wrap_angle / 0.1);
  for (int i = 0; i <= pieces; ++i) {
    const double share = static_cast<double>(i) / pieces;
    const double angle = start + side * share * contact.wrap_angle;
    const double radius = first + share * (last - first);
    points.push_back(X_BC_ * from_plane(radius * std::cos(angle), radius * std::sin(angle),
                                        entry.y() + share * (exit.y() - entry.y())));
  }
}

std::shared_ptr<const WrappingSurface> Cylinder::load(const ConfigNode& node, const Pose& X_BL) {
  const Vec3 origin = node.at("origin").as_vector3("m");
  const Vec3 axis = node.at("axis").as_vector3("1");
  if (!(axis.norm() > 1e-9)) node.at("axis").fail_expected("a vector that is not zero");
  const Vec3 y = axis.normalized();
  const Vec3 x = y.unitOrthogonal();
  Mat3 R;
  R << x, y, x.cross(y);
  return std::make_shared<Cylinder>(X_BL * Pose{R, origin}, read_circle_wrap(node));
}

}  // namespace anthrob
