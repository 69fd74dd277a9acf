#include "anthrob_calib/discovery/search/search.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>

#include "anthrob_calib/discovery/judgement/criteria.h"
#include "anthrob_calib/discovery/search/common_law.h"
#include "anthrob_calib/discovery/search/final_comparison.h"
#include "anthrob_calib/discovery/search/found_effect.h"
#include "anthrob_calib/discovery/separation/separating_experiment.h"

namespace anthrob {
namespace discovery {

namespace {

constexpr std::size_t kRenewed = 60;  ///< candidates whose doses are simulated again later
constexpr int kMostRounds = 2;        ///< for each effect that may be named

}  // namespace

void Search::run(std::vector<Score> scores) {
  add_effects(std::move(scores));
  while (fill_out()) add_effects({});
  answer_.ended_full = !model_.has_room();
}

void Search::add_effects(std::vector<Score> scores) {
  std::size_t looked_again = SIZE_MAX;  // with so many effects accepted
  answer_.ended_early = false;
  // Dropped effects make room for others, but rounds are limited.
  for (; model_.has_room() && model_.gaps.any(model_.base, kFaintGap); ++rounds_) {
    answer_.ended_early = rounds_ >= kMostRounds * setup_.question.max_effects;
    if (answer_.ended_early) break;
    const std::string title = "effect " + std::to_string(model_.named.size() + 1) + ": ";
    if (scores.empty()) {
      setup_.stage(title + "screening");
      scores = new_scores();
    }
    scores.erase(std::remove_if(scores.begin(), scores.end(),
                                [&](const Score& s) { return !model_.may_be_named(s.candidate); }),
                 scores.end());
    setup_.stage(title + "fitting the short list");
    ShortList list = setup_.comparison.weigh(model_.base, model_.excluded.filter(scores));
    comment_on(list);
    if (list.entries.empty()) break;
    if (accept_elsewhere(list)) {
      scores.clear();
      continue;
    }
    if (!earns_its_place(list)) {
      if (goes_on_elsewhere(list)) continue;
      break;
    }
    scores.clear();
    if (base_moves_on(list)) {
      model_.excluded.clear();
      if (model_.named.empty()) model_.compare_with_this(answer_);
      setup_.comparison.follow(model_.base, list);
      comment_on(list);
      if (!earns_its_place(list)) {
        // The list was drawn up for a worse fit of the base: once more, for the better one.
        if (std::exchange(looked_again, model_.named.size()) != model_.named.size()) continue;
        if (goes_on_elsewhere(list)) continue;
        break;
      }
    }
    accept(list);
    unite();
    pruning_.drop_superfluous(model_.named.size() - 1);
  }
}

std::vector<Score> Search::new_scores() {
  screening_.renew(model_.base.fit, screening_.scores(model_.base.fit), kRenewed);
  return screening_.scores(model_.base.fit);
}

void Search::comment_on(const ShortList& list) const {
  for (const FittedCandidate& entry : list.entries) {
    char line[200];
    std::snprintf(line, sizeof(line), "  %-45s probability %.3f, gain %.1f nat (%.1f sigma)",
                  setup_.candidates[entry.candidate].name().c_str(), entry.probability,
                  entry.evidence, entry.significance);
    setup_.comment(line);
  }
}

/// What looks like an effect may be ordinary parameters that found a better valley on the way: the
/// model without it gets the same chance, from where its fit has ended.
bool Search::base_moves_on(const ShortList& list) {
  const FittedCandidate& best = list.entries.front();
  Tested& base = model_.base;
  std::optional<Fitted> moved =
      setup_.context.without(model_.named.size(), best.candidate, best.fit);
  if (!moved) return false;
  const double reach = best.fit.cost + kOutOfReach * (base.fit.cost - best.fit.cost);
  if (!setup_.convergence.converge_within_reach(*moved, reach)) return false;
  if (moved->cost >= base.fit.cost) return false;
  Tested there = setup_.context.tested(std::move(*moved));
  if (there.test.size() == 0) return false;
  base = std::move(there);
  return true;
}

/// If the first of the list does not, the answer tells what it lacks.
bool Search::earns_its_place(const ShortList& list) {
  const std::string lacking = lack(model_.gaps.merit_of(list, model_.base));
  if (lacking.empty()) return true;
  const FittedCandidate& best = list.entries.front();
  const Candidate& candidate = setup_.candidates[best.candidate];
  answer_.refused = {candidate.effect->info().id, candidate.place, best.probability, best.evidence,
                     lacking};
  setup_.comment("  not named: " + lacking);
  return false;
}

bool Search::goes_on_elsewhere(const ShortList& list) {
  return model_.excluded.exclude(list.entries.front().candidate, model_.accepted());
}

void Search::accept(ShortList& list) {
  const Evidence in_its_round = evidence_of(list);
  FinalComparison(setup_.context, model_.gaps).decide(model_.base, list);
  const FittedCandidate& best = list.entries.front();
  NamedEffect effect;
  effect.found = found_effect(list, setup_.candidates);
  separate_first(list, effect.found);
  effect.candidate = best.candidate;
  effect.gained = model_.base.fit.cost - best.fit.cost;
  effect.fuller = fuller_than(best.candidate, in_its_round);
  note_what_it_changes(setup_.test_judge, model_.base.test, best.test, effect);
  model_.named.push_back(std::move(effect));
  model_.forget_refusals(setup_.candidates[best.candidate], answer_);
  model_.base = best;
}

bool Search::accept_elsewhere(const ShortList& list) {
  Tested& base = model_.base;
  const LawElsewhere elsewhere(setup_.context, setup_.scan, screening_);
  const Effect* const law = elsewhere.repeated(list, model_.accepted());
  if (!law || !model_.gaps.certain(base)) return false;
  setup_.stage("checking all other places of " + law->info().id);
  const std::size_t room =
      static_cast<std::size_t>(setup_.question.max_effects) - model_.named.size();
  const auto all = elsewhere.fit(law, model_.accepted(), base, room);
  if (!all) return false;
  ShortList both;
  both.entries = {list.entries.front(), {}};
  static_cast<Tested&>(both.entries.back()) = all->fit;
  setup_.comparison.judge(base, both);
  const FittedCandidate& first = both.entries.front();
  const bool is_first = first.fit.variant.effects.size() == all->fit.fit.variant.effects.size();
  if (!is_first || !lack(model_.gaps.merit_of(both, base)).empty()) return false;
  name_parts(*all, first.probability);
  Tested end = setup_.context.tested(setup_.convergence.to_the_end(all->fit.fit));
  base = end.test.size() > 0 ? std::move(end) : all->fit;
  unite();
  pruning_.drop_superfluous(model_.named.size());
  return true;
}

/// @param probability of all of them together: whether each is needed is asked afterwards
void Search::name_parts(const LawElsewhere::Everywhere& all, double probability) {
  for (const LawElsewhere::Part& part : all.parts) {
    const FittedCandidate& with = part.alone.entries.front();
    const Candidate& candidate = setup_.candidates[with.candidate];
    NamedEffect effect;
    effect.found = found_effect(part.alone, setup_.candidates);
    effect.found.probability = probability;
    effect.candidate = with.candidate;
    effect.gained = part.without.fit.cost - with.fit.cost;
    note_what_it_changes(setup_.test_judge, part.without.test, with.test, effect);
    setup_.comment("  named with the others: " + candidate.name());
    model_.forget_refusals(candidate, answer_);
    model_.named.push_back(std::move(effect));
  }
}

/// If the effect just named is a law that was named at other places before, one law for all places
/// may do clearly better than all of them; then it is named instead.
void Search::unite() {
  auto& named = model_.named;
  const Effect* const law = setup_.candidates[named.back().candidate].effect;
  std::vector<CommonLaw::Part> parts;
  for (std::size_t e = 0; e < named.size(); ++e) {
    if (setup_.candidates[named[e].candidate].effect == law) {
      parts.push_back({e, named[e].candidate});
    }
  }
  const CommonLaw common(setup_.context, screening_);
  const std::optional<std::size_t> everywhere = common.everywhere(parts);
  if (!everywhere) return;
  const Candidate& candidate = setup_.candidates[*everywhere];
  setup_.stage("checking whether one law explains them all: " + candidate.name());
  const auto instead = common.instead(*everywhere, model_.base, parts);
  if (!instead || !instead->is_clearly_better()) return;
  setup_.comment("  named instead of them: " + candidate.name());
  const Variant apart = model_.base.fit.variant;
  NamedEffect united = named[parts.front().effect];
  for (std::size_t p = 1; p < parts.size(); ++p) {
    united.found.evidence += named[parts[p].effect].found.evidence;
  }
  for (auto part = parts.rbegin(); part != parts.rend(); ++part) {
    model_.remove(part->effect, instead->tested);
  }
  note_what_it_changes(setup_.test_judge, instead->without, model_.base.test, united);
  if (name_instead(candidate, instead->odds, united.found)) {
    separate(model_.base.fit.variant, apart, united.found);
  }
  united.candidate = *everywhere;
  united.gained = instead->gained;
  united.fuller = std::nullopt;
  named.push_back(std::move(united));
  model_.forget_refusals(candidate, answer_);
}

bool Search::fill_out() {
  const CommonLaw common(setup_.context, screening_);
  Tested& base = model_.base;
  for (std::size_t e = 0; e < model_.named.size(); ++e) {
    NamedEffect& effect = model_.named[e];
    const std::optional<std::size_t> fuller = std::exchange(effect.fuller, std::nullopt);
    if (!fuller || !model_.may_be_named(*fuller)) continue;
    const Candidate& candidate = setup_.candidates[*fuller];
    const std::string name = setup_.candidates[effect.candidate].name();
    setup_.stage("checking whether " + candidate.name() + " does better than " + name);
    const auto instead = common.instead(*fuller, base, {{e, effect.candidate}});
    if (!instead || !instead->is_better()) continue;
    if (!instead->is_clearly_better()) {
      leave_open(candidate, instead->odds, effect.found);
      separate(base.fit.variant, instead->tested.fit.variant, effect.found);
      continue;
    }
    std::optional<Fitted> there = with_last_effect_at(setup_.train, instead->tested.fit, e);
    if (!there) continue;
    setup_.comment("  named instead of it: " + candidate.name());
    const bool stays = name_instead(candidate, instead->odds, effect.found);
    if (stays) separate(there->variant, base.fit.variant, effect.found);
    base = setup_.context.tested(std::move(*there));
    effect.candidate = *fuller;
    effect.gained = instead->gained;
    model_.forget_refusals(candidate, answer_);
    pruning_.drop_superfluous(e);
    return true;
  }
  return false;
}

Search::Evidence Search::evidence_of(const ShortList& list) {
  Evidence evidence;
  for (const FittedCandidate& entry : list.entries) evidence[entry.candidate] = entry.evidence;
  return evidence;
}

/// Of the candidates of a list, the law that says more than another at its place and does better.
std::optional<std::size_t> Search::fuller_than(std::size_t simple, const Evidence& evidence) const {
  const auto its = evidence.find(simple);
  std::optional<std::size_t> fuller;
  double most = its == evidence.end() ? HUGE_VAL : its->second;
  for (const auto& [candidate, gain] : evidence) {
    if (gain <= most || !is_nested_in(setup_.candidates[simple], setup_.candidates[candidate])) {
      continue;
    }
    most = gain;
    fuller = candidate;
  }
  return fuller;
}

void Search::separate_first(const ShortList& list, FoundEffect& effect) const {
  for (std::size_t i = 1; i < list.entries.size(); ++i) {
    if (list.entries[i].probability < kMentioned) continue;
    separate(list.entries.front().fit.variant, list.entries[i].fit.variant, effect);
    return;
  }
}

/// Plans what tells an effect from its first rival.
void Search::separate(const Variant& with, const Variant& with_rival, FoundEffect& effect) const {
  effect.separating_experiment = separating_experiment(effect.id, effect.rivals.front().id);
  effect.separating_recording =
      plan_separation(setup_.evaluator, with, with_rival, setup_.question.train.front(),
                      setup_.scales, setup_.recordings.train.front()->bin());
}

}  // namespace discovery
}  // namespace anthrob
