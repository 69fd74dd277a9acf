#include "anthrob_sim/replay/replay.h"

#include <algorithm>
#include <cmath>

#include "anthrob_core/errors.h"
#include "anthrob_ecu/state_machine.h"
#include "anthrob_recording/quantities.h"
#include "anthrob_recording/resolution.h"
#include "replay/recorded_pushes.h"
#include "replay/replay_modes.h"

namespace anthrob {

namespace {

/// How far from the truth a value may be by the sensor's count or its noise.
double position_uncertainty(std::vector<double> values) {
  constexpr double kDeviations = 3.0;
  values.erase(std::remove_if(values.begin(), values.end(),
                              [](double value) { return !std::isfinite(value); }),
               values.end());
  const Eigen::Map<const Eigen::VectorXd> series(values.data(),
                                                 static_cast<Eigen::Index>(values.size()));
  return std::max(resolution_of(values), kDeviations * white_noise(series.cast<float>()));
}

}  // namespace

Replay::Replay(std::shared_ptr<const RobotModel> model, const Dataset& recording, ReplayMode mode)
    : model_(std::move(model)),
      mode_(mode),
      meta_(recording.meta),
      pushes_(recorded_pushes(*model_->skeleton, recording)) {
  if (model_->muscles.empty() && meta_.kind == "equilibrium") {
    throw BadInput(recording.folder +
                   ": meta.yaml: kind: equilibrium: its rows are poses at rest, whose times mean "
                   "nothing; expected a trajectory to replay");
  }
  check_names(recording);
  check_inputs(recording);
  for (const auto& [muscle, position] : meta_.start_position) {
    const int index = model_->find_muscle(muscle);
    if (index < 0 || !model_->muscles[static_cast<std::size_t>(index)].has_controller) {
      throw BadInput(recording.folder + "/meta.yaml: start.reference." + muscle + ": " +
                     model_->file +
                     " has no such muscle, or the muscle has no position controller");
    }
  }
  duration_ = seconds(recording.end() - recording.begin());
  bool any = false;
  for (std::size_t m = 0; m < model_->muscles.size(); ++m) {
    const std::string& name = model_->muscles[m].name;
    CommandSeries told = followed_commands(recording, name, default_mode(m));
    if (mode == ReplayMode::kReference) require_commanded(recording, name, told);
    MuscleInput input{static_cast<int>(m),
                      std::move(told.mode),
                      std::move(told.reference),
                      recording.series(name + "/voltage"),
                      recording.series(name + "/position"),
                      recording.series(name + "/ecu_state"),
                      0.0};
    input.position_uncertainty = position_uncertainty(input.position.values);
    any = any || !(mode == ReplayMode::kReference ? input.reference
                   : mode == ReplayMode::kVoltage ? input.voltage
                                                  : input.position)
                      .empty();
    muscles_.push_back(std::move(input));
  }
  for (std::size_t j = 0; j < model_->skeleton->joints.size(); ++j) {
    const JointModel& joint = model_->skeleton->joints[j];
    read_joint(joint, static_cast<int>(j), recording);
    if (joint.type != JointType::kBall && joint.driven) any = any || !joints_.back().effort.empty();
  }
  if (!any) {
    const char* needed = mode == ReplayMode::kReference ? "<muscle>/reference"
                         : mode == ReplayMode::kVoltage ? "<muscle>/voltage"
                                                        : "<muscle>/position";
    throw BadInput(recording.folder + ": no input to replay: expected columns " + needed +
                   " of muscles, or <joint>/effort of a driven joint");
  }
}

void Replay::read_joint(const JointModel& joint, int index, const Dataset& recording) {
  const auto require = [&](bool measured) {
    if (measured || mode_ != ReplayMode::kPosture) return;
    throw BadInput(recording.folder + ": joint " + joint.name +
                   " was not measured: a replay of postures needs all joints");
  };
  if (joint.type != JointType::kBall) {
    joints_.push_back({index, recording.series(joint.name + "/effort"),
                       recording.series(joint.name + "/load"),
                       recording.series(joint.name + "/position")});
    require(!joints_.back().position.empty());
    return;
  }
  if (mode_ != ReplayMode::kPosture && !model_->muscles.empty()) return;
  const bool only_first = mode_ != ReplayMode::kPosture;
  balls_.push_back({index, OrientationSeries::read(recording, joint.name, only_first)});
  require(!balls_.back().turns.empty());
}

void Replay::posture_at(double time, std::vector<double>& q) const {
  const auto& joints = model_->skeleton->joints;
  for (const JointInput& input : joints_) {
    q[joints[input.joint].position_offset] = input.position.at(time);
  }
  for (const BallInput& input : balls_) {
    input.turns.at(time, &q[joints[input.joint].position_offset]);
  }
}

void Replay::check_names(const Dataset& recording) const {
  for (const Table& table : recording.tables) {
    if (table.name == "wrenches") continue;  // recorded_pushes() has seen it
    for (const Column& column : table.columns) {
      const int joint = model_->skeleton->find_joint(column.owner());
      const bool ball = joint >= 0 && model_->skeleton->joints[joint].type == JointType::kBall;
      const bool known =
          (model_->find_muscle(column.owner()) >= 0 && is_muscle_quantity(column.quantity())) ||
          (ball && is_ball_quantity(column.quantity())) ||
          (joint >= 0 && !ball && is_joint_quantity(column.quantity()));
      if (!known) {
        throw BadInput(recording.folder + "/" + table.name + ".csv: column '" + column.name +
                       "': " + model_->file + " has no such quantity");
      }
    }
  }
}

Replay::Use Replay::use_of(const Dataset& recording, const Column& column) const {
  const std::string owner = column.owner(), quantity = column.quantity();
  if (model_->find_muscle(owner) >= 0) {
    if (quantity == "position" && !imposes_positions(mode_)) {
      return recording.series(owner + "/reference").empty() ? Use::kStart : Use::kNone;
    }
    const bool driving = imposes_positions(mode_)
                             ? quantity == "position"
                             : quantity == "mode" || quantity == "reference" ||
                                   (quantity == "voltage" && mode_ == ReplayMode::kVoltage);
    return driving ? Use::kAll : Use::kNone;
  }
  const JointModel& joint = model_->skeleton->joints[model_->skeleton->find_joint(owner)];
  if (quantity == "load" || (quantity == "effort" && joint.driven)) return Use::kAll;
  const bool number = quantity == "w" || quantity == "x" || quantity == "y" || quantity == "z";
  if (mode_ == ReplayMode::kPosture && (quantity == "position" || number)) return Use::kAll;
  const bool starts = model_->muscles.empty() && (quantity == "position" || number);
  return starts ? Use::kStart : Use::kNone;
}

void Replay::check_inputs(const Dataset& recording) const {
  for (const Table& table : recording.tables) {
    if (table.name == "wrenches") continue;
    for (const Column& column : table.columns) {
      const Use use = use_of(recording, column);
      const bool mode = column.quantity() == "mode";
      for (std::size_t i = 0; use != Use::kNone && i < column.values.size(); ++i) {
        if (!column.present[i]) continue;
        const double value = column.values[i];
        if (!std::isfinite(value) || (mode && (value < 0.0 || value > 3.0))) {
          throw BadInput(recording.folder + "/" + table.name + ".csv: row " +
                         std::to_string(i + 1) + ": " + column.name + ": " + exact_text(value) +
                         ": expected " +
                         (mode ? "VOLTAGE, POSITION, CURRENT or FORCE"
                               : "a finite number: it drives the replay"));
        }
        if (use == Use::kStart) break;
      }
    }
  }
}

ecu::Mode Replay::default_mode(std::size_t muscle) const {
  return model_->muscles[muscle].has_controller ? ecu::Mode::kPosition : ecu::Mode::kVoltage;
}

Replay::Run::Run(const Replay& replay, Simulation& sim)
    : replay_(replay), sim_(sim), posture_(sim.configuration()) {
  for (const MuscleInput& input : replay.muscles_) {
    muscles_.push_back({&input, HeldSeries(input.mode), HeldSeries(input.reference),
                        HeldSeries(input.voltage), HeldSeries(input.ecu_state)});
  }
  for (const JointInput& input : replay.joints_) {
    const bool driven = sim.model().skeleton->joints[input.joint].driven;
    joints_.push_back({&input, driven, HeldSeries(input.effort), HeldSeries(input.load)});
  }
}

void Replay::Run::drive(double time) {
  // Rounding of decimal times can put rows just after the step that they belong to, so commands up
  // to 1 ns after the step still belong to it.
  const double now = time + 1e-9;
  for (MuscleRun& muscle : muscles_) {
    const MuscleInput& input = *muscle.input;
    if (imposes_positions(replay_.mode_)) {
      impose(input, time);
    } else if (replay_.mode_ == ReplayMode::kVoltage) {
      // Before the first recorded voltage it stays as it has settled.
      if (!input.voltage.empty() && muscle.voltage.advance(now) && now >= input.voltage.t.front()) {
        sim_.muscle_inputs().apply_voltage(input.muscle, muscle.voltage.value());
      }
    } else {
      command(muscle, now);
    }
  }
  if (replay_.mode_ == ReplayMode::kPosture) {
    replay_.posture_at(time + sim_.imposed_posture().delay() + sim_.step_length(), posture_);
    sim_.imposed_posture().impose_reading(posture_);
  }
  push(now);
  for (JointRun& joint : joints_) {
    const JointInput& input = *joint.input;
    if (joint.driven && !input.effort.empty() && joint.effort.advance(now)) {
      sim_.apply_effort(input.joint, input.effort.acting_at(now));
    }
    if (!input.load.empty() && joint.load.advance(now)) {
      sim_.apply_load(input.joint, input.load.acting_at(now));
    }
  }
}

void Replay::Run::push(double now) {
  const std::vector<PushRow>& rows = replay_.pushes_;
  while (next_push_ < rows.size() && rows[next_push_].t <= now) ++next_push_;
  if (next_push_ == 0) return;
  for (const Wrench& wrench : rows[next_push_ - 1].wrenches) sim_.external_wrenches().push(wrench);
}

void Replay::Run::command(MuscleRun& muscle, double now) {
  const MuscleInput& input = *muscle.input;
  if (!input.ecu_state.empty() && muscle.ecu_state.advance(now)) {
    sim_.muscle_inputs().set_enabled(
        input.muscle, muscle.ecu_state.value() == static_cast<double>(ecu::State::kEnabled));
  }
  if (input.reference.empty() || now < input.reference.t.front()) return;
  const bool other_mode = muscle.mode.advance(now);
  const bool other_reference = muscle.reference.advance(now);
  if (!other_mode && !other_reference) return;
  const ecu::Mode mode = input.mode.empty()
                             ? replay_.default_mode(static_cast<std::size_t>(input.muscle))
                             : mode_of(muscle.mode.value());
  sim_.command(input.muscle, mode, muscle.reference.value());
}

void Replay::Run::impose(const MuscleInput& input, double time) {
  if (input.position.empty()) return;
  const double due = time + sim_.muscle_inputs().position_delay(input.muscle);
  sim_.muscle_inputs().impose_reading(input.muscle, input.position.at(due),
                                      input.position.at(due + sim_.step_length()));
}

}  // namespace anthrob
