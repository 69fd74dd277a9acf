#pragma once

#include <string>
#include <vector>

#include "diagnostics.h"

namespace anthrob {

/// Where robot and model part: one message of the topic gap.
struct GapReading {
  std::vector<std::string> channels;  ///< "biceps_brachii/force"
  std::vector<std::string> feeds;     ///< "commands"
  std::vector<double> windows;        ///< [s]
  std::vector<double> gaps;           ///< [floors] by window, channel and feed; NaN: not told
};

/// Of a muscle or joint, the largest of its channels.
struct OwnerGap {
  std::string owner;
  std::vector<double> gaps;  ///< [floors] by feed; NaN: not told
};

/// In the order of the channels.
/// @param window index of the window
std::vector<OwnerGap> gaps_by_owner(const GapReading& reading, std::size_t window);

/// Below two floors a model may be right; from four on the twin warns.
Level level_of_gap(double floors);

/// The state of the tendons after the last test.
struct HealthReading {
  std::string headline;               ///< "11 tendons: nothing has changed"
  std::vector<std::string> warnings;  ///< what has changed, and why
};

/// What a job of the calibration node says.
struct JobReading {
  std::string job;            ///< "calibrate", "discover", "health/test"
  bool runs = false;          ///< false: it has ended
  std::string stage, best;    ///< of one that runs
  double share = 0.0;         ///< 0 to 1
  double seconds_left = 0.0;  ///< [s] NaN: not known
  std::string headline = {};  ///< of one that has ended
  bool success = false;       ///< the same
};

/// "searching, 37 %, about 20 s left, best: fitness 0.02"; or the headline.
std::string text_of(const JobReading& job);

}  // namespace anthrob
