#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "anthrob_core/errors.h"
#include "anthrob_ecu/state_machine.h"
#include "anthrob_recording/quantities.h"
#include "anthrob_sim/replay/replay.h"

namespace anthrob {

namespace {

/// Between a command's stamp and the first state that shows it [s]: a cycle or two of a slow bus.
constexpr double kHeard = 0.05;
/// States of a cycle may show a command that came while they were on their way [s].
constexpr double kAhead = 0.02;
/// Commands that are repeated more seldom end by their time-out [s].
constexpr double kRepeated = 0.5;

struct Command {
  double t, mode, reference;
};

/// What a unit said of itself.
struct State {
  Command in_force;
  bool enabled;
};

bool same(const Command& a, const Command& b) {
  return a.mode == b.mode &&
         std::abs(a.reference - b.reference) <= 1e-6 * std::max(1.0, std::abs(b.reference));
}

std::vector<Command> commands_of(const Dataset& recording, const std::string& muscle,
                                 ecu::Mode default_mode) {
  const Series mode = recording.series(muscle + "/mode"),
               reference = recording.series(muscle + "/reference");
  std::vector<Command> commands;
  for (std::size_t i = 0; i < reference.t.size(); ++i) {
    const double t = reference.t[i];
    commands.push_back({t, mode.empty() ? static_cast<double>(default_mode) : mode.held_at(t),
                        reference.values[i]});
  }
  return commands;
}

/// Rows with a complete state; none where the commands themselves are kept beside the states.
std::vector<State> states_of(const Dataset& recording, const std::string& muscle) {
  std::vector<State> states;
  if (!recording.find_table("commands")) return states;
  for (const Table& table : recording.tables) {
    const Column* state = table.find(muscle + "/ecu_state");
    const Column* mode = table.find(muscle + "/mode");
    const Column* reference = table.find(muscle + "/reference");
    if (table.name == "commands" || !state || !mode || !reference) continue;
    for (std::size_t i = 0; i < table.t.size(); ++i) {
      if (!state->present[i] || !mode->present[i] || !reference->present[i]) continue;
      if (!std::isfinite(reference->values[i])) continue;
      const double t = seconds(table.t[i] - recording.begin());
      states.push_back({{t, mode->values[i], reference->values[i]},
                        state->values[i] == static_cast<double>(ecu::State::kEnabled)});
    }
    return states;
  }
  return states;
}

/// First state that is not before a time.
std::vector<State>::const_iterator from(const std::vector<State>& states, double t) {
  return std::lower_bound(states.begin(), states.end(), t,
                          [](const State& s, double time) { return s.in_force.t < time; });
}

/// Whether a run of equal commands never came into force, though there was time to see it.
bool refused(const Command& first, double next, const std::vector<State>& states) {
  if (next < first.t + kHeard) return false;
  bool seen_any = false;
  for (auto s = from(states, first.t); s != states.end() && s->in_force.t <= first.t + kHeard;
       ++s) {
    if (!s->enabled || same(s->in_force, first)) return false;
    seen_any = true;
  }
  return seen_any;
}

void leave_out_refused(const std::vector<State>& states, std::vector<Command>& commands) {
  std::vector<Command> kept;
  for (std::size_t i = 0; i < commands.size();) {
    std::size_t next = i + 1;
    while (next < commands.size() && same(commands[next], commands[i])) ++next;
    const double end = next < commands.size() ? commands[next].t : HUGE_VAL;
    if (!refused(commands[i], end, states)) {
      kept.insert(kept.end(), commands.begin() + static_cast<long>(i),
                  commands.begin() + static_cast<long>(next));
    }
    i = next;
  }
  commands = std::move(kept);
}

/// From a stop to the next time the unit is enabled: nothing but VOLTAGE 0.
void put_in_stops(const std::vector<State>& states, std::vector<Command>& commands) {
  for (std::size_t i = 0; i < states.size();) {
    if (states[i].enabled) {
      ++i;
      continue;
    }
    const double stop = states[i].in_force.t;
    while (i < states.size() && !states[i].enabled) ++i;
    const double last = states[i - 1].in_force.t;
    const auto at = std::remove_if(commands.begin(), commands.end(),
                                   [&](const Command& c) { return c.t >= stop && c.t <= last; });
    commands.erase(at, commands.end());
    commands.push_back({stop, static_cast<double>(ecu::Mode::kVoltage), 0.0});
    // The command that enabled it may have been sent before the last state that was not.
    if (i < states.size()) commands.push_back(states[i].in_force);
    std::stable_sort(commands.begin(), commands.end(),
                     [](const Command& a, const Command& b) { return a.t < b.t; });
  }
}

/// Whether a state shows one of the commands that could be in force then.
bool commanded(const Command& in_force, const std::vector<Command>& commands) {
  auto c = std::upper_bound(commands.begin(), commands.end(), in_force.t + kAhead,
                            [](double t, const Command& command) { return t < command.t; });
  while (c != commands.begin()) {
    --c;
    if (same(in_force, *c)) return true;
    if (c->t <= in_force.t - kHeard) return false;
  }
  return false;
}

/// Of a command that is repeated, the first ones may be missing: rosbag was still connecting. The
/// unit tells since when it followed it.
void put_in_missed(const std::vector<State>& states, std::vector<Command>& commands) {
  const std::vector<Command> recorded = commands;
  for (const State& s : states) {
    if (!s.enabled || commanded(s.in_force, commands)) continue;
    const auto next =
        std::upper_bound(recorded.begin(), recorded.end(), s.in_force.t,
                         [](double t, const Command& command) { return t < command.t; });
    const bool repeated =
        next != recorded.end() && next->t <= s.in_force.t + kRepeated && same(*next, s.in_force);
    if (!repeated) continue;
    const auto at =
        std::upper_bound(commands.begin(), commands.end(), s.in_force.t,
                         [](double t, const Command& command) { return t < command.t; });
    commands.insert(at, s.in_force);
  }
}

std::vector<Command> rows_of(const CommandSeries& series) {
  std::vector<Command> commands;
  for (std::size_t i = 0; i < series.reference.t.size(); ++i) {
    commands.push_back({series.reference.t[i], series.mode.values[i], series.reference.values[i]});
  }
  return commands;
}

CommandSeries series_of(const std::vector<Command>& commands) {
  CommandSeries result;
  for (const Command& c : commands) {
    result.mode.t.push_back(c.t), result.mode.values.push_back(c.mode);
    result.reference.t.push_back(c.t), result.reference.values.push_back(c.reference);
  }
  return result;
}

}  // namespace

CommandSeries followed_commands(const Dataset& recording, const std::string& muscle,
                                ecu::Mode default_mode) {
  const std::vector<State> states = states_of(recording, muscle);
  if (states.empty()) {
    return {recording.series(muscle + "/mode"), recording.series(muscle + "/reference")};
  }
  std::vector<Command> commands = commands_of(recording, muscle, default_mode);
  leave_out_refused(states, commands);
  const Command& first = states.front().in_force;
  if (states.front().enabled && (commands.empty() || commands.front().t > first.t)) {
    if (commands.empty() || !same(commands.front(), first)) {
      commands.insert(commands.begin(), {0.0, first.mode, first.reference});
    }
  }
  put_in_stops(states, commands);
  put_in_missed(states, commands);
  return series_of(commands);
}

void require_commanded(const Dataset& recording, const std::string& muscle,
                       const CommandSeries& followed) {
  const std::vector<State> states = states_of(recording, muscle);
  if (states.empty()) return;
  const std::vector<Command> commands = rows_of(followed);
  for (const State& s : states) {
    if (!s.enabled || commanded(s.in_force, commands)) continue;
    char at[40];
    std::snprintf(at, sizeof(at), "%.3f", s.in_force.t);
    throw BadInput(
        recording.folder + ": " + muscle + ": at " + at + " s its unit followed " +
        word_of("mode", static_cast<int>(s.in_force.mode)) + " " +
        exact_text(s.in_force.reference) +
        ", but the recording contains no such command (rosbag misses those that are sent while it "
        "connects: begin to record first, and wait before the first command); cut the recording "
        "there, or replay its voltages");
  }
}

}  // namespace anthrob
