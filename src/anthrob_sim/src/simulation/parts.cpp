#include "simulation/parts.h"

#include <algorithm>
#include <cmath>

#include "anthrob_sim/skeleton/skeleton_model.h"
#include "simulation/checks.h"

namespace anthrob {

namespace {

/// Streams of random numbers of joint sensors begin here; muscles come before.
constexpr std::uint64_t kJointStreams = 1u << 20;

}  // namespace

Simulation::Parts::Parts(std::shared_ptr<const RobotModel> model)
    : model_(std::move(model)),
      skeleton_(*model_->skeleton, model_->gravity, model_->step, model_->collisions),
      tree_(*model_->skeleton),
      resistance_(*model_->skeleton, model_->step),
      readings_(*model_, store_),
      muscle_inputs_(muscles_, readings_, model_->step),
      posture_(*model_->skeleton, readings_),
      wrenches_(*model_->skeleton),
      q_(model_->skeleton->rest_configuration()),
      effort_(model_->skeleton->joints.size(), 0.0),
      load_(model_->skeleton->joints.size(), 0.0),
      acting_(model_->skeleton->joints.size(), 0.0),
      joint_loads_(*model_->skeleton, model_->gravity, model_->step) {
  const SkeletonModel& skeleton = *model_->skeleton;
  muscles_.reserve(model_->muscles.size());
  for (std::size_t i = 0; i < model_->muscles.size(); ++i) {
    muscles_.emplace_back(model_->muscles[i], skeleton, model_->sensors, static_cast<int>(i),
                          model_->step, store_);
  }
  for (Muscle& muscle : muscles_) {
    if (!muscle.sliding().contacts.empty()) sliding_.push_back(&muscle.sliding());
    if (muscle.shaft()) shafts_.push_back(muscle.shaft());
  }
  lines_.resize(muscles_.size());
  if (!shafts_.empty()) {
    driving_.resize(skeleton.joints.size(), 0.0);
    has_drive_.resize(skeleton.joints.size(), false);
  }
  for (const MuscleModel& muscle : model_->muscles) {
    if (muscle.is_drive()) has_drive_[static_cast<std::size_t>(muscle.path->joint())] = true;
  }
  dissipation_offset_ = store_.reserve(1);
  measured_offset_ = store_.reserve(skeleton.joints.size());
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
    joint_sensors_.emplace_back(model_->sensors.joint_position, model_->sensors.seed,
                                kJointStreams + i, model_->step, model_->sensors.steps_per_tick);
    joint_sensor_offsets_.push_back(store_.reserve(joint_sensors_.back().state_size()));
  }
  tau_.setZero(skeleton.velocity_count);
  way_.setZero(skeleton.velocity_count);
  inertial_.setZero(skeleton.velocity_count);
  lacking_.setZero(skeleton.velocity_count);
  acceleration_.setZero(skeleton.velocity_count);
  left_ = q_;
  heading_.resize(static_cast<std::size_t>(skeleton.velocity_count));
  arriving_.reserve(skeleton.bodies.size());
  reserve_effects();
}

void Simulation::Parts::reserve_effects() {
  const SkeletonModel& skeleton = *model_->skeleton;
  if (joint_loads_.wanted()) loads_offset_ = store_.reserve(skeleton.joints.size());
  bristles_offset_ = store_.reserve(resistance_.bristle_count() * state_size_of<BristleState>());
  if (!model_->joint_torques.empty()) joint_torque_.setZero(skeleton.velocity_count);
  for (const auto& effect : model_->power_effects) {
    power_offsets_.push_back(store_.reserve(effect->state_size()));
  }
}

void Simulation::Parts::reset_effects() {
  if (joint_loads_.wanted()) joint_loads_.reset(store_.at(loads_offset_).data());
  std::fill_n(bristles(), resistance_.bristle_count(), BristleState{0.0, 0.0});
  for (std::size_t i = 0; i < model_->power_effects.size(); ++i) {
    model_->power_effects[i]->reset(store_.at(power_offsets_[i]));
  }
  readings_.reset(truth());
}

void Simulation::Parts::head_for_posture() {
  posture_difference(*model_->skeleton, q_, posture_.q(), way_);
  way_ /= model_->step;
  Eigen::Map<Eigen::VectorXd> heading(heading_.data(), way_.size());
  heading = way_;
  for (const JointModel& joint : model_->skeleton->joints) {
    if (joint.type != JointType::kBall) continue;
    const int index = static_cast<int>(&joint - model_->skeleton->joints.data());
    heading.segment<3>(joint.velocity_offset) =
        tree_.joint(index).R_WC * way_.segment<3>(joint.velocity_offset);
  }
}

void Simulation::Parts::settle_in(const std::vector<BodyState>& bodies) {
  skeleton_.set_bodies(bodies);
  tree_.update(skeleton_.bodies(), q_);
  store_.at(dissipation_offset_)[0] = 0.0;
  reset_effects();
  for (std::size_t m = 0; m < muscles_.size(); ++m) {
    muscles_[m].reset_sensors(reading(m));
  }
  for (const JointModel& joint : model_->skeleton->joints) {
    const std::size_t i = &joint - model_->skeleton->joints.data();
    joint_sensors_[i].reset(read_positions()[joint.position_offset],
                            store_.at(joint_sensor_offsets_[i]));
  }
  sense();
}

ResistanceSolver::JointInputs Simulation::Parts::joint_inputs() const {
  ResistanceSolver::JointInputs inputs;
  if (joint_loads_.wanted()) inputs.loads = store_.at(loads_offset_).data();
  inputs.efforts = acting_.data();
  inputs.bristles = bristles();
  if (!shafts_.empty()) inputs.shafts = &shafts_;
  return inputs;
}

void Simulation::Parts::step_once() {
  for (Muscle& muscle : muscles_) muscle.control(step_index_);
  find_voltages();

  tree_.update_dynamics(skeleton_.bodies(), model_->gravity);
  tau_.setZero();
  for (const JointModel& joint : model_->skeleton->joints) {
    const std::size_t i = &joint - model_->skeleton->joints.data();
    acting_[i] = joint.effort_gain * effort_[i];
    tau_[joint.velocity_offset] += acting_[i] + load_[i];
  }
  if (!model_->joint_torques.empty()) add_joint_torques();
  wrenches_.add_generalised(tree_, skeleton_.bodies(), tau_);
  for (std::size_t m = 0; m < muscles_.size(); ++m) {
    muscles_[m].prepare_sliding(tree_, tau_);
    muscles_[m].prepare_drive(tree_, lines_[m].voltage);
  }
  if (!posture_.active()) {
    resistance_.solve(tree_, q_, tau_, sliding_, joint_inputs());
  } else {
    head_for_posture();
    resistance_.follow(tree_, heading_, sliding_, joint_inputs());
    find_lacking_efforts();
  }
  // Work within the step goes with the mean of the velocities at its ends.
  const Eigen::Map<const Eigen::VectorXd> start(tree_.velocities().data(), tau_.size());
  store_.at(dissipation_offset_)[0] =
      -0.5 * resistance_.joint_torque().dot(start + resistance_.velocity());
  for (Muscle& muscle : muscles_) muscle.finish_sliding();

  apply_wrenches();
  advance_actuators();
  move_skeleton();

  ++step_index_;
  tree_.update(skeleton_.bodies(), q_);
  for (Muscle& muscle : muscles_) muscle.update(skeleton_.bodies(), tree_);
  check_finite();
  sense();
}

void Simulation::Parts::find_lacking_efforts() {
  const auto size = tau_.size();
  const Eigen::Map<const Eigen::VectorXd> before(tree_.velocities().data(), size),
      after(heading_.data(), size);
  acceleration_ = (after - before) / model_->step;
  inertial_.noalias() = tree_.mass_matrix() * acceleration_;
  lacking_ = inertial_ + tree_.bias() - tau_;
  left_ = q_;
}

Simulation::LackingEffort Simulation::Parts::lacking_effort(int joint, double rest) const {
  const JointModel& model = model_->skeleton->joints[joint];
  const int dof = model.velocity_offset;
  const double velocity = heading_[static_cast<std::size_t>(dof)];
  // In the middle of the step, as effort and acceleration are.
  const double sliding = velocity - 0.5 * model_->step * acceleration_[dof];
  const ForceRange resistance =
      resistance_.resistance_at(left_, joint, velocity, sliding, rest, joint_inputs());
  // What reaches the joint of a little more effort: a law that lets none through explains nothing.
  double passed = model.effort_gain;
  if (std::abs(sliding) > rest) {
    passed *= 1.0 - std::copysign(model.friction.effort_share, acting_[joint] * sliding);
  }
  return {inertial_[dof] / passed,
          {(lacking_[dof] - resistance.high) / passed, (lacking_[dof] - resistance.low) / passed}};
}

void Simulation::Parts::move_skeleton() {
  if (joint_loads_.wanted()) joint_loads_.before(skeleton_);
  if (reactions_) reactions_->before(skeleton_);
  if (posture_.active()) {
    tree_.place(posture_.q(), heading_, arriving_);
    skeleton_.set_bodies(arriving_);
    // Body poses do not show whole turns of a hinge; continue counting from the imposed angle.
    q_ = posture_.q();
  } else {
    skeleton_.step();
  }
  if (reactions_) reactions_->after(skeleton_);
  if (joint_loads_.wanted()) {
    joint_loads_.after(skeleton_);
    joint_loads_.write(skeleton_, store_.at(loads_offset_).data());
  }
}

void Simulation::Parts::add_joint_torques() {
  joint_torque_.setZero();
  for (const auto& torque : model_->joint_torques) torque->add(tree_, q_, joint_torque_.data());
  tau_ += joint_torque_;
}

void Simulation::Parts::find_voltages() {
  for (std::size_t m = 0; m < muscles_.size(); ++m) lines_[m].voltage = muscles_[m].voltage();
  if (model_->power_effects.empty()) return;
  for (std::size_t m = 0; m < muscles_.size(); ++m) {
    // A motor that is moved from outside draws nothing.
    if (muscles_[m].drive() == Drive::kImposed) lines_[m].voltage = 0.0;
    lines_[m].current = muscles_[m].actuator().current;
  }
  for (std::size_t i = 0; i < model_->power_effects.size(); ++i) {
    model_->power_effects[i]->apply(lines_, store_.at(power_offsets_[i]));
  }
}

void Simulation::Parts::advance_actuators() {
  for (std::size_t m = 0; m < muscles_.size(); ++m) muscles_[m].advance_actuator(lines_[m].voltage);
}

void Simulation::Parts::apply_wrenches() {
  skeleton_.clear_wrenches();
  const auto& bodies = skeleton_.bodies();
  const auto apply = [&](int body, const Vec3& point_W, const Vec3& force_W) {
    if (body == 0) return;
    skeleton_.add_wrench(body, force_W, (point_W - bodies[body].X_WB.p).cross(force_W));
  };
  for (const Muscle& muscle : muscles_) {
    if (muscle.model().is_drive()) continue;
    const PathModel& path = *muscle.model().path;
    for (std::size_t i = 0; i < path.segment_count(); ++i) {
      if (path.joints_of_segment(i).empty()) continue;
      const PathSegment& segment = muscle.path().segments()[i];
      const Vec3 pull = muscle.tension(i) * segment.pull_W;
      apply(path.obstacles()[i].body, segment.from_W, pull);
      apply(path.obstacles()[i + 1].body, segment.to_W, -pull);
    }
  }
  for (const Wrench& wrench : wrenches_.acting()) {
    const ExternalWrenches::OnBody on = wrenches_.on_body(wrench, bodies);
    if (on.body != 0) skeleton_.add_wrench(on.body, on.force_W, on.torque_W);
  }
  apply_joint_efforts();
}

void Simulation::Parts::apply_joint_efforts() {
  const auto& bodies = skeleton_.bodies();
  const auto& joints = model_->skeleton->joints;
  std::fill(driving_.begin(), driving_.end(), 0.0);
  for (const Muscle& muscle : muscles_) {
    if (muscle.model().is_drive()) driving_[muscle.model().path->joint()] += muscle.force();
  }
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const JointModel& joint = joints[i];
    const KinematicTree::JointView& view = tree_.joint(static_cast<int>(i));
    Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
    if (joint.type == JointType::kBall) {
      torque = resistance_.joint_torque().segment<3>(joint.velocity_offset);
      if (joint_torque_.size() > 0) torque += joint_torque_.segment<3>(joint.velocity_offset);
    } else {
      double effort = resistance_.joint_torque()[joint.velocity_offset] + acting_[i] + load_[i];
      if (!driving_.empty()) effort += driving_[i];
      if (joint_torque_.size() > 0) effort += joint_torque_[joint.velocity_offset];
      (joint.type == JointType::kHinge ? torque : force) = effort * view.axis_W;
    }
    for (const auto& [body, sign] : {std::pair{joint.child, 1.0}, std::pair{joint.parent, -1.0}}) {
      if (body == 0) continue;
      const Vec3 lever = view.center_W - bodies[body].X_WB.p;
      skeleton_.add_wrench(body, sign * force, sign * (torque + lever.cross(force)));
    }
  }
}

void Simulation::Parts::sense() {
  readings_.update(truth());
  for (std::size_t m = 0; m < muscles_.size(); ++m) {
    muscles_[m].sense(step_index_, reading(m));
  }
  const auto& joints = model_->skeleton->joints;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const double position = read_positions()[joints[i].position_offset] - lead(i);
    store_.at(measured_offset_)[i] =
        joint_sensors_[i].measure(position, step_index_, store_.at(joint_sensor_offsets_[i]));
  }
}

double Simulation::Parts::lead(std::size_t joint) const {
  if (has_drive_.empty() || !has_drive_[joint] || posture_.active()) return 0.0;
  const int dof = model_->skeleton->joints[joint].velocity_offset;
  return 0.5 * model_->step * tree_.velocities()[dof];
}

void Simulation::Parts::check_finite() const {
  for (std::size_t i = 1; i < skeleton_.bodies().size(); ++i) {
    const BodyState& body = skeleton_.bodies()[i];
    const double size =
        body.v_W.cwiseAbs().sum() + body.w_W.cwiseAbs().sum() + body.X_WB.p.cwiseAbs().sum();
    if (!is_sensible(size)) {
      throw NumericalFailure(time(), "body " + model_->skeleton->bodies[i].name,
                             "its motion is not a number below 1e9");
    }
  }
  // A body's orientation shows in its joint.
  for (const JointModel& joint : model_->skeleton->joints) {
    for (int k = 0; k < joint.position_size(); ++k) {
      if (is_sensible(q_[joint.position_offset + k])) continue;
      throw NumericalFailure(time(), "joint " + joint.name,
                             "its position is not a number below 1e9");
    }
  }
  for (const Muscle& muscle : muscles_) {
    const std::string& name = muscle.model().name;
    if (!is_sensible(muscle.actuator().position)) {
      throw NumericalFailure(time(), "muscle " + name,
                             "its actuator's position is not a number below 1e9");
    }
    // A spring may treat NaN expansion as slack and hide it.
    if (!is_sensible(muscle.expansion())) {
      throw NumericalFailure(time(), "muscle " + name, "its length is not a number below 1e9");
    }
    if (!is_sensible(std::abs(muscle.tension(0)) + std::abs(muscle.spring_tension()))) {
      throw NumericalFailure(time(), "muscle " + name, "its tension is not a number below 1e9");
    }
  }
}

}  // namespace anthrob
