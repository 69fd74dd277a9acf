#include "fit/reduction.h"

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
  reduced.sensitivity = fitted.sensitivity(Eigen::all, kept);
  reduced.curvatures = fitted.curvatures;
  const std::vector<Unknown> ordinary = nuisance_unknowns(evaluator);
  for (std::size_t i = 0; i < reduced.unknowns.size(); ++i) {
    Unknown& u = reduced.unknowns[i];
    const auto& same = candidate.same_as;
    if (u.nuisance < 0 || std::find(same.begin(), same.end(), u.nuisance) == same.end()) continue;
    u = ordinary[static_cast<std::size_t>(u.nuisance)];
    for (const EffectParameter* size : candidate.sizes()) {
      u.write(u.expected + gone.parameters.at(size->name) - size->neutral, variant);
      // Held parameters have no sensitivity; that of the same quantity's size is used.
      for (std::size_t k = 0; k < fitted.unknowns.size(); ++k) {
        const Unknown& of_size = fitted.unknowns[k];
        if (of_size.effect != index || of_size.parameter != size->name) continue;
        reduced.sensitivity.col(static_cast<Eigen::Index>(i)) =
            static_cast<float>(u.scale / of_size.scale) *
            fitted.sensitivity.col(static_cast<Eigen::Index>(k));
      }
    }
  }
  if (!fit.move(reduced, variant)) return std::nullopt;
  return reduced;
}

std::optional<Fitted> with_last_effect_at(const ModelFit& fit, const Fitted& fitted,
                                          std::size_t index) {
  Fitted moved = fitted;
  Variant variant = fitted.variant;
  const int last = static_cast<int>(variant.effects.size()) - 1, to = static_cast<int>(index);
  std::rotate(variant.effects.begin() + to, variant.effects.end() - 1, variant.effects.end());
  for (Unknown& u : moved.unknowns) {
    if (u.effect == last) {
      u.effect = to;
    } else if (u.effect >= to) {
      ++u.effect;
    }
  }
  if (!fit.move(moved, variant)) return std::nullopt;
  return moved;
}

}  // namespace discovery
}  // namespace anthrob
