#include "anthrob_reference/muscle.h"

#include <cmath>

#include "anthrob_reference/check.h"

namespace anthrob::reference {

Muscle::Muscle(const MuscleParameters& parameters)
    : path_(parameters.path),
      ring_(parameters.ring),
      motor_(parameters.motor),
      friction_(parameters.eyelet_friction),
      ring_span_(path_.span_of_segment(parameters.ring_segment)),
      sensor_span_(path_.span_of_segment(parameters.sensor_segment)),
      spindle_radius_(parameters.spindle_radius),
      rest_tendon_length_(parameters.rest_tendon_length) {
  require_positive("spindle radius of " + parameters.name, spindle_radius_);
  require_positive("rest tendon length of " + parameters.name, rest_tendon_length_);
}

double Muscle::tendon_length(double position) const {
  return rest_tendon_length_ - spindle_radius_ * position;
}

void Muscle::solve(const Posture& posture, const Vector4& velocity, const MuscleState& state,
                   MuscleSolution* solution) const {
  path_.solve(posture, &solution->path);
  solution->strain = ring_.strain(solution->path.length - tendon_length(state.position));
  const double tension = ring_.force(solution->strain, state.ring);
  solution->tensions.resize(path_.span_count());
  solution->sliding.resize(path_.span_count() - 1);
  solution->tensions[ring_span_] = tension;
  spread_towards_origin(state.speed, solution);
  spread_towards_insertion(velocity, solution);
  solution->torque.setZero();
  for (std::size_t s = 0; s < path_.span_count(); ++s) {
    solution->torque += solution->tensions[s] * solution->path.spans[s].arm;
  }
}

void Muscle::spread_towards_origin(double speed, MuscleSolution* solution) const {
  const double sliding = spindle_radius_ * speed;
  const double coefficient = friction_.value(sliding);
  for (std::size_t j = ring_span_; j-- > 0;) {
    solution->sliding[j] = sliding;
    solution->tensions[j] =
        solution->tensions[j + 1] * std::exp(coefficient * solution->path.deflections[j]);
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
    const double exponent = friction_.value(solution->sliding[j]) * solution->path.deflections[j];
    solution->tensions[j + 1] = solution->tensions[j] * std::exp(-exponent);
  }
}

MuscleState Muscle::rate(const MuscleState& state, double voltage,
                         const MuscleSolution& solution) const {
  const double load = spindle_radius_ * solution.tensions.front();
  return {ring_.rate(solution.strain, state.ring),
          motor_.current_rate(voltage, state.current, state.speed),
          motor_.acceleration(state.current, state.speed, load), state.speed};
}

void Muscle::add_damping(const MuscleSolution& solution, Matrix4* damping) const {
  // Eyelet j scales all tensions beyond it alike, by the speed of all the path beyond it.
  Vector4 torque = Vector4::Zero();
  Vector4 arm = Vector4::Zero();
  for (std::size_t j = path_.span_count() - 1; j-- > ring_span_;) {
    torque += solution.tensions[j + 1] * solution.path.spans[j + 1].arm;
    arm += solution.path.spans[j + 1].arm;
    const double slope = friction_.slope(solution.sliding[j]) * solution.path.deflections[j];
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
