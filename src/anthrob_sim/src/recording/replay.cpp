#include "anthrob_sim/recording/replay.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "anthrob_ecu/state_machine.h"
#include "anthrob_sim/core/errors.h"
#include "anthrob_sim/recording/followed_commands.h"
#include "anthrob_sim/recording/quantities.h"
#include "anthrob_sim/recording/resolution.h"
#include "anthrob_sim/recording/table_sampler.h"
#include "anthrob_sim/skeleton/posture.h"

namespace anthrob {

namespace {

bool imposes_positions(ReplayMode mode) {
  return mode == ReplayMode::kPosition || mode == ReplayMode::kPosture;
}

ecu::Mode mode_of(double word) {
  return static_cast<ecu::Mode>(static_cast<int>(word));
}

/// How far from the truth a value may be by the sensor's count or its noise.
double blur_of(std::vector<double> values) {
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
    : model_(std::move(model)), mode_(mode), meta_(recording.meta) {
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
    CommandSeries told = followed_commands(recording, name, unsaid_mode(m));
    if (mode == ReplayMode::kReference) require_commanded(recording, name, told);
    MuscleInput input{static_cast<int>(m),
                      std::move(told.mode),
                      std::move(told.reference),
                      recording.series(name + "/voltage"),
                      recording.series(name + "/position"),
                      recording.series(name + "/ecu_state"),
                      0.0};
    input.blur = blur_of(input.position.values);
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
  if (mode_ != ReplayMode::kPosture) return;
  balls_.push_back({index, OrientationSeries::read(recording, joint.name)});
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
  return quantity == "position" && model_->muscles.empty() ? Use::kStart : Use::kNone;
}

void Replay::check_inputs(const Dataset& recording) const {
  for (const Table& table : recording.tables) {
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

Replay::StartInput Replay::start_input(const MuscleInput& input) const {
  const MuscleModel& muscle = model_->muscles[input.muscle];
  const auto given = meta_.start_position.find(muscle.name);
  if (!muscle.has_controller) {
    const bool excited = meta_.start == "first" && !imposes_positions(mode_);
    const Series& first = mode_ == ReplayMode::kVoltage ? input.voltage : input.reference;
    return {false, ecu::Mode::kVoltage, excited && !first.empty() ? first.held_at(0.0) : 0.0};
  }
  if (meta_.start == "given") {
    if (given != meta_.start_position.end()) return {false, ecu::Mode::kPosition, given->second};
  } else if (meta_.start == "zero") {
    return {false, ecu::Mode::kPosition, 0.0};
  } else if (!imposes_positions(mode_) && !input.reference.empty()) {
    const ecu::Mode mode =
        input.mode.empty() ? ecu::Mode::kPosition : mode_of(input.mode.held_at(0.0));
    const double reference = input.reference.held_at(0.0);
    // A motor without voltage stands where it was left, which its reference does not tell.
    const bool left = mode == ecu::Mode::kVoltage && reference == 0.0;
    if (!left) return {false, mode, reference};
  }
  if (meta_.start == "first" && !input.position.empty() &&
      std::isfinite(input.position.values.front())) {
    return {true, ecu::Mode::kPosition, input.position.values.front()};
  }
  return {false, ecu::Mode::kVoltage, 0.0};
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
  return inputs;
}

namespace {

/// What remembers its history must not remember a jerk: wound in over a fifth of the time.
double share_of_way(long step, long steps) {
  return std::min(1.0, 5.0 * static_cast<double>(step) / static_cast<double>(steps));
}

/// Whether that leaves time for a way [rad].
bool has_time_for(double way, long steps) {
  constexpr double kFastest = 0.03;  // [rad] a step
  return 5.0 * way < kFastest * static_cast<double>(steps);
}

/// Not at once: what settles for no longer than that is soon done.
bool is_stopped(const std::function<bool()>& wanted, long step) {
  return wanted && step % 1000 == 999 && !wanted();
}

}  // namespace

void Replay::lead(Simulation& sim, const std::vector<Way>& ways, long step, long steps) {
  for (const Way& way : ways) {
    const double length = way.to - way.from;
    sim.impose_reading(way.muscle, way.from + share_of_way(step, steps) * length,
                       way.from + share_of_way(step + 1, steps) * length);
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
  }
  std::vector<double> placed(model.muscles.size(), 0.0);
  std::vector<Way> imposed;
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
    sim.release(muscle.muscle);
    sim.command(muscle.muscle, ecu::Mode::kVoltage, 0.0);
    if (!input.imposed) sim.command(muscle.muscle, input.mode, input.value);
  }
  const long late = steps - last_steps(sim);
  Settled settled;
  for (long i = 0; i < steps; ++i) {
    if (i == late) settled.late = sim.snapshot();
    lead(sim, imposed, i, steps);
    sim.step();
    settled.stopped = is_stopped(wanted, i);
    if (settled.stopped) break;
  }
  for (const MuscleInput& muscle : muscles_) sim.release(muscle.muscle);
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
  const std::vector<Lead> leads = leads_from(sim);
  if (leads.empty()) return;
  const long steps = last_steps(sim);
  sim.restore(settled.late);
  std::vector<Way> ways;
  for (const Lead& lead : leads) {
    ways.push_back({lead.muscle, sim.reading(lead.muscle).position, lead.position});
  }
  for (const MuscleInput& muscle : muscles_) {
    const StartInput input = start_input(muscle);
    if (input.imposed) ways.push_back({muscle.muscle, input.value, input.value});
  }
  for (long i = 0; i < steps; ++i) {
    lead(sim, ways, i, steps);
    sim.step();
  }
  for (const Way& way : ways) sim.release(way.muscle);
}

std::vector<Replay::Lead> Replay::leads_from(const Simulation& settled) const {
  constexpr double kAtFirst = 0.1;      // [s] measured later, it may have been led elsewhere
  constexpr double kNegligible = 1e-4;  // [rad]
  constexpr double kFarthest = 1.0;     // [rad] what is farther off, no friction holds there
  constexpr double kSettled = 0.5;      // [s] after less it may not stand at all
  if (mode_ == ReplayMode::kPosture || meta_.start != "first") return {};
  if (meta_.settle_s < kSettled) return {};
  std::vector<Lead> leads;
  for (const MuscleInput& muscle : muscles_) {
    if (muscle.position.empty() || muscle.position.t.front() > kAtFirst) continue;
    const StartInput input = start_input(muscle);
    const double measured = muscle.position.values.front(),
                 reading = settled.reading(muscle.muscle).position;
    const bool stands = !input.imposed && input.mode == ecu::Mode::kPosition;
    if (!stands || !std::isfinite(measured)) continue;
    const double there = std::clamp(reading, measured - muscle.blur, measured + muscle.blur);
    const double length = std::abs(there - reading);
    if (length > kNegligible && length < kFarthest) leads.push_back({muscle.muscle, there});
  }
  return leads;
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
  // Paths wrap as in a motion; where there is no time for one, placing sees to that.
  const SkeletonModel& skeleton = *model_->skeleton;
  const RecordedStart first = recorded_start();
  std::vector<double> q = skeleton.rest_configuration();
  const std::vector<double> rest = q;
  const bool leads = has_time_for(posture_distance(skeleton, rest, first.q), steps);
  for (const MuscleInput& muscle : muscles_) {
    sim.release(muscle.muscle);
    sim.command(muscle.muscle, ecu::Mode::kVoltage, 0.0);
  }
  if (leads) {
    sim.place(rest, std::vector<double>(first.positions.size(), 0.0));
  } else {
    sim.place(first.q, first.positions);
  }
  for (long i = 0; i < steps; ++i) {
    const double from = leads ? share_of_way(i, steps) : 1.0,
                 to = leads ? share_of_way(i + 1, steps) : 1.0;
    posture_between(skeleton, rest, first.q, to, q);
    sim.impose_posture_reading(q);
    for (std::size_t m = 0; m < muscles_.size(); ++m) {
      if (muscles_[m].position.empty()) continue;
      sim.impose_reading(muscles_[m].muscle, from * first.positions[m], to * first.positions[m]);
    }
    sim.step();
    if (is_stopped(wanted, i)) return false;
  }
  for (const MuscleInput& muscle : muscles_) sim.release(muscle.muscle);
  return true;
}

ecu::Mode Replay::unsaid_mode(std::size_t muscle) const {
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
  // Rows fall between steps by rounding of decimal times; one nanosecond is nobody's intention.
  const double now = time + 1e-9;
  for (MuscleRun& muscle : muscles_) {
    const MuscleInput& input = *muscle.input;
    if (imposes_positions(replay_.mode_)) {
      impose(input, time);
    } else if (replay_.mode_ == ReplayMode::kVoltage) {
      // Until then it stays as it has settled.
      if (!input.voltage.empty() && muscle.voltage.advance(now) && now >= input.voltage.t.front()) {
        sim_.apply_voltage(input.muscle, muscle.voltage.value());
      }
    } else {
      command(muscle, now);
    }
  }
  if (replay_.mode_ == ReplayMode::kPosture) {
    replay_.posture_at(time + sim_.posture_lateness() + sim_.step_length(), posture_);
    sim_.impose_posture_reading(posture_);
  }
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

void Replay::Run::command(MuscleRun& muscle, double now) {
  const MuscleInput& input = *muscle.input;
  if (!input.ecu_state.empty() && muscle.ecu_state.advance(now)) {
    sim_.set_enabled(input.muscle,
                     muscle.ecu_state.value() == static_cast<double>(ecu::State::kEnabled));
  }
  if (input.reference.empty() || now < input.reference.t.front()) return;
  const bool other_mode = muscle.mode.advance(now);
  const bool other_reference = muscle.reference.advance(now);
  if (!other_mode && !other_reference) return;
  const ecu::Mode mode = input.mode.empty()
                             ? replay_.unsaid_mode(static_cast<std::size_t>(input.muscle))
                             : mode_of(muscle.mode.value());
  sim_.command(input.muscle, mode, muscle.reference.value());
}

void Replay::Run::impose(const MuscleInput& input, double time) {
  if (input.position.empty()) return;
  const double due = time + sim_.position_lateness(input.muscle);
  sim_.impose_reading(input.muscle, input.position.at(due),
                      input.position.at(due + sim_.step_length()));
}

namespace {

/// Tables of the output: those of the recording, and what they lack in the standard ones.
std::vector<Table> output_tables(const RobotModel& model, const Dataset& recording) {
  std::vector<Table> tables;
  std::set<std::string> have;
  const Table* densest = nullptr;
  for (const Table& table : recording.tables) {
    Table copy;
    copy.name = table.name;
    copy.t = table.t;
    for (const Column& column : table.columns) {
      copy.columns.push_back({column.name, {}, {}});
      have.insert(column.name);
    }
    tables.push_back(copy);
    if (!densest || table.t.size() > densest->t.size()) densest = &table;
  }
  const auto add = [&](const std::string& table_name, const std::string& column) {
    if (have.count(column)) return;
    auto table = std::find_if(tables.begin(), tables.end(),
                              [&](const Table& t) { return t.name == table_name; });
    if (table == tables.end()) {
      Table fresh;
      fresh.name = table_name;
      fresh.t = densest->t;
      tables.push_back(fresh);
      table = tables.end() - 1;
    }
    table->columns.push_back({column, {}, {}});
  };
  for (const MuscleModel& muscle : model.muscles) {
    for (const char* quantity :
         {"mode", "reference", "position", "velocity", "current", "voltage", "force"}) {
      add("muscles", muscle.name + "/" + quantity);
    }
  }
  for (const JointModel& joint : model.skeleton->joints) {
    if (joint.type == JointType::kBall) {
      for (const char* quantity : {"w", "x", "y", "z", "wx", "wy", "wz"}) {
        add("spherical_joints", joint.name + "/" + quantity);
      }
    } else {
      add("joints", joint.name + "/position");
      add("joints", joint.name + "/velocity");
    }
  }
  return tables;
}

}  // namespace

Dataset replay(const std::shared_ptr<const RobotModel>& model, const Dataset& recording,
               ReplayMode mode, const std::function<bool(double)>& progress, std::string* failure) {
  const Replay input(model, recording, mode);
  std::vector<TableSampler> samplers;
  for (Table& table : output_tables(*model, recording)) {
    samplers.emplace_back(*model, std::move(table), recording.begin());
  }

  const auto steps = static_cast<std::int64_t>(std::ceil(input.duration() / model->step - 1e-6));
  std::int64_t done = 0;
  bool started = false;
  try {
    Simulation sim(model);
    started = input.start(sim, [&] { return !progress || progress(0.0); });
    Replay::Run run(input, sim);
    for (auto& sampler : samplers) {
      if (started) sampler.sample(sim, 0.0);
    }
    for (bool wanted = started; wanted && done < steps; ++done) {
      const double time = static_cast<double>(done) * model->step;
      run.drive(time);
      sim.step();
      for (auto& sampler : samplers) sampler.sample(sim, time + model->step);
      wanted = !progress || done % 1000 != 0 ||
               progress(static_cast<double>(done) / static_cast<double>(steps));
    }
  } catch (const NumericalFailure& error) {
    if (!failure) throw;
    *failure = error.what();
  }

  Dataset out;
  out.meta = recording.meta;
  out.meta.other["simulated_by"] = "anthrob_replay\n";
  out.meta.other.erase("cut_short");  // that of the recording was another's
  if (done < steps || !started || (failure && !failure->empty())) {
    out.meta.other["cut_short"] = "at " + exact_text(static_cast<double>(done) * model->step) +
                                  " s of " + exact_text(input.duration()) + " s\n";
  }
  for (auto& sampler : samplers) out.tables.push_back(sampler.take());
  // Commands are what they were, row by row; where a unit did not say, what the simulated one says.
  for (Table& table : out.tables) {
    const Table* source = recording.find_table(table.name);
    for (Column& column : table.columns) {
      if (!source || (column.quantity() != "mode" && column.quantity() != "reference")) continue;
      const Column* original = source->find(column.name);
      if (!original) continue;
      const bool of_unit = source->find(column.owner() + "/ecu_state") != nullptr;
      for (std::size_t i = 0; i < column.values.size(); ++i) {
        if (of_unit && !original->present[i]) continue;
        column.values[i] = original->values[i];
        column.present[i] = original->present[i];
      }
    }
  }
  return out;
}

}  // namespace anthrob
