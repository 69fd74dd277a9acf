#pragma once

#include <Eigen/Core>
#include <vector>

#include "anthrob_sim/skeleton/skeleton_model.h"

namespace anthrob {

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
