#include "anthrob_calib/discovery/discovery.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "anthrob_calib/discovery/bootstrap.h"
#include "anthrob_calib/discovery/criteria.h"
#include "anthrob_calib/discovery/examples.h"
#include "anthrob_calib/discovery/location.h"
#include "anthrob_calib/discovery/merit.h"
#include "anthrob_calib/discovery/naming.h"
#include "anthrob_calib/discovery/preflight.h"
#include "anthrob_calib/discovery/preparation.h"
#include "anthrob_calib/discovery/screening.h"
#include "anthrob_calib/discovery/seams.h"
#include "anthrob_calib/discovery/separating_experiment.h"
#include "anthrob_calib/discovery/verdict.h"

namespace anthrob {
namespace discovery {

namespace {

constexpr int kRecalibrations = 8;
constexpr int kPolish = 8;
constexpr int kSettling = 8;
constexpr double kSettled = 5e-4;  ///< share of the cost
constexpr int kFinishing = 5;
constexpr double kFinished = 2e-4;  ///< share of the cost
constexpr double kClearGap = 2.5;   ///< of all channels together, in floors
constexpr double kRoughlySettled = 0.01;
constexpr double kOutOfReach = 0.5;  ///< share of an effect's gain that is left without it
constexpr std::size_t kRenewed =
    60;                              ///< candidates whose doses are simulated again in later rounds
constexpr double kMentioned = 0.02;  ///< least probability of a rival

/// What of all channels' squared gaps is more than that of a gap.
double whole_excess(const Judge& judge, const Eigen::VectorXf& residual, double least) {
  double sum = 0.0;
  for (const auto& [name, gap] : judge.channel_gaps(residual)) sum += excess(gap, least);
  return sum;
}

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
        candidates_(list_candidates(evaluator, question.effects)),
        naming_(train_, test_, train_judge_, test_judge_, candidates_, question.seed) {}

  Answer answer() {
    Answer answer;
    answer.scales = scales_;
    recalibrate(answer);
    stage("screening " + std::to_string(candidates_.size()) + " candidates", -1);
    Screening screening(train_, base_, candidates_, laboratory_.quick, laboratory_.slow);
    std::vector<Score> scores = screening.scores(base_);
    PreFlight(candidates_, base_, train_judge_, test_judge_, total_duration(laboratory_.test))
        .fly(screening, scores, answer);
    for (int round = 0; round < question_.max_effects && has_gap(kFaintGap); ++round) {
      if (round > 0) {
        stage("screening", round);
        screening.renew(base_, screening.scores(base_), kRenewed);
        scores = screening.scores(base_);
      }
      scores.erase(std::remove_if(scores.begin(), scores.end(),
                                  [&](const Score& s) { return is_accepted(s.candidate); }),
                   scores.end());
      stage("fitting the short list", round);
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
    }
    conclude(answer);
    return answer;
  }

 private:
  void stage(const std::string& what, int round) {
    const std::string title =
        round < 0 ? what : "effect " + std::to_string(round + 1) + ": " + what;
    if (question_.progress && !question_.progress(title)) throw Interrupted();
  }

  bool is_accepted(std::size_t candidate) const {
    return std::find(accepted_.begin(), accepted_.end(), candidate) != accepted_.end();
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
    stage("fitting ordinary parameters", -1);
    answer.given.nuisances = evaluator_.initial_nuisances();
    base_ = train_.start(answer.given, nuisance_unknowns(evaluator_));
    given_train_ = base_.residual;
    given_test_ = test_.residual(answer.given);
    train_.improve(base_, kRecalibrations);
    settle(base_);
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

  bool clearly_misses(const Fitted& fitted) const {
    return train_judge_.gap(fitted.residual) > kClearGap;
  }

  /// Polishes as long as that brings something: friction makes valleys rugged. Where something is
  /// clearly missing, the last steps to a model without it are not worth their time.
  void settle(Fitted& fitted) const {
    for (int k = 0; k < kSettling; ++k) {
      const bool clear = clearly_misses(fitted);
      const double before = fitted.cost;
      train_.polish(fitted, kPolish,
                    clear ? ModelFit::Slopes::kOneSide : ModelFit::Slopes::kBothSides);
      if (before - fitted.cost < (clear ? kRoughlySettled : kSettled) * before) break;
    }
  }

  /// What looks like an effect may be ordinary parameters that found a better valley on the way:
  /// the model without it gets the same chance, from where its fit has ended.
  bool base_moves_on(const ShortList& list) {
    const Named& best = list.named.front();
    Variant without = best.fit.variant;
    const EffectInstance effect = without.effects.back();
    without.effects.pop_back();
    for (const int nuisance : candidates_[best.candidate].same_as) {
      for (const EffectParameter* size : candidates_[best.candidate].sizes()) {
        const Unknown& own = base_.unknowns[static_cast<std::size_t>(nuisance)];
        own.write(own.expected + effect.parameters.at(size->name) - size->neutral, without);
      }
    }
    Fitted moved = base_;
    if (!train_.move(moved, without)) return false;
    train_.improve(moved, kPolish);
    train_.polish(moved, kPolish, ModelFit::Slopes::kOneSide);
    // So far off that no better derivative brings it there.
    if (moved.cost - best.fit.cost > kOutOfReach * (base_.cost - best.fit.cost)) return false;
    settle(moved);
    Eigen::VectorXf test = test_.residual(moved.variant);
    if (moved.cost >= base_.cost || test.size() == 0) return false;
    base_ = std::move(moved);
    base_test_ = std::move(test);
    return true;
  }

  /// Of a channel, in what was learned from and in what was held out.
  bool has_gap(double least) const {
    const auto learned = train_judge_.channel_gaps(base_.residual);
    const auto held_out = test_judge_.channel_gaps(base_test_);
    return std::any_of(held_out.begin(), held_out.end(), [&](const auto& channel) {
      const auto found = learned.find(channel.first);
      return channel.second > least && found != learned.end() && found->second > least;
    });
  }

  bool gap_is_certain() const {
    return certain_gap(train_judge_, base_.residual, test_judge_, base_test_, kRealGap);
  }

  /// Whether the first of a list does; if not, the answer tells why.
  bool earns_its_place(const ShortList& list, Answer& answer) const {
    const Named& best = list.named.front();
    const double before = whole_excess(test_judge_, base_test_, kFaintGap);
    const double gained = before - whole_excess(test_judge_, best.test, kFaintGap);
    Merit merit;
    merit.probability = best.probability;
    merit.none = list.none;
    merit.evidence = best.evidence;
    merit.needed_evidence = needed_evidence(candidates_.size());
    merit.significance = best.significance;
    merit.only_faint_gaps = !has_gap(kRealGap);
    if (before > 0.0) merit.share = gained / before;
    if (first_faint_excess_ > 0.0) merit.share_of_first = gained / first_faint_excess_;
    const std::string lacking = lack(merit);
    if (lacking.empty()) return true;
    const Candidate& candidate = candidates_[best.candidate];
    answer.closest = {candidate.effect->info().id, candidate.place, best.probability, best.evidence,
                      lacking};
    if (question_.comment) question_.comment("  not named: " + lacking);
    return false;
  }

  /// Values and intervals of all effects in the model as it is at the end: later ones have moved
  /// earlier ones.
  void measure_effects(Answer& answer) const {
    const auto ranges =
        bootstrap_intervals(base_, train_.experiments(), variables_, question_.seed);
    for (std::size_t e = 0; e < answer.effects.size(); ++e) {
      for (const EffectParameter& p : candidates_[accepted_[e]].parameters) {
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

  /// To the end. What was missing has led ordinary parameters astray, and friction does not let
  /// them all find back: with what is found, a fit from the given parameters mostly ends lower.
  Fitted fitted_to_the_end(const Fitted& fitted) const {
    std::optional<Fitted> best = fitted_from_given(fitted);
    if (!best || best->cost >= fitted.cost) {
      best = fitted;
      settle(*best);
    }
    finish(*best);
    return std::move(*best);
  }

  /// Nothing if the effects cannot be simulated with the given parameters.
  std::optional<Fitted> fitted_from_given(const Fitted& fitted) const {
    Variant given = fitted.variant;
    given.nuisances = evaluator_.initial_nuisances();
    try {
      Fitted fresh = train_.start(given, fitted.unknowns);
      train_.improve(fresh, kRecalibrations);
      settle(fresh);
      return fresh;
    } catch (const NotSimulated&) {
      return std::nullopt;
    }
  }

  /// The last of it: where a fit has settled, the coarse step's slopes lead nowhere, but the
  /// simulation's own do.
  void finish(Fitted& fitted) const {
    for (int k = 0; k < kFinishing && !clearly_misses(fitted); ++k) {
      const double before = fitted.cost;
      train_.polish(fitted, kPolish, ModelFit::Slopes::kExact);
      if (before - fitted.cost < kFinished * before) break;
    }
  }

  void accept(ShortList& list, Answer& answer) {
    Named& best = list.named.front();
    Fitted settled = fitted_to_the_end(best.fit);
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
          {rival.effect->info().id, rival.place, other.probability, other.evidence});
    }
    if (!effect.rivals.empty()) separate(list, effect);
    answer.effects.push_back(std::move(effect));
    base_ = best.fit;
    base_test_ = best.test;
    accepted_.push_back(best.candidate);
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
    stage("locating", -1);
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
  std::vector<Candidate> candidates_;
  Naming naming_;
  Fitted base_;
  Eigen::VectorXf base_test_, given_train_, given_test_, recalibrated_train_, recalibrated_test_;
  std::vector<std::size_t> accepted_;  ///< candidates that are in the model now, in their order
  double first_excess_ = 0.0, first_faint_excess_ = 0.0;
};

}  // namespace

Answer discover(const Evaluator& evaluator, const Question& question) {
  return Search(evaluator, question).answer();
}

}  // namespace discovery
}  // namespace anthrob
