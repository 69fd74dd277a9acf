#pragma once

#include <cstddef>

#include "options/share.h"

namespace anthrob {
namespace discovery {

/// Motion of a driven axis from its measured positions.
struct AxisOptions {
  double smoothing = 0.006;  ///< [s] half the width of the parabolas
  /// [sampling periods] longest distance of two samples that a parabola bridges
  double most_periods = 3.5;
  int fewest_samples = 4;        ///< of a parabola
  std::size_t fewest_bins = 10;  ///< of a recording

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("smoothing", options.smoothing);
    visit("most_periods", options.most_periods);
    visit("fewest_samples", options.fewest_samples);
    visit("fewest_bins", options.fewest_bins);
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
  /// times the rows of the recording of the floor: what gaps and the end of a recording change
  /// does not raise a floor
  double fewer_rows = 1.1;
  AxisOptions axis;
  CutOffOptions cut_off;
  PostureNoiseOptions postures;

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("shortest_excerpt", options.shortest_excerpt);
    visit("rate_reach", options.rate_reach);
    visit("recording_period", options.recording_period);
    visit("fewer_rows", options.fewer_rows);
    visit("axis", options.axis);
    visit("cut_off", options.cut_off);
    visit("postures", options.postures);
  }
};

}  // namespace discovery
}  // namespace anthrob
