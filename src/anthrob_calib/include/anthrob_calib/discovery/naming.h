#pragma once

#include <vector>

#include "anthrob_calib/discovery/judge.h"
#include "anthrob_calib/discovery/screening.h"

namespace anthrob {
namespace discovery {

/// A fit, and how it does where it was not fitted.
struct Tested {
  Fitted fit;            ///< on the training recordings
  Eigen::VectorXf test;  ///< whitened residual of the held-out recordings; empty: not simulated
};

/// A candidate, fitted in the full simulation together with the ordinary parameters.
struct Named : Tested {
  std::size_t candidate = 0;
  double evidence = 0.0;      ///< gain in held-out log score [nat]
  double significance = 0.0;  ///< of the gain over blocks of all recordings
  double probability = 0.0;   ///< among all that were fitted, and none
};

/// The short list of one round, most probable first. What a simpler one nearly does as well stands
/// behind it (share_of_simpler()). The simpler one's probability is then that of both, the other's
/// is 0.
struct ShortList {
  std::vector<Named> named;
  double none = 0.0;  ///< probability that none of them is it
};

/// Whether one is a law of fewer sizes than another at the same place and seam.
bool says_less(const Candidate& part, const Candidate& whole);

/// The share of one candidate's gain that another must bring alone to be named in its stead,
/// because it says less: a law of fewer sizes at the same place (one step at a time: whether more
/// is needed the next round tells), or the same law everywhere on a muscle instead of at one point
/// of it. 1: the other one is not simpler.
double share_of_simpler(const Candidate& part, const Candidate& whole);

/// The first so many of a list, told by their effects; of each effect no more than so many as long
/// as there are others: one effect at many places must not crowd out the rest.
std::vector<std::size_t> best_of_kinds(const std::vector<const Effect*>& kinds,
                                       std::size_t of_a_kind, std::size_t most);

/// Weighs candidates: the best of the linear screening are simulated at the sizes it suggests, the
/// best of those are fitted, and all are judged on data they were fitted to and on data they were
/// not.
class Naming {
 public:
  static constexpr std::size_t kTried = 30;  ///< simulated at their size
  static constexpr std::size_t kFitted = 8;  ///< fitted, roughly
  static constexpr std::size_t kJudged = 5;  ///< fitted to the end and judged
  static constexpr std::size_t kTriedOfAKind = 6, kFittedOfAKind = 3;

  Naming(const ModelFit& train, const ModelFit& test, const Judge& train_judge,
         const Judge& test_judge, const std::vector<Candidate>& candidates, std::uint64_t seed)
      : train_(train),
        test_(test),
        train_judge_(train_judge),
        test_judge_(test_judge),
        candidates_(candidates),
        seed_(seed) {}

  /// @param base fitted without them
  ShortList weigh(const Tested& base, const std::vector<Score>& scores) const;
  /// The base has moved to a better valley: from there each is fitted once more, for the same
  /// chance, and all are judged against it.
  void follow(const Tested& base, ShortList& list) const;
  /// Evidence, significance and probability of each against a base; most probable first.
  void judge(const Tested& base, ShortList& list) const;
  /// How likely one fit is right and not another, if only one of the two can be, and by how much
  /// its log score is higher: both by held-out recordings alone, where neither is better for having
  /// more unknowns.
  struct Odds {
    double probability, evidence;  ///< [1], [nat]
  };
  Odds odds(const Eigen::VectorXf& one_test, const Eigen::VectorXf& other_test) const;

 private:
  EffectInstance sized(const Candidate& candidate, const std::vector<double>& amount) const;
  /// A candidate at some size, in doses.
  struct Attempt {
    std::size_t owner = 0;  ///< among those that are tried
    std::size_t candidate = 0;
    std::vector<double> amount;
  };
  /// Cost of each after the ordinary parameters have done what they can, in linear approximation;
  /// infinite if it cannot be simulated. @param changed by how much it changes the residual
  std::vector<double> costs_at(const Fitted& base, const std::vector<Attempt>& attempts,
                               std::vector<double>& changed) const;
  std::vector<Score> try_out(const Fitted& base, const std::vector<Score>& scores) const;
  Named fit(const Fitted& base, std::size_t candidate, const EffectInstance& start) const;
  void prefer_simpler(const Fitted& base, ShortList& list) const;

  const ModelFit &train_, &test_;
  const Judge &train_judge_, &test_judge_;
  const std::vector<Candidate>& candidates_;
  std::uint64_t seed_;
};

}  // namespace discovery
}  // namespace anthrob
