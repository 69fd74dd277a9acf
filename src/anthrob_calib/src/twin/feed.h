#pragma once

#include <array>

namespace anthrob {
namespace twin {

/// What of the measurement drives a copy of the model, from most of the chain simulated to least.
enum class Feed {
  kCommands,   ///< references, modes, states of the units
  kVoltages,   ///< measured voltages, past the control law
  kPositions,  ///< measured motor positions are imposed
  kPostures,   ///< motor and joint positions are imposed: springs and tendons alone are simulated
};
constexpr int kFeedCount = 4;
constexpr std::array<Feed, kFeedCount> kFeeds = {Feed::kCommands, Feed::kVoltages, Feed::kPositions,
                                                 Feed::kPostures};
constexpr std::array<const char*, kFeedCount> kFeedNames = {"commands", "voltages", "positions",
                                                            "postures"};

constexpr int index_of(Feed feed) {
  return static_cast<int>(feed);
}

}  // namespace twin
}  // namespace anthrob
