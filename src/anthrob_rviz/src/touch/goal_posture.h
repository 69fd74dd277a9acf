#pragma once

#include <map>

#include "touch/skeleton.h"

namespace anthrob {

/// A position that was asked of a joint, cut off at its stops.
struct AskedPosition {
  JointPosition position;
  bool at_stop = false;
};

/// The position in which a joint has its child in this pose, as far as the joint can.
/// @param X_PC of the child in the parent
/// @param near of a hinge, which may turn more than once: the answer is within half a turn of it
AskedPosition position_for(const LinkJoint& joint, const Pose& X_PC, const JointPosition& near);

/// A posture that is put together joint by joint. Joints that nobody asked for are where they are
/// measured.
class GoalPosture {
 public:
  /// @param skeleton must outlive it
  explicit GoalPosture(const Skeleton& skeleton) : skeleton_(skeleton) {}

  /// Turns, or shifts, the joint on which a link hangs.
  /// @param X_WC wanted pose of the link in the root
  void ask(std::size_t link, const Pose& X_WC, const Posture& measured);
  void forget() { asked_.clear(); }

  bool empty() const { return asked_.empty(); }
  /// By the link that hangs on the joint.
  const std::map<std::size_t, AskedPosition>& asked() const { return asked_; }
  Posture posture(const Posture& measured) const;
  /// The longest way of a joint to the goal [rad, m].
  double way(const Posture& measured) const;

 private:
  const Skeleton& skeleton_;
  std::map<std::size_t, AskedPosition> asked_;
};

}  // namespace anthrob
