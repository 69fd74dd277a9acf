#include "measured_names.h"

#include <cmath>

namespace anthrob {

namespace {

template <class IsMeasured>
std::vector<std::string> names_where(const std::vector<std::string>& names,
                                     const IsMeasured& is_measured) {
  std::vector<std::string> measured;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (is_measured(i)) measured.push_back(names[i]);
  }
  return measured;
}

bool is_number(const std::vector<double>& values, std::size_t i) {
  return i < values.size() && std::isfinite(values[i]);
}

/// As the reader of recordings has it; nothing that holds NaN is of unit length.
bool is_turn(const geometry_msgs::Quaternion& q) {
  return std::abs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1.0) <= 0.01;
}

}  // namespace

std::vector<std::string> MeasuredNames::operator()(const anthrob_msgs::MuscleStates& m) {
  return names_where(m.name, [&](std::size_t i) {
    const bool force = is_number(m.force, i);
    if (force) with_force_.insert(m.name[i]);
    return is_number(m.position, i) && is_number(m.velocity, i) && is_number(m.current, i) &&
           (force || with_force_.count(m.name[i]) == 0);
  });
}

std::vector<std::string> MeasuredNames::operator()(const sensor_msgs::JointState& m) const {
  return names_where(m.name, [&](std::size_t i) { return is_number(m.position, i); });
}

std::vector<std::string> MeasuredNames::operator()(
    const anthrob_msgs::SphericalJointStates& m) const {
  return names_where(
      m.name, [&](std::size_t i) { return i < m.orientation.size() && is_turn(m.orientation[i]); });
}

}  // namespace anthrob
