#include "anthrob_recording/quantities.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <set>

namespace anthrob {

namespace {

const std::array<const char*, 4> kModes = {"VOLTAGE", "POSITION", "CURRENT", "FORCE"};
const std::array<const char*, 5> kStates = {"BOOT", "IDLE", "ENABLED", "STOPPING", "FAULT"};

}  // namespace

bool is_muscle_quantity(const std::string& quantity) {
  static const std::set<std::string> kAll = {"mode",    "reference", "position", "velocity",
                                             "current", "voltage",   "force",    "ecu_state"};
  return kAll.count(quantity) > 0;
}

bool is_ball_quantity(const std::string& quantity) {
  static const std::set<std::string> kAll = {"w", "x", "y", "z", "wx", "wy", "wz"};
  return kAll.count(quantity) > 0;
}

bool is_joint_quantity(const std::string& quantity) {
  static const std::set<std::string> kAll = {"position", "velocity", "effort", "load", "direction"};
  return kAll.count(quantity) > 0;
}

bool is_push_quantity(const std::string& quantity) {
  static const std::set<std::string> kAll = {"force_x",  "force_y",  "force_z",
                                             "torque_x", "torque_y", "torque_z",
                                             "point_x",  "point_y",  "point_z"};
  return kAll.count(quantity) > 0;
}

bool is_known_quantity(const std::string& quantity) {
  return is_muscle_quantity(quantity) || is_ball_quantity(quantity) ||
         is_joint_quantity(quantity) || is_push_quantity(quantity);
}

bool holds_words(const std::string& quantity) {
  return quantity == "mode" || quantity == "ecu_state";
}

std::string word_of(const std::string& quantity, int value) {
  const bool mode = quantity == "mode";
  const int count = static_cast<int>(mode ? kModes.size() : kStates.size());
  if (value < 0 || value >= count) return std::to_string(value);
  return mode ? kModes[value] : kStates[value];
}

std::optional<int> number_of(const std::string& quantity, const std::string& word) {
  const auto find = [&](const auto& words) -> std::optional<int> {
    const auto it = std::find(words.begin(), words.end(), word);
    if (it == words.end()) return std::nullopt;
    return static_cast<int>(it - words.begin());
  };
  if (const auto index = quantity == "mode" ? find(kModes) : find(kStates)) return index;
  int value = 0;
  const char* end = word.data() + word.size();
  const auto result = std::from_chars(word.data(), end, value);
  if (result.ec != std::errc() || result.ptr != end || value < 0 || value > 255) {
    return std::nullopt;
  }
  return value;
}

}  // namespace anthrob
