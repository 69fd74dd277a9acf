#include "anthrob_sim/simulation.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "anthrob_sim/skeleton/skeleton_model.h"
#include "simulation/checks.h"
#include "simulation/parts.h"

namespace anthrob {

namespace {

/// Largest change of a joint between two postures that muscles follow on the way to a placed
/// posture.
constexpr double kPlaceStep = 0.03;  // [rad]; a prismatic joint counts 10 rad a metre
/// Beyond some fifty turns the steps get larger, so that placing takes no longer than a second.
constexpr double kMostPostures = 10000;

}  // namespace

Simulation::Simulation(std::shared_ptr<const RobotModel> model)
    : parts_(std::make_unique<Parts>(std::move(model))) {
  for (Muscle& muscle : parts_->muscles_) muscle.set_enabled(true);
  place(parts_->q_, std::vector<double>(muscle_count(), 0.0));
}

Simulation::~Simulation() = default;

const RobotModel& Simulation::model() const {
  return *parts_->model_;
}

double Simulation::step_length() const {
  return parts_->model_->step;
}

double Simulation::time() const {
  return parts_->time();
}

void Simulation::check_joint(int joint) const {
  expect_index(joint, parts_->model_->skeleton->joints.size(), "joint");
}

void Simulation::command(int muscle, ecu::Mode mode, double reference) {
  expect_index(muscle, muscle_count(), "muscle");
  parts_->muscles_[static_cast<std::size_t>(muscle)].command(mode, reference);
}

MuscleInputs& Simulation::muscle_inputs() {
  return parts_->muscle_inputs_;
}

const MuscleInputs& Simulation::muscle_inputs() const {
  return parts_->muscle_inputs_;
}

ImposedPosture& Simulation::imposed_posture() {
  return parts_->posture_;
}

const ImposedPosture& Simulation::imposed_posture() const {
  return parts_->posture_;
}

ExternalWrenches& Simulation::external_wrenches() {
  return parts_->wrenches_;
}

const ExternalWrenches& Simulation::external_wrenches() const {
  return parts_->wrenches_;
}

void Simulation::apply_effort(int joint, double effort) {
  check_joint(joint);
  if (!parts_->model_->skeleton->joints[joint].driven) {
    throw BadInput("joint " + parts_->model_->skeleton->joints[joint].name +
                   ": takes no effort; expected 'driven: true' in " + parts_->model_->file);
  }
  expect_finite(effort, "joint ", parts_->model_->skeleton->joints[joint].name, ": effort");
  parts_->effort_[joint] = effort;
}

void Simulation::apply_load(int joint, double load) {
  check_joint(joint);
  if (parts_->model_->skeleton->joints[joint].type == JointType::kBall) {
    throw BadInput("joint " + parts_->model_->skeleton->joints[joint].name +
                   ": load: expected a hinge or prismatic joint");
  }
  expect_finite(load, "joint ", parts_->model_->skeleton->joints[joint].name, ": load");
  parts_->load_[joint] = load;
}

void Simulation::check_place(const std::vector<double>& q,
                             const std::vector<double>& positions) const {
  expect_posture(q, *parts_->model_->skeleton);
  if (positions.size() != parts_->muscles_.size()) {
    throw BadInput("place: expected " + std::to_string(parts_->muscles_.size()) +
                   " muscle positions");
  }
  for (std::size_t i = 0; i < parts_->muscles_.size(); ++i) {
    expect_sensible(positions[i], "place: muscle ", parts_->muscles_[i].model().name, "");
    expect_reachable(positions[i], "place: muscle ", parts_->muscles_[i].model(), "");
  }
}

void Simulation::place(const std::vector<double>& q, const std::vector<double>& positions) {
  check_place(q, positions);
  parts_->posture_.release();
  parts_->wrenches_.release();
  const SkeletonModel& skeleton = *parts_->model_->skeleton;
  const std::vector<double> rest = skeleton.rest_configuration();
  std::vector<BodyState> bodies;
  parts_->tree_.place(rest, {}, bodies);
  for (std::size_t i = 0; i < parts_->muscles_.size(); ++i)
    parts_->muscles_[i].place(bodies, positions[i]);

  const double change = posture_distance(skeleton, rest, q);
  const int count = static_cast<int>(std::min(std::ceil(change / kPlaceStep), kMostPostures));
  std::vector<double> way = rest;
  for (int i = 1; i <= count; ++i) {
    posture_between(skeleton, rest, q, static_cast<double>(i) / count, way);
    parts_->tree_.place(i == count ? q : way, {}, bodies);
    for (Muscle& muscle : parts_->muscles_) muscle.follow(bodies);
  }
  parts_->q_ = q;
  parts_->settle_in(bodies);
}

void Simulation::reset() {
  for (Muscle& muscle : parts_->muscles_) {
    muscle.release();
    muscle.command(ecu::Mode::kVoltage, 0.0);
  }
  std::fill(parts_->effort_.begin(), parts_->effort_.end(), 0.0);
  std::fill(parts_->load_.begin(), parts_->load_.end(), 0.0);
  place(parts_->model_->skeleton->rest_configuration(),
        std::vector<double>(parts_->muscles_.size(), 0.0));
}

void Simulation::skip(std::uint64_t steps) {
  parts_->step_index_ += steps;
}

void Simulation::step(int count) {
  for (int i = 0; i < count; ++i) {
    parts_->step_once();
    parts_->wrenches_.count_step();
  }
}

std::size_t Simulation::muscle_count() const {
  return parts_->muscles_.size();
}

const Muscle& Simulation::muscle(int i) const {
  expect_index(i, muscle_count(), "muscle");
  return parts_->muscles_[static_cast<std::size_t>(i)];
}

const std::vector<BodyState>& Simulation::bodies() const {
  return parts_->skeleton_.bodies();
}

const KinematicTree& Simulation::tree() const {
  return parts_->tree_;
}

const std::vector<double>& Simulation::configuration() const {
  return parts_->q_;
}

ecu::Measurement Simulation::reading(int muscle) const {
  expect_index(muscle, muscle_count(), "muscle");
  return parts_->reading(static_cast<std::size_t>(muscle));
}

const double* Simulation::read_positions() const {
  return parts_->read_positions();
}

double Simulation::read_velocity(int joint) const {
  check_joint(joint);
  const int dof = parts_->model_->skeleton->joints[joint].velocity_offset;
  return parts_->readings_.empty() ? parts_->tree_.velocities()[dof]
                                   : parts_->readings_.velocities()[dof];
}

Vec3 Simulation::read_ball_velocity(int joint) const {
  check_joint(joint);
  if (parts_->readings_.empty()) return parts_->tree_.ball_velocity(joint);
  const double* w =
      parts_->readings_.velocities() + parts_->model_->skeleton->joints[joint].velocity_offset;
  return {w[0], w[1], w[2]};
}

double Simulation::presliding_energy() const {
  return parts_->bristle_energy();
}

double Simulation::joint_effort(int joint) const {
  check_joint(joint);
  return parts_->effort_[joint];
}

double Simulation::joint_load(int joint) const {
  check_joint(joint);
  return parts_->load_[joint];
}

double Simulation::measured_joint_position(int joint) const {
  check_joint(joint);
  return parts_->store_.at(parts_->measured_offset_)[joint];
}

std::vector<double> Simulation::moment_arms(int index) const {
  const SkeletonModel& skeleton = *parts_->model_->skeleton;
  const MusclePath& path = muscle(index).path();
  std::vector<double> arms(skeleton.velocity_count, 0.0);
  for (std::size_t i = 0; i < path.segments().size(); ++i)
    path.add_moment_arms(i, 1.0, parts_->tree_, arms.data());
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    if (skeleton.joints[j].type != JointType::kBall) continue;
    Eigen::Map<Vec3> arm(&arms[skeleton.joints[j].velocity_offset]);
    arm = (parts_->tree_.joint(static_cast<int>(j)).R_WC.transpose() * arm).eval();
  }
  return arms;
}

Pose Simulation::link_pose(int frame) const {
  const auto& frames = parts_->model_->skeleton->frames;
  if (frame < 0 || frame >= static_cast<int>(frames.size())) {
    throw BadInput("frame " + std::to_string(frame) + ": expected an index below " +
                   std::to_string(frames.size()));
  }
  const FrameModel& model = frames[frame];
  const BodyModel& body = parts_->model_->skeleton->bodies[model.body];
  return bodies()[model.body].X_WB * body.X_LB.inverse() * model.X_LF;
}

Simulation::LastStep Simulation::last_step() const {
  return {parts_->store_.at(parts_->dissipation_offset_)[0], parts_->resistance_.iterations()};
}

Vec3 Simulation::joint_resistance(int joint) const {
  check_joint(joint);
  const JointModel& model = parts_->model_->skeleton->joints[joint];
  const auto all = parts_->resistance_.joint_torque().segment(model.velocity_offset, model.dof());
  if (model.type != JointType::kBall) return {all[0], 0.0, 0.0};
  return parts_->tree_.joint(joint).R_WC.transpose() * Vec3(all);
}

Simulation::LackingEffort Simulation::lacking_effort(int joint, double rest) const {
  check_joint(joint);
  const JointModel& model = parts_->model_->skeleton->joints[joint];
  if (model.type == JointType::kBall || muscle_count() > 0 || !parts_->posture_.active()) {
    throw BadInput("joint " + model.name +
                   ": the effort that it lacks is computed of hinges and prismatic joints of "
                   "robots without muscles, while a posture is imposed");
  }
  return parts_->lacking_effort(joint, rest);
}

void Simulation::observe_reactions() {
  if (parts_->reactions_) return;
  parts_->reactions_.emplace(*parts_->model_->skeleton, parts_->model_->gravity,
                             parts_->model_->step, JointLoads::Of::kAll);
}

Vec3 Simulation::joint_reaction(int joint) const {
  check_joint(joint);
  if (!parts_->reactions_) throw BadInput("joint reactions: call observe_reactions() first");
  const SkeletonModel& skeleton = *parts_->model_->skeleton;
  const int parent = skeleton.find_frame(skeleton.joints[joint].parent_link);
  return link_pose(parent).R.transpose() * parts_->reactions_->carried()[joint];
}

Snapshot Simulation::snapshot() const {
  return {parts_->step_index_, parts_->store_.data(),    parts_->skeleton_.bodies(),
          parts_->q_,          parts_->effort_,          parts_->load_,
          parts_->posture_.q_, parts_->wrenches_.acting_};
}

void Simulation::restore(const Snapshot& snapshot) {
  if (snapshot.state.size() != parts_->store_.data().size() ||
      snapshot.bodies.size() != bodies().size() || snapshot.q.size() != parts_->q_.size() ||
      snapshot.effort.size() != parts_->effort_.size() ||
      snapshot.load.size() != parts_->load_.size() ||
      (!snapshot.posture.empty() && snapshot.posture.size() != parts_->q_.size())) {
    throw BadInput("snapshot: it belongs to another model");
  }
  parts_->step_index_ = snapshot.step_index;
  parts_->store_.assign(snapshot.state);
  parts_->q_ = snapshot.q;
  parts_->effort_ = snapshot.effort;
  parts_->load_ = snapshot.load;
  parts_->posture_.q_ = snapshot.posture;
  parts_->wrenches_.acting_ = snapshot.wrenches;
  parts_->skeleton_.set_bodies(snapshot.bodies);
  parts_->tree_.update(parts_->skeleton_.bodies(), parts_->q_);
  // Paths are scratch memory: the same posture and states give the same paths.
  for (Muscle& muscle : parts_->muscles_) muscle.refresh_path(parts_->skeleton_.bodies());
  // refresh_path() writes to the state; restore it again.
  parts_->store_.assign(snapshot.state);
}

void Simulation::restore_in_present(const Snapshot& snapshot) {
  std::uint64_t period = static_cast<std::uint64_t>(model().sensors.steps_per_tick);
  for (const MuscleModel& muscle : model().muscles)
    period = std::lcm(period, static_cast<std::uint64_t>(muscle.steps_per_tick));
  const std::uint64_t now = parts_->step_index_;
  restore(snapshot);
  parts_->step_index_ = now + (period + snapshot.step_index % period - now % period) % period;
}

}  // namespace anthrob
