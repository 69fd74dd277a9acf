#pragma once

#include <cstddef>

#include "options/share.h"

namespace anthrob {
namespace discovery {

/// Motion of a driven axis from its measured positions, and the bins in which its effort is
/// compared.
struct AxisOptions {
  Share smoothing = 0.5;  ///< [bins] half the width of the polynomials: each sample is in one
  /// [sampling periods] longest distance of two samples that a polynomial bridges
  double most_periods = 3.5;
  int fewest_samples = 3;        ///< of a parabola
  int cubic_samples = 6;         ///< of a cubic, and more than it has coefficients
  std::size_t fewest_bins = 10;  ///< of a recording
  /// [standard errors] of a speed, up to which the joint may be at rest
  double surely_moves = 4.0;
  double shortest_bin = 0.002;  ///< [s] faster than the current of a motor settles
  double longest_bin = 0.2;     ///< [s] longer than a reversal takes
  double ratio_of_bins = 1.4;   ///< of two lengths that are tried
  /// [1] logarithm of the scatter, by which a shorter bin must be better: estimates of it scatter
  double clearly_better = 0.05;
  /// of the bins that move: more begins and ends of motions blur what friction is. The lead screw
  /// at 25 rows a second has 0.09 in bins of 0.2 s
  Share most_mixed = 0.05;
  /// of the effort, rms: with a smaller inertial effort, the axis shows no inertia. That of the
  /// lead screw is below 0.1, that of the EMPS drive above 0.5
  Share inertia_shows = 0.25;
  /// [standard errors] of an inertia that bins tell: then it is that of all shorter ones. That of
  /// a cogging motor at constant speeds is below 4, those of benches are above 100
  double inertia_told = 10.0;
  double most_inertia = 1e12;      ///< times the model's that is looked for
  int inertia_steps = 100;         ///< of that search: halving alone reaches the last bit
  double inertia_settled = 1e-12;  ///< of the factor

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("smoothing", options.smoothing);
    visit("most_periods", options.most_periods);
    visit("fewest_samples", options.fewest_samples);
    visit("cubic_samples", options.cubic_samples);
    visit("fewest_bins", options.fewest_bins);
    visit("surely_moves", options.surely_moves);
    visit("shortest_bin", options.shortest_bin);
    visit("longest_bin", options.longest_bin);
    visit("ratio_of_bins", options.ratio_of_bins);
    visit("clearly_better", options.clearly_better);
    visit("most_mixed", options.most_mixed);
    visit("inertia_shows", options.inertia_shows);
    visit("inertia_told", options.inertia_told);
    visit("most_inertia", options.most_inertia);
    visit("inertia_steps", options.inertia_steps);
    visit("inertia_settled", options.inertia_settled);
  }
};

/// Poses of driven axes at rest.
struct PoseOptions {
  /// [s] that a pose stands for: it was approached afresh, so few of them make a block
  double seconds = 0.5;
  std::size_t fewest = 12;  ///< of a recording: three blocks
  /// [rad or m] from how far a pose is approached where its direction is known: much further than
  /// friction bends before it slides
  double approach = 0.5;
  int approach_steps = 10;  ///< of the simulation
  /// [rad/s or m/s] at which it comes to rest: no speed by which friction changes
  double creep = 1e-6;

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("seconds", options.seconds);
    visit("fewest", options.fewest);
    visit("approach", options.approach);
    visit("approach_steps", options.approach_steps);
    visit("creep", options.creep);
  }
};

/// Noise of a sensor that never reports less than zero.
struct CutOffOptions {
  double window = 0.2;       ///< [s] in which a force changes little
  std::size_t samples = 20;  ///< in a window, at least
  std::size_t windows = 5;   ///< that make an estimate
  Share least_zeros = 0.3;   ///< of the readings in a window, for which an estimate is possible
  Share most_zeros = 0.7;    ///< the same
  /// fewest, between zeros and others: a force that starts or ends makes only one
  int changes = 4;
  int iterations = 20;  ///< towards a fixed point

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("window", options.window);
    visit("samples", options.samples);
    visit("windows", options.windows);
    visit("least_zeros", options.least_zeros);
    visit("most_zeros", options.most_zeros);
    visit("changes", options.changes);
    visit("iterations", options.iterations);
  }
};

/// Parabolas through measured postures.
struct PostureNoiseOptions {
  std::size_t reach = 3;     ///< rows before and after its own
  std::size_t fewest = 5;    ///< rows
  double longest_gap = 2.0;  ///< [usual row intervals] that a parabola bridges

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("reach", options.reach);
    visit("fewest", options.fewest);
    visit("longest_gap", options.longest_gap);
  }
};

/// How recordings become something to compare models with.
struct ExperimentOptions {
  /// [s] of a recording: settling takes longer than simulating a shorter one
  double shortest_excerpt = 2.0;
  std::size_t rate_reach = 2;       ///< [bins] to either side, of a difference quotient
  double recording_period = 0.005;  ///< [s] of rows that are simulated
  /// of the noise of a channel of a robot with muscles, to which differences are rounded, so that
  /// the journal takes little space: in 100 000 of them, it adds 0.02 to the sum of squares
  Share rounding = 2e-3;
  /// times the rows of the recording of the floor: what gaps and the end of a recording change
  /// does not raise a floor
  double fewer_rows = 1.1;
  /// of the bins of a driven axis, in which repeats may differ by more than noise makes them
  Share torn_repeats = 0.1;
  /// rms of normal numbers over that of those that are left without so many of the largest
  double normal_tails = 1.267;
  AxisOptions axis;
  PoseOptions poses;
  CutOffOptions cut_off;
  PostureNoiseOptions postures;

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("shortest_excerpt", options.shortest_excerpt);
    visit("rate_reach", options.rate_reach);
    visit("recording_period", options.recording_period);
    visit("rounding", options.rounding);
    visit("fewer_rows", options.fewer_rows);
    visit("torn_repeats", options.torn_repeats);
    visit("normal_tails", options.normal_tails);
    visit("axis", options.axis);
    visit("poses", options.poses);
    visit("cut_off", options.cut_off);
    visit("postures", options.postures);
  }
};

}  // namespace discovery
}  // namespace anthrob
