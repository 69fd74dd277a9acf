#include "sample_reader.h"

#include <algorithm>

namespace anthrob {

namespace {

Nanoseconds stamp_of(const std_msgs::Header& header) {
  return static_cast<Nanoseconds>(header.stamp.toNSec());
}

template <class Vector>
Vec3 vector_of(const Vector& message) {
  return {message.x, message.y, message.z};
}

}  // namespace

SampleReader::SampleReader(const RobotModel& model)
    : model_(model),
      no_muscles_(twin::blank_muscles(model)),
      no_joints_(twin::blank_joints(model)),
      muscles_(no_muscles_),
      joints_(no_joints_),
      balls_(no_joints_) {}

const std::vector<int>& SampleReader::muscles_of(const std::vector<std::string>& names) {
  if (names != muscle_places_.names) {
    muscle_places_ = {names, {}};
    for (const std::string& name : names) {
      muscle_places_.found.push_back(model_.find_muscle(name));
    }
  }
  return muscle_places_.found;
}

const std::vector<int>& SampleReader::joints_of(const std::vector<std::string>& names,
                                                Places& places, bool balls) const {
  if (names != places.names) {
    places = {names, {}};
    for (const std::string& name : names) {
      const int joint = model_.skeleton->find_joint(name);
      const bool fits =
          joint >= 0 && (model_.skeleton->joints[static_cast<std::size_t>(joint)].type ==
                         JointType::kBall) == balls;
      places.found.push_back(fits ? joint : -1);
    }
  }
  return places.found;
}

const twin::MuscleSample* SampleReader::read(const anthrob_msgs::MuscleStates& message) {
  const std::size_t size = message.name.size();
  for (const auto* list : {&message.position, &message.velocity, &message.current, &message.voltage,
                           &message.force, &message.reference}) {
    if (list->size() != size) return nullptr;
  }
  if (message.mode.size() != size || message.ecu_state.size() != size) return nullptr;
  muscles_ = no_muscles_;
  muscles_.stamp = stamp_of(message.header);
  const std::vector<int>& places = muscles_of(message.name);
  for (std::size_t i = 0; i < size; ++i) {
    if (places[i] < 0) continue;
    const bool known_mode = message.mode[i] < ecu::kModeCount;
    muscles_.muscles[static_cast<std::size_t>(places[i])] = {
        message.position[i],
        message.velocity[i],
        message.current[i],
        message.voltage[i],
        message.force[i],
        known_mode ? message.reference[i] : twin::kNotMeasured,
        known_mode ? static_cast<ecu::Mode>(message.mode[i]) : ecu::Mode::kVoltage,
        message.ecu_state[i] == anthrob_msgs::MuscleStates::ENABLED};
  }
  return &muscles_;
}

const twin::JointSample* SampleReader::read(const sensor_msgs::JointState& message) {
  const std::size_t size = message.name.size();
  // Velocities and efforts may be left out, as in any sensor_msgs/JointState.
  const auto given = [&](const std::vector<double>& list) { return !list.empty(); };
  if (message.position.size() != size ||
      (given(message.velocity) && message.velocity.size() != size) ||
      (given(message.effort) && message.effort.size() != size)) {
    return nullptr;
  }
  joints_ = no_joints_;
  joints_.stamp = stamp_of(message.header);
  const std::vector<int>& places = joints_of(message.name, joint_places_, false);
  for (std::size_t i = 0; i < size; ++i) {
    if (places[i] < 0) continue;
    const auto j = static_cast<std::size_t>(places[i]);
    const JointModel& joint = model_.skeleton->joints[j];
    joints_.q[static_cast<std::size_t>(joint.position_offset)] = message.position[i];
    if (given(message.velocity)) {
      joints_.velocity[static_cast<std::size_t>(joint.velocity_offset)] = message.velocity[i];
    }
    if (given(message.effort)) joints_.effort[j] = message.effort[i];
  }
  return &joints_;
}

const twin::JointSample* SampleReader::read(const anthrob_msgs::SphericalJointStates& message) {
  const std::size_t size = message.name.size();
  if (message.orientation.size() != size || message.angular_velocity.size() != size) return nullptr;
  balls_ = no_joints_;
  balls_.stamp = stamp_of(message.header);
  const std::vector<int>& places = joints_of(message.name, ball_places_, true);
  for (std::size_t i = 0; i < size; ++i) {
    if (places[i] < 0) continue;
    const JointModel& joint = model_.skeleton->joints[static_cast<std::size_t>(places[i])];
    const auto& o = message.orientation[i];
    const Eigen::Vector4d turn = Eigen::Vector4d(o.w, o.x, o.y, o.z).normalized();
    const auto& w = message.angular_velocity[i];
    const double velocity[] = {w.x, w.y, w.z};
    std::copy_n(turn.data(), 4, &balls_.q[static_cast<std::size_t>(joint.position_offset)]);
    std::copy_n(velocity, 3, &balls_.velocity[static_cast<std::size_t>(joint.velocity_offset)]);
  }
  return &balls_;
}

std::optional<twin::PushSample> SampleReader::read(
    const anthrob_msgs::ExternalWrenches& message) const {
  const std::size_t size = message.link.size();
  if (message.point.size() != size || message.wrench.size() != size ||
      message.left.size() != size) {
    return std::nullopt;
  }
  twin::PushSample sample;
  sample.stamp = stamp_of(message.header);
  for (std::size_t i = 0; i < size; ++i) {
    const int frame = model_.skeleton->find_frame(message.link[i]);
    if (frame < 0) continue;
    twin::PushSample::Push push;
    push.wrench.frame = frame;
    push.wrench.point = vector_of(message.point[i]);
    push.wrench.force = vector_of(message.wrench[i].force);
    push.wrench.torque = vector_of(message.wrench[i].torque);
    push.end = sample.stamp + message.left[i].toNSec();
    sample.pushes.push_back(push);
  }
  return sample;
}

}  // namespace anthrob
