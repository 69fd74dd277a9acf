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

/// Weighs candidates: the best of the linear screening are simulated at the sizes it suggests, the
/// best of those are fitted, and all are judged on data they were fitted to and on data they were
/// not.
class Naming {
 public:
  static constexpr std::size_t kJudged = 5;  ///< of those that are fitted roughly

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
  Named fit(const Fitted& base, std::size_t candidate, const EffectInstance& start) const;
  void prefer_simpler(const Fitted& base, ShortList& list) const;
  void turn_to_better_phase(const Fitted& base, Named& named) const;

  const ModelFit &train_, &test_;
  const Judge &train_judge_, &test_judge_;
  const std::vector<Candidate>& candidates_;
  std::uint64_t seed_;
};

}  // namespace discovery
}  // namespace anthrob
