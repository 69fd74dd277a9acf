#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hypotheses/candidate_comparison.h"
#include "search/named_effect.h"

namespace anthrob {
namespace discovery {

/// One law that can replace two named effects.
struct Alternative {
  std::string id, name, place;
  std::size_t instead_of[2] = {0, 0};  ///< indices of the effects
  double probability = 0.0;            ///< given that either this law or those two are right
  double evidence = 0.0;               ///< held-out log score minus that of the two [nat]
};

/// The last candidate that was not named, and why it was not.
struct Refused {
  std::string id, place;
  double probability = 0.0, evidence = 0.0;
  std::string lack;
};

/// A law that met the criteria, but leaves so much of the gap, ends so near the limit of its shape,
/// or makes a channel so much worse that it is unlikely to be right. It is reported, but not added
/// to the model.
struct Improbable {
  std::string id, name, place;
  double probability = 0.0, evidence = 0.0;
  std::string shows_in;  ///< this and the next four: as in NamedLaw
  double left = 0.0;
  std::string at_limit, spoils;
  double spoilt = 0.0;
};

/// Why a search ended.
enum class SearchEnd {
  kNoMore,  ///< no further candidate earned its place, or no gap was left
  kRounds,  ///< it had as many rounds as `max_effects` allows
  kFull,    ///< it had named `max_effects`, some of which may be dropped
};

/// What a search decided, beside the effects that it named.
struct SearchRecord {
  std::vector<Alternative> alternatives;
  std::vector<Improbable> improbable;
  std::vector<std::string> dropped;  ///< named first, but no longer needed beside the others
  /// why effects of driven axes were taken back that the recordings cannot tell
  std::vector<std::string> withheld;
  std::optional<Refused> refused;    ///< empty: the search did not end by refusing one
  SearchEnd end = SearchEnd::kNoMore;
};

struct SearchResult {
  Tested recalibrated;             ///< the model with which effects were compared
  Tested extended;                 ///< with the named effects
  std::vector<NamedEffect> named;  ///< in the order of the model
  SearchRecord record;
};

}  // namespace discovery
}  // namespace anthrob
