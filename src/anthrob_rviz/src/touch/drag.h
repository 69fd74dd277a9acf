#pragma once

#include "anthrob_core/pose.h"

namespace anthrob {

/// A link held by the mouse. Time is an argument, [s] of a clock that never jumps.
class Drag {
 public:
  /// [s] without a word from the window, which speaks in every picture it draws while the button is
  /// down: it was closed, hangs, or lost the mouse to another window.
  static constexpr double kSilence = 0.5;

  /// @param point_L where the link was grabbed   @param mouse_W that point now
  Drag(const Vec3& point_L, const Vec3& mouse_W, double now)
      : point_L_(point_L), mouse_W_(mouse_W), heard_(now) {}

  /// The button is still down.
  void hear(double now) { heard_ = now; }
  void move(const Vec3& mouse_W, double now) {
    mouse_W_ = mouse_W;
    hear(now);
  }

  const Vec3& point_L() const { return point_L_; }
  const Vec3& mouse_W() const { return mouse_W_; }
  /// Nobody holds it any more, although nobody said so.
  bool abandoned(double now) const { return now - heard_ > kSilence; }

 private:
  Vec3 point_L_, mouse_W_;
  double heard_;
};

}  // namespace anthrob
