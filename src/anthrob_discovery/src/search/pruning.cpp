#include "search/pruning.h"

#include <optional>
#include <string>
#include <utility>

#include "fit/channel_guard.h"
#include "search/backward_elimination.h"
#include "search/named_law.h"

namespace anthrob {
namespace discovery {

void Pruning::drop_superfluous(std::size_t newest) {
  const BackwardElimination elimination(hypotheses_, model_.gaps);
  for (std::size_t e = 0; e < model_.named.size();) {
    if (e == newest) {
      ++e;
      continue;
    }
    const std::size_t candidate = model_.named[e].candidate;
    const double gained = model_.named[e].gained;
    const std::string name = hypotheses_.candidates[candidate].name();
    observer_.stage("checking whether " + name + " is still needed");
    std::optional<Tested> without = elimination.without(e, candidate, gained, model_.base);
    if (!without) {
      ++e;
      continue;
    }
    observer_.say("  no longer needed: " + name);
    model_.remove(e, std::move(*without));
    if (e < newest) --newest;
    model_.record.dropped.push_back(name);
  }
}

bool Pruning::drop_improbable() {
  const TrustOptions& trust = hypotheses_.options.judgement.trust;
  // Where the search was full, the gap that a law leaves may be due to effects without a place.
  const bool left_counts =
      model_.has_room() || !model_.gaps.any(model_.base, hypotheses_.options.judgement.faint_gap);
  for (bool any = false;; any = true) {
    measure_what_is_left(hypotheses_.test_judge, model_.recalibrated.test, model_.base.test,
                         model_.named);
    model_.note_limits();
    // A channel that can be spared is not spoilt.
    if (model_.charge_for_spoilt_channels(model_.base)) {
      model_.charge_for_spoilt_channels(spared());
    }
    const NamedEffect* const improbable = least_of_improbable(model_.named, left_counts, trust);
    if (!improbable) return any;
    const auto e = static_cast<std::size_t>(improbable - model_.named.data());
    const Candidate& candidate = hypotheses_.candidates[improbable->candidate];
    observer_.stage("fitting without " + candidate.name() + ", which is improbable");
    std::optional<Fitted> without = hypotheses_.without(e, improbable->candidate, model_.base.fit);
    if (!without) return any;
    Tested base = hypotheses_.tested(hypotheses_.convergence.to_the_end(*without));
    if (base.test.size() == 0) return any;
    observer_.say("  too improbable to be added: " + candidate.name());
    model_.given_up.insert(improbable->candidate);
    const NamedLaw& found = improbable->found;
    model_.record.improbable.push_back(
        {found.id, found.name, found.place, found.probability * trust_in(found, trust),
         found.evidence, found.shows_in, found.left, found.at_limit, found.spoils, found.spoilt});
    model_.forget_refusals(candidate);
    model_.record.dropped.clear();  // they were not needed beside this one only
    model_.remove(e, std::move(base));
    // What the others explained when they were named may have been due to this one.
    for (NamedEffect& effect : model_.named) effect.before = 0.0;
    drop_superfluous(model_.named.size());
    if (model_.named.empty()) begin_again();
  }
}

/// Without any effect, the better of both fits is the one with which effects are compared.
void Pruning::begin_again() {
  if (model_.base.fit.cost < model_.recalibrated.fit.cost) {
    model_.compare_with_this();
  } else {
    model_.base = model_.recalibrated;
  }
}

Tested Pruning::spared() const {
  observer_.stage("checking whether a channel got worse");
  Tested spared =
      hypotheses_.tested(spare_channels(hypotheses_.train, hypotheses_.train_judge,
                                        model_.recalibrated.fit.residual, model_.base.fit));
  return spared.test.size() > 0 ? spared : model_.base;
}

void Pruning::spare_channels_that_pay() {
  if (model_.named.empty()) return;
  Tested without_loss = spared();
  const bool spoilt_before = model_.charge_for_spoilt_channels(model_.base);
  if (model_.charge_for_spoilt_channels(without_loss) && !spoilt_before) return;
  model_.base = std::move(without_loss);
}

}  // namespace discovery
}  // namespace anthrob
