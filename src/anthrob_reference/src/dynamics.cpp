#include "anthrob_reference/dynamics.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <utility>

namespace anthrob::reference {
namespace {

// Places in the state vector.
constexpr Eigen::Index kElbow = 4;
constexpr Eigen::Index kVelocity = 5;
constexpr Eigen::Index kMuscles = 9;
constexpr Eigen::Index kPerMuscle = 4;

Eigen::Index muscle_place(std::size_t i) {
  return kMuscles + kPerMuscle * static_cast<Eigen::Index>(i);
}

Eigen::Quaterniond quaternion(const Eigen::VectorXd& x) {
  return {x(0), x(1), x(2), x(3)};
}

Eigen::Vector4d coefficients(const Eigen::Quaterniond& q) {
  return {q.w(), q.x(), q.y(), q.z()};
}

}  // namespace

Dynamics::Dynamics(const ArmParameters& parameters) : skeleton_(parameters.skeleton) {
  for (const MuscleParameters& muscle : parameters.muscles) muscles_.emplace_back(muscle);
  voltages_.assign(muscles_.size(), 0.0);
  solutions_.resize(muscles_.size());
  regime_.resize(muscles_.size() + 1);
}

Eigen::Index Dynamics::size() const {
  return muscle_place(muscles_.size());
}

JointState Dynamics::joints(const Eigen::VectorXd& x) const {
  // The stages leave the unit sphere by their truncation error.
  return {quaternion(x).normalized(), x(kElbow), x.segment<4>(kVelocity)};
}

void Dynamics::set_joints(const JointState& joints, Eigen::VectorXd* x) const {
  x->head<4>() = coefficients(joints.shoulder.normalized());
  (*x)(kElbow) = joints.elbow;
  x->segment<4>(kVelocity) = joints.velocity;
}

MuscleState Dynamics::muscle_state(const Eigen::VectorXd& x, std::size_t i) const {
  const Eigen::Index k = muscle_place(i);
  return {x(k), x(k + 1), x(k + 2), x(k + 3)};
}

void Dynamics::set_muscle_state(std::size_t i, const MuscleState& state, Eigen::VectorXd* x) const {
  x->segment<kPerMuscle>(muscle_place(i)) << state.ring, state.current, state.speed, state.position;
}

void Dynamics::scale_eyelet_friction(double factor) {
  for (Muscle& muscle : muscles_) muscle.scale_eyelet_friction(factor);
}

void Dynamics::add_law(std::size_t i, std::shared_ptr<MuscleLaw> law) {
  muscles_.at(i).add_law(std::move(law));
  has_laws_ = true;
}

void Dynamics::add_law(std::shared_ptr<JointLaw> law) {
  joint_laws_.push_back(std::move(law));
  has_laws_ = true;
}

void Dynamics::reset_contacts(const JointState& joints) {
  const Posture posture = skeleton_.posture(joints);
  for (Muscle& muscle : muscles_) muscle.path().reset_contacts(posture);
}

void Dynamics::update_contacts(const JointState& joints) {
  const Posture posture = skeleton_.posture(joints);
  for (Muscle& muscle : muscles_) muscle.path().update_contacts(posture);
}

MuscleSolution Dynamics::solve_muscle(const Eigen::VectorXd& x, std::size_t i) const {
  const JointState state = joints(x);
  MuscleSolution solution;
  muscles_[i].solve(skeleton_.posture(state), state.velocity, muscle_state(x, i), &solution);
  return solution;
}

const std::vector<MuscleSolution>& Dynamics::solve_muscles(const Eigen::VectorXd& x) {
  const JointState state = joints(x);
  const Posture posture = skeleton_.posture(state);
  for (std::size_t i = 0; i < muscles_.size(); ++i) {
    muscles_[i].solve(posture, state.velocity, muscle_state(x, i), &solutions_[i]);
  }
  return solutions_;
}

void Dynamics::rate(const Eigen::VectorXd& x, Eigen::VectorXd* dx) {
  const JointState state = joints(x);
  const Posture posture = skeleton_.posture(state);
  Vector4 torque = skeleton_.forces(state, posture);
  dx->resize(x.size());
  for (std::size_t i = 0; i < muscles_.size(); ++i) {
    const MuscleState muscle = muscle_state(x, i);
    muscles_[i].solve(posture, state.velocity, muscle, &solutions_[i]);
    set_muscle_state(i, muscles_[i].rate(muscle, voltages_[i], solutions_[i]), dx);
    torque += solutions_[i].torque;
  }
  for (const auto& law : joint_laws_) torque += law->torque(state);
  note_regime(state);
  const Eigen::Quaterniond omega(0.0, state.velocity(0), state.velocity(1), state.velocity(2));
  dx->head<4>() = 0.5 * coefficients(quaternion(x) * omega);
  (*dx)(kElbow) = state.velocity(3);
  mass_ = skeleton_.mass_matrix(posture);
  dx->segment<4>(kVelocity) = mass_.llt().solve(torque);
}

void Dynamics::settle(double h, const Eigen::VectorXd& x) {
  if (!has_laws_) return;
  const std::vector<MuscleSolution>& solutions = solve_muscles(x);
  for (std::size_t i = 0; i < muscles_.size(); ++i) {
    if (muscles_[i].has_laws()) muscles_[i].settle(h, muscle_state(x, i), solutions[i]);
  }
  if (joint_laws_.empty()) return;
  const JointState state = joints(x);
  const Eigen::Vector3d load = shoulder_load(state);
  for (const auto& law : joint_laws_) law->settle(h, state, load);
}

Eigen::Vector3d Dynamics::shoulder_load(const JointState& state) const {
  constexpr double kNoArm = 1e-9;  // of tendons that do not cross the shoulder [m]
  Eigen::Vector3d load = skeleton_.weight(state);
  for (const MuscleSolution& solution : solutions_) {
    for (std::size_t s = 0; s < solution.tensions.size(); ++s) {
      const SpanSolution& span = solution.path.spans[s];
      if (span.arm.head<3>().norm() > kNoArm) {
        load -= solution.tensions[s] * span.geometry.u_start;
      }
    }
  }
  return load;
}

void Dynamics::note_regime(const JointState& state) {
  for (std::size_t i = 0; i < muscles_.size(); ++i) {
    regime_[i] = muscles_[i].ring_tension(solutions_[i]) > 0.0;
  }
  regime_.back() = skeleton_.at_stop(state);
  smooth_ = smooth_ && regime_ == first_regime_;
}

void Dynamics::rate_and_prepare(const Eigen::VectorXd& x, double shift, Eigen::VectorXd* dx) {
  rate(x, dx);
  first_regime_ = regime_;
  smooth_ = true;
  Matrix4 damping = skeleton_.damping(joints(x));
  for (const auto& law : joint_laws_) damping.diagonal() += law->damping(joints(x));
  for (std::size_t i = 0; i < muscles_.size(); ++i) {
    muscles_[i].add_damping(solutions_[i], &damping);
  }
  // (shift + M^-1 D)^-1 = (shift M + D)^-1 M
  velocity_solver_ = (shift * mass_ + damping).partialPivLu().solve(mass_);
  shift_ = shift;
}

void Dynamics::solve(Eigen::VectorXd* w) const {
  const Vector4 velocity = velocity_solver_ * w->segment<4>(kVelocity);
  w->head<kMuscles>() /= shift_;
  w->segment<4>(kVelocity) = velocity;
  for (std::size_t i = 0; i < muscles_.size(); ++i) {
    MuscleState muscle = muscle_state(*w, i);
    muscles_[i].motor().solve_linear(shift_, &muscle.current, &muscle.speed);
    muscle.ring /= shift_;
    muscle.position = (muscle.position + muscle.speed) / shift_;
    set_muscle_state(i, muscle, w);
  }
}

}  // namespace anthrob::reference
