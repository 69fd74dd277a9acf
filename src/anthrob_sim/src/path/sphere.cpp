#include "path/sphere.h"

#include <algorithm>
#include <cmath>

namespace anthrob {

namespace {
/// Below this sine the two points and the centre are collinear and give no plane.
constexpr double kCollinear = 1e-9;

/// The part of `v` across `direction`, as a unit vector; any such vector if there is none.
Vec3 across(const Vec3& v, const Vec3& direction) {
  const Vec3 rest = v - direction * direction.dot(v);
  return rest.norm() > kCollinear ? Vec3(rest.normalized()) : Vec3(direction.unitOrthogonal());
}
}  // namespace

struct Sphere::Arm {
  Vec3 direction;
  double distance;

  Arm(const Vec3& point, const Vec3& center)
      : direction(point - center), distance(direction.norm()) {
    distance = std::max(distance, 1e-12);
    direction /= distance;
  }
};

void Sphere::initialise(const Vec3& before, const Vec3& after, StateView state) const {
  auto& memory = state.as<State>();
  const Arm j1(before, center_), j2(after, center_);
  const Vec3 cross = j1.direction.cross(j2.direction);
  const double sine = cross.norm();
  const Vec3 normal = sine > kCollinear ? Vec3(cross / sine) : Vec3(j1.direction.unitOrthogonal());
  Eigen::Map<Vec3>(memory.normal) = normal;
  circle_.initialise(std::atan2(sine, j1.direction.dot(j2.direction)), j1.distance, j2.distance,
                     memory.circle);
}

void Sphere::wrap(const Vec3& before, const Vec3& after, StateView state,
                  WrapContact& contact) const {
  auto& memory = state.as<State>();
  Eigen::Map<Vec3> last_normal(memory.normal);
  const Arm j1(before, center_), j2(after, center_);
  const Vec3 cross = j1.direction.cross(j2.direction);
  const double sine = cross.norm(), cosine = j1.direction.dot(j2.direction);

  Vec3 normal;
  if (sine < kCollinear) {
    normal = across(last_normal, j1.direction);
  } else {
    normal = cross / sine;
    if (memory.circle.side != 0.0 && normal.dot(last_normal) < 0.0) normal = -normal;
  }
  last_normal = normal;
  const double angle = std::atan2(normal.dot(cross), cosine);
  const CircleWrap::Result w = circle_.update(angle, j1.distance, j2.distance, memory.circle);
  const bool inside = w.penetration > 0.0;
  if (w.touching) {
    follow(w, normal, j1, j2, contact);
  } else if (inside) {
    set_straight(center_ + w.lift1.distance * j1.direction,
                 center_ + w.lift2.distance * j2.direction, center_, contact);
  } else {
    set_straight(before, after, center_, contact);
  }
  contact.penetration = w.penetration;
  if (inside) pull_inside(w, j1.direction, j2.direction, Vec3::Zero(), before, after, contact);
}

void Sphere::follow(const CircleWrap::Result& w, const Vec3& normal, const Arm& j1, const Arm& j2,
                    WrapContact& contact) const {
  const double r = w.radius;
  const Vec3 forward1 = w.side * normal.cross(j1.direction);
  const Vec3 forward2 = w.side * normal.cross(j2.direction);
  const Vec3 a = w.cos1 * j1.direction + w.sin1 * forward1;
  const Vec3 b = w.cos2 * j2.direction - w.sin2 * forward2;
  contact.touching = true;
  contact.entry = center_ + r * a;
  contact.exit = center_ + r * b;
  contact.direction_in = w.side * normal.cross(a);
  contact.direction_out = w.side * normal.cross(b);
  contact.pull_in = contact.direction_in;
  contact.pull_out = contact.direction_out;
  contact.length_in = w.b1;
  contact.length_on = r * w.alpha;
  contact.length_out = w.b2;
  contact.turning = w.alpha;
  contact.wrap_angle = w.alpha;
  contact.half_turns = static_cast<int>(w.alpha / M_PI);
}

void Sphere::trace(const WrapContact& contact, std::vector<Vec3>& points) const {
  const Vec3 radial = (contact.entry - center_).normalized();
  // Both are the sphere's, but for a point inside.
  const double first = (contact.entry - center_).norm(), last = (contact.exit - center_).norm();
  const Vec3 along = across(contact.direction_in, radial);
  const int pieces = 1 + static_cast<int>(contact.wrap_angle / 0.1);
  for (int i = 0; i <= pieces; ++i) {
    const double angle = contact.wrap_angle * i / pieces;
    points.push_back(center_ + (first + (last - first) * i / pieces) *
                                   (std::cos(angle) * radial + std::sin(angle) * along));
  }
}

std::shared_ptr<const WrappingSurface> Sphere::load(const ConfigNode& node, const Pose& X_BL) {
  return std::make_shared<Sphere>(X_BL * node.at("center").as_vector3("m"), read_circle_wrap(node));
}

}  // namespace anthrob
