#include "robot.h"

#include <algorithm>

namespace anthrob::virtual_robot {

Robot::Robot(Draft draft, const SensorSettings* sensors, std::uint64_t noise_seed)
    : arm_(draft.arm),
      period_(draft.arm.muscles.front().controller.period),
      command_laws_(std::move(draft.command_laws)),
      power_laws_(std::move(draft.power_laws)),
      reading_laws_(std::move(draft.reading_laws)) {
  arm_.set_step(kStep);
  for (auto& [muscle, law] : draft.muscle_laws) arm_.add_law(muscle, std::move(law));
  for (auto& law : draft.joint_laws) arm_.add_law(std::move(law));
  for (const auto& muscle : draft.arm.muscles) controllers_.emplace_back(muscle.controller);
  if (sensors) {
    sensors_ = std::make_unique<Sensors>(*sensors, controllers_.size(), period_, noise_seed);
  }
  place(std::vector<double>(controllers_.size(), 0.0));
}

void Robot::place(const std::vector<double>& positions) {
  arm_.place(Eigen::Quaterniond::Identity(), 0.0, positions);
  references_ = positions;
  voltages_.assign(positions.size(), 0.0);
  for (const auto& law : reading_laws_) law->start();
  read();
}

void Robot::tick() {
  obeyed_ = references_;
  for (const auto& law : command_laws_) law->apply(truth_.t, &obeyed_);
  for (std::size_t i = 0; i < controllers_.size(); ++i) {
    const MuscleReading& seen = measured_.muscles[i];
    controllers_[i].command_position(obeyed_[i]);
    voltages_[i] = controllers_[i].update(seen.position, seen.velocity, seen.force);
  }
  motor_voltages_ = voltages_;
  for (const auto& law : power_laws_) law->apply(period_, truth_, &motor_voltages_);
  for (std::size_t i = 0; i < controllers_.size(); ++i) {
    arm_.command_voltage(i, motor_voltages_[i]);
  }
  arm_.advance(period_);
  read();
}

void Robot::read() {
  truth_.t = arm_.time();
  truth_.muscles.resize(controllers_.size());
  for (std::size_t i = 0; i < controllers_.size(); ++i) {
    const reference::MuscleReadings now = arm_.muscle(i);
    truth_.muscles[i] = {now.position, now.velocity, now.current, now.force};
  }
  truth_.shoulder = arm_.shoulder();
  truth_.elbow = arm_.elbow();
  measured_ = truth_;
  for (const auto& law : reading_laws_) law->apply(&measured_);
  if (sensors_) sensors_->measure(&measured_);
  // As units do: a tendon does not push.
  for (MuscleReading& muscle : measured_.muscles) muscle.force = std::max(muscle.force, 0.0);
}

}  // namespace anthrob::virtual_robot
