#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "anthrob_core/pose.h"

namespace anthrob {

enum class JointType { kBall, kHinge, kPrismatic };

/// Friction of a hinge or prismatic joint that bends before it slides: see friction/bristle.h.
struct BristleModel {
  double torque = 0.0;              ///< while sliding fast [Nm] or [N], >= 0
  double distance = 0.01;           ///< in which 63 % of it are back [rad] or [m], > 0
  double static_ratio = 1.0;        ///< friction at rest over that, >= 1
  double stribeck_velocity = 0.05;  ///< [rad/s] or [m/s], > 0
  double damping = 0.0;             ///< of the bristles over their stiffness [s], >= 0
};

/// Stribeck curve (3.6); torques for rotating joints, forces for prismatic ones.
struct JointFrictionModel {
  double static_torque = 0.0;       ///< [Nm] or [N]
  double kinetic_torque = 0.0;      ///< [Nm] or [N]
  double viscous = 0.0;             ///< [Nms/rad] or [Ns/m]
  double quadratic = 0.0;           ///< drag per square of speed [Nms^2/rad^2] or [Ns^2/m^2]
  double stribeck_velocity = 0.05;  ///< [rad/s] or [m/s]
  double forward = 0.0;   ///< more dry friction while moving forward [Nm] or [N]; not for balls
  double backward = 0.0;  ///< the same while moving backward
  /// Dry friction per force that the joint carries [m]; of a prismatic joint per force across its
  /// axis [1].
  double load_radius = 0.0;
  double effort_share = 0.0;           ///< dry friction per effort of a driven joint [1]
  std::vector<BristleModel> bristles;  ///< that add up; not for balls

  bool is_dry() const {
    return static_torque > 0.0 || kinetic_torque > 0.0 || forward > 0.0 || backward > 0.0 ||
           load_radius > 0.0 || effort_share > 0.0;
  }
};

/// A soft stop: one-sided spring and damper beyond the limit.
struct JointStopModel {
  bool enabled = false;
  double lower = 0.0;      ///< [rad] or [m]; unused for a ball joint
  double upper = 0.0;      ///< [rad] or [m]; for a ball joint the largest rotation from rest
  double stiffness = 0.0;  ///< [Nm/rad] or [N/m]
  double damping = 0.0;    ///< [Nms/rad] or [Ns/m]
};

struct JointModel {
  std::string name;
  JointType type = JointType::kHinge;
  std::string parent_link, child_link;  ///< as in the URDF
  int parent = 0;                       ///< index of a body
  int child = 0;                        ///< index of a body
  Pose X_PC_rest;                       ///< child link frame in parent link frame at rest
  Vec3 center_C = Vec3::Zero();         ///< rotation centre in the child link frame [m]
  Vec3 axis_C = Vec3::UnitZ();  ///< unit axis in the child link frame (not for a ball joint)
  JointFrictionModel friction;
  JointStopModel stop;
  bool driven = false;       ///< takes an applied effort from outside
  double effort_gain = 1.0;  ///< effort that acts, over the applied one

  int position_offset = 0;  ///< in a configuration: 1 number, or w, x, y, z of a ball joint
  int velocity_offset = 0;  ///< in generalised velocities: 1 number, or 3 of a ball joint
  int dof() const { return type == JointType::kBall ? 3 : 1; }
  int position_size() const { return type == JointType::kBall ? 4 : 1; }
};

enum class ShapeType { kBox, kSphere, kCylinder };

/// Optional collision shape, as URDF's <collision>.
struct CollisionModel {
  ShapeType type = ShapeType::kBox;
  Pose X_LS;                 ///< shape in link frame
  Vec3 size = Vec3::Zero();  ///< box: edge lengths; sphere: radius; cylinder: radius, length [m]
};

/// One rigid body: a URDF link with everything that is fixed to it. Body 0 is the world.
struct BodyModel {
  std::string name;
  double mass = 0.0;              ///< [kg]; 0 for the world
  Vec3 com_L = Vec3::Zero();      ///< centre of mass in the link frame [m]
  Mat3 inertia_L = Mat3::Zero();  ///< about the centre of mass, link axes [kg m^2]
  Pose X_LB;                      ///< principal frame: origin at the centre of mass, axes principal
  Vec3 principal = Vec3::Zero();  ///< principal moments of inertia [kg m^2]
  std::vector<CollisionModel> collisions;

  /// Sets the principal frame and moments that belong to centre of mass and inertia.
  /// @return whether the moments are physically possible: all > 0, none larger than the sum of the
  /// other two
  bool find_principal_axes();
};

/// A named link; several may belong to one body.
struct FrameModel {
  std::string name;
  int body = 0;
  Pose X_LF;  ///< in the link frame of the body
};

/// A tree of rigid bodies. Joint i moves body i + 1; parents come before children.
struct SkeletonModel {
  std::vector<BodyModel> bodies;
  std::vector<JointModel> joints;
  std::vector<FrameModel> frames;
  int position_count = 0;
  int velocity_count = 0;

  /// Index in `frames`, or -1.
  int find_frame(const std::string& name) const;
  /// Index in `joints`, or -1.
  int find_joint(const std::string& name) const;
  /// All joints at rest.
  std::vector<double> rest_configuration() const;
};

/// Reads the bodies of a URDF. Floating joints become ball joints; their centres, all frictions and
/// stops come from the model file.
/// @param collisions whether <collision> shapes are wanted; if not, they are ignored
/// @throws BadInput naming file, link or joint, and what was expected
SkeletonModel load_urdf(const std::string& file, bool collisions = false);

/// The joints that connect two bodies, with the sign with which a force on `to` (and its reaction
/// on `from`) acts on each: +1 if `to` lies beyond the joint, -1 if `from` does.
struct JointOnPath {
  int joint;
  double sign;
};
std::vector<JointOnPath> joints_between(const SkeletonModel& model, int from, int to);

/// A joint axis that is moved through a range while all other joints and the actuators stand still.
/// For a hinge or prismatic joint the values are its positions; a ball joint is rotated by them
/// from its orientation, about one of the child's axes.
struct SweepAxis {
  int joint = 0;
  int component = 0;  ///< 0, 1, 2: x, y, z of a ball joint
  std::string name;   ///< "elbow", "shoulder_x"
};

/// Axes that a robot's joints have, in the order of its generalised velocities.
std::vector<SweepAxis> sweep_axes(const SkeletonModel& skeleton);

// Postures are joint positions as in a configuration: one number, or w, x, y, z of a ball joint.

/// The velocity that leads from `from` to `to` within one second: differences of scalar joints,
/// rotation vectors of ball joints in the axes of the child at `from` [rad, m].
void posture_difference(const SkeletonModel& skeleton, const std::vector<double>& from,
                        const std::vector<double>& to, Eigen::VectorXd& difference);

/// Moves every joint by its part of `difference`, the inverse of posture_difference.
void posture_plus(const SkeletonModel& skeleton, const std::vector<double>& from,
                  const Eigen::VectorXd& difference, std::vector<double>& to);

/// A posture on the shortest way from a (share 0) to b (share 1), all joints together.
void posture_between(const SkeletonModel& skeleton, const std::vector<double>& a,
                     const std::vector<double>& b, double share, std::vector<double>& result);

/// The largest motion of any joint; angular distance for ball joints [rad], a metre of a prismatic
/// joint counts ten.
double posture_distance(const SkeletonModel& skeleton, const std::vector<double>& a,
                        const std::vector<double>& b);

/// Angular distance of one ball joint, or difference of a scalar joint, >= 0.
double joint_distance(const JointModel& joint, const std::vector<double>& a,
                      const std::vector<double>& b);

/// The rotation vector of a unit quaternion, angle in [0, pi] [rad].
Vec3 rotation_vector(const Quat& turn);
Quat quaternion_of(const Vec3& rotation_vector);

}  // namespace anthrob
