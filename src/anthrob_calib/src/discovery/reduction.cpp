#include "anthrob_calib/discovery/reduction.h"

#include <algorithm>

namespace anthrob {
namespace discovery {

std::optional<Fitted> without_effect(const Evaluator& evaluator, const ModelFit& fit,
                                     const Fitted& fitted, std::size_t effect,
                                     const Candidate& candidate) {
  Fitted reduced;
  Variant variant = fitted.variant;
  const EffectInstance gone = variant.effects[effect];
  variant.effects.erase(variant.effects.begin() + static_cast<std::ptrdiff_t>(effect));
  const auto index = static_cast<int>(effect);
  std::vector<Eigen::Index> kept;
  for (std::size_t i = 0; i < fitted.unknowns.size(); ++i) {
    Unknown u = fitted.unknowns[i];
    if (u.effect == index) continue;
    if (u.effect > index) --u.effect;
    reduced.unknowns.push_back(u);
    kept.push_back(static_cast<Eigen::Index>(i));
  }
  const std::vector<Unknown> ordinary = nuisance_unknowns(evaluator);
  for (Unknown& u : reduced.unknowns) {
    const auto& same = candidate.same_as;
    if (u.nuisance < 0 || std::find(same.begin(), same.end(), u.nuisance) == same.end()) continue;
    u = ordinary[static_cast<std::size_t>(u.nuisance)];
    for (const EffectParameter* size : candidate.sizes()) {
      u.write(u.expected + gone.parameters.at(size->name) - size->neutral, variant);
    }
  }
  reduced.sensitivity = fitted.sensitivity(Eigen::all, kept);
  if (!fit.move(reduced, variant)) return std::nullopt;
  return reduced;
}

}  // namespace discovery
}  // namespace anthrob
