#include "twin/twin.h"

#include <algorithm>
#include <cmath>

namespace anthrob {
namespace twin {

namespace {

/// Speed of an unloaded motor for each volt [rad/s/V]; 0: no motor.
double speed_per_volt(const MuscleModel& muscle, double step) {
  if (muscle.motor() == nullptr) return 0.0;
  constexpr double kRunUp = 1.0;  // [s]
  std::vector<double> memory(muscle.actuator->state_size(), 0.0);
  const StateView state(memory.data());
  muscle.actuator->place(0.0, state);
  const double volts = muscle.actuator->input_high();
  const auto steps = std::lround(kRunUp / step);
  for (long i = 0; i < steps; ++i) muscle.actuator->advance(volts, 0.0, state);
  return muscle.actuator->read(state).velocity / volts;
}

}  // namespace

Twin::Twin(std::shared_ptr<const RobotModel> model, Feed feed, const TwinOptions& options)
    : sim_(std::move(model)), feed_(feed), pull_(sim_.muscle_count(), 0.0) {
  for (std::size_t m = 0; feed == Feed::kVoltages && m < pull_.size(); ++m) {
    const double speed = speed_per_volt(sim_.model().muscles[m], sim_.step_length());
    if (speed > 0.0) pull_[m] = 1.0 / (speed * options.pull);
  }
}

void Twin::start(const Snapshot& settled) {
  sim_.restore(settled);
  for (int m = 0; m < static_cast<int>(sim_.muscle_count()); ++m) sim_.muscle_inputs().release(m);
  sim_.imposed_posture().release();
}

void Twin::step(const StepInputs& inputs) {
  for (int m = 0; m < static_cast<int>(sim_.muscle_count()); ++m) {
    const StepInputs::OfMuscle& input = inputs.muscles[static_cast<std::size_t>(m)];
    if (!sim_.muscle(m).model().actuator->takes_input()) continue;
    if (feed_ == Feed::kCommands) {
      command(m, input);
    } else if (feed_ == Feed::kVoltages) {
      apply_voltage(m, input);
    } else {
      sim_.muscle_inputs().impose_reading(m, input.from, input.to);
    }
  }
  if (feed_ == Feed::kPostures) sim_.imposed_posture().impose_reading(inputs.q);
  const auto& joints = sim_.model().skeleton->joints;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (!joints[j].driven || !std::isfinite(inputs.effort[j])) continue;
    sim_.apply_effort(static_cast<int>(j), inputs.effort[j]);
  }
  for (const Wrench& push : inputs.pushes) sim_.external_wrenches().push(push);
  sim_.step();
}

void Twin::command(int muscle, const StepInputs::OfMuscle& input) {
  const Muscle& own = sim_.muscle(muscle);
  if (input.enabled != own.enabled()) sim_.muscle_inputs().set_enabled(muscle, input.enabled);
  if (!std::isfinite(input.reference)) return;
  if (own.mode() == input.mode && own.reference() == input.reference) return;
  sim_.command(muscle, input.mode, input.reference);
}

void Twin::apply_voltage(int muscle, const StepInputs::OfMuscle& input) {
  if (input.enabled != sim_.muscle(muscle).enabled()) {
    sim_.muscle_inputs().set_enabled(muscle, input.enabled);
  }
  if (!std::isfinite(input.voltage)) return;
  const double pull = pull_[static_cast<std::size_t>(muscle)];
  const double behind = std::isfinite(input.position)
                            ? input.position - sim_.muscle(muscle).measured().position
                            : 0.0;
  sim_.muscle_inputs().apply_voltage(muscle, input.voltage + pull * behind);
}

void Twin::read(const Channels& channels, std::vector<double>& values) const {
  for (const Channel& channel : channels.all) {
    double* value = &values[channel.value];
    if (channel.topic == Topic::kMuscles) {
      const ecu::Measurement& measured = sim_.muscle(channel.index).measured();
      *value = channel.quantity == Quantity::kForce      ? measured.force
               : channel.quantity == Quantity::kPosition ? measured.position
                                                         : measured.current;
    } else if (channel.quantity == Quantity::kJointPosition) {
      *value = sim_.measured_joint_position(channel.index);
    } else {
      const JointModel& joint =
          sim_.model().skeleton->joints[static_cast<std::size_t>(channel.index)];
      std::copy_n(sim_.read_positions() + joint.position_offset, 4, value);
    }
  }
}

Snapshot settle(Simulation& sim, const std::vector<double>& q, const std::vector<double>& positions,
                bool imposed, const TwinOptions& options) {
  const int muscles = static_cast<int>(sim.muscle_count());
  for (int m = 0; m < muscles; ++m) {
    sim.muscle_inputs().release(m);
    sim.muscle_inputs().set_enabled(m, false);
    sim.command(m, ecu::Mode::kVoltage, 0.0);
  }
  sim.place(sim.imposed_posture().true_posture(q), positions);
  const auto steps = std::lround(options.stand / sim.step_length());
  for (long i = 0; i < steps; ++i) {
    if (imposed) sim.imposed_posture().impose_reading(q);
    for (int m = 0; m < muscles; ++m) {
      const double there = positions[static_cast<std::size_t>(m)];
      if (sim.muscle(m).model().actuator->takes_input()) {
        sim.muscle_inputs().impose_reading(m, there, there);
      }
    }
    sim.step();
  }
  return sim.snapshot();
}

}  // namespace twin
}  // namespace anthrob
