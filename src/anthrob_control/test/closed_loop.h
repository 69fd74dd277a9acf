#pragma once

#include <memory>

#include "anthrob_control/computed_force.h"
#include "anthrob_core/random.h"
#include "anthrob_sim/simulation.h"
#include "anthrob_sim/statics/equilibrium.h"

namespace anthrob {
namespace testing_support {

/// Noise of joint sensors: motion capture and potentiometer.
struct JointNoise {
  double angle = 0.0;     ///< [rad] a component
  double velocity = 0.0;  ///< [rad/s] a component
};

/// A simulated robot under the controller, in lock-step, without ROS.
class ClosedLoop {
 public:
  ClosedLoop(const std::shared_ptr<const RobotModel>& plant,
             const std::shared_ptr<const RobotModel>& model, const ControlSettings& settings,
             const JointNoise& noise = {}, std::uint64_t seed = 1)
      : sim(plant), controller(model, settings), settings_(settings), noise_(noise), random_(seed) {
    steps_per_tick_ = static_cast<int>(std::lround(1.0 / (settings.rate * plant->step)));
    measured_.q = sim.configuration();
    measured_.u = Eigen::VectorXd::Zero(plant->skeleton->velocity_count);
    measured_.muscles.resize(plant->muscles.size());
  }

  /// Puts the arm at rest into a posture it holds by itself.
  void place(const std::vector<double>& q) {
    const Equilibrium e = find_equilibrium(sim, q, {settings_.lowest_tension, 80.0});
    sim.place(q, e.position);
    controller.reset();
  }

  void run(double seconds) {
    const double dt = steps_per_tick_ * sim.step_length();
    for (int i = 0; i < static_cast<int>(seconds / dt + 0.5); ++i) {
      measure();
      command = &controller.update(measured_, dt);
      for (std::size_t m = 0; m < sim.muscle_count(); ++m) {
        if (!sim.muscle(static_cast<int>(m)).model().has_controller) continue;
        sim.command(static_cast<int>(m), command->mode, command->reference[m]);
      }
      sim.step(steps_per_tick_);
    }
  }

  /// How far a joint is from where it was [rad].
  double distance(const std::vector<double>& q, int joint) const {
    return joint_distance(sim.model().skeleton->joints[joint], q, sim.configuration());
  }

  Simulation sim;
  ComputedForce controller;
  const ForceCommand* command = nullptr;

 private:
  void measure() {
    const SkeletonModel& skeleton = *sim.model().skeleton;
    Eigen::VectorXd wobble = Eigen::VectorXd::Zero(skeleton.velocity_count);
    for (Eigen::Index k = 0; k < wobble.size(); ++k)
      wobble[k] = noise_.angle * random_.normal(n_++);
    posture_plus(skeleton, sim.configuration(), wobble, measured_.q);
    for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
      const int at = skeleton.joints[j].velocity_offset;
      if (skeleton.joints[j].type == JointType::kBall) {
        measured_.u.segment<3>(at) = sim.tree().ball_velocity(static_cast<int>(j));
      } else {
        measured_.u[at] = sim.tree().velocities()[static_cast<std::size_t>(at)];
      }
    }
    for (Eigen::Index k = 0; k < wobble.size(); ++k)
      measured_.u[k] += noise_.velocity * random_.normal(n_++);
    for (std::size_t m = 0; m < sim.muscle_count(); ++m)
      measured_.muscles[m] = sim.muscle(static_cast<int>(m)).measured();
  }

  ControlSettings settings_;
  JointNoise noise_;
  CounterRandom random_;
  RobotMeasurement measured_;
  std::uint64_t n_ = 0;
  int steps_per_tick_;
};

}  // namespace testing_support
}  // namespace anthrob
