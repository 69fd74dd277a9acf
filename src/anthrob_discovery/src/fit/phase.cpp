#include "fit/phase.h"

#include <algorithm>
#include <cmath>

namespace anthrob {
namespace discovery {

bool has_phase(const Candidate& candidate) {
  const auto sizes = candidate.sizes();
  return sizes.size() == 2 && sizes[0]->unit == sizes[1]->unit &&
         std::all_of(sizes.begin(), sizes.end(), [](const auto* size) {
           return size->bounds.lo < size->neutral && size->neutral < size->bounds.hi;
         });
}

std::vector<std::vector<double>> other_phases(const Candidate& candidate,
                                              const std::vector<double>& amount) {
  const auto sizes = candidate.sizes();
  const double one = sizes[0]->typical - sizes[0]->neutral,
               other = sizes[1]->typical - sizes[1]->neutral;
  const double a = amount[0] * one, b = amount[1] * other;
  return {{-b / one, a / other}, {-a / one, -b / other}, {b / one, -a / other}};
}

std::optional<EffectInstance> better_phase(const ModelFit& fit, const Candidate& candidate,
                                           const Fitted& fitted) {
  const int phases = fit.options().phases;
  const auto sizes = candidate.sizes();
  const EffectInstance& now = fitted.variant.effects.back();
  const double a = now.parameters.at(sizes[0]->name) - sizes[0]->neutral,
               b = now.parameters.at(sizes[1]->name) - sizes[1]->neutral;
  std::vector<Variant> variants;
  for (int k = 1; k < phases; ++k) {
    const double turn = 2.0 * M_PI * k / phases, c = std::cos(turn), s = std::sin(turn);
    variants.push_back(fitted.variant);
    const double turned[] = {a * c - b * s, a * s + b * c};
    for (int i = 0; i < 2; ++i) {
      const EffectParameter& size = *sizes[static_cast<std::size_t>(i)];
      variants.back().effects.back().parameters[size.name] =
          std::clamp(size.neutral + turned[i], size.bounds.lo, size.bounds.hi);
    }
  }
  const std::vector<Eigen::VectorXf> residuals = fit.residuals(variants);
  double least = fitted.residual.cast<double>().squaredNorm();
  std::optional<EffectInstance> better;
  for (std::size_t k = 0; k < variants.size(); ++k) {
    if (residuals[k].size() == 0) continue;  // cannot be simulated
    const double left = residuals[k].cast<double>().squaredNorm();
    if (left >= least) continue;
    least = left;
    better = variants[k].effects.back();
  }
  return better;
}

}  // namespace discovery
}  // namespace anthrob
