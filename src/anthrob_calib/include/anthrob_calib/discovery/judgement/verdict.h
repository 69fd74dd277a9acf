#pragma once

#include <map>
#include <string>

#include "anthrob_calib/discovery/discovery.h"

namespace anthrob {
namespace discovery {

/// Factor for the probability of an effect: it is lower the more of the gap the law leaves, if its
/// shape ends at a limit, and if it spoils a channel.
/// @param left_counts whether what the law leaves matters
double trust_in(const FoundEffect& effect, bool left_counts = true);

/// Fills in the verdict and the description of what remains, and lowers the probabilities of the
/// named effects and their rivals by trust_in().
/// @param left gap of each channel in the training recordings, with the named effects [floors]
/// @param certain whether some gap that is left is certain (certain_gap())
/// @param answer with the gaps on one side only
void fill_in_verdict(const std::map<std::string, double>& left, bool certain, Answer& answer);

}  // namespace discovery
}  // namespace anthrob
