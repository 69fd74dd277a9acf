#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "fit/candidate.h"
#include "hypotheses/candidate_comparison.h"

namespace anthrob {
namespace discovery {

struct Rival {
  std::string id, name, place;
  double probability = 0.0;
  double evidence = 0.0;  ///< gain in held-out log score [nat]
};

/// A law that was named at a place, as the search knows it.
struct NamedLaw {
  std::string id, name, place;
  double probability = 0.0, evidence = 0.0;
  std::string shows_in;  ///< the channel whose gap it reduces most, "<place>/<channel>"
  double left = 0.0;     ///< share of the squared gap in that channel that is left
  std::string at_limit;  ///< a shape parameter at the end of its range; empty: none
  std::string spoils;    ///< the held-out channel that it makes worst, clearly; empty: none
  double spoilt = 0.0;   ///< what it adds to squared gaps of such channels, as a share of what it
                         ///< takes from those of others
  std::vector<Rival> rivals;
};

/// Two models that a recording can tell apart: with an effect, and with its first rival.
struct Contest {
  Variant named, rival;
};

/// The first of a short list, with the others as its rivals.
/// @param mentioned least probability of a rival
NamedLaw named_law(const ShortList& list, const std::vector<Candidate>& candidates,
                   double mentioned);

/// An effect replaced by a law that does better: one that says more at the same place, or the same
/// law everywhere. The replaced law becomes its rival. The two share what both had, the new law as
/// a rival, by the odds.
struct Replaced {
  NamedLaw effect;
  bool is_first_rival = false;  ///< of the replaced law: then a recording may tell the two apart
};
/// @param odds against the other   @param mentioned least probability of a rival
Replaced name_instead(const Candidate& fuller, const CandidateComparison::Odds& odds,
                      NamedLaw effect, double mentioned);

/// The law that says more is not clearly better: the simpler law stays named, and the other one
/// becomes its first rival, with the same probability.
NamedLaw leave_open(const Candidate& fuller, const CandidateComparison::Odds& odds,
                    NamedLaw effect);

/// The experiment that tells an effect from its first rival, in words; empty: it has none.
std::string how_to_separate(const NamedLaw& effect);

/// Factor for the probability of an effect: it is lower the more of the gap the law leaves, if its
/// shape ends at a limit, and if it spoils a channel.
/// @param left_counts whether what the law leaves matters
double trust_in(const NamedLaw& effect, const TrustOptions& options, bool left_counts = true);

}  // namespace discovery
}  // namespace anthrob
