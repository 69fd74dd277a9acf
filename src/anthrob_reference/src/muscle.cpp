#include "anthrob_reference/muscle.h"

#include <algorithm>
#include <cmath>

#include "check.h"

namespace anthrob::reference {

Muscle::Muscle(const MuscleParameters& parameters)
    : path_(parameters.path),
      ring_(parameters.ring),
      motor_(parameters.motor),
      friction_(parameters.eyelet_friction),
      ring_span_(path_.span_of_segment(parameters.ring_segment)),
      sensor_span_(path_.span_of_segment(parameters.sensor_segment)),
      spindle_radius_(parameters.spindle_radius),
      rest_tendon_length_(parameters.rest_tendon_length),
      ring_rest_length_(parameters.ring.rest_length),
      motor_parameters_(parameters.motor) {
  require_positive("spindle radius of " + parameters.name, spindle_radius_);
  require_positive("rest tendon length of " + parameters.name, rest_tendon_length_);
}

double Muscle::tendon_length(double position) const {
  double length = rest_tendon_length_ - spindle_radius_ * position;
  for (const auto& law : laws_) length += law->elongation() - law->wound(position);
  return length;
}

void Muscle::solve(const Posture& posture, const Vector4& velocity, const MuscleState& state,
                   MuscleSolution* solution) const {
  path_.solve(posture, &solution->path);
  solution->strain = ring_.strain(solution->path.length - tendon_length(state.position));
  double tension = ring_.force(solution->strain, state.ring);
  if (solution->strain > 0.0) {
    for (const auto& law : laws_) {
      tension = std::max(0.0, tension + law->spring_force(solution->strain * ring_rest_length_));
    }
  }
  solution->tensions.resize(path_.span_count());
  solution->sliding.resize(path_.span_count() - 1);
  solution->tensions[ring_span_] = tension;
  spread_towards_origin(state, solution);
  spread_towards_insertion(velocity, solution);
  solution->torque.setZero();
  for (std::size_t s = 0; s < path_.span_count(); ++s) {
    solution->torque += solution->tensions[s] * solution->path.spans[s].arm;
  }
}

double Muscle::friction(std::size_t eyelet, double sliding) const {
  double coefficient = friction_.value(sliding);
  for (const auto& law : laws_) coefficient = law->friction(eyelet, sliding, coefficient);
  return coefficient;
}

double Muscle::friction_slope(std::size_t eyelet, double sliding) const {
  double slope = friction_.slope(sliding);
  for (const auto& law : laws_) slope = law->friction_slope(eyelet, sliding, slope);
  return slope;
}

void Muscle::spread_towards_origin(const MuscleState& state, MuscleSolution* solution) const {
  double radius = spindle_radius_;
  for (const auto& law : laws_) radius += law->leverage(state.position);
  const double sliding = radius * state.speed;
  for (std::size_t j = ring_span_; j-- > 0;) {
    solution->sliding[j] = sliding;
    solution->tensions[j] =
        solution->tensions[j + 1] * std::exp(friction(j, sliding) * solution->path.deflections[j]);
  }
}

void Muscle::spread_towards_insertion(const Vector4& velocity, MuscleSolution* solution) const {
  const std::size_t count = path_.span_count();
  double sliding = 0.0;
  for (std::size_t j = count - 1; j-- > ring_span_;) {
    sliding += solution->path.spans[j + 1].arm.dot(velocity);
    solution->sliding[j] = sliding;
  }
  for (std::size_t j = ring_span_; j + 1 < count; ++j) {
    const double exponent = friction(j, solution->sliding[j]) * solution->path.deflections[j];
    solution->tensions[j + 1] = solution->tensions[j] * std::exp(-exponent);
  }
}

MuscleState Muscle::rate(const MuscleState& state, double voltage,
                         const MuscleSolution& solution) const {
  double radius = spindle_radius_;
  double torque = 0.0;
  for (const auto& law : laws_) {
    radius += law->leverage(state.position);
    torque += law->output_torque(state.position, state.speed);
  }
  double acceleration =
      motor_.acceleration(state.current, state.speed, radius * solution.tensions.front());
  if (!laws_.empty()) acceleration += motor_.unloaded_acceleration(torque);
  return {ring_.rate(solution.strain, state.ring),
          motor_.current_rate(voltage, state.current, state.speed), acceleration, state.speed};
}

void Muscle::settle(double h, const MuscleState& state, const MuscleSolution& solution) {
  for (const auto& law : laws_) {
    law->settle(h, state, solution);
    if (law->retune(&motor_parameters_)) motor_ = Motor(motor_parameters_);
  }
}

void Muscle::add_damping(const MuscleSolution& solution, Matrix4* damping) const {
  // Eyelet j scales all tensions beyond it alike, by the speed of all the path beyond it.
  Vector4 torque = Vector4::Zero();
  Vector4 arm = Vector4::Zero();
  for (std::size_t j = path_.span_count() - 1; j-- > ring_span_;) {
    torque += solution.tensions[j + 1] * solution.path.spans[j + 1].arm;
    arm += solution.path.spans[j + 1].arm;
    const double slope = friction_slope(j, solution.sliding[j]) * solution.path.deflections[j];
    *damping += (slope * torque) * arm.transpose();
  }
}

double Muscle::ring_tension(const MuscleSolution& solution) const {
  return solution.tensions[ring_span_];
}

double Muscle::sensor_force(const MuscleSolution& solution) const {
  return solution.tensions[sensor_span_];
}

}  // namespace anthrob::reference
