#include "search/search.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "anthrob_core/text.h"
#include "fit/reduction.h"
#include "judgement/merit.h"
#include "search/alternatives.h"
#include "search/common_law.h"
#include "search/final_comparison.h"
#include "search/named_law.h"

namespace anthrob {
namespace discovery {

void Search::run(std::vector<Score> scores) {
  add_effects(std::move(scores));
  while (fill_out()) add_effects({});
  if (!model_.has_room()) model_.record.end = SearchEnd::kFull;
}

void Search::add_effects(std::vector<Score> scores) {
  std::size_t looked_again = SIZE_MAX;  // with so many effects accepted
  model_.record.end = SearchEnd::kNoMore;
  // Dropped effects make room for others, but rounds are limited.
  for (; model_.has_room() && model_.gaps.any(model_.base, hypotheses_.options.judgement.faint_gap);
       ++rounds_) {
    if (rounds_ >= options().rounds_per_effect * most_effects_) {
      model_.record.end = SearchEnd::kRounds;
      break;
    }
    const std::string title = "effect " + std::to_string(model_.named.size() + 1) + ": ";
    if (scores.empty()) {
      observer_.stage(title + "screening");
      scores = new_scores();
    }
    scores.erase(std::remove_if(scores.begin(), scores.end(),
                                [&](const Score& s) { return !model_.may_be_named(s.candidate); }),
                 scores.end());
    observer_.stage(title + "fitting the short list");
    ShortList list = hypotheses_.comparison.weigh(model_.base, model_.excluded.filter(scores));
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
      if (model_.named.empty()) model_.compare_with_this();
      hypotheses_.comparison.follow(model_.base, list);
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
    favour_what_is_named();
  }
}

std::vector<Score> Search::new_scores() {
  screening_.renew(model_.base.fit, screening_.scores(model_.base.fit), options().renewed);
  return screening_.scores(model_.base.fit);
}

void Search::comment_on(const ShortList& list) const {
  for (const FittedCandidate& entry : list.entries) {
    char line[200];
    std::snprintf(line, sizeof(line), "  %-45s probability %.3f, gain %.1f nat (%.1f sigma)",
                  hypotheses_.candidates[entry.candidate].name().c_str(), entry.probability,
                  entry.evidence, entry.significance);
    observer_.say(line);
  }
  if (list.entries.empty() || !model_.named.empty()) return;
  observer_.favour(hypotheses_.candidates[list.entries.front().candidate].name());
}

void Search::favour_what_is_named() const {
  std::vector<std::string> names;
  for (const NamedEffect& effect : model_.named) {
    names.push_back(hypotheses_.candidates[effect.candidate].name());
  }
  observer_.favour(joined(names));
}

/// What looks like an effect may be ordinary parameters that found a better valley on the way: the
/// model without it gets the same chance, from where its fit has ended.
bool Search::base_moves_on(const ShortList& list) {
  const FittedCandidate& best = list.entries.front();
  Tested& base = model_.base;
  std::optional<Fitted> moved = hypotheses_.without(model_.named.size(), best.candidate, best.fit);
  if (!moved) return false;
  const double reach = best.fit.cost + options().out_of_reach * (base.fit.cost - best.fit.cost);
  if (!hypotheses_.convergence.converge_within_reach(*moved, reach)) return false;
  if (moved->cost >= base.fit.cost) return false;
  Tested there = hypotheses_.tested(std::move(*moved));
  if (there.test.size() == 0) return false;
  base = std::move(there);
  return true;
}

/// If the first of the list does not, the answer tells what it lacks.
bool Search::earns_its_place(const ShortList& list) {
  const std::optional<std::string> lacking =
      lack(model_.gaps.merit_of(list, model_.base), hypotheses_.options.judgement.merit);
  if (!lacking) return true;
  const FittedCandidate& best = list.entries.front();
  const Candidate& candidate = hypotheses_.candidates[best.candidate];
  model_.record.refused = Refused{candidate.effect->info().id, candidate.place, best.probability,
                                  best.evidence, *lacking};
  observer_.say("  not named: " + *lacking);
  return false;
}

bool Search::goes_on_elsewhere(const ShortList& list) {
  return model_.excluded.exclude(list.entries.front().candidate, model_.accepted());
}

void Search::accept(ShortList& list) {
  const Evidence in_its_round = evidence_of(list);
  FinalComparison(hypotheses_, model_.gaps).decide(model_.base, list);
  const FittedCandidate& best = list.entries.front();
  NamedEffect effect;
  effect.found = named_law(list, hypotheses_.candidates, options().mentioned);
  effect.contest = first_contest(list);
  effect.candidate = best.candidate;
  effect.gained = model_.base.fit.cost - best.fit.cost;
  effect.fuller = fuller_than(best.candidate, in_its_round);
  note_what_it_changes(hypotheses_.test_judge, model_.base.test, best.test, effect);
  model_.named.push_back(std::move(effect));
  model_.forget_refusals(hypotheses_.candidates[best.candidate]);
  model_.base = best;
}

bool Search::accept_elsewhere(const ShortList& list) {
  Tested& base = model_.base;
  const LawElsewhere elsewhere(hypotheses_, screening_);
  const Effect* const law = elsewhere.repeated(list, model_.accepted());
  if (!law || !model_.gaps.certain(base)) return false;
  observer_.stage("checking all other places of " + law->info().id);
  const std::size_t room = static_cast<std::size_t>(most_effects_) - model_.named.size();
  const auto all = elsewhere.fit(law, model_.accepted(), base, room);
  if (!all) return false;
  ShortList both;
  both.entries = {list.entries.front(), {}};
  static_cast<Tested&>(both.entries.back()) = all->fit;
  hypotheses_.comparison.judge(base, both);
  const FittedCandidate& first = both.entries.front();
  const bool is_first = first.fit.variant.effects.size() == all->fit.fit.variant.effects.size();
  if (!is_first || lack(model_.gaps.merit_of(both, base), hypotheses_.options.judgement.merit))
    return false;
  name_parts(*all, first.probability);
  Tested end = hypotheses_.tested(hypotheses_.convergence.to_the_end(all->fit.fit));
  base = end.test.size() > 0 ? std::move(end) : all->fit;
  unite();
  pruning_.drop_superfluous(model_.named.size());
  return true;
}

/// @param probability of all of them together: whether each is needed is asked afterwards
void Search::name_parts(const LawElsewhere::Everywhere& all, double probability) {
  for (const LawElsewhere::Part& part : all.parts) {
    const FittedCandidate& with = part.alone.entries.front();
    const Candidate& candidate = hypotheses_.candidates[with.candidate];
    NamedEffect effect;
    effect.found = named_law(part.alone, hypotheses_.candidates, options().mentioned);
    effect.found.probability = probability;
    effect.candidate = with.candidate;
    effect.gained = part.without.fit.cost - with.fit.cost;
    note_what_it_changes(hypotheses_.test_judge, part.without.test, with.test, effect);
    observer_.say("  named with the others: " + candidate.name());
    model_.forget_refusals(candidate);
    model_.named.push_back(std::move(effect));
  }
}

/// If the effect just named is a law that was named at other places before, one law for all places
/// may do clearly better than all of them; then it is named instead.
void Search::unite() {
  auto& named = model_.named;
  const Effect* const law = hypotheses_.candidates[named.back().candidate].effect;
  std::vector<CommonLaw::Part> parts;
  for (std::size_t e = 0; e < named.size(); ++e) {
    if (hypotheses_.candidates[named[e].candidate].effect == law) {
      parts.push_back({e, named[e].candidate});
    }
  }
  const CommonLaw common(hypotheses_, screening_);
  const std::optional<std::size_t> everywhere = common.everywhere(parts);
  if (!everywhere) return;
  const Candidate& candidate = hypotheses_.candidates[*everywhere];
  observer_.stage("checking whether one law explains them all: " + candidate.name());
  const auto instead = common.instead(*everywhere, model_.base, parts);
  if (!instead || !instead->is_clearly_better(options().common_law)) return;
  observer_.say("  named instead of them: " + candidate.name());
  const Variant apart = model_.base.fit.variant;
  NamedEffect united = named[parts.front().effect];
  for (std::size_t p = 1; p < parts.size(); ++p) {
    united.found.evidence += named[parts[p].effect].found.evidence;
  }
  for (auto part = parts.rbegin(); part != parts.rend(); ++part) {
    model_.remove(part->effect, instead->tested);
  }
  note_what_it_changes(hypotheses_.test_judge, instead->without, model_.base.test, united);
  Replaced replaced =
      name_instead(candidate, instead->odds, std::move(united.found), options().mentioned);
  united.found = std::move(replaced.effect);
  united.contest.reset();
  if (replaced.is_first_rival) united.contest = Contest{model_.base.fit.variant, apart};
  united.candidate = *everywhere;
  united.gained = instead->gained;
  united.fuller = std::nullopt;
  named.push_back(std::move(united));
  model_.forget_refusals(candidate);
}

bool Search::fill_out() {
  const CommonLaw common(hypotheses_, screening_);
  Tested& base = model_.base;
  for (std::size_t e = 0; e < model_.named.size(); ++e) {
    NamedEffect& effect = model_.named[e];
    const std::optional<std::size_t> fuller = std::exchange(effect.fuller, std::nullopt);
    if (!fuller || !model_.may_be_named(*fuller)) continue;
    const Candidate& candidate = hypotheses_.candidates[*fuller];
    const std::string name = hypotheses_.candidates[effect.candidate].name();
    observer_.stage("checking whether " + candidate.name() + " does better than " + name);
    const auto instead = common.instead(*fuller, base, {{e, effect.candidate}});
    if (!instead || !instead->is_better(options().common_law)) continue;
    if (!instead->is_clearly_better(options().common_law)) {
      effect.found = leave_open(candidate, instead->odds, std::move(effect.found));
      effect.contest = Contest{base.fit.variant, instead->tested.fit.variant};
      continue;
    }
    std::optional<Fitted> there = with_last_effect_at(hypotheses_.train, instead->tested.fit, e);
    if (!there) continue;
    observer_.say("  named instead of it: " + candidate.name());
    Replaced replaced =
        name_instead(candidate, instead->odds, std::move(effect.found), options().mentioned);
    effect.found = std::move(replaced.effect);
    effect.contest.reset();
    if (replaced.is_first_rival) effect.contest = Contest{there->variant, base.fit.variant};
    base = hypotheses_.tested(std::move(*there));
    effect.candidate = *fuller;
    effect.gained = instead->gained;
    model_.forget_refusals(candidate);
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
    if (gain <= most ||
        !is_nested_in(hypotheses_.candidates[simple], hypotheses_.candidates[candidate])) {
      continue;
    }
    most = gain;
    fuller = candidate;
  }
  return fuller;
}

std::optional<Contest> Search::first_contest(const ShortList& list) const {
  for (std::size_t i = 1; i < list.entries.size(); ++i) {
    if (list.entries[i].probability < options().mentioned) continue;
    return Contest{list.entries.front().fit.variant, list.entries[i].fit.variant};
  }
  return std::nullopt;
}

SearchResult search(const Hypotheses& hypotheses, const Baseline& baseline, Screening& screening,
                    std::vector<Score> scores, int most_effects, const Observer& observer) {
  WorkingModel model(hypotheses, baseline.recalibrated, most_effects);
  Pruning pruning(hypotheses, observer, model);
  Search search(hypotheses, observer, model, screening, pruning, most_effects);
  search.run(std::move(scores));
  if (pruning.drop_improbable() && model.gaps.certain(model.base)) {
    // A law that was dropped may have kept the right one from being tried in its place.
    search.run({});
    pruning.drop_improbable();
  }
  model.record.alternatives = find_alternatives(hypotheses, model, screening, observer);
  measure_what_is_left(hypotheses.test_judge, model.recalibrated.test, model.base.test,
                       model.named);
  pruning.spare_channels_that_pay();
  if (!model.named.empty()) {
    model.note_limits();
    model.charge_for_spoilt_channels(model.base);
  }
  return {std::move(model.recalibrated), std::move(model.base), std::move(model.named),
          std::move(model.record)};
}

}  // namespace discovery
}  // namespace anthrob
