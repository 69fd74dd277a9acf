#include "fit/channel_guard.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "judgement/criteria.h"

namespace anthrob {
namespace discovery {

namespace {

constexpr double kWorse = 1.02;  ///< smaller growth of a gap does not matter
constexpr double kFloor = 1.0;   ///< a smaller gap is noise whose floor was overestimated
constexpr double kGrowth = 2.0;  ///< of the weight of a channel that got worse
constexpr int kRounds = 6;
constexpr int kIterations = 3;
constexpr double kEnough = 1e-4;  ///< relative gain that is not worth another iteration
constexpr double kPrice = 0.05;   ///< largest share of the gain that may be given up

using Gaps = std::map<std::string, double>;

/// By how much the squared gap of each channel that got worse is too large.
Gaps paid(const Gaps& before, const Gaps& after) {
  Gaps too_large;
  for (const auto& [name, gap] : after) {
    const double more = excess(gap, std::max(kFloor, kWorse * before.at(name)));
    if (more > 0.0) too_large[name] = more;
  }
  return too_large;
}

double sum(const Gaps& gaps) {
  double sum = 0.0;
  for (const auto& [name, gap] : gaps) sum += gap;
  return sum;
}

Gaps ones(Gaps gaps) {
  for (auto& [name, gap] : gaps) gap = 1.0;
  return gaps;
}

double cost_in(const Eigen::VectorXf& channels, const Fitted& fitted) {
  return 0.5 * channels.cwiseProduct(fitted.residual).cast<double>().squaredNorm();
}

/// Fits on with every residual multiplied by a factor, and forgets the factor again.
bool fit_on(const ModelFit& fit, const Eigen::VectorXf& factor, Fitted& fitted) {
  const ModelFit weighted = fit.weighted(factor);
  Fitted heavier = fitted;
  heavier.sensitivity.array().colwise() *= factor.array();
  if (!weighted.move(heavier, fitted.variant)) return false;
  weighted.improve(heavier, kIterations, kEnough);
  heavier.sensitivity.array().colwise() /= factor.array();
  if (!fit.move(heavier, heavier.variant)) return false;
  fitted = std::move(heavier);
  return true;
}

}  // namespace

Fitted spare_channels(const ModelFit& fit, const Judge& judge, const Eigen::VectorXf& reference,
                      const Fitted& fitted) {
  const Gaps before = judge.channel_gaps(reference);
  Fitted best = fitted, present = fitted;
  Gaps weights, paying = paid(before, judge.channel_gaps(fitted.residual));
  const double gained = 0.5 * reference.cast<double>().squaredNorm() - fitted.cost;
  const Eigen::VectorXf theirs = judge.by_channel(ones(paying), 0.0);
  const auto is_dear = [&] {
    const double more = present.cost - fitted.cost;
    const double saved = cost_in(theirs, fitted) - cost_in(theirs, present);
    return more > kPrice * gained || more > saved;
  };
  double least = sum(paying);
  for (int round = 0; round < kRounds && !paying.empty(); ++round) {
    for (const auto& [name, gap] : paying) weights.try_emplace(name, 1.0).first->second *= kGrowth;
    if (!fit_on(fit, judge.by_channel(weights, 1.0).cwiseSqrt(), present) || is_dear()) break;
    paying = paid(before, judge.channel_gaps(present.residual));
    if (sum(paying) >= least) continue;
    least = sum(paying);
    best = present;
  }
  return best;
}

}  // namespace discovery
}  // namespace anthrob
