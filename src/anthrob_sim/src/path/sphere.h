#pragma once

#include "anthrob_sim/path/wrapping_surface.h"
#include "path/circle_wrap.h"

namespace anthrob {

/// Sphere (4.23)-(4.27): a circle wrap in the plane through both points and the centre. The plane's
/// normal follows the posture without flipping, so the tendon stays on its side beyond half a turn.
class Sphere final : public WrappingSurface {
 public:
  Sphere(const Vec3& center_B, const CircleWrap& circle) : center_(center_B), circle_(circle) {}

  std::string type() const override { return "sphere"; }
  std::size_t state_size() const override { return state_size_of<State>(); }
  void initialise(const Vec3& before, const Vec3& after, StateView state) const override;
  void wrap(const Vec3& before, const Vec3& after, StateView state,
            WrapContact& contact) const override;

  void trace(const WrapContact& contact, std::vector<Vec3>& points) const override;

  const Vec3& center() const { return center_; }
  double radius() const { return circle_.radius(); }

  /// `{center: [m], radius: [m], start:, half_turns:}`
  static std::shared_ptr<const WrappingSurface> load(const ConfigNode& node, const Pose& X_BL);

 private:
  struct State {
    CircleWrap::State circle;
    double normal[3];  ///< last normal of the plane, unit, body frame
  };
  struct Arm;  ///< a point as seen from the centre

  void follow(const CircleWrap::Result& wrap, const Vec3& normal, const Arm& j1, const Arm& j2,
              WrapContact& contact) const;

  Vec3 center_;
  CircleWrap circle_;
};

}  // namespace anthrob
