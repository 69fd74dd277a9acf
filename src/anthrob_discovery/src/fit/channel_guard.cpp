#include "fit/channel_guard.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "judgement/excess.h"

namespace anthrob {
namespace discovery {

namespace {

using ChannelGaps = std::map<std::string, double>;

/// By how much the squared gap of each channel that got worse is too large.
ChannelGaps paid(const ChannelGaps& before, const ChannelGaps& after, const GuardOptions& options) {
  ChannelGaps too_large;
  for (const auto& [name, gap] : after) {
    const double more = excess(gap, std::max(options.floor, options.worse * before.at(name)));
    if (more > 0.0) too_large[name] = more;
  }
  return too_large;
}

double sum(const ChannelGaps& gaps) {
  double sum = 0.0;
  for (const auto& [name, gap] : gaps) sum += gap;
  return sum;
}

ChannelGaps ones(ChannelGaps gaps) {
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
  weighted.improve(heavier, fit.options().guard.iterations, fit.options().guard.enough);
  heavier.sensitivity.array().colwise() /= factor.array();
  if (!fit.move(heavier, heavier.variant)) return false;
  fitted = std::move(heavier);
  return true;
}

}  // namespace

Fitted spare_channels(const ModelFit& fit, const Judge& judge, const Eigen::VectorXf& reference,
                      const Fitted& fitted) {
  const GuardOptions& options = fit.options().guard;
  const ChannelGaps before = judge.channel_gaps(reference);
  Fitted best = fitted, present = fitted;
  ChannelGaps weights, paying = paid(before, judge.channel_gaps(fitted.residual), options);
  const double gained = 0.5 * reference.cast<double>().squaredNorm() - fitted.cost;
  const Eigen::VectorXf theirs = judge.by_channel(ones(paying), 0.0);
  const auto is_dear = [&] {
    const double more = present.cost - fitted.cost;
    const double saved = cost_in(theirs, fitted) - cost_in(theirs, present);
    return more > options.price * gained || more > saved;
  };
  double least = sum(paying);
  for (int round = 0; round < options.rounds && !paying.empty(); ++round) {
    for (const auto& [name, gap] : paying)
      weights.try_emplace(name, 1.0).first->second *= options.growth;
    if (!fit_on(fit, judge.by_channel(weights, 1.0).cwiseSqrt(), present) || is_dear()) break;
    paying = paid(before, judge.channel_gaps(present.residual), options);
    if (sum(paying) >= least) continue;
    least = sum(paying);
    best = present;
  }
  return best;
}

}  // namespace discovery
}  // namespace anthrob
