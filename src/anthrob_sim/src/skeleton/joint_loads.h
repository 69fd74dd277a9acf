#pragma once

#include "skeleton/skeleton.h"

namespace anthrob {

/// The forces that joints carried during the last step, for friction that grows with them. The
/// change of momentum of the bodies beyond a joint, less the impulses of gravity and of applied
/// forces, is the impulse that the joint transmitted.
class JointLoads {
 public:
  JointLoads(const SkeletonModel& model, const Vec3& gravity, double step);

  /// Whether any joint's friction depends on its load.
  bool wanted() const { return !joints_.empty(); }

  /// Robot at rest: the weight beyond each joint.
  void reset(double* loads) const;
  /// To be called right before and right after Skeleton::step.
  /// @param loads by joint [N]; those of joints without such friction stay unchanged
  void before(const Skeleton& skeleton);
  void after(const Skeleton& skeleton, double* loads);

 private:
  const SkeletonModel& model_;
  Vec3 gravity_;
  double step_;
  std::vector<int> joints_;
  std::vector<std::vector<int>> beyond_;  ///< bodies beyond each of `joints_`
  std::vector<Vec3> carried_;             ///< scratch
};

}  // namespace anthrob
