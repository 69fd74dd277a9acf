#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include "anthrob_sim/simulation.h"
#include "twin/twins.h"

namespace anthrob {
namespace twin {

inline std::string rig_file() {
  return std::string(ANTHROB_CONFIG_DIR) + "/two_muscle_rig/model_I.yaml";
}

/// A robot with sensors that have noise: model and robot may differ.
inline std::shared_ptr<const RobotModel> noisy_robot(const std::string& file,
                                                     const LoadOptions& options = {}) {
  auto robot = std::make_shared<RobotModel>(*load_robot_model(file, options));
  robot->sensors.seed = 7;
  robot->sensors.position.noise = 1e-3;        // [rad]
  robot->sensors.velocity.noise = 0.02;        // [rad/s]
  robot->sensors.current.noise = 0.01;         // [A]
  robot->sensors.force.noise = 0.2;            // [N]
  robot->sensors.joint_position.noise = 2e-3;  // [rad]
  return robot;
}

inline MuscleSample muscle_sample(const Simulation& sim, Nanoseconds stamp) {
  MuscleSample sample = blank_muscles(sim.model());
  sample.stamp = stamp;
  for (int m = 0; m < static_cast<int>(sim.muscle_count()); ++m) {
    const Muscle& muscle = sim.muscle(m);
    const ecu::Measurement& measured = muscle.measured();
    sample.muscles[static_cast<std::size_t>(m)] = {
        measured.position, measured.velocity,  measured.current, muscle.voltage(),
        measured.force,    muscle.reference(), muscle.mode(),    muscle.enabled()};
  }
  return sample;
}

inline JointSample joint_sample(const Simulation& sim, Topic topic, Nanoseconds stamp) {
  JointSample sample = blank_joints(sim.model());
  sample.stamp = stamp;
  const auto& joints = sim.model().skeleton->joints;
  for (int j = 0; j < static_cast<int>(joints.size()); ++j) {
    const JointModel& joint = joints[static_cast<std::size_t>(j)];
    if (topic_of(joint) != topic) continue;
    const auto q = static_cast<std::size_t>(joint.position_offset),
               v = static_cast<std::size_t>(joint.velocity_offset);
    if (joint.type == JointType::kBall) {
      std::copy_n(sim.read_positions() + q, 4, &sample.q[q]);
      Eigen::Map<Vec3>(&sample.velocity[v]) = sim.read_ball_velocity(j);
    } else {
      sample.q[q] = sim.measured_joint_position(j);
      sample.velocity[v] = sim.read_velocity(j);
    }
  }
  return sample;
}

/// A robot whose motors follow sines, and twins that hear it.
class MovingRobot {
 public:
  static constexpr int kEvery = 5;  // steps from one measurement to the next

  MovingRobot(const std::shared_ptr<const RobotModel>& robot, const RobotModel& model,
              const TwinOptions& options = {})
      : sim(robot), twins(model, options) {}

  /// @param heard what becomes of each measurement; empty: it is heard
  void run(double duration, const std::function<void(MovingRobot&)>& heard = {}) {
    const auto steps = std::lround(duration / sim.step_length());
    for (long i = 0; i < steps; ++i) {
      if (sim_step_++ % kEvery == 0 && !stopped) command();
      sim.step();
      if (sim_step_ % kEvery != 0) continue;
      if (heard) {
        heard(*this);
      } else {
        hear();
      }
    }
  }

  Nanoseconds stamp() const { return nanoseconds(sim.time()) + clock; }
  void hear() {
    twins.hear(muscle_sample(sim, stamp()));
    twins.hear(joint_sample(sim, Topic::kJoints, stamp()), Topic::kJoints);
    advance();
  }
  void advance() {
    while (twins.advance()) ++blocks;
  }

  double gap(const std::string& channel, Feed feed, int window = kWarningWindow) const {
    const auto& all = twins.channels().all;
    for (std::size_t c = 0; c < all.size(); ++c) {
      if (all[c].name == channel) return twins.report().gap[twins.report().at(window, c, feed)];
    }
    ADD_FAILURE() << channel;
    return kNotMeasured;
  }
  /// Of all channels that the feed tells.
  double largest_gap(Feed feed) const {
    double largest = 0.0;
    const auto& channels = twins.channels().all;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      if (!channels[c].told[static_cast<std::size_t>(feed)]) continue;
      const double own = gap(channels[c].name, feed);
      EXPECT_TRUE(std::isfinite(own)) << channels[c].name;
      largest = std::max(largest, own);
    }
    return largest;
  }

  Simulation sim;
  Twins twins;
  Nanoseconds clock = 0;  ///< of stamps, ahead of the simulation's
  bool stopped = false;
  int blocks = 0;

 private:
  void command() {
    for (int m = 0; m < static_cast<int>(sim.muscle_count()); ++m) {
      const double phase = 2.0 * M_PI * (0.3 + 0.1 * m) * sim.time() + m;
      sim.command(m, ecu::Mode::kPosition, 1.5 + 0.5 * std::sin(phase));
    }
  }

  long sim_step_ = 0;
};

}  // namespace twin
}  // namespace anthrob
