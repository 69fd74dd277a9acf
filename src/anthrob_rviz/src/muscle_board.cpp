#include "muscle_board.h"

#include <algorithm>

namespace anthrob {

bool MuscleBoard::hear(const MuscleReadings& readings, double now) {
  dead_man_.hear(now);
  if (same_muscles(readings)) {
    for (std::size_t i = 0; i < rows_.size(); ++i) rows_[i].hear(readings[i], now);
    return false;
  }
  end_all("the robot has other muscles now");
  rows_.clear();
  for (const MuscleReading& reading : readings) rows_.emplace_back(reading, limits_);
  return true;
}

bool MuscleBoard::same_muscles(const MuscleReadings& readings) const {
  return std::equal(
      rows_.begin(), rows_.end(), readings.begin(), readings.end(),
      [](const MuscleRow& row, const MuscleReading& r) { return row.reading().name == r.name; });
}

void MuscleBoard::set_limits(const ReferenceLimits& limits) {
  limits_ = limits;
  for (MuscleRow& row : rows_) row.set_limits(limits);
}

void MuscleBoard::show(bool visible) {
  dead_man_.show(visible);
  if (!visible) end_all("the panel was hidden");
}

void MuscleBoard::clear() {
  rows_.clear();
  stopped_.reset();
  dead_man_.forget();
}

void MuscleBoard::hold_all(bool held) {
  for (MuscleRow& row : rows_) row.hold(held);
}

void MuscleBoard::hold_here() {
  hold_all_in(ControlMode::kPosition);
}

void MuscleBoard::relax_all() {
  hold_all_in(ControlMode::kVoltage);
}

void MuscleBoard::tighten_all() {
  constexpr double kPretension = 5.0;  // [N]
  hold_all_in(ControlMode::kForce);
  for (MuscleRow& row : rows_) row.set_target(std::max(row.target(), kPretension));
}

void MuscleBoard::hold_all_in(ControlMode mode) {
  for (MuscleRow& row : rows_) {
    row.let_go();
    row.set_mode(mode);
    row.hold(true);
  }
}

std::vector<Reference> MuscleBoard::take(double now) {
  if (!any_active()) return {};
  if (const auto obstacle = dead_man_.obstacle(now)) {
    end_all(*obstacle);
    return {};
  }
  stopped_.reset();
  std::vector<Reference> references;
  for (MuscleRow& row : rows_) {
    if (row.active()) references.push_back(row.take(now));
  }
  return references;
}

void MuscleBoard::end_all(const std::string& why) {
  if (!any_active()) return;
  stopped_ = why;
  for (MuscleRow& row : rows_) row.let_go();
}

bool MuscleBoard::any_active() const {
  return std::any_of(rows_.begin(), rows_.end(), [](const MuscleRow& row) { return row.active(); });
}

bool MuscleBoard::all_held() const {
  return !rows_.empty() &&
         std::all_of(rows_.begin(), rows_.end(), [](const MuscleRow& row) { return row.held(); });
}

}  // namespace anthrob
