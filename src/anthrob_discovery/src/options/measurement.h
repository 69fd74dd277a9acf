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
  double sure = 4.0;              ///< standard errors by which a shift is better than none
  double clearly = 2.0;           ///< standard errors by which it is better than another cause
  double interval = 1.96;         ///< standard errors to either side, for 95 %
  Share clipped = 0.98;           ///< of the largest voltage; beyond, the law is cut off
  double other_law = 3.0;         ///< times the noise of the voltages that no law of ours leaves

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("longest", options.longest);
    visit("block", options.block);
    visit("fewest_blocks", options.fewest_blocks);
    visit("most_rows", options.most_rows);
    visit("sure", options.sure);
    visit("clearly", options.clearly);
    visit("interval", options.interval);
    visit("clipped", options.clipped);
    visit("other_law", options.other_law);
  }
};

/// How recordings were taken.
struct MeasurementOptions {
  HeldSampleOptions hold;
  ControllerAlgebraOptions controller;

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("hold", options.hold);
    visit("controller", options.controller);
  }
};

}  // namespace discovery
}  // namespace anthrob
