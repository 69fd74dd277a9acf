#include "fit/likelihood_profile.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace anthrob {
namespace discovery {

namespace {

constexpr int kIterations = 5;  ///< with the sensitivities of the fit without the effect
/// The smallest gain of an iteration that may matter.
constexpr double kLeast = 10.0;    // [nat]
constexpr double kOfARise = 0.05;  // of the rise that is asked for
constexpr double kSides[] = {-1.0, 1.0};

}  // namespace

LikelihoodProfile::LikelihoodProfile(const ModelFit& fit, Fitted base)
    : fit_(fit), base_(std::move(base)) {
  if (fit_.coarse_step() > 0.0) {
    Variant coarse = base_.variant;
    coarse.step = fit_.coarse_step();
    fit_.move(base_, coarse);  // unless the coarse step cannot simulate it
  }
  fit_.improve(base_, kIterations, kLeast / (kLeast + base_.cost));
}

std::optional<double> LikelihoodProfile::rise(const Candidate& candidate, std::size_t size,
                                              double doses, double needed) const {
  const double telling = std::max(kLeast, kOfARise * needed);
  const double enough = telling / (telling + base_.cost + needed);
  double mean = 0.0;
  for (const double side : kSides) {
    std::vector<double> amount(candidate.sizes().size(), 0.0);
    amount[size] = side * doses;
    Fitted fitted = base_;
    Variant variant = base_.variant;
    variant.effects.push_back(candidate.sized(amount));
    if (!fit_.move(fitted, variant)) return std::nullopt;
    fit_.improve(fitted, kIterations, enough);
    mean += 0.5 * (fitted.misfit() - base_.misfit());
  }
  return mean;
}

}  // namespace discovery
}  // namespace anthrob
