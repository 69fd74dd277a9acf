#include "path/circle_wrap.h"

#include <algorithm>
#include <cmath>

namespace anthrob {

namespace {

constexpr double kTwoPi = 2.0 * M_PI;

/// A tendon with an end inside is not wound on: where both ways round are equally long, at odd half
/// turns, it takes the other one.
void wind_no_further(double last, CircleWrap::State& state) {
  const double most = M_PI + kTwoPi * std::ceil(std::max(0.0, last - M_PI) / kTwoPi);
  if (std::abs(state.theta) <= most) return;
  state.theta -= std::copysign(2.0 * most, state.theta);
  state.side = -state.side;
}

}  // namespace

CircleWrap::CircleWrap(double radius, WrapStart start, int half_turns)
    : radius_(radius), start_(start), half_turns_(half_turns) {}

CircleWrap::Lift CircleWrap::lift(double distance) const {
  if (distance >= radius_) return {distance, 1.0, 1.0};
  const double share = distance / radius_;
  return {distance * (2.0 - share), 2.0 - share, 2.0 * (1.0 - share)};
}

void CircleWrap::initialise(double angle, double l1, double l2, State& state) const {
  const double d1 = lift(l1).distance, d2 = lift(l2).distance;
  const double radius = std::min({radius_, d1, d2});
  const double reach = std::acos(radius / d1) + std::acos(radius / d2);
  const double shorter = angle < 0 ? -1.0 : 1.0;
  state = {angle, 0.0};
  if (start_ == WrapStart::kNegative) {
    // The long way round: against the sense in which the points follow each other.
    state = {angle - shorter * kTwoPi, -shorter};
  } else if (std::abs(angle) > reach) {
    state.side = shorter;
  }
  if (start_ == WrapStart::kNotWrapping || state.side == 0.0) return;
  // (4.26) plus the fewest whole turns that bring alpha to Lambda half turns or beyond.
  const double alpha = state.side * state.theta - reach;
  const double turns = std::ceil((half_turns_ * M_PI - alpha) / kTwoPi);
  state.theta += state.side * kTwoPi * std::max(0.0, turns);
}

CircleWrap::Result CircleWrap::update(double angle, double l1, double l2, State& state) const {
  Result result;
  result.lift1 = lift(l1), result.lift2 = lift(l2);
  result.penetration = std::max({0.0, radius_ - l1, radius_ - l2});
  const double d1 = result.lift1.distance, d2 = result.lift2.distance;
  const double radius = std::min({radius_, d1, d2});
  const double c1 = radius / d1, c2 = radius / d2;
  const double reach = std::acos(c1) + std::acos(c2);
  if (state.side == 0.0) {
    state.theta = angle;
    if (std::abs(angle) > reach) state.side = angle < 0 ? -1.0 : 1.0;
  } else {
    const double last = std::abs(state.theta);
    state.theta = angle + kTwoPi * std::round((state.theta - angle) / kTwoPi);
    if (result.penetration > 0.0) wind_no_further(last, state);
  }
  const double alpha = state.side * state.theta - reach;
  if (state.side == 0.0 || alpha <= 0.0) {
    state = {angle, 0.0};
    return result;
  }
  result.touching = true;
  result.side = state.side;
  result.radius = radius;
  result.alpha = alpha;
  result.cos1 = c1;
  result.sin1 = std::sqrt((1.0 - c1) * (1.0 + c1));
  result.cos2 = c2;
  result.sin2 = std::sqrt((1.0 - c2) * (1.0 + c2));
  result.b1 = d1 * result.sin1;
  result.b2 = d2 * result.sin2;
  // The circle follows the nearer point; where it lies deeper, the way round is shorter.
  if (radius < radius_) (d1 <= d2 ? result.follows1 : result.follows2) = true;
  return result;
}

bool CircleWrap::segment_is_clear(double x1, double y1, double x2, double y2) const {
  const double dx = x2 - x1, dy = y2 - y1;
  const double length2 = dx * dx + dy * dy;
  // Nearest point of the segment to the centre.
  const double s = length2 > 0 ? std::clamp(-(x1 * dx + y1 * dy) / length2, 0.0, 1.0) : 0.0;
  const double x = x1 + s * dx, y = y1 + s * dy;
  return x * x + y * y > radius_ * radius_;
}

void pull_inside(const CircleWrap::Result& wrap, const Vec3& ray1, const Vec3& ray2,
                 const Vec3& axis, const Vec3& before, const Vec3& after, WrapContact& contact) {
  const auto unlifted = [&axis](const CircleWrap::Lift& lift, const Vec3& ray,
                                const Vec3& gradient) -> Vec3 {
    return lift.around * gradient + (lift.outward - lift.around) * ray.dot(gradient) * ray +
           (1.0 - lift.around) * axis.dot(gradient) * axis;
  };
  const Vec3 shrink1 = wrap.follows1 ? Vec3(contact.turning * ray1) : Vec3(Vec3::Zero());
  const Vec3 shrink2 = wrap.follows2 ? Vec3(contact.turning * ray2) : Vec3(Vec3::Zero());
  contact.pull_in = unlifted(wrap.lift1, ray1, contact.direction_in - shrink1);
  contact.pull_out = unlifted(wrap.lift2, ray2, contact.direction_out + shrink2);
  if (wrap.lift1.around > 1.0) contact.entry = before;
  if (wrap.lift2.around > 1.0) contact.exit = after;
}

CircleWrap read_circle_wrap(const ConfigNode& node) {
  const double radius = node.number("radius", Bounds::positive(), "m");
  WrapStart start = WrapStart::kNotWrapping;
  if (node.has("start")) {
    const std::string word = node.text("start");
    if (word == "positive") {
      start = WrapStart::kPositive;
    } else if (word == "negative") {
      start = WrapStart::kNegative;
    } else if (word != "not_wrapping") {
      node.at("start").fail_expected("not_wrapping, positive or negative");
    }
  }
  const int half_turns = node.has("half_turns") ? node.at("half_turns").as_integer(0, 100) : 0;
  return CircleWrap(radius, start, half_turns);
}

}  // namespace anthrob
