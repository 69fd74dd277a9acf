#include "admission/repeats.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "anthrob_core/errors.h"
#include "anthrob_ecu/control_law.h"
#include "anthrob_recording/quantities.h"
#include "experiment/chain_experiment.h"
#include "experiment/poses.h"

namespace anthrob {
namespace discovery {

namespace {

/// Two recordings, and by how much the second one is behind the first one [s].
struct Pair {
  const Dataset &first, &other;
  double late = 0.0;

  /// The time that both cover, in the time of the first one [s].
  double begin() const { return std::max(0.0, -late); }
  double end() const { return std::min(length(first), length(other) - late); }

  static double length(const Dataset& recording) {
    return seconds(recording.end() - recording.begin());
  }
};

double tolerance_of(const Series& commands, const RepeatOptions& options) {
  double range = 0.0;
  for (const double value : commands.values) {
    range = std::max(range, std::abs(value - commands.values.front()));
  }
  return options.same_command * range + 1e-6;
}

/// When a series first leaves its initial value by more than a distance; infinite if it does not.
double first_change(const Series& series, double tolerance) {
  for (std::size_t i = 0; i < series.t.size(); ++i) {
    if (std::abs(series.values[i] - series.values.front()) > tolerance) return series.t[i];
  }
  return HUGE_VAL;
}

/// Of two series that hold their values: when they begin to differ, if they do for too long a part
/// of their time. What comes up to options.together earlier or later is the same.
std::optional<double> differ(const Series& asked, const Series& again, const Pair& pair,
                             double tolerance, const RepeatOptions& options) {
  const auto slack = static_cast<std::ptrdiff_t>(std::lround(options.together / options.grid));
  const auto count =
      static_cast<std::ptrdiff_t>(std::floor((pair.end() - pair.begin()) / options.grid));
  const auto time = [&](std::ptrdiff_t i) {
    return pair.begin() + options.grid * static_cast<double>(i) + 1e-9;
  };
  std::vector<double> around;
  for (std::ptrdiff_t i = -slack; i < count + slack; ++i) {
    around.push_back(again.held_at(time(i) + pair.late));
  }
  std::ptrdiff_t others = 0;
  std::optional<double> begins;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const auto window = around.begin() + i;
    const auto [low, high] = std::minmax_element(window, window + 2 * slack + 1);
    const double value = asked.held_at(time(i));
    if (value >= *low - tolerance && value <= *high + tolerance) continue;
    ++others;
    if (!begins) begins = time(i);
  }
  if (static_cast<double>(others) <= options.other_commands * static_cast<double>(count)) return {};
  return begins;
}

/// The mode of a muscle's references; if none was recorded, the one that a replay assumes.
Series mode_series(const MuscleModel& muscle, const Dataset& recording) {
  Series mode = recording.series(muscle.name + "/mode");
  if (!mode.empty()) return mode;
  const auto unsaid = muscle.has_controller ? ecu::Mode::kPosition : ecu::Mode::kVoltage;
  return {{0.0}, {static_cast<double>(unsaid)}};
}

/// "1.25 rad at t = 3.20 s"
std::string told(const std::string& value, double t) {
  char time[40];
  std::snprintf(time, sizeof(time), " at t = %.2f s", t);
  return value + time;
}

std::string with_unit(double reference, double mode) {
  static const char* const kUnits[] = {"V", "rad", "A", "N"};
  return std::to_string(reference) + " " + kUnits[std::clamp(static_cast<int>(mode), 0, 3)];
}

/// Complaint about a column that only one of two recordings has.
/// @param in_first whether that is the first one
std::string only_in_one(const std::string& column, bool in_first, const std::string& first) {
  return column + (in_first ? ": missing, but " + first + " has it" : ": not in " + first) +
         "; expected a repeat of its commands";
}

/// How the commands of the other recording differ for a muscle, in one line; empty if they do not.
std::string other_command(const MuscleModel& muscle, const Pair& pair,
                          const RepeatOptions& options) {
  const std::string name = muscle.name + "/reference";
  const Series asked = pair.first.series(name), again = pair.other.series(name);
  const std::string& first = pair.first.folder;
  if (asked.empty() != again.empty()) {
    return only_in_one(name, !asked.empty(), first);
  }
  if (asked.empty()) return "";
  const Series mode = mode_series(muscle, pair.first), other_mode = mode_series(muscle, pair.other);
  const std::string expected = ": expected a repeat of the commands of " + first + ", with ";
  if (const auto t = differ(mode, other_mode, pair, 0.5, options)) {
    const double then = *t + pair.late;
    const auto word = [](double value) { return word_of("mode", static_cast<int>(value)); };
    return muscle.name + "/mode: " + told(word(other_mode.held_at(then)), then) + expected +
           told(word(mode.held_at(*t)), *t);
  }
  if (const auto t = differ(asked, again, pair, tolerance_of(asked, options), options)) {
    const double then = *t + pair.late;
    return name + ": " + told(with_unit(again.held_at(then), other_mode.held_at(then)), then) +
           expected + told(with_unit(asked.held_at(*t), mode.held_at(*t)), *t);
  }
  return "";
}

/// By when commands first change.
double command_lateness(const RobotModel& robot, const Dataset& first, const Dataset& other,
                        const RepeatOptions& options) {
  double one = HUGE_VAL, two = HUGE_VAL;
  for (const MuscleModel& muscle : robot.muscles) {
    const Series asked = first.series(muscle.name + "/reference"),
                 again = other.series(muscle.name + "/reference");
    if (asked.empty() || again.empty()) continue;
    one = std::min(one, first_change(asked, tolerance_of(asked, options)));
    two = std::min(two, first_change(again, tolerance_of(asked, options)));
  }
  if (one == HUGE_VAL || two == HUGE_VAL || std::abs(two - one) <= options.together) return 0.0;
  return two - one;
}

/// The quantity that drives a robot without references.
struct Motion {
  std::string column;
  Series asked, again;
  double range = 0.0;  ///< of the first one; 0: nothing but noise
};

Motion motion_of(const std::string& column, const Dataset& first, const Dataset& other,
                 const RepeatOptions& options) {
  Motion motion{column, first.series(column), other.series(column)};
  const auto& values = motion.asked.values;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  double noise = 0.0;  // of neighbours, squares
  for (std::size_t i = 1; i < values.size(); ++i) {
    noise += std::pow(values[i] - values[i - 1], 2);
  }
  noise = std::sqrt(0.5 * noise / static_cast<double>(values.size()));
  if (*high - *low > options.noise_range * noise) motion.range = *high - *low;
  return motion;
}

/// Mean square difference between a motion and its repeat.
double apart(const Motion& motion, double late, const RepeatOptions& options) {
  const double begin = std::max(0.0, -late);
  const double end = std::min(motion.asked.t.back(), motion.again.t.back() - late);
  double squares = 0.0;
  for (int i = 0; i < options.points; ++i) {
    const double t = begin + (end - begin) * i / options.points;
    const double difference = motion.asked.at(t) - motion.again.at(t + late);
    squares += difference * difference / options.points;
  }
  return squares;
}

/// By when the motion begins, if that clearly aligns the two better: repeats do not begin exactly
/// alike.
double motion_lateness(const std::vector<Motion>& motions, const RepeatOptions& options) {
  double one = HUGE_VAL, two = HUGE_VAL;
  for (const Motion& motion : motions) {
    if (motion.range == 0.0) continue;
    one = std::min(one, first_change(motion.asked, options.motion_begins * motion.range));
    two = std::min(two, first_change(motion.again, options.motion_begins * motion.range));
  }
  if (one == HUGE_VAL || two == HUGE_VAL || std::abs(two - one) <= options.together) return 0.0;
  const double late = two - one;
  double as_they_are = 0.0, aligned = 0.0;
  for (const Motion& motion : motions) {
    if (motion.range == 0.0) continue;
    as_they_are += apart(motion, 0.0, options) / (motion.range * motion.range);
    aligned += apart(motion, late, options) / (motion.range * motion.range);
  }
  return aligned < options.better_aligned * as_they_are ? late : 0.0;
}

/// Whether two motions are the same, apart from noise and small differences of control.
void refuse_another_motion(const Motion& motion, double late, const Dataset& first,
                           const Dataset& repeat, const RepeatOptions& options) {
  const double rms = std::sqrt(apart(motion, late, options));
  if (motion.range == 0.0 || rms <= options.same_motion * motion.range) return;
  throw BadInput(repeat.folder + ": " + motion.column + ": differs from " + first.folder + " by " +
                 std::to_string(rms) + " rms, where the motion ranges over " +
                 std::to_string(motion.range) + "; expected a repeat of its motion");
}

/// @param driving quantity that drives the muscles, with its slash; empty: references do
std::vector<Motion> motions_of(const RobotModel& robot, const std::string& driving,
                               const Dataset& first, const Dataset& repeat,
                               const RepeatOptions& options) {
  std::vector<Motion> motions;
  for (const MuscleModel& muscle : robot.muscles) {
    if (driving.empty()) break;
    const std::string column = muscle.name + driving;
    const bool has = !first.series(column).empty();
    if (has != !repeat.series(column).empty()) {
      throw BadInput(repeat.folder + ": " + only_in_one(column, has, first.folder));
    }
    if (has) motions.push_back(motion_of(column, first, repeat, options));
  }
  for (const JointModel& joint : robot.skeleton->joints) {
    const std::string column = joint.name + "/position";
    const bool both = !first.series(column).empty() && !repeat.series(column).empty();
    if (joint.driven && both) motions.push_back(motion_of(column, first, repeat, options));
  }
  return motions;
}

}  // namespace

double lateness_of_repeat(const RobotModel& robot, const Dataset& first, const Dataset& repeat,
                          const RepeatOptions& options) {
  if (repeat.meta.model != first.meta.model) {
    throw BadInput(repeat.folder + ": meta.yaml: model: differs from that of " + first.folder +
                   "; expected a repeat with the same robot");
  }
  if (repeat.meta.kind != first.meta.kind && robot.muscles.empty()) {
    throw BadInput(repeat.folder + ": meta.yaml: kind: " + repeat.meta.kind + ": expected " +
                   first.meta.kind + ", as " + first.folder + ", which it repeats");
  }
  if (holds_poses(robot, first)) {
    const std::size_t asked = first.tables.front().t.size(), again = repeat.tables.front().t.size();
    if (asked != again) {
      throw BadInput(repeat.folder + ": " + std::to_string(again) +
                     " complete poses: expected the " + std::to_string(asked) + " of " +
                     first.folder + ", which it repeats");
    }
  }
  const ReplayMode mode = mode_of(robot, first);
  const bool commanded = mode == ReplayMode::kReference;
  const char* const driving = commanded                      ? ""
                              : mode == ReplayMode::kVoltage ? "/voltage"
                                                             : "/position";
  const std::vector<Motion> motions = motions_of(robot, driving, first, repeat, options);
  const double late = commanded                   ? command_lateness(robot, first, repeat, options)
                      : holds_poses(robot, first) ? 0.0
                                                  : motion_lateness(motions, options);
  for (const MuscleModel& muscle : robot.muscles) {
    if (!commanded) break;
    const std::string other = other_command(muscle, {first, repeat, late}, options);
    if (!other.empty()) throw BadInput(repeat.folder + ": " + other);
  }
  for (const Motion& motion : motions) refuse_another_motion(motion, late, first, repeat, options);
  return late;
}

bool have_same_commands(const RobotModel& robot, const Dataset& first, const Dataset& other,
                        const RepeatOptions& options) {
  if (mode_of(robot, first) != ReplayMode::kReference) return false;
  if (first.meta.model != other.meta.model) return false;  // another robot, another motion
  const Pair pair{first, other, command_lateness(robot, first, other, options)};
  return std::all_of(robot.muscles.begin(), robot.muscles.end(), [&](const MuscleModel& muscle) {
    return other_command(muscle, pair, options).empty();
  });
}

}  // namespace discovery
}  // namespace anthrob
