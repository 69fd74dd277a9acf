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

/// How recordings were taken.
struct MeasurementOptions {
  HeldSampleOptions hold;

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("hold", options.hold);
  }
};

}  // namespace discovery
}  // namespace anthrob
