#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

#include "options/judgement.h"

namespace anthrob {
namespace discovery {

/// Gain in held-out log score that an effect needs to be named [nat]. It grows with the number of
/// candidates that were searched.
inline double needed_evidence(std::size_t candidates, const MeritOptions& options) {
  return options.evidence + std::log(static_cast<double>(std::max<std::size_t>(1, candidates)));
}

/// The numbers by which step 7 of docs/discovery_method.md decides whether the first candidate of a
/// short list is named.
struct Merit {
  double probability = 0.0, none = 0.0;  ///< of this candidate; that none of the list is right
  double learned = 0.0;                  ///< reduction of the cost on training recordings
  double evidence = 0.0;                 ///< gain in held-out log score [nat]
  double needed_evidence = 0.0;          ///< needed_evidence() [nat]
  double significance = 0.0;             ///< of the gain over blocks [standard errors]
  bool only_faint_gaps = false;          ///< no channel is above JudgementOptions::real_gap
  double share = 0.0;           ///< share of the squared gaps above `faint_gap` that it removes
  double share_of_first = 0.0;  ///< the same, in units of the squared gaps at the start
};

/// Decides whether an effect earns its place: the first criterion that it misses, in words; nothing
/// if it is to be named.
std::optional<std::string> lack(const Merit& merit, const MeritOptions& options);

}  // namespace discovery
}  // namespace anthrob
