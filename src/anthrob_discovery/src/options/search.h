#pragma once

#include <cstddef>

#include "options/share.h"

namespace anthrob {
namespace discovery {

/// One law in place of several named ones.
struct CommonLawOptions {
  double evidence = 3.0;    ///< [nat] held out; no penalty, since only one law is tried
  Share probability = 0.9;  ///< with which it is clearly better

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("evidence", options.evidence);
    visit("probability", options.probability);
  }
};

/// A named law at all other places at once.
struct LawElsewhereOptions {
  std::size_t fewest = 2;  ///< places
  int iterations = 6;      ///< of a model without one of them

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("fewest", options.fewest);
    visit("iterations", options.iterations);
  }
};

/// The first of a short list and its challengers.
struct FinalComparisonOptions {
  Share comes_near = 0.5;   ///< of the gain of the first, which makes a challenger
  Share lags_behind = 0.4;  ///< of that gain: a fit that lacks more after rough steps is out
  /// of that gain: so is one that lacks more than this and, in addition, `far_above`
  Share behind = 0.1;
  Share far_above = 0.5;  ///< of the cost of the first

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("comes_near", options.comes_near);
    visit("lags_behind", options.lags_behind);
    visit("behind", options.behind);
    visit("far_above", options.far_above);
  }
};

/// Round after round.
struct SearchOptions {
  /// of what an effect gains: a model without it that still lacks more after a rough fit is not
  /// fitted further
  Share out_of_reach = 0.5;
  std::size_t renewed = 60;   ///< candidates whose doses are simulated again later
  int rounds_per_effect = 2;  ///< that may be named
  Share mentioned = 0.02;     ///< least probability of a rival that is reported
  Share scatter = 0.01;       ///< of the gain of the better one: ends of two fits of one law
  CommonLawOptions common_law;
  LawElsewhereOptions law_elsewhere;
  FinalComparisonOptions final_comparison;

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("out_of_reach", options.out_of_reach);
    visit("renewed", options.renewed);
    visit("rounds_per_effect", options.rounds_per_effect);
    visit("mentioned", options.mentioned);
    visit("scatter", options.scatter);
    visit("common_law", options.common_law);
    visit("law_elsewhere", options.law_elsewhere);
    visit("final_comparison", options.final_comparison);
  }
};

}  // namespace discovery
}  // namespace anthrob
