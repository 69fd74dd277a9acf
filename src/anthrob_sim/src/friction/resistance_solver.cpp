#include "friction/resistance_solver.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "friction/joint_friction.h"

namespace anthrob {

namespace {
constexpr int kMaxIterations = 40;
/// A step is solved when the prediction error of the last sweep changes no velocity by more [rad/s,
/// m/s].
constexpr double kTolerance = 1e-5;
/// A joint slower than this at the start of a step counts as at rest [rad/s, m/s].
constexpr double kAtRest = 1e-9;
/// If friction was predicted with this accuracy, the tangent is used [1]; of bristles, of their
/// torque.
constexpr double kForeseen = 1e-6;
/// Drives are solved one after the other, until none changes its joint's velocity by more [rad/s,
/// m/s].
constexpr double kShaftTolerance = 1e-9;
constexpr int kMaxShaftRounds = 100;
/// Factor by which a sweep is extrapolated where speeds are unstable.
constexpr double kLeap = 6.0;

/// Slope of friction over speed used in the linearisation. The tangent alone makes the iteration
/// cycle: friction changes sign within 0.1 mm/s of rest, and tangents from outside lead across it.
/// The chord to rest always comes closer, but slowly. How well the last sweep predicted the
/// friction that it led to chooses between them (the primal-dual method of Chan, Golub and Mulet,
/// 1999): predicted well, the tangent; not at all, the chord; with the wrong sign, steeper than the
/// chord.
/// @param rest friction at rest   @param accuracy with which it counts as predicted well
double trusted_slope(double rest, double speed, const FrictionLaw::Value& friction, double foreseen,
                     double accuracy) {
  if (std::abs(foreseen - friction.mu) < accuracy) return friction.slope;
  const double grown = friction.mu - rest;
  if (speed == 0.0 || grown == 0.0) return friction.slope;
  const double chord = grown / speed;
  const double trust = std::clamp((foreseen - rest) / grown, -1.0, 1.0);
  return chord + trust * (friction.slope - chord);
}
}  // namespace

ResistanceSolver::ResistanceSolver(const SkeletonModel& model, double step)
    : model_(model), step_(step) {
  const int n = model.velocity_count;
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    if (model.joints[i].friction.is_dry()) {
      dry_.push_back({static_cast<int>(i), true, Vec3::Zero(), 0.0, 0.0, 0.0});
    }
    for (const BristleModel& bristle : model.joints[i].friction.bristles) {
      bristles_.push_back({static_cast<int>(i), model.joints[i].velocity_offset,
                           Bristle(bristle, step), 0.0, 0.0, 0.0, 0.0});
    }
  }
  held_.resize(n, 0);
  for (auto* v : {&constant_, &rhs_, &u_, &next_, &joint_torque_, &surprise_, &damping_}) {
    v->setZero(n);
  }
  stops_.reserve(2 * model.joints.size());
  system_.setZero(n, n);
  factor_.setZero(n, n);
}

void ResistanceSolver::solve(const KinematicTree& tree, const std::vector<double>& q,
                             const Eigen::VectorXd& tau, const std::vector<SlidingTendon*>& tendons,
                             const JointInputs& inputs) {
  for (DryJoint& dry : dry_) {
    dry.proportional = proportional_friction(model_.joints[dry.joint].friction,
                                             inputs.loads ? inputs.loads[dry.joint] : 0.0,
                                             inputs.efforts ? inputs.efforts[dry.joint] : 0.0);
  }
  start(tree, tau);
  find_stops(tree, q);
  falling_ = false;
  for (SlidingTendon* tendon : tendons) slide(*tendon, true);
  begin_bending(inputs);
  for (BristleJoint& bristle : bristles_) bend(bristle, true);
  for (iterations_ = 1; iterations_ <= kMaxIterations; ++iterations_) {
    assemble(tree, tendons);
    const bool stable = solve_linear(inputs);
    if (!stable) leave_unstable_speed(tree, tendons, inputs);
    falling_ = stable;
    u_ = next_;
    const bool revised = revise_dry_friction();
    surprise_.setZero();
    for (SlidingTendon* tendon : tendons) slide(*tendon, false);
    for (BristleJoint& bristle : bristles_) bend(bristle, false);
    if (stable && !revised && is_solved(tree)) break;
  }
  finish(tendons, inputs);
}

void ResistanceSolver::follow(const KinematicTree& tree, const std::vector<double>& velocity,
                              const std::vector<SlidingTendon*>& tendons,
                              const JointInputs& inputs) {
  u_ = Eigen::Map<const Eigen::VectorXd>(tree.velocities().data(), u_.size());
  falling_ = false;
  for (SlidingTendon* tendon : tendons) slide(*tendon, true);
  begin_bending(inputs);
  u_ = Eigen::Map<const Eigen::VectorXd>(velocity.data(), u_.size());
  for (SlidingTendon* tendon : tendons) slide(*tendon, false);
  if (inputs.shafts) {
    for (DriveShaft* shaft : *inputs.shafts) shaft->solve(u_[shaft->dof()], 0.0);
  }
  commit(tendons, inputs);
  joint_torque_.setZero();
  iterations_ = 0;
}

ForceRange ResistanceSolver::resistance_at(const std::vector<double>& q, int joint, double velocity,
                                           double sliding, double rest,
                                           const JointInputs& inputs) const {
  const JointModel& model = model_.joints[joint];
  const JointFrictionModel& friction = model.friction;
  double force = -(friction.viscous + friction.quadratic * std::abs(sliding)) * sliding;
  for (std::size_t i = 0; i < bristles_.size(); ++i) {
    if (bristles_[i].joint == joint) force -= inputs.bristles[i].friction;
  }
  if (model.stop.enabled) {
    const double position = q[model.position_offset];
    const Stop above = stop_of(model, Vec3::UnitX(), position - model.stop.upper),
               below = stop_of(model, -Vec3::UnitX(), model.stop.lower - position);
    force -= std::max(0.0, above.inside + above.slope * velocity);
    force += std::max(0.0, below.inside - below.slope * velocity);
  }
  if (!friction.is_dry()) return {force, force};
  const double proportional =
      proportional_friction(friction, inputs.loads ? inputs.loads[joint] : 0.0,
                            inputs.efforts ? inputs.efforts[joint] : 0.0);
  if (std::abs(sliding) <= rest) {
    const double limit = std::max(friction.static_torque, friction.kinetic_torque) + proportional;
    return {force - limit - friction.forward, force + limit + friction.backward};
  }
  const double level =
      dry_friction(friction, sliding) + one_way_friction(friction, sliding) + proportional;
  force -= std::copysign(level, sliding);
  return {force, force};
}

double ResistanceSolver::bristle_energy(const BristleState* states) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < bristles_.size(); ++i) {
    sum += bristles_[i].law.energy(states[i].bend);
  }
  return sum;
}

void ResistanceSolver::start(const KinematicTree& tree, const Eigen::VectorXd& tau) {
  u_ = Eigen::Map<const Eigen::VectorXd>(tree.velocities().data(), u_.size());
  constant_.noalias() = tree.mass_matrix() * u_;
  constant_ += step_ * (tau - tree.bias());
  for (const JointModel& joint : model_.joints) {
    // Quadratic drag is -drag |u| u', linear in the end's velocity: it cannot turn a motion round.
    const double speed = u_.segment(joint.velocity_offset, joint.dof()).norm();
    damping_.segment(joint.velocity_offset, joint.dof())
        .setConstant(joint.friction.viscous + joint.friction.quadratic * speed);
  }
  for (DryJoint& dry : dry_) {
    const JointModel& joint = model_.joints[dry.joint];
    const auto speed = u_.segment(joint.velocity_offset, joint.dof());
    const double norm = speed.norm();
    dry.held = norm < kAtRest;
    dry.speed = norm;
    dry.direction.setZero();
    if (!dry.held) dry.direction.head(joint.dof()) = speed / norm;
    dry.level = dry_friction(joint.friction, norm) +
                one_way_friction(joint.friction, dry.direction.x()) + dry.proportional;
  }
}

void ResistanceSolver::assemble(const KinematicTree& tree,
                                const std::vector<SlidingTendon*>& tendons) {
  system_ = tree.mass_matrix();
  rhs_ = constant_;
  system_.diagonal() += step_ * damping_;
  for (const BristleJoint& b : bristles_) {
    system_(b.dof, b.dof) += step_ * b.slope;
    rhs_[b.dof] -= step_ * (b.torque - b.slope * b.speed);
  }
  for (Stop& stop : stops_) add_push(stop);
  for (const SlidingTendon* tendon : tendons) add_tendon(*tendon);
  add_dry_friction();
}

void ResistanceSolver::find_stops(const KinematicTree& tree, const std::vector<double>& q) {
  stops_.clear();
  for (const JointModel& joint : model_.joints) {
    if (!joint.stop.enabled) continue;
    const double* position = &q[joint.position_offset];
    if (joint.type != JointType::kBall) {
      stops_.push_back(stop_of(joint, Vec3::UnitX(), position[0] - joint.stop.upper));
      stops_.push_back(stop_of(joint, -Vec3::UnitX(), joint.stop.lower - position[0]));
      continue;
    }
    // Rotation from rest: its angle grows with the velocity along its axis.
    const Vec3 axis(position[1], position[2], position[3]);
    const double sine = axis.norm();
    if (sine < 1e-9) continue;
    const Mat3& R_WC = tree.joint(static_cast<int>(&joint - model_.joints.data())).R_WC;
    stops_.push_back(stop_of(joint, R_WC * (axis / sine),
                             2.0 * std::atan2(sine, position[0]) - joint.stop.upper));
  }
}

ResistanceSolver::Stop ResistanceSolver::stop_of(const JointModel& joint, const Vec3& direction,
                                                 double depth) const {
  // The damper works on the way inside the stop only. If it worked on the whole step, its force
  // would set in at once where the stop begins, and some steps would have no solution.
  const JointStopModel& stop = joint.stop;
  const double inside = stop.stiffness * depth + stop.damping * std::min(0.0, depth) / step_;
  return {joint.velocity_offset,
          joint.dof(),
          direction,
          inside,
          step_ * stop.stiffness + stop.damping,
          0.0};
}

double ResistanceSolver::push_of(const Stop& stop) const {
  const double speed = stop.direction.head(stop.count).dot(u_.segment(stop.dof, stop.count));
  return std::max(0.0, stop.inside + stop.slope * speed);
}

void ResistanceSolver::add_push(Stop& stop) {
  stop.push = push_of(stop);
  if (stop.push <= 0.0) return;
  const auto direction = stop.direction.head(stop.count);
  system_.block(stop.dof, stop.dof, stop.count, stop.count) +=
      step_ * stop.slope * direction * direction.transpose();
  rhs_.segment(stop.dof, stop.count) -= step_ * stop.inside * direction;
}

void ResistanceSolver::slide(SlidingTendon& tendon, bool first) {
  const std::size_t nd = tendon.dofs.size();
  double tension = tendon.tension;
  for (std::size_t j = 0; j < tendon.contacts.size(); ++j) {
    const SlidingTendon::Contact& contact = tendon.contacts[j];
    const double* arms = &tendon.slide_arms[j * nd];
    double speed = 0.0;
    for (std::size_t a = 0; a < nd; ++a) speed += arms[a] * u_[tendon.dofs[a]];

    const FrictionLaw::Value friction = contact.law->evaluate(speed, contact.state);
    const double after = tension * std::exp(-friction.mu * contact.turning);
    double slope = friction.slope;
    if (first) {
      tendon.start_speed[j] = speed;
    } else {
      const double faster = speed - tendon.slide_speed[j];
      slope = trusted_slope(contact.law->coefficient(0.0, contact.state), speed, friction,
                            tendon.mu[j] + tendon.slope[j] * faster, kForeseen);
      const double unforeseen = after - tendon.tension_after[j] + tendon.steepness[j] * faster;
      const double* piece = &tendon.piece_arms[j * nd];
      for (std::size_t a = 0; a < nd; ++a) surprise_[tendon.dofs[a]] += unforeseen * piece[a];
    }
    if (!falling_) slope = std::max(0.0, slope);
    tendon.mu[j] = friction.mu;
    tendon.slope[j] = slope;
    tendon.steepness[j] = after * contact.turning * slope;
    tendon.slide_speed[j] = speed;
    tendon.tension_after[j] = after;
    tension = after;
  }
}

void ResistanceSolver::begin_bending(const JointInputs& inputs) {
  for (std::size_t i = 0; i < bristles_.size(); ++i) {
    bristles_[i].state = inputs.bristles[i].bend;
    bristles_[i].law.begin(u_[bristles_[i].dof]);
  }
}

void ResistanceSolver::bend(BristleJoint& bristle, bool first) {
  const double speed = u_[bristle.dof];
  const FrictionLaw::Value friction = {bristle.law.friction(speed, bristle.state),
                                       bristle.law.slope(speed, bristle.state)};
  double slope = friction.slope;
  if (!first) {
    const double foreseen = bristle.torque + bristle.slope * (speed - bristle.speed);
    slope = trusted_slope(bristle.law.held(bristle.state), speed, friction, foreseen,
                          kForeseen * bristle.law.torque());
    surprise_[bristle.dof] += friction.mu - foreseen;
  }
  if (!falling_) slope = std::max(0.0, slope);
  bristle.torque = friction.mu;
  bristle.slope = slope;
  bristle.speed = speed;
}

void ResistanceSolver::add_tendon(const SlidingTendon& tendon) {
  const std::size_t nd = tendon.dofs.size();
  for (std::size_t j = 0; j < tendon.contacts.size(); ++j) {
    const double* slide = &tendon.slide_arms[j * nd];
    const double* piece = &tendon.piece_arms[j * nd];
    const double after = tendon.tension_after[j], steepness = step_ * tendon.steepness[j];
    const double speed = tendon.slide_speed[j];
    for (std::size_t a = 0; a < nd; ++a) {
      rhs_[tendon.dofs[a]] += step_ * after * piece[a] + steepness * speed * slide[a];
      // The Cholesky factorisation reads the lower triangle only; rows of dry joints must be
      // complete.
      auto column = system_.col(tendon.dofs[a]);
      for (std::size_t b = dry_.empty() ? a : 0; b < nd; ++b) {
        column[tendon.dofs[b]] += steepness * slide[b] * slide[a];
      }
    }
  }
}

/// Whether the remaining prediction error would change no velocity by more than the tolerance.
bool ResistanceSolver::is_solved(const KinematicTree& tree) const {
  for (const Stop& stop : stops_) {
    if ((push_of(stop) > 0.0) != (stop.push > 0.0)) return false;
  }
  for (Eigen::Index i = 0; i < u_.size(); ++i) {
    if (step_ * std::abs(surprise_[i]) > kTolerance * tree.mass_matrix()(i, i)) return false;
  }
  return true;
}

void ResistanceSolver::add_dry_friction() {
  for (const DryJoint& dry : dry_) {
    const JointModel& joint = model_.joints[dry.joint];
    for (int k = 0; k < joint.dof(); ++k) {
      const int dof = joint.velocity_offset + k;
      held_[dof] = dry.held;
      if (!dry.held) rhs_[dof] -= step_ * dry.level * dry.direction[k];
    }
    if (!dry.held && joint.dof() == 3 && dry.speed > kAtRest) add_turning(dry, joint);
  }
}

void ResistanceSolver::add_turning(const DryJoint& dry, const JointModel& joint) {
  // A ball joint's friction turns with its velocity: tangent of -level u / |u| across u. Without it
  // slow sliding of a body with one small moment of inertia would not settle.
  const double stiffness = step_ * dry.level / dry.speed;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double across = (i == j ? 1.0 : 0.0) - dry.direction[i] * dry.direction[j];
      system_(joint.velocity_offset + i, joint.velocity_offset + j) += stiffness * across;
    }
  }
}

/// Friction falls with speed faster than inertia allows: the contact either breaks away or sticks
/// within this step. A sweep without negative slopes leads in the right direction, but hardly
/// moves.
void ResistanceSolver::leave_unstable_speed(const KinematicTree& tree,
                                            const std::vector<SlidingTendon*>& tendons,
                                            const JointInputs& inputs) {
  for (SlidingTendon* tendon : tendons) {
    for (double& steepness : tendon->steepness) steepness = std::max(0.0, steepness);
    for (double& slope : tendon->slope) slope = std::max(0.0, slope);
  }
  for (BristleJoint& bristle : bristles_) bristle.slope = std::max(0.0, bristle.slope);
  assemble(tree, tendons);
  solve_linear(inputs);
  next_ += (kLeap - 1.0) * (next_ - u_);
}

/// False if the system is not positive definite.
bool ResistanceSolver::solve_linear(const JointInputs& inputs) {
  factor_ = system_;
  next_ = rhs_;
  if (!dry_.empty()) {
    for (Eigen::Index i = 0; i < next_.size(); ++i) {
      if (!held_[i]) continue;
      factor_.row(i).setZero();
      factor_.col(i).setZero();
      factor_(i, i) = 1.0;
      next_[i] = 0.0;
    }
  }
  Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> cholesky(factor_);
  if (cholesky.info() != Eigen::Success) return false;
  cholesky.solveInPlace(next_);
  if (!inputs.shafts) return true;
  const std::vector<DriveShaft*>& shafts = *inputs.shafts;
  const Eigen::Index count = static_cast<Eigen::Index>(shafts.size());
  responses_.setZero(next_.size(), count);
  for (Eigen::Index s = 0; s < count; ++s) {
    const int dof = shafts[s]->dof();
    if (!held_[dof]) responses_(dof, s) = step_;
  }
  cholesky.solveInPlace(responses_);
  for (Eigen::Index s = 0; s < count; ++s) next_ += shafts[s]->torque() * responses_.col(s);
  turn_shafts(shafts);
  for (const DriveShaft* shaft : shafts) rhs_[shaft->dof()] += step_ * shaft->torque();
  return true;
}

/// The drives' torques and the velocities that go with them. Each finds its own exactly, the others
/// held: coordinate descent on a convex function, as motors resist being turned.
void ResistanceSolver::turn_shafts(const std::vector<DriveShaft*>& shafts) {
  for (int round = 0; round < kMaxShaftRounds; ++round) {
    double largest = 0.0;
    for (std::size_t s = 0; s < shafts.size(); ++s) {
      DriveShaft& shaft = *shafts[s];
      const auto column = responses_.col(static_cast<Eigen::Index>(s));
      const double response = column[shaft.dof()];
      const double change = shaft.solve(next_[shaft.dof()] - response * shaft.torque(), response);
      next_ += change * column;
      largest = std::max(largest, std::abs(change) * response);
    }
    if (largest < kShaftTolerance || shafts.size() == 1) break;
  }
}

bool ResistanceSolver::revise_dry_friction() {
  bool revised = false;
  for (DryJoint& dry : dry_) {
    const JointModel& joint = model_.joints[dry.joint];
    const int dof = joint.velocity_offset, count = joint.dof();
    if (dry.held) {
      // Torque that is needed to hold the joint.
      Vec3 hold = Vec3::Zero();
      for (int k = 0; k < count; ++k)
        hold[k] = (system_.row(dof + k).dot(u_) - rhs_[dof + k]) / step_;
      const double norm = hold.norm();
      const double limit = std::max(joint.friction.static_torque, joint.friction.kinetic_torque) +
                           one_way_friction(joint.friction, -hold.x()) + dry.proportional;
      if (norm <= limit) continue;
      dry.held = false;
      dry.direction = -hold / norm;
      dry.speed = 0.0;
      dry.level = limit;
      revised = true;
      continue;
    }
    Vec3 speed = Vec3::Zero();
    speed.head(count) = u_.segment(dof, count);
    if (speed.dot(dry.direction) <= 0.0) {
      dry.held = true;
      revised = true;
      continue;
    }
    const double norm = speed.norm();
    const Vec3 direction = speed / norm;
    const double level = dry_friction(joint.friction, norm) +
                         one_way_friction(joint.friction, direction.x()) + dry.proportional;
    if ((direction - dry.direction).norm() > 1e-9 ||
        std::abs(level - dry.level) > 1e-9 * dry.level) {
      revised = true;
    }
    dry.direction = direction;
    dry.speed = norm;
    dry.level = level;
  }
  return revised;
}

void ResistanceSolver::commit(const std::vector<SlidingTendon*>& tendons,
                              const JointInputs& inputs) {
  for (std::size_t i = 0; i < bristles_.size(); ++i) {
    const double z = bristles_[i].state, speed = u_[bristles_[i].dof];
    inputs.bristles[i] = {bristles_[i].law.bend(speed, z), bristles_[i].law.friction(speed, z)};
  }
  for (const SlidingTendon* tendon : tendons) {
    for (std::size_t j = 0; j < tendon->contacts.size(); ++j) {
      tendon->contacts[j].law->commit(tendon->slide_speed[j], tendon->contacts[j].state);
    }
  }
}

void ResistanceSolver::finish(const std::vector<SlidingTendon*>& tendons,
                              const JointInputs& inputs) {
  commit(tendons, inputs);
  joint_torque_ = -damping_.cwiseProduct(u_);
  for (const BristleJoint& bristle : bristles_) joint_torque_[bristle.dof] -= bristle.torque;
  for (const Stop& stop : stops_) {
    joint_torque_.segment(stop.dof, stop.count) -= push_of(stop) * stop.direction.head(stop.count);
  }
  for (const DryJoint& dry : dry_) {
    const JointModel& joint = model_.joints[dry.joint];
    for (int k = 0; k < joint.dof(); ++k) {
      const int dof = joint.velocity_offset + k;
      joint_torque_[dof] +=
          dry.held ? (system_.row(dof).dot(u_) - rhs_[dof]) / step_ : -dry.level * dry.direction[k];
    }
  }
}

}  // namespace anthrob
