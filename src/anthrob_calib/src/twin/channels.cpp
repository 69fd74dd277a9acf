#include "twin/channels.h"

#include <algorithm>
#include <cmath>

namespace anthrob {
namespace twin {

namespace {

/// Error of a value that is rounded to counts, but not less than `least`.
double least_of(const SensorModel& sensor, double least) {
  return std::max(sensor.quantum / std::sqrt(12.0), least);
}

Channel muscle_channel(const MuscleModel& muscle, std::size_t index, Quantity quantity,
                       const std::string& word, const std::string& unit) {
  Channel channel;
  channel.owner = muscle.name;
  channel.name = muscle.name + "/" + word;
  channel.unit = unit;
  channel.quantity = quantity;
  channel.index = static_cast<int>(index);
  channel.told[index_of(Feed::kCommands)] = channel.told[index_of(Feed::kVoltages)] = true;
  return channel;
}

}  // namespace

Channels::Channels(const RobotModel& model, const TwinOptions& options) {
  for (std::size_t m = 0; m < model.muscles.size(); ++m) {
    const MuscleModel& muscle = model.muscles[m];
    if (muscle.has_force_sensor()) {
      Channel force =
          muscle_channel(muscle, m, Quantity::kForce, "force", muscle.is_drive() ? "Nm" : "N");
      force.told.fill(true);
      force.least = least_of(model.sensors.force, options.least_force);
      if (!muscle.is_drive()) {
        force.cut_noise = model.sensors.force.noise / std::sqrt(model.sensors.force.average);
      }
      all.push_back(force);
    }
    if (!muscle.actuator->takes_input()) continue;
    Channel position = muscle_channel(muscle, m, Quantity::kPosition, "position", "rad");
    position.least = least_of(model.sensors.position, options.least_position);
    all.push_back(position);
    if (muscle.motor() == nullptr) continue;
    Channel current = muscle_channel(muscle, m, Quantity::kCurrent, "current", "A");
    current.least = least_of(model.sensors.current, options.least_current);
    all.push_back(current);
  }
  const auto& joints = model.skeleton->joints;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const bool ball = joints[j].type == JointType::kBall;
    Channel channel;
    channel.owner = joints[j].name;
    channel.name = joints[j].name + (ball ? "/rotation" : "/position");
    channel.unit = joints[j].type == JointType::kPrismatic ? "m" : "rad";
    channel.quantity = ball ? Quantity::kRotation : Quantity::kJointPosition;
    channel.index = static_cast<int>(j);
    channel.topic = topic_of(joints[j]);
    channel.components = ball ? 3 : 1;
    channel.told.fill(true);
    channel.told[index_of(Feed::kPostures)] = false;
    const double least =
        joints[j].type == JointType::kPrismatic ? options.least_distance : options.least_angle;
    channel.least = ball ? least : least_of(model.sensors.joint_position, least);
    all.push_back(channel);
  }
  for (Channel& channel : all) {
    channel.value = values;
    channel.series = series;
    values += channel.quantity == Quantity::kRotation ? 4 : 1;
    series += static_cast<std::size_t>(channel.components);
  }
}

double mean_above_zero(double value, double noise) {
  const double z = noise > 0.0 ? value / noise : 0.0;
  constexpr double kNothingCutOff = 6.0;  // deviations
  if (!(noise > 0.0) || z > kNothingCutOff) return value;
  return noise *
         (0.5 * z * std::erfc(-z * M_SQRT1_2) + std::exp(-0.5 * z * z) / std::sqrt(2.0 * M_PI));
}

void difference(const Channel& channel, const MuscleSample& measured,
                const std::vector<double>& values, double* result) {
  const MuscleReading& reading = measured.muscles[static_cast<std::size_t>(channel.index)];
  const double value = values[channel.value];
  if (channel.quantity == Quantity::kForce) {
    *result = reading.force - mean_above_zero(value, channel.cut_noise);
  } else {
    *result =
        (channel.quantity == Quantity::kPosition ? reading.position : reading.current) - value;
  }
}

void difference(const Channel& channel, const JointModel& joint, const JointSample& measured,
                const std::vector<double>& values, double* result) {
  const double* q = &measured.q[static_cast<std::size_t>(joint.position_offset)];
  const double* own = &values[channel.value];
  if (channel.quantity != Quantity::kRotation) {
    *result = q[0] - own[0];
    return;
  }
  const Quat there(q[0], q[1], q[2], q[3]), here(own[0], own[1], own[2], own[3]);
  if (!there.coeffs().allFinite()) {
    result[0] = result[1] = result[2] = kNotMeasured;
    return;
  }
  Eigen::Map<Vec3> rotation(result);
  rotation = rotation_vector(here.conjugate() * there);
}

}  // namespace twin
}  // namespace anthrob
