#include "anthrob_ecu/gains.h"

#include <algorithm>
#include <cstdio>

namespace anthrob {
namespace ecu {

namespace {

bool has_gains(const MuscleChannel& muscle) {
  return muscle.takes_commands && muscle.modes[static_cast<std::size_t>(Mode::kPosition)];
}

/// What is wrong with a value.
std::optional<std::string> check_value(const std::string& muscle, const ParameterInfo& info,
                                       double value) {
  // As it goes over the wire; written so that NaN is refused too.
  const float held = static_cast<float>(value);
  if (held >= info.lowest && held <= info.highest) return std::nullopt;
  char text[160];
  std::snprintf(text, sizeof(text), ": %s: %g: expected %g to %g %s", info.name, value,
                static_cast<double>(info.lowest), static_cast<double>(info.highest), info.unit);
  return "muscle '" + muscle + "'" + text;
}

}  // namespace

const char* name(Parameter parameter) {
  return kParameters[static_cast<std::size_t>(parameter)].name;
}

const ParameterInfo* find_gain(const std::string& wanted) {
  for (const ParameterInfo& info : kParameters) {
    if (info.live && info.name == wanted) return &info;
  }
  return nullptr;
}

std::vector<Gain> gains_of(const std::vector<MuscleChannel>& muscles) {
  std::vector<Gain> list;
  for (std::size_t m = 0; m < muscles.size(); ++m) {
    if (!has_gains(muscles[m])) continue;
    for (const ParameterInfo& info : kParameters) {
      if (info.live) list.push_back({static_cast<int>(m), info.parameter});
    }
  }
  return list;
}

std::optional<std::string> read_gain_changes(const std::vector<MuscleChannel>& muscles,
                                             const std::vector<std::string>& names,
                                             const std::vector<std::string>& gains,
                                             const std::vector<double>& values,
                                             std::vector<GainChange>& changes) {
  changes.clear();
  if (gains.size() != names.size() || values.size() != names.size()) {
    return "muscle, gain and value: " + std::to_string(names.size()) + ", " +
           std::to_string(gains.size()) + " and " + std::to_string(values.size()) +
           " entries: expected the same number of each";
  }
  // Each takes its time on a bus.
  const std::size_t most = gains_of(muscles).size();
  const std::string too_many =
      "too many entries: expected at most " + std::to_string(most) + ", one for each gain";
  if (names.size() > most) return too_many;
  std::vector<GainChange> wanted;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const ParameterInfo* info = find_gain(gains[i]);
    if (!info) return "'" + gains[i] + "': expected the name of a gain; held_gain lists them";
    bool any = false;
    for (std::size_t m = 0; m < muscles.size(); ++m) {
      if (!names[i].empty() && names[i] != muscles[m].name) continue;
      if (!has_gains(muscles[m])) {
        if (names[i].empty()) continue;
        return "muscle '" + names[i] + "' has no gains";
      }
      if (const auto wrong = check_value(muscles[m].name, *info, values[i])) return wrong;
      // Checked as a frame carries it, with fewer digits: by itself it may be beyond by some.
      const double value = std::clamp<double>(values[i], info->lowest, info->highest);
      wanted.push_back({{static_cast<int>(m), info->parameter}, value});
      any = true;
    }
    if (!any) return "'" + names[i] + "': expected the name of a muscle";
    if (wanted.size() > most) return too_many;
  }
  changes = std::move(wanted);
  return std::nullopt;
}

}  // namespace ecu
}  // namespace anthrob
