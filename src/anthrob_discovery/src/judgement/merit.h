#pragma once

#include <string>

namespace anthrob {
namespace discovery {

/// The numbers by which step 7 of docs/discovery_method.md decides whether the first candidate of a
/// short list is named.
struct Merit {
  double probability = 0.0, none = 0.0;  ///< of this candidate; that none of the list is right
  double learned = 0.0;                  ///< reduction of the cost on training recordings
  double evidence = 0.0;                 ///< gain in held-out log score [nat]
  double needed_evidence = 0.0;          ///< needed_evidence() [nat]
  double significance = 0.0;             ///< of the gain over blocks [standard errors]
  bool only_faint_gaps = false;          ///< no channel is above kRealGap
  double share = 0.0;           ///< share of the squared gaps above kFaintGap that it removes
  double share_of_first = 0.0;  ///< the same, in units of the squared gaps at the start
};

/// Empty if the effect is to be named; else the first criterion that it misses, in words.
std::string lack(const Merit& merit);

}  // namespace discovery
}  // namespace anthrob
