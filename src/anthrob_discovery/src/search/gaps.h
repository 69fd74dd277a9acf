#pragma once

#include "hypotheses/candidate_comparison.h"
#include "judgement/judge.h"
#include "judgement/merit.h"

namespace anthrob {
namespace discovery {

/// Gaps that fits leave, and how an effect changes them.
class Gaps {
 public:
  /// @param train, test judges of what was fitted and of what is held out
  /// @param candidates that were searched
  Gaps(const Judge& train, const Judge& test, std::size_t candidates)
      : train_(train), test_(test), candidates_(candidates) {}

  /// Whether a channel is above a level both in training and in held-out recordings.
  bool any(const Tested& tested, double least) const;
  /// Whether a gap is certain, that is not by chance (certain_gap()).
  bool certain(const Tested& tested) const;
  /// Sum of excess() over all channels of the held-out recordings.
  double excess_of(const Eigen::VectorXf& held_out, double least) const;

  /// Sets the start of the search, with which effects are compared.
  /// @param held_out residual there
  void begin(const Eigen::VectorXf& held_out) { first_ = held_out; }
  double first_excess(double least) const { return excess_of(first_, least); }

  /// Merit of the first candidate of a short list that was judged against a base.
  Merit merit_of(const ShortList& list, const Tested& base) const;

 private:
  const Judge &train_, &test_;
  std::size_t candidates_;
  Eigen::VectorXf first_;
};

}  // namespace discovery
}  // namespace anthrob
