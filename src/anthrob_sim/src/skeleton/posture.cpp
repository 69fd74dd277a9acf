#include <cmath>

#include "anthrob_sim/skeleton/skeleton_model.h"

namespace anthrob {

namespace {

Quat ball(const std::vector<double>& q, const JointModel& joint) {
  const double* p = &q[joint.position_offset];
  return Quat(p[0], p[1], p[2], p[3]);
}

void set_ball(const Quat& turn, const JointModel& joint, std::vector<double>& q) {
  const Quat unit = canonical(turn.normalized());
  double* p = &q[joint.position_offset];
  p[0] = unit.w(), p[1] = unit.x(), p[2] = unit.y(), p[3] = unit.z();
}

}  // namespace

Vec3 rotation_vector(const Quat& turn) {
  const Quat unit = canonical(turn);
  const double sine = unit.vec().norm();
  // Near identity the angle is twice the sine; the quotient would be 0/0.
  if (sine < 1e-12) return 2.0 * unit.vec();
  return unit.vec() * (2.0 * std::atan2(sine, unit.w()) / sine);
}

Quat quaternion_of(const Vec3& v) {
  const double angle = v.norm();
  if (angle < 1e-12) return Quat(1.0, 0.5 * v.x(), 0.5 * v.y(), 0.5 * v.z()).normalized();
  return Quat(Eigen::AngleAxisd(angle, v / angle));
}

void posture_difference(const SkeletonModel& skeleton, const std::vector<double>& from,
                        const std::vector<double>& to, Eigen::VectorXd& difference) {
  for (const JointModel& joint : skeleton.joints) {
    if (joint.type == JointType::kBall) {
      difference.segment<3>(joint.velocity_offset) =
          rotation_vector(ball(from, joint).conjugate() * ball(to, joint));
    } else {
      difference[joint.velocity_offset] = to[joint.position_offset] - from[joint.position_offset];
    }
  }
}

void posture_plus(const SkeletonModel& skeleton, const std::vector<double>& from,
                  const Eigen::VectorXd& difference, std::vector<double>& to) {
  for (const JointModel& joint : skeleton.joints) {
    if (joint.type == JointType::kBall) {
      const Vec3 turn = difference.segment<3>(joint.velocity_offset);
      set_ball(ball(from, joint) * quaternion_of(turn), joint, to);
    } else {
      to[joint.position_offset] = from[joint.position_offset] + difference[joint.velocity_offset];
    }
  }
}

void posture_between(const SkeletonModel& skeleton, const std::vector<double>& a,
                     const std::vector<double>& b, double share, std::vector<double>& result) {
  for (const JointModel& joint : skeleton.joints) {
    const int i = joint.position_offset;
    if (joint.type == JointType::kBall) {
      set_ball(ball(a, joint).slerp(share, ball(b, joint)), joint, result);
    } else {
      result[i] = a[i] + share * (b[i] - a[i]);
    }
  }
}

double joint_distance(const JointModel& joint, const std::vector<double>& a,
                      const std::vector<double>& b) {
  if (joint.type == JointType::kBall) return angular_distance(ball(a, joint), ball(b, joint));
  return std::abs(b[joint.position_offset] - a[joint.position_offset]);
}

double posture_distance(const SkeletonModel& skeleton, const std::vector<double>& a,
                        const std::vector<double>& b) {
  double most = 0.0;
  for (const JointModel& joint : skeleton.joints) {
    const double scale = joint.type == JointType::kPrismatic ? 10.0 : 1.0;
    most = std::max(most, scale * joint_distance(joint, a, b));
  }
  return most;
}

}  // namespace anthrob
