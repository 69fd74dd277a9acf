#pragma once

#include <cstddef>

#include "options/share.h"

namespace anthrob {
namespace discovery {

/// What an effect needs to be named.
struct MeritOptions {
  /// [nat] on held-out recordings, and the logarithm of the number of candidates
  double evidence = 3.0;
  double significance = 3.0;        ///< [standard errors] of its gain, over blocks
  double faint_significance = 6.0;  ///< [standard errors] the same where no gap is above `real_gap`
  Share share_of_present = 0.1;     ///< of the squared gap that it must remove
  /// of the squared gap at first; a smaller one may be what the shape of the first law leaves
  Share share_of_first = 0.03;
  double small_significance = 8.0;  ///< [standard errors] with which so small a share is enough

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("evidence", options.evidence);
    visit("significance", options.significance);
    visit("faint_significance", options.faint_significance);
    visit("share_of_present", options.share_of_present);
    visit("share_of_first", options.share_of_first);
    visit("small_significance", options.small_significance);
  }
};

/// What lowers the probability of a law.
struct TrustOptions {
  /// of the squared gap that a law leaves of what it should explain, at which it is as likely as
  /// not that the true law is another one. Measured by how often the answers of the study
  /// (studies/notes.md), seeds 1 to 6, were right
  Share even_odds = 0.05;
  /// of what a law explains, that it spoils, at which it is as likely as not that the true law is
  /// another one. Of 13 answers of the study (seeds 1 to 8) with a spoilt channel, 12 name an
  /// effect that is not there; all effects of an answer together spoil 0.002 to 0.22 of what they
  /// explain, that of the right answer 0.011
  Share even_odds_spoilt = 0.02;
  /// factor for a law with a shape parameter at the end of its range where that parameter may
  /// have either sign: such a law tends to stand in for another one. Of 65 effects named in the
  /// study (seeds 1 to 8) whose laws have such a shape, 7 ended there, none of them right; of the
  /// other 58, 45 were right
  Share at_limit = 0.05;
  Share near_limit = 0.03;  ///< of its range: a parameter that is nearer to its limit is at it
  /// a held-out channel is spoilt if its gap ends at more than this times both the floor and what
  /// the recalibrated model leaves
  double spoilt = 1.2;
  /// a law whose probability, together with that of its rivals, is lower is not added to the
  /// model. Of 15 effects in the study (seeds 1 to 6) that have less by themselves, two were
  /// right, both in one robot; of those with 0.1 to 0.2, two of six
  Share improbable = 0.1;

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("even_odds", options.even_odds);
    visit("even_odds_spoilt", options.even_odds_spoilt);
    visit("at_limit", options.at_limit);
    visit("near_limit", options.near_limit);
    visit("spoilt", options.spoilt);
    visit("improbable", options.improbable);
  }
};

/// How models and gaps are judged.
struct JudgementOptions {
  double block = 2.0;             ///< [s] longer than residuals are correlated
  std::size_t fewest_blocks = 3;  ///< whose scatter says how certain a gain or a gap is
  double real_gap = 1.4;  ///< [floors] up to it, a gap may be due to a wrong estimate of the noise
  /// [floors] above it, a gap is worth a search for what explains it, because the evidence is
  /// judged by what the best model leaves, not by the floor
  double faint_gap = 1.15;
  double certain_gap = 2.0;   ///< [floors] no noise estimate is that wrong
  double sure = 3.0;          ///< [standard errors] over blocks, which are not due to chance
  double telling_gain = 1.0;  ///< [nat] a smaller gain of a block says nothing
  int draws = 2000;           ///< of the Bayesian bootstrap
  MeritOptions merit;
  TrustOptions trust;

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("block", options.block);
    visit("fewest_blocks", options.fewest_blocks);
    visit("real_gap", options.real_gap);
    visit("faint_gap", options.faint_gap);
    visit("certain_gap", options.certain_gap);
    visit("sure", options.sure);
    visit("telling_gain", options.telling_gain);
    visit("draws", options.draws);
    visit("merit", options.merit);
    visit("trust", options.trust);
  }
};

}  // namespace discovery
}  // namespace anthrob
