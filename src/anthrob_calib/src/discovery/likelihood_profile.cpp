#include "anthrob_calib/discovery/likelihood_profile.h"

namespace anthrob {
namespace discovery {

namespace {

constexpr int kIterations = 5;    ///< by the slopes of the fit without the effect
constexpr double kEnough = 1e-3;  ///< relative gain that is not worth another one
constexpr double kSides[] = {-1.0, 1.0};

}  // namespace

std::optional<double> profile_rise(const ModelFit& fit, const Fitted& base,
                                   const Candidate& candidate, std::size_t size, double doses) {
  double mean = 0.0;
  for (const double side : kSides) {
    std::vector<double> amount(candidate.sizes().size(), 0.0);
    amount[size] = side * doses;
    Variant variant = base.variant;
    variant.effects.push_back(candidate.sized(amount));
    Fitted fitted = base;
    if (!fit.move(fitted, variant)) return std::nullopt;
    fit.improve(fitted, kIterations, kEnough);
    mean += 0.5 * (fitted.cost - base.cost);
  }
  return mean;
}

}  // namespace discovery
}  // namespace anthrob
