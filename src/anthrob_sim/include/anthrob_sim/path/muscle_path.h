#pragma once

#include <memory>
#include <string>
#include <vector>

#include "anthrob_sim/friction/friction_law.h"
#include "anthrob_sim/path/wrapping_surface.h"
#include "anthrob_sim/skeleton/kinematic_tree.h"

namespace anthrob {

/// One entry of a muscle's path (4.78): a point through which the tendon runs, or a surface over
/// which it may run. The first and the last entry are points: origin and insertion.
struct PathObstacle {
  int body = 0;
  Vec3 point_B = Vec3::Zero();   ///< in the body's principal frame [m]; of a point
  Mat3 R_BL = Mat3::Identity();  ///< the axes of the link that the model file names
  std::shared_ptr<const WrappingSurface> surface;  ///< null: a point
  std::shared_ptr<const FrictionLaw> friction;     ///< null: frictionless
  int entry = -1;  ///< number in the model file's path; -1: put there by an effect
};

/// A straight piece between two neighbouring obstacles.
struct PathSegment {
  Vec3 from_W, to_W;    ///< [m]
  Vec3 direction_W;     ///< unit, towards the insertion
  Vec3 pull_W;          ///< force on the nearer end per unit of tension: see WrapContact::pull_in
  double length = 0.0;  ///< [m]
};

/// What one obstacle does to the tendon in the current posture.
struct ObstacleState {
  bool touching = true;     ///< always true for a point
  double length_on = 0.0;   ///< along a surface [m]
  double turning = 0.0;     ///< deflection of the tendon [rad], alpha of (4.76)
  double wrap_angle = 0.0;  ///< about the surface's axis [rad]
  int half_turns = 0;
  double penetration = 0.0;  ///< [m]
};

/// The ordered obstacles of a muscle (4.17), (4.23), (4.28): immutable, shared by simulations.
class PathModel {
 public:
  /// @param skeleton must outlive the path
  PathModel(const SkeletonModel& skeleton, std::vector<PathObstacle> obstacles);
  /// Of a drive: from one link of a hinge or prismatic joint to the other, at the joint. Its length
  /// is minus the joint's position [rad, m], so that its moment arm is 1 and its tension the torque
  /// on the joint [Nm, N].
  PathModel(const SkeletonModel& skeleton, int joint);

  const std::vector<PathObstacle>& obstacles() const { return obstacles_; }
  std::size_t segment_count() const { return obstacles_.size() - 1; }
  std::size_t state_size() const { return state_size_; }
  std::size_t state_offset(std::size_t obstacle) const { return state_offsets_[obstacle]; }

  /// Joints that change the length of a segment.
  const std::vector<JointOnPath>& joints_of_segment(std::size_t i) const { return joints_[i]; }
  /// Both ends are points of the world: nothing about the segment ever changes.
  bool is_static(std::size_t i) const { return static_[i]; }
  /// The joint of a drive; -1: a tendon.
  int joint() const { return joint_; }
  /// The joints that a drive sees; null: a tendon.
  const KinematicTree* tree() const { return tree_.get(); }

 private:
  void prepare_surface(std::size_t i);

  std::vector<PathObstacle> obstacles_;
  std::vector<std::size_t> state_offsets_;
  std::size_t state_size_ = 0;
  std::vector<std::vector<JointOnPath>> joints_;
  std::vector<char> static_;
  int joint_ = -1;
  std::shared_ptr<const KinematicTree> tree_;
};

/// A point of a path that moves with a body.
struct CarriedPoint {
  int body;
  Vec3 point_B;  ///< in the body's principal frame [m]
};

/// A muscle's path in one posture: lines 1-10 of Algorithm 4.1. Scratch memory; what must survive a
/// step is in the state.
class MusclePath {
 public:
  explicit MusclePath(const PathModel& model);

  /// Evaluates wrapping states from a first posture, then updates.
  void initialise(const std::vector<BodyState>& bodies, StateView state);
  void update(const std::vector<BodyState>& bodies, StateView state);

  /// l_M [m]
  double length() const { return length_; }
  const std::vector<PathSegment>& segments() const { return segments_; }
  const std::vector<ObstacleState>& obstacles() const { return obstacles_; }
  const PathModel& model() const { return model_; }
  /// The path for drawing: points and, on surfaces, points along the way.
  std::vector<CarriedPoint> carried_points() const;
  /// The same in the world [m].
  std::vector<Vec3> polyline(const std::vector<BodyState>& bodies) const;

  /// Adds `scale` times the moment arms of one segment (-dl/dq, joints beyond world axes) to
  /// `target`.
  void add_moment_arms(std::size_t segment, double scale, const KinematicTree& tree,
                       double* target) const;

 private:
  void update_point_segment(const std::vector<BodyState>& bodies, std::size_t i);
  void update_drive(const std::vector<BodyState>& bodies, StateView state);
  void update_surface(const std::vector<BodyState>& bodies, StateView state, std::size_t i);
  bool has_no_length(std::size_t segment) const;
  void direct_short_segments();

  const PathModel& model_;
  std::vector<PathSegment> segments_;
  std::vector<ObstacleState> obstacles_;
  std::vector<WrapContact> contacts_;  ///< of surfaces, in their bodies' frames
  double length_ = 0.0;
};

}  // namespace anthrob
