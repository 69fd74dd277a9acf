#include "anthrob_sim/placement.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "anthrob_core/errors.h"
#include "anthrob_sim/simulation.h"

namespace anthrob {

namespace {

constexpr double kUnit = 1e-3;  // how far a quaternion may be from unit length

std::string text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof(buffer), "%g", value);
  return buffer;
}

[[noreturn]] void refuse(const std::string& who, double value, double lowest, double highest) {
  throw BadInput(who + ": " + text(value) + ": expected a position within its limits, " +
                 text(lowest) + " to " + text(highest));
}

}  // namespace

void refuse_repeated(const std::string& what, const std::vector<std::string>& names) {
  for (auto name = names.begin(); name != names.end(); ++name) {
    if (std::find(names.begin(), name, *name) == name) continue;
    throw BadInput(what + " '" + *name + "': named twice");
  }
}

Placement::Placement(const RobotModel& model)
    : Placement(model, model.skeleton->rest_configuration()) {}

Placement::Placement(const RobotModel& model, std::vector<double> q)
    : model_(model), q_(std::move(q)), positions_(model.muscles.size()) {}

Placement::Placement(const Simulation& sim) : model_(sim.model()), q_(sim.configuration()) {
  for (std::size_t i = 0; i < sim.muscle_count(); ++i) {
    positions_.push_back(sim.muscle(static_cast<int>(i)).actuator().position);
  }
}

void Placement::set_joint(const std::string& name, double position) {
  const std::string who = "joint '" + name + "'";
  const int index = model_.skeleton->find_joint(name);
  if (index < 0) throw BadInput(who + ": no hinge or prismatic joint of that name");
  if (model_.skeleton->joints[index].type == JointType::kBall) {
    throw BadInput(who +
                   " is a ball joint: give its orientation (ball_joint_name, "
                   "ball_joint_orientation)");
  }
  const JointModel& joint = model_.skeleton->joints[index];
  if (!(std::abs(position) < Simulation::kSensible)) {
    throw BadInput(who + ": " + text(position) + ": expected a finite position below 1e9");
  }
  const double give = joint.type == JointType::kPrismatic ? 0.1 * kGive : kGive;
  if (joint.stop.enabled &&
      (position < joint.stop.lower - give || position > joint.stop.upper + give)) {
    refuse(who, position, joint.stop.lower, joint.stop.upper);
  }
  q_[joint.position_offset] = position;
}

void Placement::set_ball_joint(const std::string& name, const Quat& turn) {
  const std::string who = "ball joint '" + name + "'";
  const int index = model_.skeleton->find_joint(name);
  if (index < 0 || model_.skeleton->joints[index].type != JointType::kBall) {
    throw BadInput(who + ": no ball joint of that name");
  }
  if (!(std::abs(turn.norm() - 1.0) < kUnit)) {
    throw BadInput(who + ": (" + text(turn.w()) + ", " + text(turn.x()) + ", " + text(turn.y()) +
                   ", " + text(turn.z()) + "): expected a unit quaternion");
  }
  const JointModel& joint = model_.skeleton->joints[index];
  const Quat unit = canonical(turn.normalized());
  const double angle = angular_distance(unit, Quat::Identity());
  if (joint.stop.enabled && angle > joint.stop.upper + kGive) {
    refuse(who, angle, 0.0, joint.stop.upper);
  }
  double* p = &q_[joint.position_offset];
  p[0] = unit.w(), p[1] = unit.x(), p[2] = unit.y(), p[3] = unit.z();
}

void Placement::set_muscle(const std::string& name, double position) {
  const std::string who = "muscle '" + name + "'";
  const int index = model_.muscle_index(name);
  if (!std::isfinite(position)) {
    throw BadInput(who + ": " + text(position) + ": expected a finite position");
  }
  const MuscleModel& muscle = model_.muscles[index];
  if (!muscle.actuator->takes_input() && position != 0.0) {
    throw BadInput(who + ": " + text(position) + ": expected 0, because the muscle is passive");
  }
  const double limit = muscle.limits.position;
  const double highest = std::min(limit + kGive, muscle.actuator->highest_position());
  if (position < -limit - kGive || position > highest) {
    refuse(who, position, -limit, std::min(limit, highest));
  }
  positions_[index] = position;
}

}  // namespace anthrob
