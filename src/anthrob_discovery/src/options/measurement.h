#pragma once

#include <cstddef>

#include "options/share.h"

namespace anthrob {
namespace discovery {

/// Rows that repeat a sensor's last value until it is fresh.
struct HeldSampleOptions {
  std::size_t fewest_frames = 30;  ///< fresh values; fewer may be regular by chance
  double least_rows = 1.2;         ///< rows of a frame; less hardly differs from fresh rows
  /// of the fresh rows that come when their clock says: coarse counts repeat values, too, but as
  /// long as the motion is slow
  Share on_time = 0.97;
  Share slack = 0.05;       ///< of a row by which a frame may be off its clock
  Share alike = 0.01;       ///< of a rate by which sensors of one system may differ
  double neighbours = 1.5;  ///< times the usual distance of fresh rows: no frame lies between

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("fewest_frames", options.fewest_frames);
    visit("least_rows", options.least_rows);
    visit("on_time", options.on_time);
    visit("slack", options.slack);
    visit("alike", options.alike);
    visit("neighbours", options.neighbours);
  }
};

/// Voltages against the controllers' law of recorded references and measurements.
struct ControllerAlgebraOptions {
  double longest = 0.025;         ///< [s] a shift that is sampling: mocap and buses are no later
  double block = 2.0;             ///< [s] taken as independent of the others
  std::size_t fewest_blocks = 4;  ///< for a standard error
  std::size_t most_rows = 20000;  ///< of all muscles and recordings together
  double beside = 0.003;          ///< [s] from a measured position, at most
  double sure = 4.0;              ///< standard errors by which a shift is better than none
  double clearly = 2.0;           ///< standard errors by which it is better than another cause
  double interval = 1.96;         ///< standard errors to either side, for 95 %
  Share clipped = 0.98;           ///< of the largest voltage; beyond, the law is cut off
  double other_law = 3.0;         ///< times the noise of the voltages that no law of ours leaves
  double longest_latency = 0.05;  ///< [s] until a controller gets references or measurements
  double shortest_filter = 4.0;   ///< [ticks] time constant; a shorter one looks like another tick
  double longest_filter = 0.3;    ///< [s] time constant; a slower one holds no posture
  double filter_step = 1.1;       ///< ratio of time constants at which their search ends
  /// of the noise of the voltages; less of a difference is below the floor of a bin of several rows
  double least_law = 0.3;
  Share least_gain = 0.02;   ///< of a gain by which another one differs
  double noise_only = 1.0;   ///< times the noise of the voltages that the right law leaves at most
  Share unexplained = 0.05;  ///< or of what the model's law leaves: filters leave hardly any noise
  /// times what the right law leaves at most: a shift of whole ticks that leaves less is no other
  /// law. Voltages 3.0 and 4.25 ms late left 1.00 and 1.04
  double rounded_shift = 1.5;

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("longest", options.longest);
    visit("block", options.block);
    visit("fewest_blocks", options.fewest_blocks);
    visit("most_rows", options.most_rows);
    visit("beside", options.beside);
    visit("sure", options.sure);
    visit("clearly", options.clearly);
    visit("interval", options.interval);
    visit("clipped", options.clipped);
    visit("other_law", options.other_law);
    visit("longest_latency", options.longest_latency);
    visit("shortest_filter", options.shortest_filter);
    visit("longest_filter", options.longest_filter);
    visit("filter_step", options.filter_step);
    visit("least_law", options.least_law);
    visit("least_gain", options.least_gain);
    visit("noise_only", options.noise_only);
    visit("unexplained", options.unexplained);
    visit("rounded_shift", options.rounded_shift);
  }
};

/// Columns of a wrong sign or unit.
struct ColumnOptions {
  std::size_t fewest_rows = 200;  ///< of both columns
  Share correlated = 0.7;  ///< squared correlation with what the column must be a multiple of
  /// by which the multiple may differ from a factor between units: more than errors of a motor's
  /// resistance or a reference that is hardly followed
  Share near = 0.4;
  /// the same for another sign and factors that are `large`: what a model lacks spoils the
  /// correlation, and a joint at rest has none
  Share hardly_correlated = 0.25;
  double large = 30.0;        ///< a factor that no physics makes, or one over it
  double beside_large = 5.0;  ///< factor by which the multiple may be off a large one, or off -1
  std::size_t rows = 10;      ///< over which a velocity is integrated
  double beside = 0.01;       ///< [s] to either side, for the velocity of a current's expectation
  std::size_t blocks = 8;     ///< for a standard error
  Share exactly = 0.02;       ///< of a velocity against its own position: 9.55 and 10 are units

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("fewest_rows", options.fewest_rows);
    visit("correlated", options.correlated);
    visit("near", options.near);
    visit("hardly_correlated", options.hardly_correlated);
    visit("large", options.large);
    visit("beside_large", options.beside_large);
    visit("rows", options.rows);
    visit("beside", options.beside);
    visit("blocks", options.blocks);
    visit("exactly", options.exactly);
  }
};

/// Lags and clocks by least squares.
struct ClockFitOptions {
  double block = 2.0;             ///< [s] taken as independent of the others
  std::size_t fewest_blocks = 4;  ///< for a standard error
  double sure = 4.0;              ///< standard errors of a lag or a drift
  double most_drift = 1e-3;       ///< [1] of a quartz that is broken; beyond, it is something else
  double interval = 1.96;         ///< standard errors to either side, for 95 %
  double beside = 0.005;          ///< [s] to either side, for a rate; grid of lags
  int steps = 6;                  ///< of Gauss and Newton from the best of the grid

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("block", options.block);
    visit("fewest_blocks", options.fewest_blocks);
    visit("sure", options.sure);
    visit("most_drift", options.most_drift);
    visit("interval", options.interval);
    visit("beside", options.beside);
    visit("steps", options.steps);
  }
};

/// How recordings were taken.
struct MeasurementOptions {
  HeldSampleOptions hold;
  ControllerAlgebraOptions controller;
  ColumnOptions column;
  ClockFitOptions clock;

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("hold", options.hold);
    visit("controller", options.controller);
    visit("column", options.column);
    visit("clock", options.clock);
  }
};

}  // namespace discovery
}  // namespace anthrob
