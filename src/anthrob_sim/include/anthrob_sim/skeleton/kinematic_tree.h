#pragma once

#include <vector>

#include "anthrob_sim/skeleton/skeleton_model.h"

namespace anthrob {

/// Motion of one rigid body; B is the principal frame at its centre of mass.
struct BodyState {
  Pose X_WB;
  Vec3 v_W = Vec3::Zero();  ///< velocity of the centre of mass [m/s]
  Vec3 w_W = Vec3::Zero();  ///< angular velocity [rad/s]
};

/// The skeleton seen through its joints: positions q, generalised velocities u, mass matrix M(q)
/// and bias forces, computed from the motion of the bodies. Bullet moves the bodies (3.1)-(3.5);
/// this view is for what lives on joints and muscles: friction, stops, moment arms, sensors.
///
/// u of a hinge or prismatic joint is its speed; of a ball joint the angular velocity of the child
/// relative to the parent, in world axes.
class KinematicTree {
 public:
  struct JointView {
    Vec3 center_W;  ///< [m]
    Vec3 axis_W;    ///< not for a ball joint
    Mat3 R_WC;      ///< axes of the child link; only of a ball joint
  };

  explicit KinematicTree(const SkeletonModel& model);

  /// Bodies for given joint positions and generalised velocities (may be empty: at rest).
  /// @param q size position_count; quaternions w, x, y, z are normalised
  void place(const std::vector<double>& q, const std::vector<double>& u,
             std::vector<BodyState>& bodies) const;

  /// Reads joint positions and velocities off the bodies. Hinge angles are continuous: `q` holds
  /// the last ones on entry.
  void update(const std::vector<BodyState>& bodies, std::vector<double>& q);

  /// Position of a hinge or prismatic joint, read off the bodies [rad, m].
  /// @param last position, for whole turns of a hinge
  double position(int joint, const std::vector<BodyState>& bodies, double last) const;

  /// Mass matrix and bias of the posture of the last update. M du/dt + bias = generalised forces.
  void update_dynamics(const std::vector<BodyState>& bodies, const Vec3& gravity);

  const JointView& joint(int i) const { return views_[i]; }
  const std::vector<double>& velocities() const { return u_; }
  const Eigen::MatrixXd& mass_matrix() const { return mass_; }
  const Eigen::VectorXd& bias() const { return bias_; }

  /// Velocity of a ball joint in the child's link axes [rad/s].
  Vec3 ball_velocity(int joint) const;

  const SkeletonModel& model() const { return model_; }

 private:
  /// A joint in the principal frames P of its parent and C of its child.
  struct JointGeometry {
    Vec3 center_P, center_C;
    Vec3 axis_P;
    Vec3 mark_P, mark_C;  ///< a direction across the axis, fixed in each body, equal at rest
    Mat3 R_PC_rest;
    Mat3 R_P_rest;  ///< axes of the child link at rest, in the parent's principal frame
    Mat3 R_CL;      ///< axes of the child link in its principal frame
  };
  struct CompositeInertia {
    double mass;
    Vec3 moment;   ///< mass times centre of mass, world [kg m]
    Mat3 inertia;  ///< about the world origin [kg m^2]
  };
  /// Motion that one unit of a generalised velocity causes beyond its joint: angular velocity, and
  /// the velocity of the point at the world origin.
  struct UnitMotion {
    Vec3 w, v;
  };
  static UnitMotion unit_motion(const JointModel& joint, const JointView& view, int k);

  const SkeletonModel& model_;
  std::vector<JointGeometry> geometry_;
  std::vector<JointView> views_;
  std::vector<double> u_;
  Eigen::MatrixXd mass_;
  Eigen::VectorXd bias_;
  std::vector<UnitMotion> unit_motions_;  ///< by generalised velocity
  std::vector<CompositeInertia> composite_;
  std::vector<Vec3> alpha_, accel_;   ///< bias accelerations of bodies
  std::vector<Vec3> force_, torque_;  ///< on subtrees, about the world origin
};

}  // namespace anthrob
