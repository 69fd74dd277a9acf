#pragma once

#include "anthrob_sim/path/wrapping_surface.h"
#include "path/circle_wrap.h"

namespace anthrob {

/// Infinitely long cylinder (4.28)-(4.33): a circle wrap in the plane across the axis; the path is
/// straight once the cylinder is unrolled, so its slope along the axis is the same everywhere.
class Cylinder final : public WrappingSurface {
 public:
  /// @param X_BC cylinder in its body's frame; y is the axis
  Cylinder(const Pose& X_BC, const CircleWrap& circle) : X_BC_(X_BC), circle_(circle) {}

  std::string type() const override { return "cylinder"; }
  std::size_t state_size() const override { return state_size_of<CircleWrap::State>(); }
  void initialise(const Vec3& before, const Vec3& after, StateView state) const override;
  void wrap(const Vec3& before, const Vec3& after, StateView state,
            WrapContact& contact) const override;

  void trace(const WrapContact& contact, std::vector<Vec3>& points) const override;

  const Pose& pose() const { return X_BC_; }
  double radius() const { return circle_.radius(); }

  /// `{origin: [m], axis: [1], radius: [m], start:, half_turns:}`
  static std::shared_ptr<const WrappingSurface> load(const ConfigNode& node, const Pose& X_BL);

 private:
  struct Polar;  ///< a point as seen along the axis

  void follow(const CircleWrap::Result& wrap, const Polar& p1, const Polar& p2,
              WrapContact& contact) const;

  Pose X_BC_;
  CircleWrap circle_;
};

}  // namespace anthrob
