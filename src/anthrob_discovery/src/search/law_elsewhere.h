#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "hypotheses/hypotheses.h"
#include "hypotheses/screening.h"

namespace anthrob {
namespace discovery {

/// A law that is named at one muscle, joint or body, at all others at once, each with a size of its
/// own. What is missing at one muscle may be missing at every one. One at a time, each is a small
/// part of what is missing, and until the last is in, what the others leave misleads the fits.
class LawElsewhere {
 public:
  LawElsewhere(const Hypotheses& hypotheses, Screening& screening)
      : hypotheses_(hypotheses), screening_(screening) {}

  /// A law of a list that is named already, at another place; null: there is none.
  /// @param named candidates
  const Effect* repeated(const ShortList& list, const std::vector<std::size_t>& named) const;

  /// One of the places, compared with a model of all others.
  struct Part {
    ShortList alone;  ///< the model with it and all others, its only entry
    Tested without;   ///< the model with all others
  };
  struct Everywhere {
    Tested fit;               ///< the base, and the law at each of these places
    std::vector<Part> parts;  ///< in the order of the fit
  };
  /// Fits the law at one place of each muscle, joint or body at which it is not named, and takes
  /// away those that do not help beside all others. As long as much is left, more cannot be
  /// asked of a single one.
  /// @param named candidates   @param most so many places
  /// @return nothing if fewer than two are left
  std::optional<Everywhere> fit(const Effect* law, const std::vector<std::size_t>& named,
                                const Tested& base, std::size_t most) const;

 private:
  std::vector<Score> asked(const Effect* law, const std::vector<std::size_t>& named,
                           const Fitted& base) const;
  std::vector<Score> best_places(std::vector<Score> tried, const Fitted& base,
                                 std::size_t most) const;
  std::optional<Part> part(std::size_t effect, std::size_t candidate, const Tested& all) const;

  const Hypotheses& hypotheses_;
  Screening& screening_;
};

}  // namespace discovery
}  // namespace anthrob
