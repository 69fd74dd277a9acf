#pragma once

#include <cstddef>

#include "options/share.h"

namespace anthrob {
namespace discovery {

/// Columns that never change although their muscle or joint must have moved.
struct FrozenColumnOptions {
  std::size_t fewest_values = 20;  ///< fewer equal ones may be chance
  double least_turn = 0.1;         ///< [rad] for which a motor does not stick
  /// of the largest range of all muscles: what was asked for less may well be friction
  Share share_of_widest = 0.25;
  double least_joint = 0.02;    ///< [rad or m] a joint that moved
  double fewest_counts = 10.0;  ///< coarser sensors may well stay at one count

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("fewest_values", options.fewest_values);
    visit("least_turn", options.least_turn);
    visit("share_of_widest", options.share_of_widest);
    visit("least_joint", options.least_joint);
    visit("fewest_counts", options.fewest_counts);
  }
};

/// What counts as motion.
struct MovementOptions {
  double least_turn = 0.02;         ///< [rad] of a motor
  double least_followed = 0.01;     ///< [rad] of a reference that the motor follows
  double least_force = 0.5;         ///< [N] of a tendon
  double least_driven = 1e-5;       ///< [rad or m] of a driven axis
  double beyond_noise = 2.0;        ///< standard deviations of the means
  std::size_t means = 200;          ///< at least, where there are so many values
  std::size_t most_in_a_mean = 16;  ///< values; more would hide motion

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("least_turn", options.least_turn);
    visit("least_followed", options.least_followed);
    visit("least_force", options.least_force);
    visit("least_driven", options.least_driven);
    visit("beyond_noise", options.beyond_noise);
    visit("means", options.means);
    visit("most_in_a_mean", options.most_in_a_mean);
  }
};

/// Whether a recording repeats the commands of another one.
struct RepeatOptions {
  /// [s] commands that start no further apart start together: messages of a controller come early
  /// or late by as much
  double together = 0.05;
  Share same_command = 0.01;    ///< of the range of commands
  Share other_commands = 0.05;  ///< of the time; lost messages cause less
  double grid = 0.01;           ///< [s] at which commands are compared
  Share same_motion = 0.15;     ///< of its range
  double noise_range = 10.0;    ///< standard deviations; what ranges less is noise
  Share motion_begins = 0.1;    ///< of its range
  Share better_aligned = 0.25;  ///< largest share of the difference that a shift may leave
  int points = 1000;            ///< at which motions are compared

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("together", options.together);
    visit("same_command", options.same_command);
    visit("other_commands", options.other_commands);
    visit("grid", options.grid);
    visit("same_motion", options.same_motion);
    visit("noise_range", options.noise_range);
    visit("motion_begins", options.motion_begins);
    visit("better_aligned", options.better_aligned);
    visit("points", options.points);
  }
};

/// Recordings that are not what they seem.
struct SoundnessOptions {
  Share repeated_rows = 0.02;  ///< of rows with the time of the row before: deserves a remark
  std::size_t stretch = 50;    ///< rows that are compared with those of other recordings
  std::size_t distinct = 25;   ///< of these rows; where less happens, two recordings may agree
  Share copied = 0.1;          ///< of the stretches of the shorter recording: it was given twice
  Share latest_begin = 0.5;    ///< of the recording: a file that begins later has another clock
  Share least_covered = 0.3;   ///< of the recording: a file that covers less has another clock

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("repeated_rows", options.repeated_rows);
    visit("stretch", options.stretch);
    visit("distinct", options.distinct);
    visit("copied", options.copied);
    visit("latest_begin", options.latest_begin);
    visit("least_covered", options.least_covered);
  }
};

/// Joints that were stamped by another clock than their muscles.
struct ClockOptions {
  double bin = 0.05;               ///< [s] lags are multiples of it: 0.1 s may explain far less
  double longest_lag = 5.0;        ///< [s] that is tried
  Share share_of_time = 0.3;       ///< of the recording, by which it may be shifted
  double fold = 1.0;               ///< [s] fitted and judged in turn
  Share ridge = 1e-3;              ///< of the diagonal; rates of antagonists are much alike
  double most_work = 4e7;          ///< products for one lag
  int most_bins = 6000;            ///< of a recording
  double least_turn = 0.02;        ///< [rad or m] of a motor or joint that moves
  double least_force = 0.5;        ///< [N] of a tendon whose force changes
  double plausible = 0.2;          ///< [s] lag of real sensors, as of `mocap_delay`
  Share explains = 0.6;            ///< least share of the squares at the other lag
  Share clearly = 0.5;             ///< of what a plausible lag leaves unexplained, at most
  double few_movements = 2.5;      ///< fewer are not examined
  double several_movements = 4.0;  ///< fewer get a remark only

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("bin", options.bin);
    visit("longest_lag", options.longest_lag);
    visit("share_of_time", options.share_of_time);
    visit("fold", options.fold);
    visit("ridge", options.ridge);
    visit("most_work", options.most_work);
    visit("most_bins", options.most_bins);
    visit("least_turn", options.least_turn);
    visit("least_force", options.least_force);
    visit("plausible", options.plausible);
    visit("explains", options.explains);
    visit("clearly", options.clearly);
    visit("few_movements", options.few_movements);
    visit("several_movements", options.several_movements);
  }
};

/// How recordings are cut and what is refused or remarked.
struct AdmissionOptions {
  double shortest = 2.0;          ///< [s] of all training or of all held-out recordings
  double finest_bin = 0.02;       ///< [s] over which differences are averaged, at least
  double most_differences = 4e5;  ///< of the training recordings; with more, bins are longer
  double quick_look = 20.0;       ///< [s] along which doses of quick effects are simulated
  /// [s] the same of slow effects, and of driven axes, which are simulated fast enough
  double slow_look = 120.0;
  std::size_t names_listed = 4;  ///< channels that a message names
  FrozenColumnOptions frozen;
  MovementOptions movement;
  RepeatOptions repeats;
  SoundnessOptions soundness;
  ClockOptions clocks;

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("shortest", options.shortest);
    visit("finest_bin", options.finest_bin);
    visit("most_differences", options.most_differences);
    visit("quick_look", options.quick_look);
    visit("slow_look", options.slow_look);
    visit("names_listed", options.names_listed);
    visit("frozen", options.frozen);
    visit("movement", options.movement);
    visit("repeats", options.repeats);
    visit("soundness", options.soundness);
    visit("clocks", options.clocks);
  }
};

}  // namespace discovery
}  // namespace anthrob
