#include "anthrob_sim/path/circle_wrap.h"

#include <algorithm>
#include <cmath>

namespace anthrob {

namespace {

constexpr double kPi = 3.141592653589793;
constexpr double kTwoPi = 6.283185307179586;
/// Deeper than half the radius the model is wrong anyway; forces must stay bounded.
constexpr double kMaxGain = 2.0;

/// Angle at the centre between a point and its tangent point. Points inside count as on the circle.
double tangent_angle(double radius, double distance) {
  return std::acos(std::min(1.0, radius / distance));
}

}  // namespace

CircleWrap::CircleWrap(double radius, WrapStart start, int half_turns)
    : radius_(radius), start_(start), half_turns_(half_turns) {}

void CircleWrap::initialise(double angle, double l1, double l2, State& state) const {
  const double reach = tangent_angle(radius_, l1) + tangent_angle(radius_, l2);
  const double shorter = angle < 0 ? -1.0 : 1.0;
  state = {angle, 0.0};
  if (start_ == WrapStart::kNegative) {
    // The long way round: against the sense in which the points follow each other.
    state = {angle - shorter * kTwoPi, -shorter};
  } else if (std::abs(angle) > reach) {
    state.side = shorter;
  }
  if (start_ == WrapStart::kNotWrapping || state.side == 0.0) return;
  // (4.26): alpha lies between Lambda and Lambda + 1 half turns.
  const double alpha = state.side * state.theta - reach;
  const double turns = std::ceil((half_turns_ * kPi - alpha) / kTwoPi);
  state.theta += state.side * kTwoPi * std::max(0.0, turns);
}

CircleWrap::Result CircleWrap::update(double angle, double l1, double l2, State& state) const {
  Result result;
  const double c1 = std::min(1.0, radius_ / l1), c2 = std::min(1.0, radius_ / l2);
  const double reach = std::acos(c1) + std::acos(c2);
  if (state.side == 0.0) {
    state.theta = angle;
    if (std::abs(angle) > reach) state.side = angle < 0 ? -1.0 : 1.0;
  } else {
    state.theta = angle + kTwoPi * std::round((state.theta - angle) / kTwoPi);
  }
  const double alpha = state.side * state.theta - reach;
  if (state.side == 0.0 || alpha <= 0.0) {
    state = {angle, 0.0};
    return result;
  }
  result.touching = true;
  result.side = state.side;
  result.alpha = alpha;
  result.cos1 = c1;
  result.sin1 = std::sqrt((1.0 - c1) * (1.0 + c1));
  result.cos2 = c2;
  result.sin2 = std::sqrt((1.0 - c2) * (1.0 + c2));
  result.b1 = l1 > radius_ ? l1 * result.sin1 : 0.0;
  result.b2 = l2 > radius_ ? l2 * result.sin2 : 0.0;
  result.penetration = std::max({0.0, radius_ - l1, radius_ - l2});
  result.gain1 = std::clamp(radius_ / l1, 1.0, kMaxGain);
  result.gain2 = std::clamp(radius_ / l2, 1.0, kMaxGain);
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
