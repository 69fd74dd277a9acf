#pragma once

#include <vector>

#include "anthrob_calib/discovery/model_fit.h"
#include "anthrob_calib/discovery/screening.h"

namespace anthrob {
namespace discovery {

/// The first so many of a list, told by their effects; of each effect no more than so many as long
/// as there are others: one effect at many places must not crowd out the rest.
std::vector<std::size_t> best_of_kinds(const std::vector<const Effect*>& kinds,
                                       std::size_t of_a_kind, std::size_t most);

/// Simulates candidates at several sizes: a unit dose says little of one ten times smaller or
/// larger where an effect is not linear. Ordinary parameters stay as they are; what they could take
/// up is taken off in linear approximation.
class Trials {
 public:
  static constexpr std::size_t kTried = 30, kTriedOfAKind = 6;
  static constexpr std::size_t kKept = 8, kKeptOfAKind = 3;

  Trials(const ModelFit& fit, const std::vector<Candidate>& candidates)
      : fit_(fit), candidates_(candidates) {}

  /// Of the best by the screening, and of all that can be where the first is (at the whole of its
  /// muscle or joint), those that leave least, least first, each at its best size.
  /// @param scores in order of falling gain
  std::vector<Score> best(const Fitted& base, const std::vector<Score>& scores) const;

 private:
  /// A candidate at some size.
  struct Trial {
    std::size_t owner = 0;       ///< among those that are tried
    std::vector<double> amount;  ///< of each size, in doses
    double cost = 0.0;     ///< once ordinary parameters have done what they can; may be infinite
    double changed = 0.0;  ///< norm of the change of the residual
  };

  static std::vector<Score> most_promising(const std::vector<Score>& scores,
                                           const std::vector<Candidate>& candidates);
  static void add_place_of_first(const std::vector<Score>& scores,
                                 const std::vector<Candidate>& candidates,
                                 std::vector<Score>& tried);
  std::vector<Trial> simulate(const Fitted& base, const std::vector<Score>& tried,
                              std::vector<Trial> trials) const;

  const ModelFit& fit_;
  const std::vector<Candidate>& candidates_;
};

}  // namespace discovery
}  // namespace anthrob
