#include "anthrob_sim/inputs.h"

#include "simulation/checks.h"
#include "simulation/reading_chain.h"

namespace anthrob {

Muscle& MuscleInputs::at(int muscle) const {
  expect_index(muscle, muscles_.size(), "muscle");
  return muscles_[static_cast<std::size_t>(muscle)];
}

void MuscleInputs::set_enabled(int muscle, bool enabled) {
  at(muscle).set_enabled(enabled);
}

void MuscleInputs::set_gain(int muscle, ecu::Parameter gain, double value) {
  at(muscle).set_gain(gain, value);
}

void MuscleInputs::apply_voltage(int muscle, double voltage) {
  at(muscle).apply_voltage(voltage);
}

void MuscleInputs::impose_position(int muscle, double position, double velocity) {
  Muscle& moved = at(muscle);
  const std::string& name = moved.model().name;
  expect_sensible(position, "muscle ", name, ": position");
  expect_reachable(position, "muscle ", moved.model(), ": position");
  expect_sensible(velocity, "muscle ", name, ": velocity");
  moved.impose(position, velocity);
}

void MuscleInputs::impose_reading(int muscle, double from, double to) {
  const Muscle& moved = at(muscle);
  const auto m = static_cast<std::size_t>(muscle);
  to = readings_.true_position(m, to);
  // The inverse of a reading effect can change between steps, so start from the actuator itself.
  const bool goes_on = !readings_.empty() && moved.drive() == Drive::kImposed;
  from = goes_on ? moved.actuator().position : readings_.true_position(m, from);
  impose_position(muscle, to, (to - from) / step_);
}

double MuscleInputs::position_delay(int muscle) const {
  at(muscle);
  return readings_.position_delay(static_cast<std::size_t>(muscle));
}

void MuscleInputs::release(int muscle) {
  at(muscle).release();
}

ImposedPosture::ImposedPosture(const SkeletonModel& skeleton, const ReadingChain& readings)
    : skeleton_(skeleton), readings_(readings) {
  q_.reserve(static_cast<std::size_t>(skeleton.position_count));
}

void ImposedPosture::impose(const std::vector<double>& q) {
  expect_posture(q, skeleton_);
  q_ = q;
}

void ImposedPosture::impose_reading(const std::vector<double>& q) {
  impose(q);
  readings_.true_joint_positions(q_.data());
}

std::vector<double> ImposedPosture::true_posture(std::vector<double> read) const {
  readings_.true_joint_positions(read.data());
  return read;
}

double ImposedPosture::delay() const {
  return readings_.joint_delay();
}

}  // namespace anthrob
