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

/// Whether a command never came into force, though there was time to see it before the next other.
bool refused(const Command& command, double next, const std::vector<State>& states) {
  if (next < command.t + kHeard) return false;
  bool seen_any = false;
  for (auto s = from(states, command.t); s != states.end() && s->in_force.t <= command.t + kHeard;
       ++s) {
    if (!s->enabled || same(s->in_force, command)) return false;
    seen_any = true;
  }
  return seen_any;
}

using Commands = std::vector<Command>::const_iterator;

/// Those of a run of equal commands that a unit heard: it may miss the first ones while it
/// connects.
Commands first_heard(Commands first, Commands end, double next, const std::vector<State>& states) {
  if (!refused(*first, next, states)) return first;
  const auto last = from(states, next);
  const auto shown = std::find_if(from(states, first->t), last, [&](const State& s) {
    return s.enabled && same(s.in_force, *first);
  });
  if (shown == last) return end;
  return std::upper_bound(first, end, shown->in_force.t,
                          [](double t, const Command& command) { return t < command.t; });
}

void leave_out_refused(const std::vector<State>& states, std::vector<Command>& commands) {
  std::vector<Command> kept;
  const Commands all = commands.cend();
  for (Commands first = commands.cbegin(); first != all;) {
    const Commands end =
        std::find_if(first, all, [&](const Command& c) { return !same(c, *first); });
    const double next = end != all ? end->t : HUGE_VAL;
    kept.insert(kept.end(), first_heard(first, end, next, states), end);
    first = end;
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
/// unit tells since when it followed it, up to the first that was recorded.
void put_in_missed(const std::vector<State>& states, std::vector<Command>& commands) {
  std::vector<Command> missed;
  bool heard = false;  // whether the next state shows a command that was recorded
  for (auto s = states.rbegin(); s != states.rend(); ++s) {
    const bool recorded = s->enabled && commanded(s->in_force, commands);
    const bool before = heard && s->enabled && same(s->in_force, std::prev(s)->in_force);
    if (before && !recorded) missed.push_back(s->in_force);
    heard = recorded || before;
  }
  commands.insert(commands.end(), missed.begin(), missed.end());
  std::stable_sort(commands.begin(), commands.end(),
                   [](const Command& a, const Command& b) { return a.t < b.t; });
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
