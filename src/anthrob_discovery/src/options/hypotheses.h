#pragma once

#include <array>
#include <cstddef>

#include "options/share.h"

namespace anthrob {
namespace discovery {

/// A longer step of the simulation, where only differences count.
struct LongerStepOptions {
  double times = 2.0;       ///< the usual step
  double most_error = 3.0;  ///< [standard deviations] rms of a channel, that it alone may change

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("times", options.times);
    visit("most_error", options.most_error);
  }
};

/// Doses of all candidates.
struct ScreeningOptions {
  double faint = 9.0;  ///< squared change by a dose, below which it is lost in the noise
  /// of that square, which ordinary parameters must leave: at most a hundredth of the change
  Share visible = 1e-4;
  double alike = 0.95;  ///< correlation from which nothing tells two candidates apart
  /// of that square; where ordinary parameters leave less, doses have two sides
  Share imitated = 0.1;
  double largest = 100.0;      ///< [doses] that are suggested
  double least_square = 1e-6;  ///< of a change by a dose that shows at all

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("faint", options.faint);
    visit("visible", options.visible);
    visit("alike", options.alike);
    visit("imitated", options.imitated);
    visit("largest", options.largest);
    visit("least_square", options.least_square);
  }
};

/// Sizes at which the best of the screening are simulated.
struct TrialOptions {
  std::size_t tried = 30;           ///< candidates
  std::size_t tried_of_a_kind = 6;  ///< of one effect, as long as there are others
  std::size_t kept = 8;             ///< candidates, which are fitted
  std::size_t kept_of_a_kind = 3;   ///< of one effect, as long as there are others
  /// shares of what the screening suggests, which comes last
  std::array<double, 2> suggested = {0.5, 1.0};
  /// [doses] whatever it suggests, the dose first: a surface that is too small to touch does
  /// nothing, and a strong effect need not look like a weak one
  std::array<double, 3> doses = {1.0, 3.0, 10.0};
  /// shares of the way from what it suggests to the dose
  std::array<double, 3> between = {0.25, 0.5, 0.75};
  /// of what a law would do in proportion to the dose; one that does less begins later
  Share begun = 0.3;
  double unasked = 5.0;  ///< [doses] where the screening suggests nothing

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("tried", options.tried);
    visit("tried_of_a_kind", options.tried_of_a_kind);
    visit("kept", options.kept);
    visit("kept_of_a_kind", options.kept_of_a_kind);
    visit("suggested", options.suggested);
    visit("doses", options.doses);
    visit("between", options.between);
    visit("begun", options.begun);
    visit("unasked", options.unasked);
  }
};

/// Sizes and shapes of effects as unknowns of a fit.
struct UnknownOptions {
  double largest = 100.0;        ///< [doses] from where the fit begins: bounds may be infinite
  Share scale_of_size = 0.2;     ///< of the size: its scale
  Share least_scale = 0.03;      ///< of the dose: the same, at least
  Share finest_scale = 0.003;    ///< of the dose: the same in polishing
  Share scale_of_shape = 0.3;    ///< of its typical value: scale of a shape
  Share finest_of_shape = 0.03;  ///< of its typical value: the same in polishing
  /// times its typical value: what is expected of a shape scatters so
  double spread_of_shape = 1.5;
  /// times its typical value: the same of a shape whose sign is unknown
  double spread_of_either_sign = 3.0;
  Share inside = 1e-3;  ///< of the dose, from a bound that does not belong to the range

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("largest", options.largest);
    visit("scale_of_size", options.scale_of_size);
    visit("least_scale", options.least_scale);
    visit("finest_scale", options.finest_scale);
    visit("scale_of_shape", options.scale_of_shape);
    visit("finest_of_shape", options.finest_of_shape);
    visit("spread_of_shape", options.spread_of_shape);
    visit("spread_of_either_sign", options.spread_of_either_sign);
    visit("inside", options.inside);
  }
};

/// The short list.
struct ComparisonOptions {
  /// of those that are fitted roughly, how many are fitted further and judged
  std::size_t judged = 5;
  int first_iterations = 2;   ///< after which only the best are fitted on
  int iterations = 6;         ///< of these
  double telling_gain = 2.0;  ///< [nat] a smaller gain of an iteration decides nothing
  /// of the gain of a law, which a simpler one at the same place must bring to be named first
  Share most_of_it = 0.75;
  /// of the gain of a law at one point of a muscle, which the same law all along it must bring
  Share all_of_it = 0.98;

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("judged", options.judged);
    visit("first_iterations", options.first_iterations);
    visit("iterations", options.iterations);
    visit("telling_gain", options.telling_gain);
    visit("most_of_it", options.most_of_it);
    visit("all_of_it", options.all_of_it);
  }
};

/// Periods of an effort over the position of a driven joint.
struct PeriodOptions {
  double least_periods = 1.5;  ///< within the way, below which a period is a slope or a bend
  /// [periods] between two frequencies that are tried, over the whole way: a peak loses a twentieth
  double spacing = 0.25;
  std::size_t most_frequencies = 8000;  ///< that are tried: a second of computing
  /// [periods] a bin moves at most over, in half of the bins: faster ripple is averaged out
  Share fastest = 0.4;
  /// times the way of a bin that three quarters do not exceed: more is a start or a return
  double rush = 3.0;
  /// of the peak's height, which a whole number of periods a turn must have to be taken instead
  Share whole = 0.9;
  std::size_t blocks = 20;  ///< of time; a curve is fitted to every second and judged on the others
  /// of the squared effort that is left before it: what a period must predict; twice what the best
  /// of thousands does by chance in 600 bins
  Share least_share = 0.05;
  /// of what other laws of the motion leave: the same of all periods; below, none is looked for
  Share least_together = 0.2;

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("least_periods", options.least_periods);
    visit("spacing", options.spacing);
    visit("most_frequencies", options.most_frequencies);
    visit("fastest", options.fastest);
    visit("rush", options.rush);
    visit("whole", options.whole);
    visit("blocks", options.blocks);
    visit("least_share", options.least_share);
    visit("least_together", options.least_together);
  }
};

/// Doses at driven joints of robots without muscles.
struct AxisDoseOptions {
  /// of the rms effort that the given model lacks; of it over speed, and over half the way: trials
  /// of sizes begin there
  Share share = 0.5;
  Share share_of_mass = 0.1;  ///< of a body's mass: the same for a payload

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("share", options.share);
    visit("share_of_mass", options.share_of_mass);
  }
};

/// How candidates are weighed.
struct HypothesisOptions {
  LongerStepOptions fits = {2.0, 3.0};    ///< of sensitivities
  LongerStepOptions scans = {4.0, 20.0};  ///< of doses and trials, which only choose what is fitted
  AxisDoseOptions axis_doses;
  ScreeningOptions screening;
  TrialOptions trials;
  UnknownOptions unknowns;
  ComparisonOptions comparison;
  PeriodOptions periods;

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("fits", options.fits);
    visit("scans", options.scans);
    visit("axis_doses", options.axis_doses);
    visit("screening", options.screening);
    visit("trials", options.trials);
    visit("unknowns", options.unknowns);
    visit("comparison", options.comparison);
    visit("periods", options.periods);
  }
};

}  // namespace discovery
}  // namespace anthrob
