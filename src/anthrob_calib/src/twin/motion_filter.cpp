#include "twin/motion_filter.h"

#include <cmath>

namespace anthrob {
namespace twin {

namespace {

double blend(double from, double to, double share) {
  return from + share * (to - from);
}

Quat turn_at(const Timeline<JointSample>::Between& measured, std::size_t offset) {
  const double *a = &measured.from.q[offset], *b = &measured.to.q[offset];
  return Quat(a[0], a[1], a[2], a[3]).slerp(measured.share, Quat(b[0], b[1], b[2], b[3]));
}

void put(const Quat& turn, std::size_t offset, std::vector<double>& q) {
  q[offset] = turn.w(), q[offset + 1] = turn.x();
  q[offset + 2] = turn.y(), q[offset + 3] = turn.z();
}

}  // namespace

double position_at(const Timeline<MuscleSample>& timeline, std::size_t muscle, Nanoseconds time) {
  const auto [from, to, share] = timeline.between(time);
  return blend(from.muscles[muscle].position, to.muscles[muscle].position, share);
}

void joint_at(const Timeline<JointSample>& timeline, const JointModel& joint, Nanoseconds time,
              std::vector<double>& q) {
  const auto measured = timeline.between(time);
  const auto offset = static_cast<std::size_t>(joint.position_offset);
  if (joint.type == JointType::kBall) return put(turn_at(measured, offset), offset, q);
  q[offset] = blend(measured.from.q[offset], measured.to.q[offset], measured.share);
}

double smooth_position(const Timeline<MuscleSample>& timeline, std::size_t muscle, Nanoseconds time,
                       Nanoseconds step, double smooth, Nanoseconds average, double position) {
  const Nanoseconds middle = time + step / 2;
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < timeline.size() && timeline[i].stamp <= middle + average; ++i) {
    if (timeline[i].stamp < middle - average) continue;
    sum += timeline[i].muscles[muscle].velocity;
    count += 1.0;
  }
  const double speed = sum / count;
  if (!std::isfinite(speed) || !std::isfinite(position)) {
    return position_at(timeline, muscle, time + step);
  }
  const double away = position_at(timeline, muscle, time) - position;
  return position + seconds(step) * (speed + away / smooth);
}

void smooth_joint(const Timeline<JointSample>& timeline, const JointModel& joint, Nanoseconds time,
                  Nanoseconds step, double smooth, std::vector<double>& q) {
  const auto midway = timeline.between(time + step / 2);
  const auto first = static_cast<std::size_t>(joint.velocity_offset);
  const double *from = &midway.from.velocity[first], *to = &midway.to.velocity[first];
  Vec3 speed = Vec3::Zero();
  for (int k = 0; k < joint.dof(); ++k) {
    speed[k] = blend(from[k], to[k], midway.share);
  }
  if (!speed.allFinite()) return joint_at(timeline, joint, time + step, q);
  const auto measured = timeline.between(time);
  const auto offset = static_cast<std::size_t>(joint.position_offset);
  if (joint.type != JointType::kBall) {
    const double away =
        blend(measured.from.q[offset], measured.to.q[offset], measured.share) - q[offset];
    q[offset] += seconds(step) * (speed[0] + away / smooth);
    return;
  }
  const Quat turn(q[offset], q[offset + 1], q[offset + 2], q[offset + 3]);
  const Vec3 away = rotation_vector(turn.conjugate() * turn_at(measured, offset));
  const Vec3 motion = seconds(step) * (speed + away / smooth);
  put((turn * quaternion_of(motion)).normalized(), offset, q);
}

}  // namespace twin
}  // namespace anthrob
