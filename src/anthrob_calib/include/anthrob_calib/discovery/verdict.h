#pragma once

#include <map>
#include <string>

#include "anthrob_calib/discovery/discovery.h"

namespace anthrob {
namespace discovery {

/// What remains, in words, where no gap does.
constexpr char kNoCertainGap[] = "no gap that is certain";

/// How likely the law of an effect is right, by what it leaves and where its shape has ended: a
/// factor of its probability.
double trust_in(const FoundEffect& effect);

/// Fills in the verdict and what is to be said of what remains, and takes from the named effects'
/// probabilities what remains speaks against them.
/// @param left each channel's gap in what was learned from, with the named effects [floors]
/// @param certain whether some gap that is left is none by chance
void pronounce(const std::map<std::string, double>& left, bool certain, Answer& answer);

}  // namespace discovery
}  // namespace anthrob
