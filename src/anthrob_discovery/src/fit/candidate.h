#pragma once

#include <string>
#include <vector>

#include "anthrob_sim/effects/effect.h"
#include "experiment/evaluator.h"

namespace anthrob {
namespace discovery {

/// An effect at a place that might be missing.
struct Candidate {
  const Effect* effect = nullptr;
  std::string place;
  std::vector<EffectParameter> parameters;  ///< at this place
  /// Indices of ordinary parameters that are the same quantity. They are held at the model's values
  /// while the effect is fitted, so that the whole effect is found.
  std::vector<int> same_as;
  /// Doses that are realistic, where they are scaled to recordings; 0: as many as of all others.
  double realistic_doses = 0.0;

  std::string name() const { return effect->info().id + " @ " + place; }
  /// The muscle, joint or motor that its place belongs to; the first of two.
  std::string owner() const;
  /// Whether its place is all muscles together ("all").
  bool is_everywhere() const { return place == "all"; }
  /// At its neutral sizes, other parameters at their defaults.
  EffectInstance neutral() const;
  /// The same with one size at its typical value.
  EffectInstance dose(const EffectParameter& size) const;
  /// The same with every size so many doses from neutral, within its bounds.
  EffectInstance sized(const std::vector<double>& doses) const;
  std::vector<const EffectParameter*> sizes() const;
};

/// All effects at all their places on a robot, without those its model has already.
/// @param ids only these; empty: the whole catalogue  @throws BadInput for unknown ids
std::vector<Candidate> list_candidates(const Evaluator& evaluator,
                                       const std::vector<std::string>& ids);

}  // namespace discovery
}  // namespace anthrob
