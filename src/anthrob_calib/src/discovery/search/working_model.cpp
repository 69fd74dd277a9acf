#include "anthrob_calib/discovery/search/working_model.h"

#include <algorithm>
#include <utility>

namespace anthrob {
namespace discovery {

WorkingModel::WorkingModel(const SearchSetup& setup)
    : gaps(setup.train_judge, setup.test_judge, setup.candidates.size()),
      excluded(setup.candidates),
      setup_(setup) {}

bool WorkingModel::has_room() const {
  return named.size() < static_cast<std::size_t>(setup_.question.max_effects);
}

bool WorkingModel::is_named(std::size_t candidate) const {
  return std::any_of(named.begin(), named.end(),
                     [&](const NamedEffect& effect) { return effect.candidate == candidate; });
}

bool WorkingModel::may_be_named(std::size_t candidate) const {
  const Candidate& one = setup_.candidates[candidate];
  return !is_named(candidate) &&
         std::none_of(given_up.begin(), given_up.end(), [&](std::size_t other) {
           const Candidate& dropped = setup_.candidates[other];
           return dropped.effect == one.effect && dropped.owner() == one.owner();
         });
}

std::vector<std::size_t> WorkingModel::accepted() const {
  std::vector<std::size_t> candidates;
  for (const NamedEffect& effect : named) candidates.push_back(effect.candidate);
  return candidates;
}

void WorkingModel::compare_with_this(Answer& answer) {
  answer.recalibrated = base.fit.variant;
  recalibrated = base;
  gaps.begin(base.test);
}

void WorkingModel::remove(std::size_t e, Tested without) {
  base = std::move(without);
  named.erase(named.begin() + static_cast<std::ptrdiff_t>(e));
  // Experiments were planned with that effect in the model.
  for (NamedEffect& effect : named) effect.found.separating_recording = {};
}

void WorkingModel::forget_refusals(const Candidate& candidate, Answer& answer) {
  auto& dropped = answer.dropped;
  dropped.erase(std::remove(dropped.begin(), dropped.end(), candidate.name()), dropped.end());
  answer.refused = {};
  excluded.clear();
}

bool WorkingModel::charge_for_spoilt_channels(const Tested& with_all) {
  return charge_spoilt_channels(setup_.test_judge, recalibrated.test, with_all.test, named);
}

void WorkingModel::note_limits() {
  for (std::size_t e = 0; e < named.size(); ++e) {
    named[e].found.at_limit =
        limit_of(setup_.candidates[named[e].candidate], base.fit.variant.effects[e]);
  }
}

}  // namespace discovery
}  // namespace anthrob
