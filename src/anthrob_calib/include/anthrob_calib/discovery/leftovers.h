#pragma once

#include <set>
#include <string>
#include <vector>

#include "anthrob_calib/discovery/screening.h"

namespace anthrob {
namespace discovery {

/// What effects that were named leave, being of another shape than the true ones, may be more than
/// what else is missing, and earn nothing a place. Muscles and joints of which only that is left
/// are not looked at, for the others to be seen.
class Leftovers {
 public:
  explicit Leftovers(const std::vector<Candidate>& candidates) : candidates_(candidates) {}

  /// That the first of a short list was refused.
  /// @param accepted candidates that are in the model
  /// @return whether that is news of what one of them leaves, so that another list is worth it
  bool refused(std::size_t first, const std::vector<std::size_t>& accepted);
  /// Of what is looked at.
  std::vector<Score> besides(std::vector<Score> scores) const;
  /// With another model all are looked at again.
  void forget() { places_.clear(); }

 private:
  const std::vector<Candidate>& candidates_;
  std::set<std::string> places_;  ///< Candidate::owner()
};

}  // namespace discovery
}  // namespace anthrob
