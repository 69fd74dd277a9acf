#pragma once

#include <string>

#include "anthrob_calib/discovery/discovery.h"

namespace anthrob {
namespace discovery {

/// Simulated minus measured over time, of the held-out channels that changed most.
std::string example_figures(const Answer& answer);

/// Channels that the extended model has worse than the recalibrated one, above their floors;
/// empty: none.
std::string worse_channels(const Answer& answer);

/// The held-out gap of every channel.
std::string channel_table(const Answer& answer);

/// From which size on each effect would have shown, and what could not have been told apart.
std::string visibility(const Answer& answer, const Question& question);

}  // namespace discovery
}  // namespace anthrob
