#pragma once

#include <vector>

#include "fit/model_fit.h"
#include "hypotheses/screening.h"
#include "options/hypotheses.h"

namespace anthrob {
namespace discovery {

/// Indices of the first `most` entries of a list of candidates, given by their effects. Each effect
/// gets at most `of_a_kind` of them as long as there are other effects, so that one effect at many
/// places does not crowd out the rest.
std::vector<std::size_t> best_of_kinds(const std::vector<const Effect*>& kinds,
                                       std::size_t of_a_kind, std::size_t most);

/// Simulates candidates at several sizes, because a unit dose says little about a size ten times
/// smaller or larger where an effect is not linear. Ordinary parameters stay as they are; what they
/// can imitate is subtracted in linear approximation.
class Trials {
 public:
  Trials(const ModelFit& fit, const std::vector<Candidate>& candidates, const TrialOptions& options)
      : fit_(fit), candidates_(candidates), options_(options) {}

  /// Tries the best candidates of the screening and every effect of the muscle, joint or motor of
  /// the first one. @return those that leave least, best first, each at its best size
  /// @param scores largest gain first
  std::vector<Score> best(const Fitted& base, const std::vector<Score>& scores) const;
  /// Gives each candidate the size at which it leaves least, alone.
  /// @return the cost that it leaves there; that of the base if no size does better
  std::vector<double> choose_sizes(const Fitted& base, std::vector<Score>& tried) const;

 private:
  /// A candidate at some size.
  struct Trial {
    std::size_t owner = 0;       ///< among those that are tried
    std::vector<double> amount;  ///< of each size, in doses
    double cost = 0.0;     ///< once ordinary parameters have done what they can; may be infinite
    double changed = 0.0;  ///< norm of the change of the residual
  };

  std::vector<Score> most_promising(const std::vector<Score>& scores,
                                    const std::vector<Candidate>& candidates) const;
  void add_place_of_first(const std::vector<Score>& scores,
                          const std::vector<Candidate>& candidates,
                          std::vector<Score>& tried) const;
  std::vector<Trial> simulate(const Fitted& base, const std::vector<Score>& tried,
                              std::vector<Trial> trials) const;

  const ModelFit& fit_;
  const std::vector<Candidate>& candidates_;
  TrialOptions options_;
};

}  // namespace discovery
}  // namespace anthrob
