#pragma once

#include <btBulletDynamicsCommon.h>

namespace anthrob {

/// Body B slides along an axis of body A. Bullet's own sliders leave out the lever that grows as B
/// slides away (their constraint forces have a net torque), so this one states its rows exactly:
///
///   n_i . (b - a) = 0,  i = 1, 2
///   rotation vector of B relative to A = 0
///
/// The n_i are orthogonal to the axis and fixed in A; a and b are the origins of the joint frames.
class PrismaticConstraint final : public btTypedConstraint {
 public:
  BT_DECLARE_ALIGNED_ALLOCATOR();

  /// @param frame_a,frame_b the joint frame in each body; x is the axis
  PrismaticConstraint(btRigidBody& a, btRigidBody& b, const btTransform& frame_a,
                      const btTransform& frame_b)
      : btTypedConstraint(SLIDER_CONSTRAINT_TYPE, a, b), frame_a_(frame_a), frame_b_(frame_b) {}

  void getInfo1(btConstraintInfo1* info) override;
  void getInfo2(btConstraintInfo2* info) override;

  // Bullet's generic parameters; this constraint has none.
  void setParam(int, btScalar, int) override {}
  btScalar getParam(int, int) const override { return 0.0; }

 private:
  btTransform frame_a_, frame_b_;
};

}  // namespace anthrob
