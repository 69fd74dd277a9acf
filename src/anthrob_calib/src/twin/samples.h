#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "anthrob_ecu/control_law.h"
#include "anthrob_recording/table.h"
#include "anthrob_sim/inputs.h"
#include "anthrob_sim/model/robot_model.h"

namespace anthrob {
namespace twin {

/// @param time [s]
inline Nanoseconds nanoseconds(double time) {
  return static_cast<Nanoseconds>(std::llround(time * 1e9));
}

constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

/// What a unit measures and says of one muscle, as in anthrob_msgs/MuscleStates. NaN: not measured.
struct MuscleReading {
  double position = kNotMeasured;   ///< [rad]
  double velocity = kNotMeasured;   ///< [rad/s]
  double current = kNotMeasured;    ///< [A]
  double voltage = kNotMeasured;    ///< [V]
  double force = kNotMeasured;      ///< [N]
  double reference = kNotMeasured;  ///< V, rad, A or N, by mode
  ecu::Mode mode = ecu::Mode::kVoltage;
  bool enabled = false;
};

/// All muscles at one instant, in the order of the model.
struct MuscleSample {
  Nanoseconds stamp = 0;
  std::vector<MuscleReading> muscles;
};

/// Joints of one topic at one instant.
struct JointSample {
  Nanoseconds stamp = 0;
  std::vector<double> q;         ///< as a configuration; NaN: not measured, or of another topic
  std::vector<double> velocity;  ///< generalised; of ball joints in the child's axes [rad/s, m/s]
  std::vector<double> effort;    ///< by joint, of driven ones [Nm, N]
};

/// What pushes links from an instant on, until the next sample; in any order.
struct PushSample {
  struct Push {
    Wrench wrench;
    Nanoseconds end = 0;
  };
  Nanoseconds stamp = 0;
  std::vector<Push> pushes;
};

inline MuscleSample blank_muscles(const RobotModel& model) {
  return {0, std::vector<MuscleReading>(model.muscles.size())};
}

inline JointSample blank_joints(const RobotModel& model) {
  const auto& skeleton = *model.skeleton;
  return {0, std::vector<double>(static_cast<std::size_t>(skeleton.position_count), kNotMeasured),
          std::vector<double>(static_cast<std::size_t>(skeleton.velocity_count), kNotMeasured),
          std::vector<double>(skeleton.joints.size(), kNotMeasured)};
}

/// What measures the joints.
enum class Topic { kMuscles, kJoints, kBallJoints };
constexpr int kTopicCount = 3;
constexpr const char* kTopicNames[kTopicCount] = {"muscle_states", "joint_states",
                                                  "spherical_joint_states"};

inline Topic topic_of(const JointModel& joint) {
  return joint.type == JointType::kBall ? Topic::kBallJoints : Topic::kJoints;
}

}  // namespace twin
}  // namespace anthrob
