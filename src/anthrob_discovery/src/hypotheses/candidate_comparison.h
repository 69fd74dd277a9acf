#pragma once

#include <utility>
#include <vector>

#include "hypotheses/screening.h"
#include "judgement/judge.h"
#include "options/hypotheses.h"

namespace anthrob {
namespace discovery {

/// A fit and its residual on recordings to which it was not fitted.
struct Tested {
  Fitted fit;            ///< on the training recordings
  Eigen::VectorXf test;  ///< whitened residual of the held-out recordings; empty: not simulated
};

/// A candidate, fitted in the full simulation together with the ordinary parameters.
struct FittedCandidate : Tested {
  std::size_t candidate = 0;
  double evidence = 0.0;      ///< gain in held-out log score [nat]
  double significance = 0.0;  ///< of the gain over blocks of all recordings
  double probability = 0.0;   ///< among all that were fitted and "none of them"
};

/// The short list of one round, most probable first. A candidate that a simpler one nearly equals
/// (share_of_simpler()) stands behind the simpler one, which then has the probability of both; its
/// own is 0.
struct ShortList {
  std::vector<FittedCandidate> entries;
  double none = 0.0;  ///< probability that none of them is right
};

/// Whether `part` is a law of fewer sizes than `whole`, or what that becomes in a limit, at the
/// same place and in the same part of the chain.
bool is_nested_in(const Candidate& part, const Candidate& whole);

/// The share of the gain of `whole` that `part` must bring alone to be named first because it is
/// simpler: a law of fewer sizes at the same place (a later round decides whether more is needed),
/// or the same law everywhere on a muscle instead of at one point of it. 1: `part` is not simpler.
double share_of_simpler(const Candidate& part, const Candidate& whole,
                        const ComparisonOptions& options);

/// Makes the short list: simulates the best candidates of the screening at several sizes, fits the
/// best of those, and judges them on training and held-out recordings (steps 5 and 6 of
/// docs/discovery_method.md).
class CandidateComparison {
 public:
  /// @param scan as `train`, for trials of many sizes
  CandidateComparison(const ModelFit& train, const ModelFit& test, const ModelFit& scan,
                      const Judge& train_judge, const Judge& test_judge,
                      const std::vector<Candidate>& candidates, const HypothesisOptions& options,
                      std::uint64_t seed)
      : train_(train),
        test_(test),
        scan_(scan),
        train_judge_(train_judge),
        test_judge_(test_judge),
        candidates_(candidates),
        options_(options),
        seed_(seed) {}

  /// @param base fitted without them
  ShortList weigh(const Tested& base, const std::vector<Score>& scores) const;
  /// After the base has moved to a better fit: fits every candidate once more from there, and
  /// judges all against the new base.
  void follow(const Tested& base, ShortList& list) const;
  /// Fits several candidates at once, as far as those of a short list.
  /// @param parts each with the size to begin with   @throws NotSimulated
  Tested together(const Tested& base, const std::vector<Score>& parts) const;
  /// Computes evidence, significance and probability of each against a base, and sorts, most
  /// probable first.
  void judge(const Tested& base, ShortList& list) const;
  /// Probability that one fit is right, given that one of the two is, and by how much its log score
  /// is higher. Both from held-out recordings alone, where more unknowns are no advantage.
  struct Odds {
    double probability, evidence;  ///< [1], [nat]
  };
  Odds odds(const Eigen::VectorXf& one_test, const Eigen::VectorXf& other_test) const;

 private:
  using Start = std::pair<std::size_t, EffectInstance>;  ///< a candidate and its parameters

  /// The least relative gain of an iteration that may matter, however long the recordings are.
  double least_gain(const Fitted& fitted) const;
  Fitted begin(const Fitted& base, const std::vector<Start>& starts) const;
  FittedCandidate fit(const Fitted& base, std::size_t candidate, const EffectInstance& start) const;
  void prefer_simpler(const Fitted& base, ShortList& list) const;
  void turn_to_better_phase(const Fitted& base, FittedCandidate& named) const;

  const ModelFit &train_, &test_, &scan_;
  const Judge &train_judge_, &test_judge_;
  const std::vector<Candidate>& candidates_;
  HypothesisOptions options_;
  std::uint64_t seed_;
};

}  // namespace discovery
}  // namespace anthrob
