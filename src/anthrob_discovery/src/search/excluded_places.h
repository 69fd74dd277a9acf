#pragma once

#include <set>
#include <string>
#include <vector>

#include "hypotheses/screening.h"

namespace anthrob {
namespace discovery {

/// A named law of not quite the true shape leaves something at its place, which may be larger than
/// what else is missing, but not enough for another effect there to be named. Such muscles and
/// joints are left out of the next short list, so that effects elsewhere can be found.
class ExcludedPlaces {
 public:
  explicit ExcludedPlaces(const std::vector<Candidate>& candidates) : candidates_(candidates) {}

  /// Notes that the first candidate of a short list was refused.
  /// @param accepted candidates that are in the model
  /// @return whether its muscle or joint is now left out for the first time, so that another short
  /// list is worthwhile
  bool exclude(std::size_t first, const std::vector<std::size_t>& accepted);
  /// The scores without those of places that are left out.
  std::vector<Score> filter(std::vector<Score> scores) const;
  /// Looks at all places again; to be called when the model has changed.
  void clear() { places_.clear(); }

 private:
  const std::vector<Candidate>& candidates_;
  std::set<std::string> places_;  ///< Candidate::owner()
};

}  // namespace discovery
}  // namespace anthrob
