#include "anthrob_sim/simulation.h"

#include <algorithm>
#include <cmath>

#include "anthrob_sim/skeleton/posture.h"

namespace anthrob {

namespace {

/// Largest change of a joint between two postures that muscles follow on the way to a placed
/// posture.
constexpr double kPlaceStep = 0.03;  // [rad]; a prismatic joint counts 10 rad a metre
/// Beyond some fifty turns the steps get larger, so that placing takes no longer than a second.
constexpr double kMostPostures = 10000;

bool is_sensible(double value) {
  return std::abs(value) < Simulation::kSensible;  // false if it is not a number
}

// Called in every step: text is made of the names only where there is something to say.
void expect_finite(double value, const char* kind, const std::string& name, const char* what) {
  if (std::isfinite(value)) return;
  throw BadInput(std::string(kind) + name + what + ": expected a finite number");
}

void expect_sensible(double value, const char* kind, const std::string& name, const char* what) {
  if (is_sensible(value)) return;
  throw BadInput(std::string(kind) + name + what + ": expected a finite number below 1e9");
}

/// A Hill muscle can pull its tendon in only so far; recorded positions have noise.
void expect_reachable(double position, const char* kind, const MuscleModel& muscle,
                      const char* what) {
  constexpr double kGive = 0.05;
  const double highest = muscle.actuator->highest_position();
  if (position <= highest + kGive) return;
  throw BadInput(kind + muscle.name + what + ": " + std::to_string(position) +
                 ": expected at most " + std::to_string(highest));
}

/// Streams of random numbers of joint sensors begin here; muscles come before.
constexpr std::uint64_t kJointStreams = 1u << 20;

}  // namespace

Simulation::Simulation(std::shared_ptr<const RobotModel> model)
    : model_(std::move(model)),
      skeleton_(*model_->skeleton, model_->gravity, model_->step, model_->collisions),
      tree_(*model_->skeleton),
      resistance_(*model_->skeleton, model_->step),
      readings_(*model_, store_),
      q_(model_->skeleton->rest_configuration()),
      effort_(model_->skeleton->joints.size(), 0.0),
      load_(model_->skeleton->joints.size(), 0.0),
      joint_loads_(*model_->skeleton, model_->gravity, model_->step) {
  const SkeletonModel& skeleton = *model_->skeleton;
  muscles_.reserve(model_->muscles.size());
  for (std::size_t i = 0; i < model_->muscles.size(); ++i) {
    muscles_.emplace_back(model_->muscles[i], skeleton, model_->sensors, static_cast<int>(i),
                          model_->step, store_);
  }
  for (Muscle& muscle : muscles_) {
    if (!muscle.sliding().contacts.empty()) sliding_.push_back(&muscle.sliding());
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
  heading_.resize(static_cast<std::size_t>(skeleton.velocity_count));
  posture_.reserve(static_cast<std::size_t>(skeleton.position_count));
  arriving_.reserve(skeleton.bodies.size());
  reserve_effects();
  for (Muscle& muscle : muscles_) muscle.set_enabled(true);
  place(q_, std::vector<double>(muscles_.size(), 0.0));
}

void Simulation::reserve_effects() {
  const SkeletonModel& skeleton = *model_->skeleton;
  if (joint_loads_.wanted()) loads_offset_ = store_.reserve(skeleton.joints.size());
  if (!model_->joint_torques.empty()) joint_torque_.setZero(skeleton.velocity_count);
  if (!model_->power_effects.empty()) lines_.resize(muscles_.size());
  for (const auto& effect : model_->power_effects) {
    power_offsets_.push_back(store_.reserve(effect->state_size()));
  }
}

void Simulation::reset_effects() {
  if (joint_loads_.wanted()) joint_loads_.reset(store_.at(loads_offset_).data());
  for (std::size_t i = 0; i < model_->power_effects.size(); ++i) {
    model_->power_effects[i]->reset(store_.at(power_offsets_[i]));
  }
  readings_.reset(truth());
}

void Simulation::check_muscle(int muscle) const {
  if (muscle < 0 || muscle >= static_cast<int>(muscles_.size())) {
    throw BadInput("muscle " + std::to_string(muscle) + ": expected an index below " +
                   std::to_string(muscles_.size()));
  }
}

void Simulation::check_joint(int joint) const {
  const std::size_t count = model_->skeleton->joints.size();
  if (joint < 0 || joint >= static_cast<int>(count)) {
    throw BadInput("joint " + std::to_string(joint) + ": expected an index below " +
                   std::to_string(count));
  }
}

void Simulation::command(int muscle, ecu::Mode mode, double reference) {
  check_muscle(muscle);
  muscles_[muscle].command(mode, reference);
}

void Simulation::set_enabled(int muscle, bool enabled) {
  check_muscle(muscle);
  muscles_[muscle].set_enabled(enabled);
}

void Simulation::set_gain(int muscle, ecu::Parameter gain, double value) {
  check_muscle(muscle);
  muscles_[muscle].set_gain(gain, value);
}

void Simulation::apply_voltage(int muscle, double voltage) {
  check_muscle(muscle);
  muscles_[muscle].apply_voltage(voltage);
}

void Simulation::impose_position(int muscle, double position, double velocity) {
  check_muscle(muscle);
  const std::string& name = muscles_[muscle].model().name;
  expect_sensible(position, "muscle ", name, ": position");
  expect_reachable(position, "muscle ", muscles_[muscle].model(), ": position");
  expect_sensible(velocity, "muscle ", name, ": velocity");
  muscles_[muscle].impose(position, velocity);
}

void Simulation::impose_reading(int muscle, double from, double to) {
  check_muscle(muscle);
  const auto m = static_cast<std::size_t>(muscle);
  to = readings_.true_position(m, to);
  // The inverse of a reading effect can change between steps, so start from the actuator itself.
  const bool goes_on = !readings_.empty() && muscles_[m].drive() == Drive::kImposed;
  from = goes_on ? muscles_[m].actuator().position : readings_.true_position(m, from);
  impose_position(muscle, to, (to - from) / step_length());
}

double Simulation::position_delay(int muscle) const {
  check_muscle(muscle);
  return readings_.position_delay(static_cast<std::size_t>(muscle));
}

void Simulation::release(int muscle) {
  check_muscle(muscle);
  muscles_[muscle].release();
}

void Simulation::apply_effort(int joint, double effort) {
  check_joint(joint);
  if (!model_->skeleton->joints[joint].driven) {
    throw BadInput("joint " + model_->skeleton->joints[joint].name +
                   ": takes no effort; expected 'driven: true' in " + model_->file);
  }
  expect_finite(effort, "joint ", model_->skeleton->joints[joint].name, ": effort");
  effort_[joint] = effort;
}

void Simulation::apply_load(int joint, double load) {
  check_joint(joint);
  if (model_->skeleton->joints[joint].type == JointType::kBall) {
    throw BadInput("joint " + model_->skeleton->joints[joint].name +
                   ": load: expected a hinge or prismatic joint");
  }
  expect_finite(load, "joint ", model_->skeleton->joints[joint].name, ": load");
  load_[joint] = load;
}

void Simulation::check_posture(const std::vector<double>& q) const {
  const SkeletonModel& skeleton = *model_->skeleton;
  if (q.size() != static_cast<std::size_t>(skeleton.position_count)) {
    throw BadInput("posture: expected " + std::to_string(skeleton.position_count) +
                   " joint numbers");
  }
  for (const JointModel& joint : skeleton.joints) {
    const double* p = &q[joint.position_offset];
    double squares = 0.0;
    for (int k = 0; k < joint.position_size(); ++k) {
      expect_sensible(p[k], "posture: joint ", joint.name, "");
      squares += p[k] * p[k];
    }
    if (joint.type == JointType::kBall && squares < 1e-12) {
      throw BadInput("posture: joint " + joint.name + ": expected a quaternion that is not zero");
    }
  }
}

void Simulation::check_place(const std::vector<double>& q,
                             const std::vector<double>& positions) const {
  check_posture(q);
  if (positions.size() != muscles_.size()) {
    throw BadInput("place: expected " + std::to_string(muscles_.size()) + " muscle positions");
  }
  for (std::size_t i = 0; i < muscles_.size(); ++i) {
    expect_sensible(positions[i], "place: muscle ", muscles_[i].model().name, "");
    expect_reachable(positions[i], "place: muscle ", muscles_[i].model(), "");
  }
}

void Simulation::impose_posture(const std::vector<double>& q) {
  check_posture(q);
  posture_ = q;
}

std::vector<double> Simulation::true_posture(std::vector<double> read) const {
  readings_.true_joint_positions(read.data());
  return read;
}

void Simulation::impose_posture_reading(const std::vector<double>& q) {
  impose_posture(q);
  readings_.true_joint_positions(posture_.data());
}

double Simulation::posture_delay() const {
  return readings_.joint_delay();
}

void Simulation::head_for_posture() {
  posture_difference(*model_->skeleton, q_, posture_, way_);
  way_ /= step_length();
  Eigen::Map<Eigen::VectorXd> heading(heading_.data(), way_.size());
  heading = way_;
  for (const JointModel& joint : model_->skeleton->joints) {
    if (joint.type != JointType::kBall) continue;
    const int index = static_cast<int>(&joint - model_->skeleton->joints.data());
    heading.segment<3>(joint.velocity_offset) =
        tree_.joint(index).R_WC * way_.segment<3>(joint.velocity_offset);
  }
}

void Simulation::place(const std::vector<double>& q, const std::vector<double>& positions) {
  check_place(q, positions);
  release_posture();
  const SkeletonModel& skeleton = *model_->skeleton;
  const std::vector<double> rest = skeleton.rest_configuration();
  std::vector<BodyState> bodies;
  tree_.place(rest, {}, bodies);
  for (std::size_t i = 0; i < muscles_.size(); ++i) muscles_[i].place(bodies, positions[i]);

  const double change = posture_distance(skeleton, rest, q);
  const int count = static_cast<int>(std::min(std::ceil(change / kPlaceStep), kMostPostures));
  std::vector<double> way = rest;
  for (int i = 1; i <= count; ++i) {
    posture_between(skeleton, rest, q, static_cast<double>(i) / count, way);
    tree_.place(i == count ? q : way, {}, bodies);
    for (Muscle& muscle : muscles_) muscle.follow(bodies);
  }
  q_ = q;
  settle_in(bodies);
}

void Simulation::settle_in(const std::vector<BodyState>& bodies) {
  skeleton_.set_bodies(bodies);
  tree_.update(skeleton_.bodies(), q_);
  store_.at(dissipation_offset_)[0] = 0.0;
  reset_effects();
  for (std::size_t m = 0; m < muscles_.size(); ++m) {
    muscles_[m].reset_sensors(reading(static_cast<int>(m)));
  }
  for (const JointModel& joint : model_->skeleton->joints) {
    const std::size_t i = &joint - model_->skeleton->joints.data();
    joint_sensors_[i].reset(read_positions()[joint.position_offset],
                            store_.at(joint_sensor_offsets_[i]));
  }
  sense();
}

void Simulation::reset() {
  for (Muscle& muscle : muscles_) {
    muscle.release();
    muscle.command(ecu::Mode::kVoltage, 0.0);
  }
  std::fill(effort_.begin(), effort_.end(), 0.0);
  std::fill(load_.begin(), load_.end(), 0.0);
  place(model_->skeleton->rest_configuration(), std::vector<double>(muscles_.size(), 0.0));
}

void Simulation::step(int count) {
  for (int i = 0; i < count; ++i) step_once();
}

void Simulation::step_once() {
  for (Muscle& muscle : muscles_) muscle.control(step_index_);

  tree_.update_dynamics(skeleton_.bodies(), model_->gravity);
  tau_.setZero();
  for (const JointModel& joint : model_->skeleton->joints) {
    const std::size_t i = &joint - model_->skeleton->joints.data();
    tau_[joint.velocity_offset] += effort_[i] + load_[i];
  }
  if (!model_->joint_torques.empty()) add_joint_torques();
  for (Muscle& muscle : muscles_) muscle.prepare_sliding(tree_, tau_);
  if (posture_.empty()) {
    resistance_.solve(tree_, q_, tau_, sliding_,
                      joint_loads_.wanted() ? store_.at(loads_offset_).data() : nullptr);
  } else {
    head_for_posture();
    resistance_.follow(tree_, heading_, sliding_);
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

void Simulation::move_skeleton() {
  if (!posture_.empty()) {
    tree_.place(posture_, heading_, arriving_);
    skeleton_.set_bodies(arriving_);
    // Body poses do not show whole turns of a hinge; continue counting from the imposed angle.
    q_ = posture_;
    return;
  }
  if (joint_loads_.wanted()) joint_loads_.before(skeleton_);
  skeleton_.step();
  if (joint_loads_.wanted()) joint_loads_.after(skeleton_, store_.at(loads_offset_).data());
}

void Simulation::add_joint_torques() {
  joint_torque_.setZero();
  for (const auto& torque : model_->joint_torques) torque->add(tree_, q_, joint_torque_.data());
  tau_ += joint_torque_;
}

void Simulation::advance_actuators() {
  if (model_->power_effects.empty()) {
    for (Muscle& muscle : muscles_) muscle.advance_actuator(muscle.voltage());
    return;
  }
  for (std::size_t m = 0; m < muscles_.size(); ++m) {
    // A motor that is moved from outside draws nothing.
    const bool imposed = muscles_[m].drive() == Drive::kImposed;
    lines_[m] = {imposed ? 0.0 : muscles_[m].voltage(), muscles_[m].actuator().current};
  }
  for (std::size_t i = 0; i < model_->power_effects.size(); ++i) {
    model_->power_effects[i]->apply(lines_, store_.at(power_offsets_[i]));
  }
  for (std::size_t m = 0; m < muscles_.size(); ++m) muscles_[m].advance_actuator(lines_[m].voltage);
}

void Simulation::apply_wrenches() {
  skeleton_.clear_wrenches();
  const auto& bodies = skeleton_.bodies();
  const auto apply = [&](int body, const Vec3& point_W, const Vec3& force_W) {
    if (body == 0) return;
    skeleton_.add_wrench(body, force_W, (point_W - bodies[body].X_WB.p).cross(force_W));
  };
  for (const Muscle& muscle : muscles_) {
    const PathModel& path = *muscle.model().path;
    for (std::size_t i = 0; i < path.segment_count(); ++i) {
      if (path.joints_of_segment(i).empty()) continue;
      const PathSegment& segment = muscle.path().segments()[i];
      const Vec3 pull = muscle.tension(i) * segment.pull_W;
      apply(path.obstacles()[i].body, segment.from_W, pull);
      apply(path.obstacles()[i + 1].body, segment.to_W, -pull);
    }
  }
  apply_joint_efforts();
}

void Simulation::apply_joint_efforts() {
  const auto& bodies = skeleton_.bodies();
  const auto& joints = model_->skeleton->joints;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const JointModel& joint = joints[i];
    const KinematicTree::JointView& view = tree_.joint(static_cast<int>(i));
    Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
    if (joint.type == JointType::kBall) {
      torque = resistance_.joint_torque().segment<3>(joint.velocity_offset);
      if (joint_torque_.size() > 0) torque += joint_torque_.segment<3>(joint.velocity_offset);
    } else {
      double effort = resistance_.joint_torque()[joint.velocity_offset] + effort_[i] + load_[i];
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

void Simulation::sense() {
  readings_.update(truth());
  for (std::size_t m = 0; m < muscles_.size(); ++m) {
    muscles_[m].sense(step_index_, reading(static_cast<int>(m)));
  }
  const auto& joints = model_->skeleton->joints;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    store_.at(measured_offset_)[i] =
        joint_sensors_[i].measure(read_positions()[joints[i].position_offset], step_index_,
                                  store_.at(joint_sensor_offsets_[i]));
  }
}

ecu::Measurement Simulation::reading(int muscle) const {
  check_muscle(muscle);
  const auto m = static_cast<std::size_t>(muscle);
  return readings_.empty() ? muscles_[m].truth() : readings_.muscle(m);
}

const double* Simulation::read_positions() const {
  return readings_.empty() ? q_.data() : readings_.positions();
}

double Simulation::read_velocity(int joint) const {
  check_joint(joint);
  const int dof = model_->skeleton->joints[joint].velocity_offset;
  return readings_.empty() ? tree_.velocities()[dof] : readings_.velocities()[dof];
}

Vec3 Simulation::read_ball_velocity(int joint) const {
  check_joint(joint);
  if (readings_.empty()) return tree_.ball_velocity(joint);
  const double* w = readings_.velocities() + model_->skeleton->joints[joint].velocity_offset;
  return {w[0], w[1], w[2]};
}

void Simulation::check_finite() const {
  for (std::size_t i = 1; i < bodies().size(); ++i) {
    const BodyState& body = bodies()[i];
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

const Muscle& Simulation::muscle(int i) const {
  check_muscle(i);
  return muscles_[i];
}

double Simulation::joint_effort(int joint) const {
  check_joint(joint);
  return effort_[joint];
}

double Simulation::joint_load(int joint) const {
  check_joint(joint);
  return load_[joint];
}

double Simulation::measured_joint_position(int joint) const {
  check_joint(joint);
  return store_.at(measured_offset_)[joint];
}

std::vector<double> Simulation::moment_arms(int index) const {
  const SkeletonModel& skeleton = *model_->skeleton;
  const MusclePath& path = muscle(index).path();
  std::vector<double> arms(skeleton.velocity_count, 0.0);
  for (std::size_t i = 0; i < path.segments().size(); ++i)
    path.add_moment_arms(i, 1.0, tree_, arms.data());
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    if (skeleton.joints[j].type != JointType::kBall) continue;
    Eigen::Map<Vec3> arm(&arms[skeleton.joints[j].velocity_offset]);
    arm = (tree_.joint(static_cast<int>(j)).R_WC.transpose() * arm).eval();
  }
  return arms;
}

Pose Simulation::link_pose(int frame) const {
  const auto& frames = model_->skeleton->frames;
  if (frame < 0 || frame >= static_cast<int>(frames.size())) {
    throw BadInput("frame " + std::to_string(frame) + ": expected an index below " +
                   std::to_string(frames.size()));
  }
  const FrameModel& model = frames[frame];
  const BodyModel& body = model_->skeleton->bodies[model.body];
  return bodies()[model.body].X_WB * body.X_LB.inverse() * model.X_LF;
}

double Simulation::kinetic_energy() const {
  double energy = 0.0;
  for (std::size_t i = 1; i < bodies().size(); ++i) {
    const BodyModel& body = model_->skeleton->bodies[i];
    const Vec3 w_B = bodies()[i].X_WB.R.transpose() * bodies()[i].w_W;
    energy += 0.5 * body.mass * bodies()[i].v_W.squaredNorm() +
              0.5 * w_B.dot(body.principal.cwiseProduct(w_B));
  }
  return energy;
}

double Simulation::potential_energy() const {
  double energy = 0.0;
  for (std::size_t i = 1; i < bodies().size(); ++i) {
    energy -= model_->skeleton->bodies[i].mass * model_->gravity.dot(bodies()[i].X_WB.p);
  }
  for (const auto& torque : model_->joint_torques) energy += torque->energy(q_);
  return energy;
}

Snapshot Simulation::snapshot() const {
  return {step_index_, store_.data(), skeleton_.bodies(), q_, effort_, load_, posture_};
}

void Simulation::restore(const Snapshot& snapshot) {
  if (snapshot.state.size() != store_.data().size() || snapshot.bodies.size() != bodies().size() ||
      snapshot.q.size() != q_.size() || snapshot.effort.size() != effort_.size() ||
      snapshot.load.size() != load_.size() ||
      (!snapshot.posture.empty() && snapshot.posture.size() != q_.size())) {
    throw BadInput("snapshot: it belongs to another model");
  }
  step_index_ = snapshot.step_index;
  store_.assign(snapshot.state);
  q_ = snapshot.q;
  effort_ = snapshot.effort;
  load_ = snapshot.load;
  posture_ = snapshot.posture;
  skeleton_.set_bodies(snapshot.bodies);
  tree_.update(skeleton_.bodies(), q_);
  // Paths are scratch memory: the same posture and states give the same paths.
  for (Muscle& muscle : muscles_) muscle.refresh_path(skeleton_.bodies());
  // refresh_path() writes to the state; restore it again.
  store_.assign(snapshot.state);
}

}  // namespace anthrob
