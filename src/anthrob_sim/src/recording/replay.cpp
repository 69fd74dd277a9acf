#include "anthrob_sim/recording/replay.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "anthrob_ecu/state_machine.h"
#include "anthrob_sim/core/errors.h"
#include "anthrob_sim/recording/followed_commands.h"

namespace anthrob {

namespace {

const std::set<std::string> kMuscleQuantities = {"mode",    "reference", "position", "velocity",
                                                 "current", "voltage",   "force",    "ecu_state"};
const std::set<std::string> kBallQuantities = {"w", "x", "y", "z", "wx", "wy", "wz"};
const std::set<std::string> kJointQuantities = {"position", "velocity", "effort", "load"};

ecu::Mode mode_of(double word) {
  return static_cast<ecu::Mode>(static_cast<int>(word));
}

}  // namespace

Replay::Replay(std::shared_ptr<const RobotModel> model, const Dataset& recording, ReplayMode mode)
    : model_(std::move(model)), mode_(mode), meta_(recording.meta) {
  check_names(recording);
  check_inputs(recording);
  for (const auto& [muscle, position] : meta_.start_position) {
    const int index = model_->find_muscle(muscle);
    if (index < 0 || !model_->muscles[static_cast<std::size_t>(index)].has_controller) {
      throw BadInput(recording.folder + "/meta.yaml: start.reference." + muscle +
                     ": the robot of " + model_->file +
                     " has no such muscle, or it holds no position");
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
                      recording.series(name + "/ecu_state")};
    any = any || !(mode == ReplayMode::kReference ? input.reference
                   : mode == ReplayMode::kVoltage ? input.voltage
                                                  : input.position)
                      .empty();
    muscles_.push_back(std::move(input));
  }
  for (std::size_t j = 0; j < model_->skeleton->joints.size(); ++j) {
    const JointModel& joint = model_->skeleton->joints[j];
    if (joint.type == JointType::kBall) continue;
    JointInput input{static_cast<int>(j), recording.series(joint.name + "/effort"),
                     recording.series(joint.name + "/load"),
                     recording.series(joint.name + "/position")};
    any = any || (joint.driven && !input.effort.empty());
    joints_.push_back(std::move(input));
  }
  if (!any) {
    const char* needed = mode == ReplayMode::kReference ? "<muscle>/reference"
                         : mode == ReplayMode::kVoltage ? "<muscle>/voltage"
                                                        : "<muscle>/position";
    throw BadInput(recording.folder + ": no input to replay: expected columns " + needed +
                   " of muscles, or <joint>/effort of a driven joint");
  }
}

void Replay::check_names(const Dataset& recording) const {
  for (const Table& table : recording.tables) {
    for (const Column& column : table.columns) {
      const int joint = model_->skeleton->find_joint(column.owner());
      const bool ball = joint >= 0 && model_->skeleton->joints[joint].type == JointType::kBall;
      const bool known = (model_->find_muscle(column.owner()) >= 0 &&
                          kMuscleQuantities.count(column.quantity())) ||
                         (ball && kBallQuantities.count(column.quantity())) ||
                         (joint >= 0 && !ball && kJointQuantities.count(column.quantity()));
      if (!known) {
        throw BadInput(recording.folder + "/" + table.name + ".csv: column '" + column.name +
                       "': the robot of " + model_->file + " has no such quantity");
      }
    }
  }
}

Replay::Use Replay::use_of(const Dataset& recording, const Column& column) const {
  const std::string owner = column.owner(), quantity = column.quantity();
  if (model_->find_muscle(owner) >= 0) {
    if (quantity == "position" && mode_ != ReplayMode::kPosition) {
      return recording.series(owner + "/reference").empty() ? Use::kStart : Use::kNone;
    }
    const bool driving = mode_ == ReplayMode::kPosition
                             ? quantity == "position"
                             : quantity == "mode" || quantity == "reference" ||
                                   (quantity == "voltage" && mode_ == ReplayMode::kVoltage);
    return driving ? Use::kAll : Use::kNone;
  }
  const JointModel& joint = model_->skeleton->joints[model_->skeleton->find_joint(owner)];
  if (quantity == "load" || (quantity == "effort" && joint.driven)) return Use::kAll;
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
    const bool excited = meta_.start == "first" && mode_ != ReplayMode::kPosition;
    const Series& first = mode_ == ReplayMode::kVoltage ? input.voltage : input.reference;
    return {false, ecu::Mode::kVoltage, excited && !first.empty() ? first.held_at(0.0) : 0.0};
  }
  if (meta_.start == "given") {
    if (given != meta_.start_position.end()) return {false, ecu::Mode::kPosition, given->second};
  } else if (meta_.start == "zero") {
    return {false, ecu::Mode::kPosition, 0.0};
  } else if (mode_ != ReplayMode::kPosition && !input.reference.empty()) {
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
  for (const MuscleInput& muscle : muscles_) {
    const StartInput input = start_input(muscle);
    inputs.insert(inputs.end(),
                  {input.imposed ? 1.0 : 0.0, static_cast<double>(input.mode), input.value});
  }
  if (!muscles_.empty()) return inputs;
  for (const JointInput& joint : joints_) {
    inputs.push_back(joint.position.empty() ? 0.0 : joint.position.values.front());
  }
  return inputs;
}

void Replay::start(Simulation& sim) const {
  const RobotModel& model = sim.model();
  std::vector<double> q = model.skeleton->rest_configuration();
  if (muscles_.empty()) {
    for (const JointInput& input : joints_) {
      if (input.position.empty()) continue;
      q[model.skeleton->joints[input.joint].position_offset] = input.position.values.front();
    }
  }
  sim.place(q, std::vector<double>(model.muscles.size(), 0.0));
  if (muscles_.empty()) return;

  std::vector<std::pair<int, double>> imposed;
  for (const MuscleInput& muscle : muscles_) {
    const StartInput input = start_input(muscle);
    sim.release(muscle.muscle);
    sim.command(muscle.muscle, ecu::Mode::kVoltage, 0.0);
    if (input.imposed) {
      imposed.emplace_back(muscle.muscle, input.value);
    } else {
      sim.command(muscle.muscle, input.mode, input.value);
    }
  }
  const auto steps = std::lround(meta_.settle_s / sim.step_length());
  // Wound in over a fifth of the time: what remembers its history must not remember a jerk.
  const auto share = [&](long i) {
    return std::min(1.0, 5.0 * static_cast<double>(i) / static_cast<double>(steps));
  };
  for (long i = 0; i < steps; ++i) {
    for (const auto& [muscle, position] : imposed) {
      sim.impose_reading(muscle, share(i) * position, share(i + 1) * position);
    }
    sim.step();
  }
  for (const MuscleInput& muscle : muscles_) sim.release(muscle.muscle);
}

ecu::Mode Replay::unsaid_mode(std::size_t muscle) const {
  return model_->muscles[muscle].has_controller ? ecu::Mode::kPosition : ecu::Mode::kVoltage;
}

Replay::Run::Run(const Replay& replay, Simulation& sim) : replay_(replay), sim_(sim) {
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
    if (replay_.mode_ == ReplayMode::kPosition) {
      impose(input, time);
    } else if (replay_.mode_ == ReplayMode::kVoltage) {
      if (!input.voltage.empty() && muscle.voltage.advance(now)) {
        sim_.apply_voltage(input.muscle, muscle.voltage.value());
      }
    } else {
      command(muscle, now);
    }
  }
  for (JointRun& joint : joints_) {
    const JointInput& input = *joint.input;
    if (joint.driven && !input.effort.empty() && joint.effort.advance(now)) {
      sim_.apply_effort(input.joint, joint.effort.value());
    }
    if (!input.load.empty() && joint.load.advance(now)) {
      sim_.apply_load(input.joint, joint.load.value());
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

/// Reads one quantity off a running simulation.
class Probe {
 public:
  Probe(const RobotModel& model, const std::string& column) {
    const std::string owner = column.substr(0, column.find('/'));
    quantity_ = column.substr(column.find('/') + 1);
    muscle_ = kMuscleQuantities.count(quantity_) ? model.find_muscle(owner) : -1;
    joint_ = muscle_ < 0 ? model.skeleton->find_joint(owner) : -1;
    const bool part = quantity_ == "w" || quantity_ == "x" || quantity_ == "y" || quantity_ == "z";
    turn_ = part ? joint_ : -1;
  }

  /// The ball joint that this is a number of the orientation of, or -1.
  int turn() const { return turn_; }

  /// Words jump; angles of orientations and numbers move.
  bool interpolates() const { return !holds_words(quantity_) && quantity_ != "reference"; }

  double read(const Simulation& sim) const {
    return muscle_ >= 0 ? read_muscle(sim) : read_joint(sim);
  }

 private:
  double read_muscle(const Simulation& sim) const {
    const Muscle& muscle = sim.muscle(muscle_);
    const ecu::Measurement reading = sim.reading(muscle_);
    if (quantity_ == "position") return reading.position;
    if (quantity_ == "velocity") return reading.velocity;
    if (quantity_ == "current") return reading.current;
    if (quantity_ == "voltage") return muscle.voltage();
    if (quantity_ == "force") return std::max(reading.force, 0.0);  // as it is measured
    if (quantity_ == "reference") return muscle.reference();
    if (quantity_ == "mode") return static_cast<double>(muscle.mode());
    const ecu::State state = muscle.enabled() ? ecu::State::kEnabled : ecu::State::kStopping;
    return static_cast<double>(state);
  }

  double read_joint(const Simulation& sim) const {
    const JointModel& joint = sim.model().skeleton->joints[joint_];
    const double* q = sim.read_positions() + joint.position_offset;
    if (joint.type == JointType::kBall) {
      if (quantity_ == "w") return q[0];
      if (quantity_ == "x") return q[1];
      if (quantity_ == "y") return q[2];
      if (quantity_ == "z") return q[3];
      return sim.read_ball_velocity(joint_)[quantity_[1] - 'x'];
    }
    if (quantity_ == "position") return q[0];
    if (quantity_ == "velocity") return sim.read_velocity(joint_);
    if (quantity_ == "effort") return sim.joint_effort(joint_);
    return sim.joint_load(joint_);
  }

  std::string quantity_;
  int muscle_, joint_, turn_;
};

/// Fills one table of the output, row after row as time goes by.
class TableSampler {
 public:
  TableSampler(const RobotModel& model, Table table, Nanoseconds start)
      : table_(std::move(table)), start_(start) {
    for (Column& column : table_.columns) {
      column.values.assign(table_.t.size(), 0.0);
      column.present.assign(table_.t.size(), 1);
      probes_.emplace_back(model, column.name);
    }
    last_.resize(probes_.size(), 0.0);
    now_.resize(probes_.size(), 0.0);
    turned_.resize(probes_.size(), 0);
  }

  /// The simulation has arrived at `time`; fills the rows up to there.
  void sample(const Simulation& sim, double time) {
    std::swap(last_, now_);
    for (std::size_t c = 0; c < probes_.size(); ++c) now_[c] = probes_[c].read(sim);
    find_turned_signs();
    for (; row_ < table_.t.size(); ++row_) {
      const double due = seconds(table_.t[row_] - start_);
      if (due > time + 1e-9) break;
      const bool exact = first_ || due >= time - 1e-9;
      const double share = exact ? 1.0 : (due - last_time_) / (time - last_time_);
      for (std::size_t c = 0; c < probes_.size(); ++c) {
        const bool blend = !exact && probes_[c].interpolates() && !turned_[c];
        const double before = exact ? now_[c] : last_[c];
        table_.columns[c].values[row_] = blend ? before + share * (now_[c] - before) : before;
      }
    }
    first_ = false;
    last_time_ = time;
  }

  /// The rows that were filled.
  Table take() {
    table_.t.resize(row_);
    for (Column& column : table_.columns) {
      column.values.resize(row_);
      column.present.resize(row_);
    }
    return std::move(table_);
  }

 private:
  /// The same orientation has two signs; between them there is none.
  void find_turned_signs() {
    for (std::size_t c = 0; c < probes_.size(); ++c) {
      if (probes_[c].turn() < 0) continue;
      double product = 0.0;
      for (std::size_t d = 0; d < probes_.size(); ++d) {
        if (probes_[d].turn() == probes_[c].turn()) product += last_[d] * now_[d];
      }
      turned_[c] = product < 0.0;
    }
  }

  Table table_;
  Nanoseconds start_;
  std::vector<Probe> probes_;
  std::vector<double> last_, now_;
  std::vector<char> turned_;  ///< numbers that must not be interpolated in this step
  std::size_t row_ = 0;
  double last_time_ = 0.0;
  bool first_ = true;
};

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
  try {
    Simulation sim(model);
    input.start(sim);
    Replay::Run run(input, sim);
    for (auto& sampler : samplers) sampler.sample(sim, 0.0);
    for (bool wanted = true; wanted && done < steps; ++done) {
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
  if (done < steps || (failure && !failure->empty())) {
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
