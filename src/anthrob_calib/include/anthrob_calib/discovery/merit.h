#pragma once

#include <string>

namespace anthrob {
namespace discovery {

/// What speaks for the first of a short list, judged on data it was not fitted to.
struct Merit {
  double probability = 0.0, none = 0.0;  ///< its own; that none of the list is it
  double evidence = 0.0;                 ///< gain in held-out log score [nat]
  double needed_evidence = 0.0;          ///< by the number of candidates searched [nat]
  double significance = 0.0;             ///< of the gain over blocks [standard errors]
  bool only_faint_gaps = false;          ///< no channel is above kRealGap
  double share = 0.0;                    ///< of the squared gaps above kFaintGap, what goes
  double share_of_first = 0.0;           ///< the same, of those that were there at first
};

/// Empty if the effect earns its place in the model; else what it lacks, in words.
std::string lack(const Merit& merit);

}  // namespace discovery
}  // namespace anthrob
