#include "simulator_plant.h"

#include <algorithm>
#include <cmath>

namespace anthrob {

namespace {

/// The simulator's answer to a name that it does not know is below 0.
std::optional<int> found(int index) {
  if (index < 0) return std::nullopt;
  return index;
}

}  // namespace

SimulatorPlant::SimulatorPlant(std::shared_ptr<const RobotModel> model,
                               const driver::Hardware& hardware)
    : simulation_(std::move(model)),
      steps_(static_cast<int>(std::lround(0.001 / simulation_.step_length()))) {
  if (steps_ < 1 || std::abs(steps_ * simulation_.step_length() - 0.001) > 1e-12) {
    throw BadInput(
        "simulation step: expected one that divides 1 ms (1, 0.5, 0.25 ms and so on) behind "
        "emulated ECUs");
  }
  for (const driver::MuscleHardware& muscle : hardware.muscles) {
    muscles_.push_back(found(simulation_.model().find_muscle(muscle.name)));
    // The hand may be wired and not simulated.
    if (muscles_.back() || muscle.name.rfind("hand_", 0) == 0) continue;
    throw BadInput(simulation_.model().file + ": muscles: " + muscle.name + " of " + hardware.file +
                   " is missing; expected a model of the robot that is wired there");
  }
  for (const MuscleModel& muscle : simulation_.model().muscles) {
    if (muscle.command_delay > 0.0) {
      throw BadInput(
          simulation_.model().file + ": effects: command_latency of muscle " + muscle.name +
          ": expected a model without it: emulated ECUs get their commands over the bus");
    }
  }
  for (const driver::JointSensor& joint : hardware.joints) {
    joints_.push_back(found(simulation_.model().skeleton->find_joint(joint.joint)));
  }
  for (const driver::TouchSensor& touch : hardware.touch) {
    const auto& pads = simulation_.model().touch_pads;
    const auto pad = std::find_if(pads.begin(), pads.end(),
                                  [&](const TouchPadModel& p) { return p.name == touch.name; });
    pads_.emplace_back();
    if (pad != pads.end()) pads_.back() = static_cast<std::size_t>(pad - pads.begin());
  }
}

driver::Plant::Muscle SimulatorPlant::muscle(std::size_t index) const {
  if (!muscles_[index]) return {};
  const ecu::Measurement reading = simulation_.reading(*muscles_[index]);
  return {reading.position, reading.current, reading.force};
}

double SimulatorPlant::joint(std::size_t joint) const {
  if (!joints_[joint]) return 0.0;
  const JointModel& model =
      simulation_.model().skeleton->joints[static_cast<std::size_t>(*joints_[joint])];
  return simulation_.read_positions()[model.position_offset];
}

double SimulatorPlant::touch(std::size_t pad) const {
  if (!pads_[pad]) return 0.0;
  const TouchPadModel& model = simulation_.model().touch_pads[*pads_[pad]];
  return pad_force(model, simulation_.tree(), simulation_.configuration());
}

void SimulatorPlant::drive(std::size_t muscle, double voltage) {
  if (muscles_[muscle]) simulation_.muscle_inputs().apply_voltage(*muscles_[muscle], voltage);
}

void SimulatorPlant::advance() {
  simulation_.step(steps_);
}

}  // namespace anthrob
