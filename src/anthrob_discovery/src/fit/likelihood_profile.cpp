#include "fit/likelihood_profile.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace anthrob {
namespace discovery {

namespace {}  // namespace

LikelihoodProfile::LikelihoodProfile(const ModelFit& fit, Fitted base)
    : fit_(fit), base_(std::move(base)) {
  if (fit_.coarse_step() > 0.0) {
    Variant coarse = base_.variant;
    coarse.step = fit_.coarse_step();
    fit_.move(base_, coarse);  // unless the coarse step cannot simulate it
  }
  const ProfileOptions& options = fit_.options().profile;
  fit_.improve(base_, options.iterations, options.least_gain / (options.least_gain + base_.cost));
}

std::optional<double> LikelihoodProfile::rise(const Candidate& candidate, std::size_t size,
                                              double doses, double needed) const {
  const ProfileOptions& options = fit_.options().profile;
  const double telling = std::max(options.least_gain, options.share_of_rise * needed);
  const double enough = telling / (telling + base_.cost + needed);
  double mean = 0.0;
  for (const double side : {-1.0, 1.0}) {
    std::vector<double> amount(candidate.sizes().size(), 0.0);
    amount[size] = side * doses;
    Fitted fitted = base_;
    Variant variant = base_.variant;
    variant.effects.push_back(candidate.sized(amount));
    if (!fit_.move(fitted, variant)) return std::nullopt;
    fit_.improve(fitted, options.iterations, enough);
    mean += 0.5 * (fitted.misfit() - base_.misfit());
  }
  return mean;
}

}  // namespace discovery
}  // namespace anthrob
