#include "anthrob_calib/discovery/discovery.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "anthrob_calib/discovery/bootstrap.h"
#include "anthrob_calib/discovery/common_law.h"
#include "anthrob_calib/discovery/criteria.h"
#include "anthrob_calib/discovery/examples.h"
#include "anthrob_calib/discovery/location.h"
#include "anthrob_calib/discovery/merit.h"
#include "anthrob_calib/discovery/naming.h"
#include "anthrob_calib/discovery/preflight.h"
#include "anthrob_calib/discovery/preparation.h"
#include "anthrob_calib/discovery/reduction.h"
#include "anthrob_calib/discovery/screening.h"
#include "anthrob_calib/discovery/seams.h"
#include "anthrob_calib/discovery/separating_experiment.h"
#include "anthrob_calib/discovery/settling.h"
#include "anthrob_calib/discovery/verdict.h"

namespace anthrob {
namespace discovery {

namespace {

constexpr int kRecalibrations = 8;
constexpr double kOutOfReach = 0.5;  ///< share of an effect's gain that is left without it
constexpr std::size_t kRenewed =
    60;                              ///< candidates whose doses are simulated again in later rounds
constexpr int kMostRounds = 2;       ///< for each effect that may be named
constexpr double kMentioned = 0.02;  ///< least probability of a rival

/// What of all channels' squared gaps is more than that of a gap.
double whole_excess(const Judge& judge, const Eigen::VectorXf& residual, double least) {
  double sum = 0.0;
  for (const auto& [name, gap] : judge.channel_gaps(residual)) sum += excess(gap, least);
  return sum;
}

/// A candidate that is in the model now.
struct Accepted {
  std::size_t candidate = 0;
  double gained = 0.0;  ///< of the cost, when it came in
};

class Search {
 public:
  Search(const Evaluator& evaluator, const Question& question)
      : evaluator_(evaluator),
        question_(question),
        laboratory_(prepare(evaluator, question)),
        variables_(measured_variables(laboratory_.train, question.train)),
        scales_(measure_scales(evaluator, laboratory_.train, laboratory_.repeats)),
        train_(evaluator, laboratory_.train, whitener(laboratory_.train, scales_, true),
               coarse_step(evaluator, laboratory_.train, scales_)),
        test_(evaluator, laboratory_.test, whitener(laboratory_.test, scales_, true)),
        train_judge_(laboratory_.train, train_.whitening(), scales_),
        test_judge_(laboratory_.test, test_.whitening(), scales_),
        settling_(evaluator, train_, train_judge_),
        candidates_(list_candidates(evaluator, question.effects)),
        naming_(train_, test_, train_judge_, test_judge_, candidates_, question.seed) {}

  Answer answer() {
    Answer answer;
    answer.scales = scales_;
    recalibrate(answer);
    stage("screening " + std::to_string(candidates_.size()) + " candidates");
    Screening screening(train_, base_, candidates_, laboratory_.quick, laboratory_.slow);
    std::vector<Score> scores = screening.scores(base_);
    PreFlight(candidates_, base_, train_judge_, test_judge_, total_duration(laboratory_.test))
        .fly(screening, scores, answer);
    // What is dropped again makes room; but not for ever.
    for (int round = 0;
         round < kMostRounds * question_.max_effects && has_room() && has_gap(kFaintGap); ++round) {
      const std::string title = "effect " + std::to_string(accepted_.size() + 1) + ": ";
      if (round > 0) {
        stage(title + "screening");
        screening.renew(base_, screening.scores(base_), kRenewed);
        scores = screening.scores(base_);
      }
      scores.erase(std::remove_if(scores.begin(), scores.end(),
                                  [&](const Score& s) { return is_accepted(s.candidate); }),
                   scores.end());
      stage(title + "fitting the short list");
      ShortList list = naming_.weigh(base_, base_test_, scores);
      if (question_.comment) comment_on(list);
      if (list.named.empty() || !earns_its_place(list, answer)) break;
      if (base_moves_on(list)) {
        if (accepted_.empty()) note_recalibrated(answer);
        naming_.follow(base_, base_test_, list);
        if (question_.comment) comment_on(list);
        if (!earns_its_place(list, answer)) break;
      }
      accept(list, answer);
      drop_superfluous(answer);
    }
    find_common_laws(screening, answer);
    conclude(answer);
    return answer;
  }

 private:
  void stage(const std::string& what) const {
    if (question_.progress && !question_.progress(what)) throw Interrupted();
  }

  bool has_room() const {
    return accepted_.size() < static_cast<std::size_t>(question_.max_effects);
  }

  bool is_accepted(std::size_t candidate) const {
    return std::any_of(accepted_.begin(), accepted_.end(),
                       [&](const Accepted& a) { return a.candidate == candidate; });
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
    stage("fitting ordinary parameters");
    answer.given.nuisances = evaluator_.initial_nuisances();
    base_ = train_.start(answer.given, nuisance_unknowns(evaluator_));
    given_train_ = base_.residual;
    given_test_ = test_.residual(answer.given);
    train_.improve(base_, kRecalibrations);
    settling_.settle(base_);
    base_test_ = test_.residual(base_.variant);
    if (given_test_.size() == 0 || base_test_.size() == 0) {
      throw std::runtime_error("the model cannot be simulated along the held-out recordings");
    }
    note_recalibrated(answer);
  }

  void note_recalibrated(Answer& answer) {
    answer.recalibrated = base_.variant;
    recalibrated_train_ = base_.residual;
    recalibrated_test_ = base_test_;
    first_excess_ = whole_excess(test_judge_, base_test_, kRealGap);
    first_faint_excess_ = whole_excess(test_judge_, base_test_, kFaintGap);
  }

  /// What looks like an effect may be ordinary parameters that found a better valley on the way:
  /// the model without it gets the same chance, from where its fit has ended.
  bool base_moves_on(const ShortList& list) {
    const Named& best = list.named.front();
    std::optional<Fitted> moved =
        without_effect(evaluator_, train_, best.fit, accepted_.size(), candidates_[best.candidate]);
    if (!moved) return false;
    const double reach = best.fit.cost + kOutOfReach * (base_.cost - best.fit.cost);
    if (!settling_.settle_within_reach(*moved, reach)) return false;
    Eigen::VectorXf test = test_.residual(moved->variant);
    if (moved->cost >= base_.cost || test.size() == 0) return false;
    base_ = std::move(*moved);
    base_test_ = std::move(test);
    return true;
  }

  bool has_gap(double least) const { return has_gap(base_, base_test_, least); }

  /// Of a channel, in what was learned from and in what was held out.
  bool has_gap(const Fitted& fitted, const Eigen::VectorXf& test, double least) const {
    const auto learned = train_judge_.channel_gaps(fitted.residual);
    const auto held_out = test_judge_.channel_gaps(test);
    return std::any_of(held_out.begin(), held_out.end(), [&](const auto& channel) {
      const auto found = learned.find(channel.first);
      return channel.second > least && found != learned.end() && found->second > least;
    });
  }

  bool gap_is_certain() const {
    return certain_gap(train_judge_, base_.residual, test_judge_, base_test_, kRealGap);
  }

  /// Of the first of a list that was judged against a base.
  Merit merit_of(const ShortList& list, const Fitted& base,
                 const Eigen::VectorXf& base_test) const {
    const Named& best = list.named.front();
    const double before = whole_excess(test_judge_, base_test, kFaintGap);
    const double gained = before - whole_excess(test_judge_, best.test, kFaintGap);
    Merit merit;
    merit.probability = best.probability;
    merit.none = list.none;
    merit.evidence = best.evidence;
    merit.needed_evidence = needed_evidence(candidates_.size());
    merit.significance = best.significance;
    merit.only_faint_gaps = !has_gap(base, base_test, kRealGap);
    if (before > 0.0) merit.share = gained / before;
    if (first_faint_excess_ > 0.0) merit.share_of_first = gained / first_faint_excess_;
    return merit;
  }

  /// Whether the first of a list does; if not, the answer tells why.
  bool earns_its_place(const ShortList& list, Answer& answer) const {
    const std::string lacking = lack(merit_of(list, base_, base_test_));
    if (lacking.empty()) return true;
    const Named& best = list.named.front();
    const Candidate& candidate = candidates_[best.candidate];
    answer.closest = {candidate.effect->info().id, candidate.place, best.probability, best.evidence,
                      lacking};
    if (question_.comment) question_.comment("  not named: " + lacking);
    return false;
  }

  /// What was named early may have stood in for what was named later: whatever does not earn its
  /// place beside the others any more goes.
  void drop_superfluous(Answer& answer) {
    for (std::size_t e = 0; e + 1 < accepted_.size();) {
      const std::string name = candidates_[accepted_[e].candidate].name();
      stage("whether " + name + " is still needed");
      if (!is_superfluous(e)) {
        ++e;
        continue;
      }
      if (question_.comment) question_.comment("  not needed any more: " + name);
      accepted_.erase(accepted_.begin() + static_cast<std::ptrdiff_t>(e));
      answer.effects.erase(answer.effects.begin() + static_cast<std::ptrdiff_t>(e));
    }
  }

  /// If it is, the base goes on without it.
  bool is_superfluous(std::size_t index) {
    const auto& [candidate, gained] = accepted_[index];
    std::optional<Fitted> without =
        without_effect(evaluator_, train_, base_, index, candidates_[candidate]);
    if (!without || !settling_.settle_within_reach(*without, base_.cost + kOutOfReach * gained)) {
      return false;
    }
    *without = settling_.to_the_end(*without);
    Eigen::VectorXf test = test_.residual(without->variant);
    if (test.size() == 0) return false;
    ShortList list;
    list.named = {{candidate, base_, base_test_}};
    naming_.judge(*without, test, list);
    if (lack(merit_of(list, *without, test)).empty()) return false;
    base_ = std::move(*without);
    base_test_ = std::move(test);
    return true;
  }

  /// One law that says what two say is a rival of both.
  void find_common_laws(Screening& screening, Answer& answer) const {
    const CommonLaw common(evaluator_, train_, test_, candidates_, naming_, settling_, screening);
    for (std::size_t later = 1; later < accepted_.size(); ++later) {
      for (std::size_t earlier = 0; earlier < later; ++earlier) {
        const CommonLaw::Part a{earlier, accepted_[earlier].candidate},
            b{later, accepted_[later].candidate};
        for (std::size_t law = 0; law < candidates_.size(); ++law) {
          if (is_accepted(law) || !common.may_be(law, a.candidate, b.candidate)) continue;
          stage("whether " + candidates_[law].name() + " says alone what " +
                candidates_[a.candidate].name() + " and " + candidates_[b.candidate].name() +
                " say");
          const std::optional<Rival> rival = common.weigh(law, base_, base_test_, a, b);
          if (!rival || rival->probability < kMentioned) continue;
          for (const std::size_t e : {earlier, later}) {
            FoundEffect& effect = answer.effects[e];
            effect.rivals.push_back(*rival);
            if (effect.separating_experiment.empty()) {
              effect.separating_experiment = separating_experiment(effect.id, rival->id);
            }
          }
        }
      }
    }
  }

  /// Values and intervals of all effects in the model as it is at the end: later ones have moved
  /// earlier ones.
  void measure_effects(Answer& answer) const {
    const auto ranges =
        bootstrap_intervals(base_, train_.experiments(), variables_, question_.seed);
    for (std::size_t e = 0; e < answer.effects.size(); ++e) {
      for (const EffectParameter& p : candidates_[accepted_[e].candidate].parameters) {
        const double value = base_.variant.effects[e].parameters.at(p.name);
        FoundParameter found{p.name, p.unit, value, value, value};
        for (std::size_t i = 0; i < ranges.size(); ++i) {
          const Unknown& u = base_.unknowns[i];
          if (u.effect != static_cast<int>(e) || u.parameter != p.name) continue;
          found.low = ranges[i].first;
          found.high = ranges[i].second;
        }
        answer.effects[e].parameters.push_back(std::move(found));
      }
    }
  }

  void accept(ShortList& list, Answer& answer) {
    Named& best = list.named.front();
    Fitted settled = settling_.to_the_end(best.fit);
    Eigen::VectorXf test = test_.residual(settled.variant);
    if (test.size() > 0) {
      best.fit = std::move(settled);
      best.test = std::move(test);
    }
    const Candidate& candidate = candidates_[best.candidate];
    FoundEffect effect;
    effect.id = candidate.effect->info().id;
    effect.name = candidate.effect->info().name;
    effect.place = candidate.place;
    effect.probability = best.probability;
    effect.evidence = best.evidence;
    for (std::size_t i = 1; i < list.named.size(); ++i) {
      const Named& other = list.named[i];
      if (other.probability < kMentioned) continue;
      const Candidate& rival = candidates_[other.candidate];
      effect.rivals.push_back(
          {rival.effect->info().id, rival.place, other.probability, other.evidence, {}});
    }
    if (!effect.rivals.empty()) separate(list, effect);
    answer.effects.push_back(std::move(effect));
    accepted_.push_back({best.candidate, base_.cost - best.fit.cost});
    base_ = best.fit;
    base_test_ = best.test;
  }

  void separate(const ShortList& list, FoundEffect& effect) const {
    effect.separating_experiment = separating_experiment(effect.id, effect.rivals.front().id);
    for (std::size_t i = 1; i < list.named.size(); ++i) {
      if (list.named[i].probability < kMentioned) continue;
      effect.separating_recording =
          plan_separation(evaluator_, list.named.front().fit.variant, list.named[i].fit.variant,
                          question_.train.front(), scales_);
      return;
    }
  }

  Gap gap_of(const Judge& judge, const Eigen::VectorXf& given, const Eigen::VectorXf& recalibrated,
             const Eigen::VectorXf& after) const {
    return {judge.gap(given), judge.gap(recalibrated), judge.gap(after), 1.0};
  }

  void conclude(Answer& answer) {
    answer.extended = base_.variant;
    measure_effects(answer);
    answer.train = gap_of(train_judge_, given_train_, recalibrated_train_, base_.residual);
    answer.test = gap_of(test_judge_, given_test_, recalibrated_test_, base_test_);
    const auto given = test_judge_.channel_gaps(given_test_),
               recalibrated = test_judge_.channel_gaps(recalibrated_test_),
               after = test_judge_.channel_gaps(base_test_);
    for (const auto& [name, value] : given) {
      answer.per_channel[name] = {value, recalibrated.at(name), after.at(name), 1.0};
    }
    const double first = answer.effects.empty() ? first_excess_ : first_faint_excess_;
    answer.remaining_share =
        first > 0.0 ? whole_excess(test_judge_, base_test_, least_gap(answer)) / first : 0.0;
    answer.regimes = regime_gaps(laboratory_.train, variables_, recalibrated_train_,
                                 train_.whitening(), scales_);
    answer.dependences =
        find_dependences(laboratory_.train, variables_, recalibrated_train_, train_.whitening());
    answer.remaining =
        find_dependences(laboratory_.train, variables_, base_.residual, train_.whitening());
    stage("locating");
    answer.seams = seam_gaps(evaluator_, question_, laboratory_, scales_, answer.recalibrated);
    answer.where = locate(train_judge_, recalibrated_train_, least_gap(answer), scales_,
                          answer.seams, answer.dependences);
    answer.examples = examples_of(*laboratory_.test.front(), test_.whitening(), recalibrated_test_,
                                  base_test_, answer.per_channel);
    pronounce(train_judge_.channel_gaps(base_.residual), gap_is_certain(), answer);
  }

  /// What was worth naming is worth counting.
  static double least_gap(const Answer& answer) {
    return answer.effects.empty() ? kRealGap : kFaintGap;
  }

  const Evaluator& evaluator_;
  const Question& question_;
  Laboratory laboratory_;
  std::vector<MeasuredVariable> variables_;
  Scales scales_;
  ModelFit train_, test_;
  Judge train_judge_, test_judge_;
  Settling settling_;
  std::vector<Candidate> candidates_;
  Naming naming_;
  Fitted base_;
  Eigen::VectorXf base_test_, given_train_, given_test_, recalibrated_train_, recalibrated_test_;
  std::vector<Accepted> accepted_;  ///< what is in the model now, in its order
  double first_excess_ = 0.0, first_faint_excess_ = 0.0;
};

}  // namespace

Answer discover(const Evaluator& evaluator, const Question& question) {
  return Search(evaluator, question).answer();
}

}  // namespace discovery
}  // namespace anthrob
