#include "replay/table_sampler.h"

#include <algorithm>
#include <utility>

#include "anthrob_ecu/state_machine.h"
#include "anthrob_recording/quantities.h"

namespace anthrob {

Probe::Probe(const RobotModel& model, const std::string& column) {
  const std::string owner = column.substr(0, column.find('/'));
  quantity_ = column.substr(column.find('/') + 1);
  muscle_ = is_muscle_quantity(quantity_) ? model.find_muscle(owner) : -1;
  joint_ = muscle_ < 0 ? model.skeleton->find_joint(owner) : -1;
  const bool part = quantity_ == "w" || quantity_ == "x" || quantity_ == "y" || quantity_ == "z";
  turn_ = part ? joint_ : -1;
}

bool Probe::interpolates() const {
  return !holds_words(quantity_) && quantity_ != "reference";
}

double Probe::read(const Simulation& sim) const {
  return muscle_ >= 0 ? read_muscle(sim) : read_joint(sim);
}

double Probe::read_muscle(const Simulation& sim) const {
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

double Probe::read_joint(const Simulation& sim) const {
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

TableSampler::TableSampler(const RobotModel& model, Table table, Nanoseconds start)
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

void TableSampler::sample(const Simulation& sim, double time) {
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

Table TableSampler::take() {
  table_.t.resize(row_);
  for (Column& column : table_.columns) {
    column.values.resize(row_);
    column.present.resize(row_);
  }
  return std::move(table_);
}

/// The same orientation has two signs; between them there is none.
void TableSampler::find_turned_signs() {
  for (std::size_t c = 0; c < probes_.size(); ++c) {
    if (probes_[c].turn() < 0) continue;
    double product = 0.0;
    for (std::size_t d = 0; d < probes_.size(); ++d) {
      if (probes_[d].turn() == probes_[c].turn()) product += last_[d] * now_[d];
    }
    turned_[c] = product < 0.0;
  }
}

}  // namespace anthrob
