// How a simulation gets to where its recording starts.
#include <algorithm>
#include <cmath>

#include "anthrob_sim/replay/replay.h"
#include "anthrob_sim/skeleton/skeleton_model.h"
#include "replay/replay_modes.h"

namespace anthrob {

Replay::StartInput Replay::start_input(const MuscleInput& input) const {
  const MuscleModel& muscle = model_->muscles[input.muscle];
  const auto given = meta_.start_position.find(muscle.name);
  const bool first = meta_.start == "first";
  const StartInput measured =
      input.position.empty() || !std::isfinite(input.position.values.front())
          ? StartInput{false, ecu::Mode::kVoltage, 0.0}
          : StartInput{true, ecu::Mode::kPosition, input.position.values.front()};
  if (!muscle.has_controller) {
    if (first && imposes_positions(mode_)) return measured;
    const Series& input_at_first = mode_ == ReplayMode::kVoltage ? input.voltage : input.reference;
    const bool excited = first && !input_at_first.empty();
    return {false, ecu::Mode::kVoltage, excited ? input_at_first.held_at(0.0) : 0.0};
  }
  if (meta_.start == "given") {
    if (given != meta_.start_position.end()) return {false, ecu::Mode::kPosition, given->second};
  } else if (meta_.start == "zero") {
    return {false, ecu::Mode::kPosition, 0.0};
  } else if (!imposes_positions(mode_) && !input.reference.empty()) {
    const ecu::Mode mode =
        input.mode.empty() ? ecu::Mode::kPosition : mode_of(input.mode.held_at(0.0));
    const double reference = input.reference.held_at(0.0);
    // An unpowered motor keeps its position; VOLTAGE 0 says nothing about where that is.
    const bool left = mode == ecu::Mode::kVoltage && reference == 0.0;
    if (!left) return {false, mode, reference};
  }
  return first ? measured : StartInput{false, ecu::Mode::kVoltage, 0.0};
}

std::vector<double> Replay::start_inputs() const {
  std::vector<double> inputs = {meta_.settle_s};
  if (mode_ == ReplayMode::kPosture) {
    const RecordedStart first = recorded_start();
    inputs.insert(inputs.end(), first.q.begin(), first.q.end());
    inputs.insert(inputs.end(), first.positions.begin(), first.positions.end());
    return inputs;
  }
  for (const MuscleInput& muscle : muscles_) {
    const StartInput input = start_input(muscle);
    inputs.insert(inputs.end(),
                  {input.imposed ? 1.0 : 0.0, static_cast<double>(input.mode), input.value});
  }
  for (const JointInput& joint : joints_) {
    if (muscles_.empty()) {
      inputs.push_back(joint.position.empty() ? 0.0 : joint.position.values.front());
    } else {
      inputs.insert(inputs.end(), {joint.effort.acting_at(0.0), joint.load.acting_at(0.0)});
    }
  }
  for (const BallInput& ball : balls_) {
    double turn[] = {1.0, 0.0, 0.0, 0.0};
    if (!ball.turns.empty()) ball.turns.at(0.0, turn);
    inputs.insert(inputs.end(), std::begin(turn), std::end(turn));
  }
  return inputs;
}

namespace {

/// Share of a ramp that is done before a step. Ramps over the first fifth of the settling time, so
/// that history-dependent elements see no jump.
double ramp_share(long step, long steps) {
  return std::min(1.0, 5.0 * static_cast<double>(step) / static_cast<double>(steps));
}

/// Whether a ramp of this size [rad] is slow enough in that time.
bool has_time_for(double distance, long steps) {
  constexpr double kFastest = 0.03;  // [rad] a step
  return 5.0 * distance < kFastest * static_cast<double>(steps);
}

/// Asks every 1000 steps only; a shorter settling is not worth interrupting.
bool is_stopped(const std::function<bool()>& wanted, long step) {
  return wanted && step % 1000 == 999 && !wanted();
}

}  // namespace

void Replay::ramp(Simulation& sim, const std::vector<Ramp>& ramps, long step, long steps) {
  for (const Ramp& ramp : ramps) {
    const double length = ramp.to - ramp.from;
    sim.muscle_inputs().impose_reading(ramp.muscle, ramp.from + ramp_share(step, steps) * length,
                                       ramp.from + ramp_share(step + 1, steps) * length);
  }
}

bool Replay::start(Simulation& sim, const std::function<bool()>& wanted) const {
  const Settled settled = settle(sim, wanted);
  if (!settled.stopped) start(sim, settled);
  return !settled.stopped;
}

Replay::Settled Replay::settle(Simulation& sim, const std::function<bool()>& wanted) const {
  const auto steps = std::lround(meta_.settle_s / sim.step_length());
  const bool stands = mode_ != ReplayMode::kPosture && !muscles_.empty();
  load_joints(sim, stands);
  if (mode_ == ReplayMode::kPosture) {
    const bool started = start_where_recorded(sim, steps, wanted);
    return {sim.snapshot(), sim.snapshot(), !started};
  }
  const RobotModel& model = sim.model();
  std::vector<double> q = model.skeleton->rest_configuration();
  if (muscles_.empty()) {
    for (const JointInput& input : joints_) {
      if (input.position.empty()) continue;
      q[model.skeleton->joints[input.joint].position_offset] = input.position.values.front();
    }
    for (const BallInput& input : balls_) {
      if (input.turns.empty()) continue;
      input.turns.at(0.0, &q[model.skeleton->joints[input.joint].position_offset]);
    }
  }
  std::vector<double> placed(model.muscles.size(), 0.0);
  std::vector<Ramp> imposed;
  for (const MuscleInput& muscle : muscles_) {
    const StartInput input = start_input(muscle);
    if (!input.imposed) continue;
    if (!has_time_for(std::abs(input.value), steps)) placed[muscle.muscle] = input.value;
    imposed.push_back({muscle.muscle, placed[muscle.muscle], input.value});
  }
  sim.place(q, placed);
  if (muscles_.empty()) return {sim.snapshot(), sim.snapshot()};

  for (const MuscleInput& muscle : muscles_) {
    const StartInput input = start_input(muscle);
    sim.muscle_inputs().release(muscle.muscle);
    sim.command(muscle.muscle, ecu::Mode::kVoltage, 0.0);
    if (!input.imposed) sim.command(muscle.muscle, input.mode, input.value);
  }
  const long late = steps - last_steps(sim);
  Settled settled;
  for (long i = 0; i < steps; ++i) {
    if (i == late) settled.late = sim.snapshot();
    ramp(sim, imposed, i, steps);
    sim.step();
    settled.stopped = is_stopped(wanted, i);
    if (settled.stopped) break;
  }
  for (const MuscleInput& muscle : muscles_) sim.muscle_inputs().release(muscle.muscle);
  settled.last = sim.snapshot();
  return settled;
}

void Replay::load_joints(Simulation& sim, bool as_recorded) const {
  const auto& joints = sim.model().skeleton->joints;
  for (int j = 0; j < static_cast<int>(joints.size()); ++j) {
    if (joints[j].driven) sim.apply_effort(j, 0.0);
    if (joints[j].type != JointType::kBall) sim.apply_load(j, 0.0);
  }
  if (!as_recorded) return;
  for (const JointInput& input : joints_) {
    if (joints[input.joint].driven) sim.apply_effort(input.joint, input.effort.acting_at(0.0));
    if (!input.load.empty()) sim.apply_load(input.joint, input.load.acting_at(0.0));
  }
}

void Replay::start(Simulation& sim, const Settled& settled) const {
  sim.restore(settled.last);
  const std::vector<RampTarget> targets = ramp_targets(sim);
  if (targets.empty()) return;
  const long steps = last_steps(sim);
  sim.restore(settled.late);
  std::vector<Ramp> ramps;
  for (const RampTarget& target : targets) {
    ramps.push_back({target.muscle, sim.reading(target.muscle).position, target.position});
  }
  for (const MuscleInput& muscle : muscles_) {
    const StartInput input = start_input(muscle);
    if (input.imposed) ramps.push_back({muscle.muscle, input.value, input.value});
  }
  for (long i = 0; i < steps; ++i) {
    ramp(sim, ramps, i, steps);
    sim.step();
  }
  for (const Ramp& ramp : ramps) sim.muscle_inputs().release(ramp.muscle);
}

std::vector<Replay::RampTarget> Replay::ramp_targets(const Simulation& settled) const {
  constexpr double kAtFirst = 0.1;      // [s] a later measurement may show another position
  constexpr double kNegligible = 1e-4;  // [rad]
  constexpr double kFarthest = 1.0;     // [rad] friction explains no larger difference
  constexpr double kSettled = 0.5;      // [s] after a shorter settling the motor may still move
  if (mode_ == ReplayMode::kPosture || meta_.start != "first") return {};
  if (meta_.settle_s < kSettled) return {};
  std::vector<RampTarget> targets;
  for (const MuscleInput& muscle : muscles_) {
    if (muscle.position.empty() || muscle.position.t.front() > kAtFirst) continue;
    const StartInput input = start_input(muscle);
    const double measured = muscle.position.values.front(),
                 reading = settled.reading(muscle.muscle).position;
    const bool stands = !input.imposed && input.mode == ecu::Mode::kPosition;
    if (!stands || !std::isfinite(measured)) continue;
    const double there = std::clamp(reading, measured - muscle.position_uncertainty,
                                    measured + muscle.position_uncertainty);
    const double length = std::abs(there - reading);
    if (length > kNegligible && length < kFarthest) targets.push_back({muscle.muscle, there});
  }
  return targets;
}

long Replay::last_steps(const Simulation& sim) const {
  constexpr double kLast = 1.0;  // [s]
  return std::lround(std::min(kLast, 0.5 * meta_.settle_s) / sim.step_length());
}

Replay::RecordedStart Replay::recorded_start() const {
  RecordedStart first{model_->skeleton->rest_configuration(), {}};
  posture_at(0.0, first.q);
  for (const MuscleInput& muscle : muscles_) {
    first.positions.push_back(muscle.position.empty() ? 0.0 : muscle.position.values.front());
  }
  return first;
}

bool Replay::start_where_recorded(Simulation& sim, long steps,
                                  const std::function<bool()>& wanted) const {
  // A motion wraps the paths step by step; without time for a motion, place() finds the wrapping
  // state.
  const SkeletonModel& skeleton = *model_->skeleton;
  const RecordedStart first = recorded_start();
  std::vector<double> q = skeleton.rest_configuration();
  const std::vector<double> rest = q;
  double farthest = posture_distance(skeleton, rest, first.q);
  for (const double position : first.positions) farthest = std::max(farthest, std::abs(position));
  const bool ramped = has_time_for(farthest, steps);
  for (const MuscleInput& muscle : muscles_) {
    sim.muscle_inputs().release(muscle.muscle);
    sim.command(muscle.muscle, ecu::Mode::kVoltage, 0.0);
  }
  if (ramped) {
    sim.place(sim.imposed_posture().true_posture(rest),
              std::vector<double>(first.positions.size(), 0.0));
  } else {
    sim.place(sim.imposed_posture().true_posture(first.q), first.positions);
  }
  for (long i = 0; i < steps; ++i) {
    const double from = ramped ? ramp_share(i, steps) : 1.0,
                 to = ramped ? ramp_share(i + 1, steps) : 1.0;
    posture_between(skeleton, rest, first.q, to, q);
    sim.imposed_posture().impose_reading(q);
    for (std::size_t m = 0; m < muscles_.size(); ++m) {
      if (muscles_[m].position.empty()) continue;
      sim.muscle_inputs().impose_reading(muscles_[m].muscle, from * first.positions[m],
                                         to * first.positions[m]);
    }
    sim.step();
    if (is_stopped(wanted, i)) return false;
  }
  for (const MuscleInput& muscle : muscles_) sim.muscle_inputs().release(muscle.muscle);
  return true;
}

}  // namespace anthrob
