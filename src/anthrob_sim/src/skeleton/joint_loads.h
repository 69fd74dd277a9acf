#pragma once

#include "skeleton/skeleton.h"

namespace anthrob {

/// The forces that joints carried during the last step, for friction that grows with them and for
/// who asks. The change of momentum of the bodies beyond a joint, less the impulses of gravity and
/// of applied forces, is the impulse that the joint transmitted.
class JointLoads {
 public:
  /// Of the joints whose friction depends on their load, or of all.
  enum class Of { kLoadFriction, kAll };
  JointLoads(const SkeletonModel& model, const Vec3& gravity, double step,
             Of joints = Of::kLoadFriction);

  bool wanted() const { return !joints_.empty(); }
  /// The force that the parent put on the child [N], world; in the order of the joints wanted.
  const std::vector<Vec3>& carried() const { return carried_; }

  /// Robot at rest: the weight beyond each joint.
  void reset(double* loads) const;
  /// To be called right before and right after Skeleton::step.
  void before(const Skeleton& skeleton);
  void after(const Skeleton& skeleton);
  /// @param loads by joint [N], of prismatic joints across their axes; those of joints that are not
  /// wanted stay unchanged
  void write(const Skeleton& skeleton, double* loads) const;

 private:
  const SkeletonModel& model_;
  Vec3 gravity_;
  double step_;
  std::vector<int> joints_;
  std::vector<std::vector<int>> beyond_;  ///< bodies beyond each of `joints_`
  std::vector<Vec3> carried_;             ///< [N]
};

}  // namespace anthrob
