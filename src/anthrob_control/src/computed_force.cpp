#include "anthrob_control/computed_force.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "anthrob_control/posture_sequence.h"
#include "anthrob_recording/table.h"
#include "anthrob_sim/spring/series_elastic_element.h"
#include "anthrob_sim/statics/equilibrium.h"

namespace anthrob {

namespace {

constexpr double kForgotten = 0.5;  ///< without an update [s]; begins anew after it
constexpr double kLongestPause =
    0.1;  ///< of motion and integrals [s]; a measurement that old is stale

/// Muscles without a controller are left alone: their bounds are zero. A drive turns its joint
/// either way.
/// @param side of a drive's torque: -1 for the lower bound, 1 for the upper
Eigen::VectorXd bounds(const RobotModel& model, double tension, double side) {
  Eigen::VectorXd bound = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.muscles.size()));
  for (std::size_t m = 0; m < model.muscles.size(); ++m) {
    if (!model.muscles[m].has_controller) continue;
    const double limit = model.muscles[m].limits.force;
    bound[static_cast<Eigen::Index>(m)] =
        model.muscles[m].is_drive() ? side * limit : std::min(tension, limit);
  }
  return bound;
}

/// Zero gravity would let the arm fall.
void refuse_without_forces(const RobotModel& model, const ControlSettings& settings) {
  const bool forces =
      settings.hold_output == ecu::Mode::kForce || settings.move_output == ecu::Mode::kForce;
  if (!forces) return;
  for (const MuscleModel& muscle : model.muscles) {
    if (muscle.has_controller && muscle.has_force_sensor()) return;
  }
  throw BadInput(
      model.file +
      ": no muscle has a force sensor; expected POSITION, not FORCE, as the controller's "
      "output (hold and move)");
}

}  // namespace

ComputedForce::ComputedForce(std::shared_ptr<const RobotModel> model,
                             const ControlSettings& settings)
    : settings_(settings),
      posture_(model),
      target_posture_(model),
      filter_(*model->skeleton, settings.position_cutoff, settings.velocity_cutoff),
      servo_(*model->skeleton, settings.joints),
      motion_(*model->skeleton),
      split_(model->skeleton->velocity_count, bounds(*model, settings.lowest_tension, -1.0),
             bounds(*model, settings.highest_tension, 1.0)),
      ligaments_(ligaments_of(*model)),
      voltage_memory_(model->muscles.size()),
      held_(model->skeleton->rest_configuration()) {
  zero_ = wanted_ = command_.torque = command_.shortfall =
      Eigen::VectorXd::Zero(model->skeleton->velocity_count);
  command_.tension = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model->muscles.size()));
  command_.reference.assign(model->muscles.size(), 0.0);
  refuse_without_controllers(*model);
  refuse_without_forces(*model, settings);
  // Muscles that cannot be held in POSITION are refused here, before the arm depends on them.
  const bool positions =
      settings.hold_output == ecu::Mode::kPosition || settings.move_output == ecu::Mode::kPosition;
  for (const MuscleModel& muscle : model->muscles) {
    if (positions && muscle.has_controller) position_reference(muscle, 0.0, 0.0);
  }
}

std::vector<ComputedForce::Ligament> ComputedForce::ligaments_of(const RobotModel& model) {
  std::vector<Ligament> ligaments;
  for (std::size_t m = 0; m < model.muscles.size(); ++m) {
    const MuscleModel& muscle = model.muscles[m];
    if (muscle.actuator->takes_input()) continue;
    std::vector<double> state(muscle.actuator->state_size() + 1, 0.0);
    muscle.actuator->place(0.0, StateView(state.data()));
    ligaments.push_back({m, muscle.actuator->tendon_length(StateView(state.data())) +
                                muscle.spring->rest_length()});
  }
  return ligaments;
}

void ComputedForce::reset() {
  fresh_ = true;
  moving_ = false;
}

void ComputedForce::zero_gravity() {
  moving_ = false;
  held_ = filter_.configuration();
}

void ComputedForce::go_to(const std::vector<double>& q, double duration) {
  if (q.size() != held_.size())
    throw std::invalid_argument("go_to: posture does not fit the robot");
  for (const double value : q) {
    if (!std::isfinite(value)) throw std::invalid_argument("go_to: posture is not finite");
  }
  if (!(duration > 0.0)) throw std::invalid_argument("go_to: duration: expected > 0 s");
  refuse_haste(q, duration);
  refuse_beyond_limits(q);
  if (!moving_) servo_.reset();
  motion_.start(target(), q, duration);
  moving_ = true;
}

void ComputedForce::refuse_haste(const std::vector<double>& q, double duration) const {
  const auto& joints = model().skeleton->joints;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const double way = PostureMotion::kFastest * joint_distance(joints[j], target(), q);
    const double fastest = settings_.joints[j].fastest;
    if (way <= fastest * duration) continue;
    const char* const unit = joints[j].type == JointType::kPrismatic ? "m/s" : "rad/s";
    char speeds[100], least[20];
    std::snprintf(speeds, sizeof(speeds), "at %.3g %s, but 'fastest' allows %g %s", way / duration,
                  unit, fastest, unit);
    std::snprintf(least, sizeof(least), "%.3g", way / fastest);
    throw BadInput("duration: " + exact_text(duration) + " s: joint '" + joints[j].name +
                   "' would move " + speeds + "; expected at least " + least + " s");
  }
}

void ComputedForce::refuse_beyond_limits(const std::vector<double>& q) {
  if (settings_.move_output != ecu::Mode::kPosition) return;
  target_posture_.update(q, zero_);
  TensionSplit split = split_;
  Eigen::VectorXd wanted = target_posture_.load();
  subtract_ligaments(target_posture_, wanted);
  const TensionSplit::Result& result = split.solve(target_posture_.moment_arms(), wanted);
  std::vector<double> references(model().muscles.size(), 0.0);
  for (std::size_t m = 0; m < references.size(); ++m) {
    if (!model().muscles[m].has_controller) continue;
    references[m] = position_reference(model().muscles[m], target_posture_.muscle_length(m),
                                       result.tension[static_cast<Eigen::Index>(m)]);
  }
  anthrob::refuse_beyond_limits("go_to", model(), references);
}

const ForceCommand& ComputedForce::update(const RobotMeasurement& measured, double dt) {
  if (!(dt >= 0.0) || measured.muscles.size() != command_.reference.size()) {
    throw std::invalid_argument(
        "ComputedForce: expected a time step >= 0 and one measurement per muscle");
  }
  // Meanwhile the motors have stopped, or nobody held the arm: earlier targets are out of date.
  if (dt > std::max(kForgotten, 2.0 / settings_.rate)) reset();
  if (fresh_) filter_.reset();
  filter_.step(measured.q, measured.u, dt);
  // Where commands were held up the motion waits, and nothing is integrated: what it would have
  // done meanwhile is no step to be taken at once.
  const double step = std::min(dt, std::max(kLongestPause, 2.0 / settings_.rate));
  posture_.update(filter_.configuration(), filter_.velocity());
  if (fresh_) {
    fresh_ = false;
    held_ = filter_.configuration();
    forget_voltages();
  }
  compute_torque(step);
  split();
  const ecu::Mode mode = moving_ ? settings_.move_output : settings_.hold_output;
  // What was integrated for another posture would come as a jolt.
  if (mode != command_.mode) forget_voltages();
  command_.mode = mode;
  if (command_.mode == ecu::Mode::kPosition) target_posture_.update(target(), zero_);
  command_.limited.reset();
  for (std::size_t m = 0; m < command_.reference.size(); ++m)
    command_.reference[m] = reference_for(m, measured.muscles[m], step);
  return command_;
}

void ComputedForce::forget_voltages() {
  std::fill(voltage_memory_.begin(), voltage_memory_.end(), ecu::ControllerMemory{});
}

void ComputedForce::compute_torque(double dt) {
  const std::vector<double>& q = filter_.configuration();
  const Eigen::VectorXd& u = filter_.velocity();
  command_.torque = posture_.load();
  if (!moving_) {
    command_.torque += servo_.hold(held_, q, u);
    return;
  }
  motion_.advance(dt);
  command_.torque += servo_.track(motion_.configuration(), motion_.velocity(), q, u, dt);
  command_.torque.noalias() += posture_.mass_matrix() * motion_.acceleration();
  for (const JointModel& joint : model().skeleton->joints) {
    for (int k = joint.velocity_offset; k < joint.velocity_offset + joint.dof(); ++k)
      command_.torque[k] += joint.friction.viscous * motion_.velocity()[k];
  }
}

void ComputedForce::subtract_ligaments(const PostureModel& posture, Eigen::VectorXd& torque) const {
  for (const Ligament& ligament : ligaments_) {
    const Eigen::Index m = static_cast<Eigen::Index>(ligament.muscle);
    torque -= posture.moment_arms().col(m) * tension_of(ligament, posture);
  }
}

void ComputedForce::split() {
  wanted_ = command_.torque;
  subtract_ligaments(posture_, wanted_);
  const TensionSplit::Result& result = split_.solve(posture_.moment_arms(), wanted_);
  command_.tension = result.tension;
  for (const Ligament& ligament : ligaments_) {
    command_.tension[static_cast<Eigen::Index>(ligament.muscle)] = tension_of(ligament, posture_);
  }
  command_.shortfall = result.shortfall;
  command_.converged = result.converged;
}

double ComputedForce::tension_of(const Ligament& ligament, const PostureModel& posture) const {
  return model().muscles[ligament.muscle].spring->relaxed_tension(
      posture.muscle_length(ligament.muscle) - ligament.slack_length);
}

double ComputedForce::reference_for(std::size_t muscle, const ecu::Measurement& measured,
                                    double dt) {
  const MuscleModel& m = model().muscles[muscle];
  if (!m.has_controller) return 0.0;
  const double tension = command_.tension[static_cast<Eigen::Index>(muscle)];
  switch (command_.mode) {
    case ecu::Mode::kPosition: {
      const double reference =
          position_reference(m, target_posture_.muscle_length(muscle), tension);
      if (std::abs(reference) > m.limits.position) command_.limited = muscle;
      return std::min(m.limits.position, std::max(-m.limits.position, reference));
    }
    case ecu::Mode::kVoltage: {
      // The ECU's own force law, run here.
      ecu::ControllerSettings law = m.controller;
      law.period = dt;
      return ecu::control(ecu::Mode::kForce, tension, measured, law, voltage_memory_[muscle]);
    }
    case ecu::Mode::kForce:
    case ecu::Mode::kCurrent:
      break;
  }
  return tension;
}

}  // namespace anthrob
