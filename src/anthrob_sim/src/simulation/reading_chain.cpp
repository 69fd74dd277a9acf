#include "simulation/reading_chain.h"

#include <algorithm>

namespace anthrob {

ReadingChain::ReadingChain(const RobotModel& model, StateStore& store)
    : skeleton_(*model.skeleton),
      effects_(model.reading_effects),
      store_(store),
      muscle_count_(model.muscles.size()) {
  if (empty()) return;
  readings_offset_ = store.reserve(muscle_count_ * state_size_of<ecu::Measurement>() +
                                   skeleton_.position_count + skeleton_.velocity_count);
  for (const auto& effect : effects_) offsets_.push_back(store.reserve(effect->state_size()));
}

void ReadingChain::reset(const Truth& truth) {
  if (empty()) return;
  Readings readings = true_readings(truth);
  for (std::size_t i = 0; i < effects_.size(); ++i) {
    const ReadingEffect& effect = *effects_[i];
    const StateView state = store_.at(offsets_[i]);
    effect.reset(readings, state);
    // Initialise later effects with this one's output, without advancing this one.
    const std::vector<double> begun(state.data(), state.data() + effect.state_size());
    effect.apply(readings, state);
    std::copy(begun.begin(), begun.end(), state.data());
  }
}

void ReadingChain::update(const Truth& truth) {
  if (empty()) return;
  Readings readings = true_readings(truth);
  for (std::size_t i = 0; i < effects_.size(); ++i) {
    effects_[i]->apply(readings, store_.at(offsets_[i]));
  }
}

Readings ReadingChain::readings() const {
  const StateView memory = store_.at(readings_offset_);
  double* const positions = memory.from(muscle_count_ * state_size_of<ecu::Measurement>()).data();
  return {&memory.as<ecu::Measurement>(), positions, positions + skeleton_.position_count};
}

Readings ReadingChain::true_readings(const Truth& truth) const {
  const Readings readings = this->readings();
  for (std::size_t m = 0; m < muscle_count_; ++m) readings.muscles[m] = truth.muscles[m].truth();
  std::copy(truth.q.begin(), truth.q.end(), readings.positions);
  for (const JointModel& joint : skeleton_.joints) {
    double* velocity = readings.velocities + joint.velocity_offset;
    if (joint.type == JointType::kBall) {
      const Vec3 w = truth.tree.ball_velocity(static_cast<int>(&joint - skeleton_.joints.data()));
      std::copy(w.data(), w.data() + 3, velocity);
    } else {
      *velocity = truth.tree.velocities()[joint.velocity_offset];
    }
  }
  return readings;
}

double ReadingChain::position_delay(std::size_t muscle) const {
  double delay = 0.0;
  for (const auto& effect : effects_) delay += effect->position_delay(muscle);
  return delay;
}

double ReadingChain::true_position(std::size_t muscle, double position) const {
  for (std::size_t i = effects_.size(); i-- > 0;) {
    position = effects_[i]->true_position(muscle, position, store_.at(offsets_[i]));
  }
  return position;
}

double ReadingChain::joint_delay() const {
  double delay = 0.0;
  for (const auto& effect : effects_) delay += effect->joint_delay();
  return delay;
}

void ReadingChain::true_joint_positions(double* positions) const {
  for (std::size_t i = effects_.size(); i-- > 0;) effects_[i]->true_joint_positions(positions);
}

}  // namespace anthrob
