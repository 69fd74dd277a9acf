#include "anthrob_reference/arm.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "check.h"
#include "load.h"

namespace anthrob::reference {
namespace {

constexpr double kDefaultPeriod = 1e-3;  // of an arm without muscles [s]
constexpr double kShortestStep = 1e-9;   // [s]
constexpr double kTimeTolerance = 1e-9;  // times closer than this are one [s]

// No contact may turn by more than a fraction of a revolution between two postures.
constexpr double kLargestTurn = 0.005;  // [rad]

double common_period(const std::vector<MuscleParameters>& muscles) {
  if (muscles.empty()) return kDefaultPeriod;
  const double period = muscles.front().controller.period;
  for (const MuscleParameters& muscle : muscles) {
    require(muscle.controller.period == period, "the same ECU period for all muscles",
            muscle.controller.period);
  }
  return period;
}

}  // namespace

ArmParameters Arm::load(const std::string& model_file) {
  return load_arm(model_file);
}

Arm::Arm(const ArmParameters& parameters)
    : dynamics_(parameters),
      x_(Eigen::VectorXd::Zero(dynamics_.size())),
      period_(common_period(parameters.muscles)),
      step_(kDefaultStep) {
  for (const MuscleParameters& muscle : parameters.muscles) {
    names_.push_back(muscle.name);
    controllers_.emplace_back(muscle.controller);
  }
  place(Eigen::Quaterniond::Identity(), 0.0, std::vector<double>(muscle_count(), 0.0));
}

void Arm::set_step(double step) {
  require_positive("integration step", step);
  step_ = step;
}

void Arm::scale_eyelet_friction(double factor) {
  dynamics_.scale_eyelet_friction(factor);
}

void Arm::add_law(std::size_t i, std::shared_ptr<MuscleLaw> law) {
  dynamics_.add_law(i, std::move(law));
}

void Arm::add_law(std::shared_ptr<JointLaw> law) {
  dynamics_.add_law(std::move(law));
}

void Arm::place(const Eigen::Quaterniond& shoulder, double elbow,
                const std::vector<double>& positions) {
  require(positions.size() == muscle_count(), "one position for each muscle",
          static_cast<double>(positions.size()));
  require_positive("norm of the shoulder quaternion", shoulder.norm());
  require(std::isfinite(elbow), "finite elbow angle", elbow);
  for (const double position : positions) {
    require(std::isfinite(position), "finite muscle position", position);
  }
  JointState joints;
  joints.shoulder = shoulder.normalized();
  joints.elbow = elbow;
  move_contacts_from_rest(joints);
  dynamics_.set_joints(joints, &x_);
  for (std::size_t i = 0; i < muscle_count(); ++i) {
    MuscleState state;
    state.position = positions[i];
    dynamics_.set_muscle_state(i, state, &x_);
    state.ring = dynamics_.muscles()[i].ring().relaxed(dynamics_.solve_muscle(x_, i).strain);
    dynamics_.set_muscle_state(i, state, &x_);
    command_voltage(i, 0.0);
    dynamics_.set_voltage(i, 0.0);
  }
  ticks_ = 0;
  since_tick_ = 0.0;
}

void Arm::move_contacts_from_rest(const JointState& target) {
  const double turn = Eigen::Quaterniond::Identity().angularDistance(target.shoulder);
  const int count = 1 + static_cast<int>(std::max(turn, std::abs(target.elbow)) / kLargestTurn);
  JointState joints;
  dynamics_.reset_contacts(joints);
  for (int k = 1; k <= count; ++k) {
    const double share = static_cast<double>(k) / count;
    joints.shoulder = Eigen::Quaterniond::Identity().slerp(share, target.shoulder);
    joints.elbow = share * target.elbow;
    dynamics_.update_contacts(joints);
  }
}

void Arm::command_position(std::size_t i, double position) {
  controllers_.at(i).command_position(position);
}

void Arm::command_voltage(std::size_t i, double voltage) {
  controllers_.at(i).command_voltage(voltage);
}

void Arm::advance(double seconds) {
  require_not_negative("time to advance", seconds);
  const double total = since_tick_ + seconds;
  const auto periods = static_cast<std::int64_t>((total + kTimeTolerance) / period_);
  const double rest = total - static_cast<double>(periods) * period_;
  for (std::int64_t k = 0; k < periods; ++k) {
    advance_to(period_);
    since_tick_ = 0.0;
    ++ticks_;
  }
  if (rest > kTimeTolerance) advance_to(rest);
}

void Arm::advance_to(double phase) {
  if (phase <= since_tick_) return;
  if (since_tick_ == 0.0) tick();
  integrate(phase - since_tick_);
  since_tick_ = phase;
}

void Arm::tick() {
  const std::vector<MuscleSolution>& solutions = dynamics_.solve_muscles(x_);
  for (std::size_t i = 0; i < muscle_count(); ++i) {
    const MuscleState state = dynamics_.muscle_state(x_, i);
    const double force = dynamics_.muscles()[i].sensor_force(solutions[i]);
    dynamics_.set_voltage(i, controllers_[i].update(state.position, state.speed, force));
  }
}

void Arm::integrate(double seconds) {
  const auto count = static_cast<int>(std::ceil((seconds - kTimeTolerance) / step_));
  const double h = seconds / std::max(1, count);
  for (int k = 0; k < std::max(1, count); ++k) step(h);
}

void Arm::step(double h) {
  const Eigen::VectorXd before = x_;
  integrator_.step(h, &dynamics_, &x_);
  // An impact on a stop or a ring that becomes taut would cost the method its order.
  if (!dynamics_.smooth() && h > kShortestStep) {
    x_ = before;
    step(0.5 * h);
    step(0.5 * h);
    return;
  }
  if (!x_.allFinite()) throw std::runtime_error("the simulation of the reference arm diverged");
  const JointState joints = dynamics_.joints(x_);
  dynamics_.set_joints(joints, &x_);
  dynamics_.update_contacts(joints);
  dynamics_.settle(h, x_);
}

double Arm::time() const {
  return static_cast<double>(ticks_) * period_ + since_tick_;
}

Eigen::Quaterniond Arm::shoulder() const {
  Eigen::Quaterniond q = dynamics_.joints(x_).shoulder;
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  return q;
}

Eigen::Vector3d Arm::shoulder_velocity() const {
  return dynamics_.joints(x_).velocity.head<3>();
}

double Arm::elbow() const {
  return dynamics_.joints(x_).elbow;
}

double Arm::elbow_velocity() const {
  return dynamics_.joints(x_).velocity(3);
}

MuscleReadings Arm::muscle(std::size_t i) const {
  const Muscle& muscle = dynamics_.muscles().at(i);
  const MuscleState state = dynamics_.muscle_state(x_, i);
  const MuscleSolution solution = dynamics_.solve_muscle(x_, i);
  MuscleReadings readings;
  readings.position = state.position;
  readings.velocity = state.speed;
  readings.current = state.current;
  readings.voltage = dynamics_.voltage(i);
  readings.force = muscle.sensor_force(solution);
  readings.ring_tension = muscle.ring_tension(solution);
  readings.length = solution.path.length;
  readings.tendon_length = muscle.tendon_length(state.position);
  for (const SpanSolution& span : solution.path.spans) readings.wrap_angle += span.geometry.angle;
  readings.penetration =
      muscle.path().penetration(dynamics_.skeleton().posture(dynamics_.joints(x_)));
  return readings;
}

Vector4 Arm::moment_arm(std::size_t i) const {
  if (i >= muscle_count()) throw std::out_of_range("no such muscle");
  Vector4 arm = Vector4::Zero();
  for (const SpanSolution& span : dynamics_.solve_muscle(x_, i).path.spans) arm += span.arm;
  return arm;
}

double Arm::kinetic_energy() const {
  return dynamics_.skeleton().kinetic_energy(dynamics_.joints(x_));
}

double Arm::potential_energy() const {
  return dynamics_.skeleton().potential_energy(dynamics_.joints(x_));
}

}  // namespace anthrob::reference
