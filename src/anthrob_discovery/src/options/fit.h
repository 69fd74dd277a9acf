#pragma once

#include <array>
#include <cstddef>

#include "options/share.h"

namespace anthrob {
namespace discovery {

/// Steps of difference quotients. Those to both sides average over friction that sticks a little
/// earlier or later, but stay where the valley is straight: in three cases whole scales took 1.5 to
/// 3 times as many rounds to a minimum within 0.02 % of the same cost, or a higher one.
struct SlopeOptions {
  double one_side = 0.5;              ///< [scales] to one side
  double both_sides = 0.35;           ///< [scales] to either side
  double both_sides_of_effect = 1.0;  ///< [scales] polishing has made its scale small
  double hardly_moved = 0.1;  ///< [scales] since slopes were simulated, which are good enough
  Share smooth = 0.1;  ///< of the changes, in which both sides of a smooth curvature differ at most

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("one_side", options.one_side);
    visit("both_sides", options.both_sides);
    visit("both_sides_of_effect", options.both_sides_of_effect);
    visit("hardly_moved", options.hardly_moved);
    visit("smooth", options.smooth);
  }
};

/// The damping schedule of Levenberg and Marquardt, as shares of the information. Its first entry
/// reaches the minimum of valleys that are flat along combined changes of unknowns.
struct DampingOptions {
  /// dampings that are tried in turn while a step falls short of the prediction
  std::array<double, 3> full_steps = {1e-7, 1e-4, 1.0};
  /// dampings for where no full step gains anything
  std::array<double, 4> last_resort = {1e-4, 1e-4, 10.0, 100.0};
  /// shares of those steps that are taken
  std::array<double, 4> last_resort_lengths = {0.5, 0.25, 1.0, 1.0};
  Share linear_enough = 0.5;  ///< of the predicted gain, with which a step is kept at once

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("full_steps", options.full_steps);
    visit("last_resort", options.last_resort);
    visit("last_resort_lengths", options.last_resort_lengths);
    visit("linear_enough", options.linear_enough);
  }
};

/// How far fits are taken.
struct ConvergenceOptions {
  int rough = 8;                 ///< iterations by the first slopes
  int polish = 8;                ///< iterations by the same slopes
  int rounds = 4;                ///< in which slopes are simulated again
  int finishing_rounds = 5;      ///< by exact slopes
  Share enough = 3e-3;           ///< of the cost: an iteration that gains less is the last
  Share polished = 5e-4;         ///< the same in polishing
  Share finished = 1e-4;         ///< the same where slopes are exact
  Share settled = 5e-4;          ///< of the cost: a round that gains less is the last
  Share at_the_end = 5e-4;       ///< the same where slopes are exact
  Share roughly_settled = 0.01;  ///< the same where something is clearly missing
  double clear_gap = 2.5;       ///< [floors] of all channels together: something is clearly missing
  double hopeless = 4.0 / 3.0;  ///< times what rough steps should reach
  /// times the cost of a fit from elsewhere: one begun anew that is still above it does not pass
  /// it
  double falls_behind = 1.02;
  /// times the sizes of effects, from which a fit that clearly misses is begun anew
  std::array<double, 5> other_sizes = {0.6, 0.8, 1.0, 1.25, 1.6};
  Share narrower = 0.1;  ///< of its scale, to which that of an effect shrinks in polishing, at most
  Share scale_of_size = 0.05;  ///< of the size of an effect: its scale in polishing, at least
  double at_bound = 1e-3;      ///< [scales] from a bound
  Share rounded = 1e-5;        ///< of a residual: a smaller change is rounding, and shows no slope

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("rough", options.rough);
    visit("polish", options.polish);
    visit("rounds", options.rounds);
    visit("finishing_rounds", options.finishing_rounds);
    visit("enough", options.enough);
    visit("polished", options.polished);
    visit("finished", options.finished);
    visit("settled", options.settled);
    visit("at_the_end", options.at_the_end);
    visit("roughly_settled", options.roughly_settled);
    visit("clear_gap", options.clear_gap);
    visit("hopeless", options.hopeless);
    visit("falls_behind", options.falls_behind);
    visit("other_sizes", options.other_sizes);
    visit("narrower", options.narrower);
    visit("scale_of_size", options.scale_of_size);
    visit("at_bound", options.at_bound);
    visit("rounded", options.rounded);
  }
};

/// Channels that a fit has made worse.
struct GuardOptions {
  double worse = 1.02;  ///< times the gap before; smaller growth does not matter
  double floor = 1.0;   ///< [floors] a smaller gap is noise whose floor was overestimated
  double growth = 2.0;  ///< of the weight of a channel that got worse
  int rounds = 6;       ///< of weighting
  int iterations = 3;   ///< in a round
  Share enough = 1e-4;  ///< of the cost: an iteration that gains less is the last
  Share price = 0.05;   ///< of what the fit has gained, that may be given up

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("worse", options.worse);
    visit("floor", options.floor);
    visit("growth", options.growth);
    visit("rounds", options.rounds);
    visit("iterations", options.iterations);
    visit("enough", options.enough);
    visit("price", options.price);
  }
};

/// The rise of the misfit where an effect is put into the model.
struct ProfileOptions {
  int iterations = 5;          ///< with the slopes of the fit without the effect
  double least_gain = 10.0;    ///< [nat] of an iteration that may matter
  Share share_of_rise = 0.05;  ///< of the rise that is asked for, the same

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("iterations", options.iterations);
    visit("least_gain", options.least_gain);
    visit("share_of_rise", options.share_of_rise);
  }
};

/// Intervals of sizes.
struct IntervalOptions {
  Share confidence = 0.95;  ///< of an interval
  int draws = 400;          ///< of the bootstrap
  /// of what a law does: standard deviation of the difference between the true law and that of
  /// the catalogue
  Share other_law = 0.05;
  std::size_t few_blocks = 5;  ///< of time; fewer are too few to estimate the noise
  Share exact = 1e-3;          ///< of its range, to which a flat range is found
  /// [standard deviations] that an unknown may change over all its range and still be flat
  double nothing = 1.0;

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("confidence", options.confidence);
    visit("draws", options.draws);
    visit("other_law", options.other_law);
    visit("few_blocks", options.few_blocks);
    visit("exact", options.exact);
    visit("nothing", options.nothing);
  }
};

/// How models are fitted.
struct FitOptions {
  int phases = 8;  ///< of a periodic effect that are tried
  SlopeOptions slopes;
  DampingOptions damping;
  ConvergenceOptions convergence;
  GuardOptions guard;
  ProfileOptions profile;
  IntervalOptions intervals;

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("phases", options.phases);
    visit("slopes", options.slopes);
    visit("damping", options.damping);
    visit("convergence", options.convergence);
    visit("guard", options.guard);
    visit("profile", options.profile);
    visit("intervals", options.intervals);
  }
};

}  // namespace discovery
}  // namespace anthrob
