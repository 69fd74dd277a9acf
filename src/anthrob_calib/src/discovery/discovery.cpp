#include "anthrob_calib/discovery/discovery.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <optional>
#include <utility>

#include "anthrob_calib/discovery/bootstrap.h"
#include "anthrob_calib/discovery/channel_guard.h"
#include "anthrob_calib/discovery/common_law.h"
#include "anthrob_calib/discovery/criteria.h"
#include "anthrob_calib/discovery/examples.h"
#include "anthrob_calib/discovery/found_effect.h"
#include "anthrob_calib/discovery/gaps.h"
#include "anthrob_calib/discovery/leftovers.h"
#include "anthrob_calib/discovery/location.h"
#include "anthrob_calib/discovery/named_effect.h"
#include "anthrob_calib/discovery/preflight.h"
#include "anthrob_calib/discovery/preparation.h"
#include "anthrob_calib/discovery/run_off.h"
#include "anthrob_calib/discovery/screening.h"
#include "anthrob_calib/discovery/seams.h"
#include "anthrob_calib/discovery/second_thoughts.h"
#include "anthrob_calib/discovery/separating_experiment.h"
#include "anthrob_calib/discovery/verdict.h"
#include "anthrob_calib/discovery/workbench.h"
#include "anthrob_calib/discovery/wrap_angle.h"

namespace anthrob {
namespace discovery {

namespace {

constexpr std::size_t kRenewed = 60;  ///< candidates whose doses are simulated again later
constexpr int kMostRounds = 2;        ///< for each effect that may be named

class Search {
 public:
  Search(const Evaluator& evaluator, const Question& question)
      : evaluator_(evaluator),
        question_(question),
        candidates_(list_candidates(evaluator, question.effects)),  // a wrong one is told at once
        laboratory_(prepare(evaluator, question)),
        variables_(measured_variables(laboratory_.train, question.train)),
        scales_(
            measure_scales(evaluator, laboratory_.train, laboratory_.repeats, laboratory_.lags)),
        train_(evaluator, laboratory_.train, whitener(laboratory_.train, scales_, true),
               coarse_step(evaluator, laboratory_.train, scales_)),
        test_(evaluator, laboratory_.test, whitener(laboratory_.test, scales_, true)),
        train_judge_(laboratory_.train, train_.whitening(), scales_),
        test_judge_(laboratory_.test, test_.whitening(), scales_),
        settling_(evaluator, train_, train_judge_),
        naming_(train_, test_, train_judge_, test_judge_, candidates_, question.seed),
        bench_{evaluator, train_, test_, candidates_, naming_, settling_},
        gaps_(train_judge_, test_judge_, candidates_.size()),
        leftovers_(candidates_) {}

  Answer answer() {
    Answer answer;
    answer.scales = scales_;
    answer.remarks = laboratory_.remarks;
    for (const std::string& remark : answer.remarks) {
      if (question_.comment) question_.comment(remark);
    }
    recalibrate(answer);
    stage("screening " + std::to_string(candidates_.size()) + " candidates");
    Screening screening(train_, base_.fit, candidates_, laboratory_.quick, laboratory_.slow);
    std::vector<Score> scores = screening.scores(base_.fit);
    stage("checking which effects these recordings can show");
    PreFlight(candidates_, train_, base_.fit, train_judge_, test_judge_,
              total_duration(laboratory_.test))
        .fly(screening, scores, answer);
    search(screening, std::move(scores), answer);
    while (fill_out(screening, answer)) search(screening, {}, answer);
    drop_improbable(answer);
    find_alternatives(screening, answer);
    measure_what_is_left(test_judge_, recalibrated_.test, base_.test, named_);
    spare_channels_that_pay();
    conclude(answer);
    return answer;
  }

 private:
  /// Effect after effect, until none earns its place.
  /// @param scores of the model as it is; empty: to be found
  void search(Screening& screening, std::vector<Score> scores, Answer& answer) {
    std::size_t looked_again = SIZE_MAX;  // with so many effects accepted
    // What is dropped again makes room; but not for ever.
    for (;
         rounds_ < kMostRounds * question_.max_effects && has_room() && gaps_.any(base_, kFaintGap);
         ++rounds_) {
      const std::string title = "effect " + std::to_string(named_.size() + 1) + ": ";
      if (scores.empty()) {
        stage(title + "screening");
        screening.renew(base_.fit, screening.scores(base_.fit), kRenewed);
        scores = screening.scores(base_.fit);
      }
      scores.erase(std::remove_if(scores.begin(), scores.end(),
                                  [&](const Score& s) { return is_named(s.candidate); }),
                   scores.end());
      stage(title + "fitting the short list");
      ShortList list = naming_.weigh(base_, leftovers_.besides(scores));
      if (question_.comment) comment_on(list);
      if (list.named.empty()) break;
      if (!earns_its_place(list, answer)) {
        if (leftovers_.refused(list.named.front().candidate, accepted())) continue;
        break;
      }
      scores.clear();
      if (base_moves_on(list)) {
        leftovers_.forget();
        if (named_.empty()) note_recalibrated(answer);
        naming_.follow(base_, list);
        if (question_.comment) comment_on(list);
        if (!earns_its_place(list, answer)) {
          // The list was drawn up for a base gone astray: once more, for the one that was found.
          if (std::exchange(looked_again, named_.size()) != named_.size()) continue;
          if (leftovers_.refused(list.named.front().candidate, accepted())) continue;
          break;
        }
      }
      accept(list, answer);
      unite(screening, answer);
      drop_superfluous(named_.size() - 1, answer);
    }
  }

  void stage(const std::string& what) const {
    if (question_.progress && !question_.progress(what)) throw Interrupted();
  }

  bool has_room() const { return named_.size() < static_cast<std::size_t>(question_.max_effects); }

  std::vector<std::size_t> accepted() const {
    std::vector<std::size_t> candidates;
    for (const NamedEffect& effect : named_) candidates.push_back(effect.candidate);
    return candidates;
  }

  bool is_named(std::size_t candidate) const {
    return std::any_of(named_.begin(), named_.end(),
                       [&](const NamedEffect& effect) { return effect.candidate == candidate; });
  }

  void comment_on(const ShortList& list) const {
    for (const Named& named : list.named) {
      char line[200];
      std::snprintf(line, sizeof(line), "  %-45s probability %.3f, gain %.1f nat (%.1f sigma)",
                    candidates_[named.candidate].name().c_str(), named.probability, named.evidence,
                    named.significance);
      question_.comment(line);
    }
  }

  void recalibrate(Answer& answer) {
    stage("fitting the ordinary parameters");
    answer.given.nuisances = evaluator_.initial_nuisances();
    given_train_ = train_.residual(answer.given);
    given_test_ = test_.residual(answer.given);
    base_ = bench_.tested(settling_.settled(answer.given, nuisance_unknowns(evaluator_)));
    if (given_test_.size() == 0 || base_.test.size() == 0) {
      throw std::runtime_error(
          "the model cannot be simulated with the inputs of the held-out recordings: replay them "
          "with anthrob_replay to see where it fails");
    }
    note_recalibrated(answer);
  }

  void note_recalibrated(Answer& answer) {
    answer.recalibrated = base_.fit.variant;
    recalibrated_ = base_;
    gaps_.begin(base_.test);
  }

  /// What looks like an effect may be ordinary parameters that found a better valley on the way:
  /// the model without it gets the same chance, from where its fit has ended.
  bool base_moves_on(const ShortList& list) {
    const Named& best = list.named.front();
    std::optional<Fitted> moved = bench_.without(named_.size(), best.candidate, best.fit);
    if (!moved) return false;
    const double reach = best.fit.cost + kOutOfReach * (base_.fit.cost - best.fit.cost);
    if (!settling_.settle_within_reach(*moved, reach)) return false;
    if (moved->cost >= base_.fit.cost) return false;
    Tested there = bench_.tested(std::move(*moved));
    if (there.test.size() == 0) return false;
    base_ = std::move(there);
    return true;
  }

  /// Whether the first of a list does; if not, the answer tells what it lacks.
  bool earns_its_place(const ShortList& list, Answer& answer) const {
    const std::string lacking = lack(gaps_.merit_of(list, base_));
    if (lacking.empty()) return true;
    const Named& best = list.named.front();
    const Candidate& candidate = candidates_[best.candidate];
    answer.refused = {candidate.effect->info().id, candidate.place, best.probability, best.evidence,
                      lacking};
    if (question_.comment) question_.comment("  not named: " + lacking);
    return false;
  }

  /// @param newest the effect that is not asked: it has just earned its place
  void drop_superfluous(std::size_t newest, Answer& answer) {
    const SecondThoughts second(bench_, gaps_);
    for (std::size_t e = 0; e < named_.size();) {
      if (e == newest) {
        ++e;
        continue;
      }
      const std::size_t candidate = named_[e].candidate;
      const double gained = named_[e].gained;
      const std::string name = candidates_[candidate].name();
      stage("checking whether " + name + " is still needed");
      std::optional<Tested> without = second.without(e, candidate, gained, base_);
      if (!without) {
        ++e;
        continue;
      }
      if (question_.comment) question_.comment("  no longer needed: " + name);
      remove(e, std::move(*without));
      if (e < newest) --newest;
      answer.dropped.push_back(name);
    }
  }

  /// @param without the model without that effect
  void remove(std::size_t e, Tested without) {
    base_ = std::move(without);
    named_.erase(named_.begin() + static_cast<std::ptrdiff_t>(e));
    // Planned with it in the model.
    for (NamedEffect& effect : named_) effect.found.separating_recording = {};
  }

  /// What has just been named, and was at other places before, may be everywhere: named instead of
  /// them where it clearly does better.
  void unite(Screening& screening, Answer& answer) {
    const Effect* const law = candidates_[named_.back().candidate].effect;
    std::vector<CommonLaw::Part> parts;
    for (std::size_t e = 0; e < named_.size(); ++e) {
      if (candidates_[named_[e].candidate].effect == law) parts.push_back({e, named_[e].candidate});
    }
    const CommonLaw common(bench_, screening);
    const std::optional<std::size_t> everywhere = common.everywhere(parts);
    if (!everywhere) return;
    const Candidate& candidate = candidates_[*everywhere];
    stage("checking whether one law explains them all: " + candidate.name());
    const auto instead = common.instead(*everywhere, base_, parts);
    if (!instead || !instead->is_clearly_better()) return;
    if (question_.comment) question_.comment("  named instead of them: " + candidate.name());
    const Variant apart = base_.fit.variant;
    NamedEffect united = named_[parts.front().effect];
    for (std::size_t p = 1; p < parts.size(); ++p) {
      united.found.evidence += named_[parts[p].effect].found.evidence;
    }
    for (auto part = parts.rbegin(); part != parts.rend(); ++part) {
      remove(part->effect, instead->tested);
    }
    note_what_it_changes(test_judge_, instead->without, base_.test, united);
    if (name_instead(candidate, instead->odds, united.found)) {
      separate(base_.fit.variant, apart, united.found);
    }
    united.candidate = *everywhere;
    united.gained = instead->gained;
    united.fuller = std::nullopt;
    named_.push_back(std::move(united));
    forget_refusals(candidate, answer);
  }

  /// A law that says more than a named one at its place is named instead of it, if it did better
  /// in that one's round and clearly does in the end. @return whether one is
  bool fill_out(Screening& screening, Answer& answer) {
    const CommonLaw common(bench_, screening);
    for (std::size_t e = 0; e < named_.size(); ++e) {
      NamedEffect& effect = named_[e];
      const std::optional<std::size_t> fuller = std::exchange(effect.fuller, std::nullopt);
      if (!fuller || is_named(*fuller)) continue;
      const Candidate& candidate = candidates_[*fuller];
      const std::string name = candidates_[effect.candidate].name();
      stage("checking whether " + candidate.name() + " does better than " + name);
      const auto instead = common.instead(*fuller, base_, {{e, effect.candidate}});
      if (!instead || !instead->is_better()) continue;
      if (!instead->is_clearly_better()) {
        leave_open(candidate, instead->odds, effect.found);
        separate(base_.fit.variant, instead->tested.fit.variant, effect.found);
        continue;
      }
      std::optional<Fitted> there = with_last_effect_at(train_, instead->tested.fit, e);
      if (!there) continue;
      if (question_.comment) question_.comment("  named instead of it: " + candidate.name());
      const bool stays = name_instead(candidate, instead->odds, effect.found);
      if (stays) separate(there->variant, base_.fit.variant, effect.found);
      base_ = bench_.tested(std::move(*there));
      effect.candidate = *fuller;
      effect.gained = instead->gained;
      forget_refusals(candidate, answer);
      drop_superfluous(e, answer);
      return true;
    }
    return false;
  }

  void note_limits() {
    for (std::size_t e = 0; e < named_.size(); ++e) {
      named_[e].found.at_limit =
          limit_of(candidates_[named_[e].candidate], base_.fit.variant.effects[e]);
    }
  }

  /// @return whether any effect is charged
  bool charge_for_spoilt_channels(const Tested& with_all) {
    return charge_spoilt_channels(test_judge_, recalibrated_.test, with_all.test, named_);
  }

  /// What leaves so much, bends so far, or costs a channel so much that it is hardly the right law
  /// does not extend the model: it may do what another one should.
  void drop_improbable(Answer& answer) {
    // What was not let in may be what is left.
    const bool left_counts = has_room() || !gaps_.any(base_, kFaintGap);
    for (;;) {
      measure_what_is_left(test_judge_, recalibrated_.test, base_.test, named_);
      note_limits();
      // What can be spared is not spoilt.
      if (charge_for_spoilt_channels(base_)) charge_for_spoilt_channels(spared());
      const NamedEffect* const improbable = least_of_improbable(named_, left_counts);
      if (!improbable) return;
      const auto e = static_cast<std::size_t>(improbable - named_.data());
      const Candidate& candidate = candidates_[improbable->candidate];
      stage("fitting without " + candidate.name() + ", which is improbable");
      std::optional<Fitted> without = bench_.without(e, improbable->candidate, base_.fit);
      if (!without) return;
      Tested base = bench_.tested(settling_.to_the_end(*without));
      if (base.test.size() == 0) return;
      if (question_.comment) question_.comment("  too improbable to be added: " + candidate.name());
      const FoundEffect& found = improbable->found;
      answer.improbable.push_back({found.id, found.name, found.place,
                                   found.probability * trust_in(found), found.evidence,
                                   found.shows_in, found.left, found.at_limit, found.spoils});
      forget_refusals(candidate, answer);
      answer.dropped.clear();  // beside this one they were not needed
      remove(e, std::move(base));
      for (NamedEffect& effect : named_) effect.before = 0.0;  // which may have been its work
      drop_superfluous(named_.size(), answer);
      if (named_.empty()) begin_again(answer);
    }
  }

  /// Nothing is named any more: of both fits the better one is what all is compared with.
  void begin_again(Answer& answer) {
    if (base_.fit.cost < recalibrated_.fit.cost) {
      note_recalibrated(answer);
    } else {
      base_ = recalibrated_;
    }
  }

  /// The model as it is, fitted so that what was found costs no channel anything, as far as that
  /// goes.
  Tested spared() const {
    stage("checking whether a channel got worse");
    Tested spared =
        bench_.tested(spare_channels(train_, train_judge_, recalibrated_.fit.residual, base_.fit));
    return spared.test.size() > 0 ? spared : base_;
  }

  /// Unless sparing one channel spoils another one.
  void spare_channels_that_pay() {
    if (named_.empty()) return;
    Tested without_loss = spared();
    const bool spoilt_before = charge_for_spoilt_channels(base_);
    if (charge_for_spoilt_channels(without_loss) && !spoilt_before) return;
    base_ = std::move(without_loss);
  }

  void find_alternatives(Screening& screening, Answer& answer) const {
    const CommonLaw common(bench_, screening);
    for (std::size_t later = 1; later < named_.size(); ++later) {
      for (std::size_t earlier = 0; earlier < later; ++earlier) {
        const CommonLaw::Part a{earlier, named_[earlier].candidate},
            b{later, named_[later].candidate};
        for (std::size_t law = 0; law < candidates_.size(); ++law) {
          if (is_named(law) || !common.may_be(law, a.candidate, b.candidate)) continue;
          const Candidate& alone = candidates_[law];
          stage("checking whether " + alone.name() + " alone can replace " +
                candidates_[a.candidate].name() + " and " + candidates_[b.candidate].name());
          const auto instead = common.instead(law, base_, {a, b});
          if (!instead || instead->odds.probability < kMentioned) continue;
          const std::string& id = alone.effect->info().id;
          answer.alternatives.push_back({id,
                                         alone.place,
                                         {earlier, later},
                                         instead->odds.probability,
                                         instead->odds.evidence,
                                         separating_experiment(named_[earlier].found.id, id)});
        }
      }
    }
  }

  /// Values and intervals of all effects in the model as it is at the end: later ones have moved
  /// earlier ones.
  void measure_effects() {
    if (named_.empty()) return;
    note_limits();
    charge_for_spoilt_channels(base_);
    const auto ranges =
        bootstrap_intervals(base_.fit, train_.experiments(), variables_, question_.seed);
    for (std::size_t e = 0; e < named_.size(); ++e) {
      for (const EffectParameter& p : candidates_[named_[e].candidate].parameters) {
        const double value = base_.fit.variant.effects[e].parameters.at(p.name);
        FoundParameter found{p.name, p.unit, value, value, value, true, false};
        for (std::size_t i = 0; i < ranges.size(); ++i) {
          const Unknown& u = base_.fit.unknowns[i];
          if (u.effect != static_cast<int>(e) || u.parameter != p.name) continue;
          found.known = false;
          found.low = ranges[i].first;
          found.high = ranges[i].second;
          found.undetermined = found.low <= u.lower && found.high >= u.upper;
        }
        named_[e].found.parameters.push_back(std::move(found));
      }
    }
  }

  /// What held-out recordings say of the candidates of a list [nat].
  using Evidence = std::map<std::size_t, double>;
  static Evidence evidence_of(const ShortList& list) {
    Evidence evidence;
    for (const Named& named : list.named) evidence[named.candidate] = named.evidence;
    return evidence;
  }

  /// Of these, the law that says more than another at its place and does better.
  std::optional<std::size_t> fuller_than(std::size_t simple, const Evidence& evidence) const {
    const auto its = evidence.find(simple);
    std::optional<std::size_t> fuller;
    double most = its == evidence.end() ? HUGE_VAL : its->second;
    for (const auto& [candidate, gain] : evidence) {
      if (gain <= most || !says_less(candidates_[simple], candidates_[candidate])) continue;
      most = gain;
      fuller = candidate;
    }
    return fuller;
  }

  /// With another model all are looked at again; one that is in it now was not refused.
  void forget_refusals(const Candidate& named, Answer& answer) {
    auto& dropped = answer.dropped;
    dropped.erase(std::remove(dropped.begin(), dropped.end(), named.name()), dropped.end());
    answer.refused = {};
    leftovers_.forget();
  }

  void accept(ShortList& list, Answer& answer) {
    const Evidence in_its_round = evidence_of(list);
    RunOff(bench_, gaps_).decide(base_, list);
    const Named& best = list.named.front();
    NamedEffect effect;
    effect.found = found_effect(list, candidates_);
    separate_first(list, effect.found);
    effect.candidate = best.candidate;
    effect.gained = base_.fit.cost - best.fit.cost;
    effect.fuller = fuller_than(best.candidate, in_its_round);
    note_what_it_changes(test_judge_, base_.test, best.test, effect);
    named_.push_back(std::move(effect));
    forget_refusals(candidates_[best.candidate], answer);
    base_ = best;
  }

  void separate_first(const ShortList& list, FoundEffect& effect) const {
    for (std::size_t i = 1; i < list.named.size(); ++i) {
      if (list.named[i].probability < kMentioned) continue;
      separate(list.named.front().fit.variant, list.named[i].fit.variant, effect);
      return;
    }
  }

  /// Plans what tells an effect from its first rival.
  void separate(const Variant& with, const Variant& with_rival, FoundEffect& effect) const {
    effect.separating_experiment = separating_experiment(effect.id, effect.rivals.front().id);
    effect.separating_recording =
        plan_separation(evaluator_, with, with_rival, question_.train.front(), scales_,
                        laboratory_.train.front()->bin());
  }

  Gap gap_of(const Judge& judge, const Eigen::VectorXf& given, const Eigen::VectorXf& recalibrated,
             const Eigen::VectorXf& after) const {
    return {judge.gap(given), judge.gap(recalibrated), judge.gap(after), 1.0};
  }

  void conclude(Answer& answer) {
    answer.extended = base_.fit.variant;
    measure_effects();
    for (const NamedEffect& effect : named_) answer.effects.push_back(effect.found);
    answer.train =
        gap_of(train_judge_, given_train_, recalibrated_.fit.residual, base_.fit.residual);
    answer.test = gap_of(test_judge_, given_test_, recalibrated_.test, base_.test);
    const auto given = test_judge_.channel_gaps(given_test_),
               recalibrated = test_judge_.channel_gaps(recalibrated_.test),
               after = test_judge_.channel_gaps(base_.test);
    for (const auto& [name, value] : given) {
      answer.per_channel[name] = {value, recalibrated.at(name), after.at(name), 1.0};
    }
    const double least = least_gap(answer), first = gaps_.first_excess(least);
    answer.remaining_share = first > 0.0 ? gaps_.excess_of(base_.test, least) / first : 0.0;
    stage("locating the gap");
    std::vector<MeasuredVariable> variables = variables_;
    for (MeasuredVariable& angle :
         wrap_angles(evaluator_, question_.train, laboratory_.train, answer.recalibrated)) {
      variables.push_back(std::move(angle));
    }
    answer.regimes = regime_gaps(laboratory_.train, variables, recalibrated_.fit.residual,
                                 train_.whitening(), scales_);
    answer.dependences = find_dependences(laboratory_.train, variables, recalibrated_.fit.residual,
                                          train_.whitening());
    answer.remaining =
        find_dependences(laboratory_.train, variables, base_.fit.residual, train_.whitening());
    answer.seams = seam_gaps(evaluator_, question_, laboratory_, scales_, answer.recalibrated);
    answer.where = locate(train_judge_, recalibrated_.fit.residual, least_gap(answer), scales_,
                          answer.seams, answer.dependences);
    answer.examples = examples_of(*laboratory_.test.front(), test_.whitening(), recalibrated_.test,
                                  base_.test, answer.per_channel);
    pronounce(train_judge_.channel_gaps(base_.fit.residual), gaps_.certain(base_), answer);
  }

  /// What was worth naming is worth counting.
  static double least_gap(const Answer& answer) {
    return answer.effects.empty() ? kRealGap : kFaintGap;
  }

  const Evaluator& evaluator_;
  const Question& question_;
  std::vector<Candidate> candidates_;
  Laboratory laboratory_;
  std::vector<MeasuredVariable> variables_;
  Scales scales_;
  ModelFit train_, test_;
  Judge train_judge_, test_judge_;
  Settling settling_;
  Naming naming_;
  Workbench bench_;
  Gaps gaps_;
  Leftovers leftovers_;
  Tested base_, recalibrated_;  ///< the model as it is; without effects
  Eigen::VectorXf given_train_, given_test_;
  std::vector<NamedEffect> named_;  ///< what is in the model now, in its order
  int rounds_ = 0;
};

}  // namespace

Answer discover(const Evaluator& evaluator, const Question& question) {
  return Search(evaluator, question).answer();
}

}  // namespace discovery
}  // namespace anthrob
