#include "search/working_model.h"

#include <algorithm>
#include <utility>

namespace anthrob {
namespace discovery {

WorkingModel::WorkingModel(const Hypotheses& hypotheses, Tested recalibrated_model,
                           int most_effects)
    : base(std::move(recalibrated_model)),
      gaps(hypotheses.train_judge, hypotheses.test_judge, hypotheses.candidates.size()),
      excluded(hypotheses.candidates),
      hypotheses_(hypotheses),
      most_effects_(static_cast<std::size_t>(most_effects)) {
  compare_with_this();
}

bool WorkingModel::has_room() const {
  return named.size() < most_effects_;
}

bool WorkingModel::is_named(std::size_t candidate) const {
  return std::any_of(named.begin(), named.end(),
                     [&](const NamedEffect& effect) { return effect.candidate == candidate; });
}

bool WorkingModel::may_be_named(std::size_t candidate) const {
  const Candidate& one = hypotheses_.candidates[candidate];
  return !is_named(candidate) &&
         std::none_of(given_up.begin(), given_up.end(), [&](std::size_t other) {
           const Candidate& dropped = hypotheses_.candidates[other];
           return dropped.effect == one.effect && dropped.owner() == one.owner();
         });
}

std::vector<std::size_t> WorkingModel::accepted() const {
  std::vector<std::size_t> candidates;
  for (const NamedEffect& effect : named) candidates.push_back(effect.candidate);
  return candidates;
}

void WorkingModel::compare_with_this() {
  recalibrated = base;
  gaps.begin(base.test);
}

void WorkingModel::remove(std::size_t e, Tested without) {
  base = std::move(without);
  named.erase(named.begin() + static_cast<std::ptrdiff_t>(e));
  // Contests were drawn up with that effect in the model.
  for (NamedEffect& effect : named) effect.contest.reset();
}

void WorkingModel::forget_refusals(const Candidate& candidate) {
  auto& dropped = record.dropped;
  dropped.erase(std::remove(dropped.begin(), dropped.end(), candidate.name()), dropped.end());
  record.refused.reset();
  excluded.clear();
}

bool WorkingModel::charge_for_spoilt_channels(const Tested& with_all) {
  return charge_spoilt_channels(hypotheses_.test_judge, recalibrated.test, with_all.test, named);
}

void WorkingModel::note_limits() {
  for (std::size_t e = 0; e < named.size(); ++e) {
    named[e].found.at_limit =
        limit_of(hypotheses_.candidates[named[e].candidate], base.fit.variant.effects[e],
                 hypotheses_.options.judgement.trust)
            .value_or("");
  }
}

}  // namespace discovery
}  // namespace anthrob
