#pragma once

#include <string>

#include "conclusion/answer.h"
#include "question/question.h"

namespace anthrob {
namespace discovery {

/// Simulated minus measured over time, of the held-out channels that changed most.
std::string example_figures(const Answer& answer);

/// Channels above their floors that are worse with the extended model than with the recalibrated
/// one; empty: none.
std::string worse_channels(const Answer& answer);

/// The held-out gap of every channel.
std::string channel_table(const Answer& answer);

/// The size from which on each effect would have shown, and groups that cannot be told apart.
std::string visibility(const Answer& answer, const Question& question);

}  // namespace discovery
}  // namespace anthrob
