#include "anthrob_emulator/simulator_plant.h"

#include <algorithm>
#include <cmath>

namespace anthrob {

SimulatorPlant::SimulatorPlant(std::shared_ptr<const RobotModel> model,
                               const driver::Hardware& hardware)
    : simulation_(std::move(model)),
      steps_(static_cast<int>(std::lround(0.001 / simulation_.step_length()))) {
  if (steps_ < 1 || std::abs(steps_ * simulation_.step_length() - 0.001) > 1e-12) {
    throw BadInput("simulation step: expected a whole part of a millisecond");
  }
  for (const driver::MuscleHardware& muscle : hardware.muscles) {
    muscles_.push_back(simulation_.model().find_muscle(muscle.name));
  }
  for (const driver::JointSensor& joint : hardware.joints) {
    joints_.push_back(simulation_.model().skeleton->find_joint(joint.joint));
  }
  for (const driver::TouchSensor& touch : hardware.touch) {
    const auto& pads = simulation_.model().touch_pads;
    const auto pad = std::find_if(pads.begin(), pads.end(),
                                  [&](const TouchPadModel& p) { return p.name == touch.name; });
    pads_.push_back(pad == pads.end() ? -1 : static_cast<int>(pad - pads.begin()));
  }
}

driver::Plant::Muscle SimulatorPlant::muscle(std::size_t index) const {
  if (muscles_[index] < 0) return {};
  const anthrob::Muscle& muscle = simulation_.muscle(muscles_[index]);
  const Actuator::Readout actuator = muscle.actuator();
  return {actuator.position, actuator.current, muscle.force()};
}

double SimulatorPlant::joint(std::size_t joint) const {
  const int index = joints_[joint];
  if (index < 0) return 0.0;
  const JointModel& model = simulation_.model().skeleton->joints[static_cast<std::size_t>(index)];
  return simulation_.configuration()[static_cast<std::size_t>(model.position_offset)];
}

double SimulatorPlant::touch(std::size_t pad) const {
  if (pads_[pad] < 0) return 0.0;
  const TouchPadModel& model = simulation_.model().touch_pads[static_cast<std::size_t>(pads_[pad])];
  return pad_force(model, simulation_.tree(), simulation_.configuration());
}

void SimulatorPlant::drive(std::size_t muscle, double voltage) {
  if (muscles_[muscle] >= 0) simulation_.command(muscles_[muscle], ecu::Mode::kVoltage, voltage);
}

void SimulatorPlant::advance() {
  simulation_.step(steps_);
}

}  // namespace anthrob
