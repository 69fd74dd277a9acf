#include "anthrob_calib/discovery/fit/likelihood_profile.h"

#include <utility>
#include <vector>

namespace anthrob {
namespace discovery {

namespace {

constexpr int kIterations = 5;     ///< with the sensitivities of the fit without the effect
constexpr double kTelling = 10.0;  ///< [nat] a smaller gain of an iteration decides nothing
constexpr double kSides[] = {-1.0, 1.0};

void fit_on(const ModelFit& fit, Fitted& fitted) {
  fit.improve(fitted, kIterations, kTelling / (kTelling + fitted.cost));
}

}  // namespace

LikelihoodProfile::LikelihoodProfile(const ModelFit& fit, Fitted base)
    : fit_(fit), base_(std::move(base)) {
  if (fit_.coarse_step() > 0.0) {
    Variant coarse = base_.variant;
    coarse.step = fit_.coarse_step();
    fit_.move(base_, coarse);  // unless the coarse step cannot simulate it
  }
  fit_on(fit_, base_);
}

std::optional<double> LikelihoodProfile::rise(const Candidate& candidate, std::size_t size,
                                              double doses) const {
  double mean = 0.0;
  for (const double side : kSides) {
    std::vector<double> amount(candidate.sizes().size(), 0.0);
    amount[size] = side * doses;
    Fitted fitted = base_;
    Variant variant = base_.variant;
    variant.effects.push_back(candidate.sized(amount));
    if (!fit_.move(fitted, variant)) return std::nullopt;
    fit_on(fit_, fitted);
    mean += 0.5 * (fitted.misfit() - base_.misfit());
  }
  return mean;
}

}  // namespace discovery
}  // namespace anthrob
