#include "anthrob_reference/cylinder.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace anthrob::reference {
namespace {

// Tangent from a point to the circle, in the plane across the axis.
struct Tangent {
  Eigen::Vector3d foot;   // tangent point from the axis
  double length = 0.0;    // point to tangent point in the plane
  double leverage = 1.0;  // of a lifted point: its foot moves farther around than it does itself
};

// turn = +1: the foot lies positively about the axis as seen from the point.
Tangent tangent(const PlacedCylinder& cylinder, const Eigen::Vector3d& from_origin, double turn) {
  const Eigen::Vector3d radial = from_origin - cylinder.axis * cylinder.axis.dot(from_origin);
  const double r = cylinder.radius;
  const double distance_2 = radial.squaredNorm();
  Tangent result;
  if (distance_2 <= r * r) {
    result.leverage = r / std::sqrt(distance_2);
    result.foot = result.leverage * radial;
    return result;
  }
  result.length = std::sqrt(distance_2 - r * r);
  result.foot =
      (r / distance_2) * (r * radial + turn * result.length * cylinder.axis.cross(radial));
  return result;
}

// Arc from one tangent point to the other in the sense of `side`, in (-pi, pi].
double principal_arc(const PlacedCylinder& cylinder, const Tangent& a, const Tangent& b, int side) {
  return std::atan2(side * cylinder.axis.dot(a.foot.cross(b.foot)), a.foot.dot(b.foot));
}

double unwrap(double angle, double near) {
  return angle + 2.0 * M_PI * std::round((near - angle) / (2.0 * M_PI));
}

int segment_side(const PlacedCylinder& cylinder, const Eigen::Vector3d& from_start,
                 const Eigen::Vector3d& from_end) {
  return cylinder.axis.dot(from_start.cross(from_end)) < 0.0 ? -1 : 1;
}

}  // namespace

WrapMemory next_contact(const PlacedCylinder& cylinder, const Eigen::Vector3d& start,
                        const Eigen::Vector3d& end, const WrapMemory& memory) {
  const Eigen::Vector3d from_start = start - cylinder.origin;
  const Eigen::Vector3d from_end = end - cylinder.origin;
  const int side = memory.side != 0 ? memory.side : segment_side(cylinder, from_start, from_end);
  const Tangent a = tangent(cylinder, from_start, side);
  const Tangent b = tangent(cylinder, from_end, -side);
  // The segment of a free tendon subtends less than pi at the axis, so its arc needs no unwrapping;
  // and its arc is positive exactly if it cuts the circle between the two points.
  if (memory.side == 0 && side * cylinder.axis.dot(a.foot.cross(b.foot)) <= 0.0) return {};
  const double arc = principal_arc(cylinder, a, b, side);
  const double angle = memory.side != 0 ? unwrap(arc, memory.angle) : arc;
  return angle > 0.0 ? WrapMemory{side, angle} : WrapMemory{};
}

SpanGeometry wrapped_span(const PlacedCylinder& cylinder, const Eigen::Vector3d& start,
                          const Eigen::Vector3d& end, const WrapMemory& memory) {
  const int side = memory.side;
  const Tangent a = tangent(cylinder, start - cylinder.origin, side);
  const Tangent b = tangent(cylinder, end - cylinder.origin, -side);
  SpanGeometry span;
  span.angle = unwrap(principal_arc(cylinder, a, b, side), memory.angle);
  const double plane = a.length + cylinder.radius * span.angle + b.length;
  const double axial = cylinder.axis.dot(end - start);
  span.length = std::sqrt(plane * plane + axial * axial);
  const double around = side * plane / (span.length * cylinder.radius);
  const Eigen::Vector3d along = cylinder.axis * (axial / span.length);
  span.u_start = (around * a.leverage) * cylinder.axis.cross(a.foot) + along;
  span.u_end = (around * b.leverage) * cylinder.axis.cross(b.foot) + along;
  return span;
}

SpanGeometry straight_span(const Eigen::Vector3d& start, const Eigen::Vector3d& end) {
  SpanGeometry span;
  span.u_start = end - start;
  span.length = span.u_start.norm();
  span.u_start /= span.length;
  span.u_end = span.u_start;
  return span;
}

double penetration(const PlacedCylinder& cylinder, const Eigen::Vector3d& start,
                   const Eigen::Vector3d& end) {
  const double d_start = cylinder.axis.cross(start - cylinder.origin).norm();
  const double d_end = cylinder.axis.cross(end - cylinder.origin).norm();
  return std::max(0.0, cylinder.radius - std::min(d_start, d_end));
}

}  // namespace anthrob::reference
