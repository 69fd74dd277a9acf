#include "anthrob_calib/discovery/discovery.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "anthrob_calib/discovery/bootstrap.h"
#include "anthrob_calib/discovery/naming.h"
#include "anthrob_calib/discovery/preparation.h"
#include "anthrob_calib/discovery/screening.h"
#include "anthrob_calib/discovery/seams.h"
#include "anthrob_calib/discovery/separating_experiment.h"

namespace anthrob {
namespace discovery {

namespace {

/// What an effect must do to be named. Judged on data it was not fitted to.
constexpr double kEvidence = 3.0;      ///< [nat] beyond the logarithm of the number of candidates
constexpr double kSignificance = 3.0;  ///< standard errors over blocks
constexpr double kFaintSignificance = 6.0;  ///< where no gap is above kRealGap
constexpr double kShareOfPresent = 0.1;     ///< of the squared gaps above faint ones
constexpr double kShareOfFirst = 0.03;
/// What is smaller beside the first gap may be what the shape of the first law leaves.
constexpr double kSmallSignificance = 8.0;
/// A channel's gap is one only beyond what a wrong estimate of the noise may look like. A fainter
/// one is worth a look for what would explain it: evidence is judged by what is left, not by the
/// floor.
constexpr double kRealGap = 1.4;
constexpr double kFaintGap = 1.15;
constexpr int kRecalibrations = 8;
constexpr int kPolish = 8;
constexpr int kSettling = 8;
constexpr double kSettled = 5e-4;  ///< share of the cost
constexpr double kClearGap = 2.5;  ///< of all channels together, in floors
constexpr double kRoughlySettled = 0.01;
constexpr double kOutOfReach = 0.5;   ///< share of an effect's gain that is left without it
constexpr double kMostRemains = 0.5;  ///< of the squared gap: the named effects are not the answer
constexpr std::size_t kRenewed =
    60;                              ///< candidates whose doses are simulated again in later rounds
constexpr double kMentioned = 0.02;  ///< least probability of a rival
constexpr double kMostlyFound = 1.645;  ///< standard deviations: nineteen times out of twenty

/// What of a channel's squared gap is more than that of a gap.
double excess(double gap, double least) {
  return std::max(0.0, gap * gap - least * least);
}

/// The same over all channels.
double excess(const Judge& judge, const Eigen::VectorXf& residual, double least) {
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
    fly_ahead(screening, scores, answer);
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
      if (list.named.empty() || !earns_its_place(list)) break;
      if (base_moves_on(list)) {
        if (accepted_.empty()) note_recalibrated(answer);
        naming_.judge_again(base_, base_test_, list);
        if (!earns_its_place(list)) break;
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
    first_excess_ = excess(test_judge_, base_test_, kRealGap);
    first_faint_excess_ = excess(test_judge_, base_test_, kFaintGap);
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
      train_.polish(fitted, kPolish, clear);
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
    train_.polish(moved, kPolish, true);
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

  bool earns_its_place(const ShortList& list) const {
    const Named& best = list.named.front();
    const double before = excess(test_judge_, base_test_, kFaintGap);
    const double gained = before - excess(test_judge_, best.test, kFaintGap);
    return best.probability > list.none &&
           best.evidence > kEvidence + std::log(static_cast<double>(candidates_.size())) &&
           best.significance > (has_gap(kRealGap) ? kSignificance : kFaintSignificance) &&
           gained > kShareOfPresent * before &&
           (gained > kShareOfFirst * first_faint_excess_ || best.significance > kSmallSignificance);
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
    Variant given = fitted.variant;
    given.nuisances = evaluator_.initial_nuisances();
    try {
      Fitted fresh = train_.start(given, fitted.unknowns);
      train_.improve(fresh, kRecalibrations);
      settle(fresh);
      if (fresh.cost < fitted.cost) return fresh;
    } catch (const NotSimulated&) {
      // Not from there.
    }
    Fitted settled = fitted;
    settle(settled);
    return settled;
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

  /// What these recordings can show, before any effect is named.
  void fly_ahead(const Screening& screening, std::vector<Score> scores, Answer& answer) const {
    std::sort(scores.begin(), scores.end(),
              [](const Score& a, const Score& b) { return a.candidate < b.candidate; });
    std::vector<Visibility> all;
    const std::vector<double> for_gap =
        screening.doses_to_a_gap(base_, scores, train_judge_, mostly_looked_at());
    for (std::size_t s = 0; s < scores.size(); ++s) {
      const Score& score = scores[s];
      const EffectParameter& size = *candidates_[score.candidate].sizes()[score.size];
      const double dose = std::abs(size.typical - size.neutral);
      const double largest = std::max(size.bounds.hi - size.neutral, size.neutral - size.bounds.lo);
      all.push_back(visibility_of(score, for_gap[s]));
      const double ordinary = taken_for_ordinary(candidates_[score.candidate]);
      const double smallest = all.back().smallest_visible;
      const bool visible = smallest <= largest && smallest - ordinary <= 5.0 * dose;
      (visible ? answer.visible : answer.not_visible).push_back(all.back());
    }
    for (const auto& group : screening.alike(base_)) {
      answer.alike.emplace_back();
      for (const std::size_t candidate : group) {
        answer.alike.back().push_back(all[candidate]);
      }
    }
  }

  /// How high a channel must stand so that it mostly is above a faint gap [floors].
  std::map<std::string, double> mostly_looked_at() const {
    const auto learned = train_judge_.chance_of_gaps();
    std::map<std::string, double> levels;
    for (const auto& [name, held_out] : test_judge_.chance_of_gaps()) {
      const auto found = learned.find(name);
      if (found == learned.end()) continue;
      levels[name] = kFaintGap * (1.0 + kMostlyFound * std::max(held_out, found->second));
    }
    return levels;
  }

  /// What is named must gain on held-out data, and some channel must show a gap without it.
  /// @param for_gap of its doses
  Visibility visibility_of(const Score& score, double for_gap) const {
    const Candidate& candidate = candidates_[score.candidate];
    const EffectParameter& size = *candidate.sizes()[score.size];
    // Evidence E scatters by sqrt(2 E); it is to suffice in spite of that.
    const double needed = kEvidence + std::log(static_cast<double>(candidates_.size()));
    const double root =
        kMostlyFound / std::sqrt(2.0) + std::sqrt(0.5 * kMostlyFound * kMostlyFound + needed);
    const double held_out = total_duration(laboratory_.test) / score.seconds;
    const double dose = std::abs(size.typical - size.neutral);
    const double for_evidence = score.uncertainty * root * std::sqrt(2.0 / held_out);
    return {candidate.effect->info().id, candidate.place, size.unit,
            std::max(for_evidence, for_gap) * dose + taken_for_ordinary(candidate)};
  }

  /// How much of an effect an ordinary parameter that is the same quantity may be.
  double taken_for_ordinary(const Candidate& candidate) const {
    const EffectParameter& size = *candidate.sizes().front();
    const bool either = size.bounds.lo < size.neutral;
    double room = 0.0;
    for (const Unknown& u : base_.unknowns) {
      if (!std::count(candidate.same_as.begin(), candidate.same_as.end(), u.nuisance)) continue;
      room = std::max({room, u.upper - u.expected, either ? u.expected - u.lower : 0.0});
    }
    return room;
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
        first > 0.0 ? excess(test_judge_, base_test_, least_gap(answer)) / first : 0.0;
    answer.regimes = regime_gaps(laboratory_.train, variables_, recalibrated_train_,
                                 train_.whitening(), scales_);
    answer.dependences =
        find_dependences(laboratory_.train, variables_, recalibrated_train_, train_.whitening());
    answer.remaining =
        find_dependences(laboratory_.train, variables_, base_.residual, train_.whitening());
    locate(answer);
    show_examples(answer);
    pronounce(answer);
  }

  /// What was worth naming is worth counting.
  static double least_gap(const Answer& answer) {
    return answer.effects.empty() ? kRealGap : kFaintGap;
  }

  void locate(Answer& answer) {
    stage("locating", -1);
    const double least = least_gap(answer);
    const auto gaps = train_judge_.channel_gaps(recalibrated_train_);
    const auto significance = train_judge_.excess_significance(recalibrated_train_, least);
    double whole = 0.0;
    for (const auto& [name, gap] : gaps) whole += excess(gap, least);
    answer.seams = seam_gaps(evaluator_, question_, laboratory_, scales_, answer.recalibrated);
    for (const auto& [name, gap] : gaps) {
      const ChannelScale& scale = scales_.at(name);
      const std::size_t slash = name.rfind('/');
      Place place{name.substr(slash + 1), name.substr(0, slash), "", "", scale.unit};
      place.rmse = gap * scale.sigma();
      place.noise_floor = scale.floor;
      place.share = whole > 0.0 ? excess(gap, least) / whole : 0.0;
      if (significance.count(name)) place.significance = significance.at(name);
      for (const SeamGap& seam : answer.seams) {
        if (seam.place == place.place && seam.channel == place.channel) {
          place.subsystem = subsystem_of(seam);
        }
      }
      double best = 0.05;
      for (const Dependence& d : answer.dependences) {
        if (d.channel.rfind(name, 0) == 0 && d.share > best) {
          best = d.share;
          place.regime = d.word + (d.word == "time" ? "" : " (" + d.variable + ")");
        }
      }
      if (gap > least) answer.where.push_back(std::move(place));
    }
    std::stable_sort(answer.where.begin(), answer.where.end(),
                     [](const Place& a, const Place& b) { return a.share > b.share; });
  }

  /// The held-out channels in which most happened.
  void show_examples(Answer& answer) const {
    std::vector<std::pair<double, std::string>> order;
    for (const auto& [name, gap] : answer.per_channel) {
      order.emplace_back(-std::abs(gap.recalibrated - gap.after) - 1e-3 * gap.recalibrated, name);
    }
    std::sort(order.begin(), order.end());
    const Experiment& experiment = *laboratory_.test.front();
    for (std::size_t i = 0; i < order.size() && i < 3; ++i) {
      for (const Channel& channel : experiment.channels()) {
        if (channel.name() != order[i].second) continue;
        Example example{channel.name(), channel.unit, {}, {}, {}};
        for (std::size_t b = 0; b < channel.count; ++b) {
          const auto k = static_cast<Eigen::Index>(channel.offset + b);
          const double factor = test_.whitening()[k];
          if (!(factor > 0.0)) continue;
          example.t.push_back(experiment.bin_time(b));
          example.recalibrated.push_back(recalibrated_test_[k] / factor);
          example.after.push_back(base_test_[k] / factor);
        }
        answer.examples.push_back(std::move(example));
        break;
      }
    }
  }

  void pronounce(Answer& answer) const {
    // What depends on nothing is noise that was thought smaller, not something missing.
    double structured = 0.0;
    const Dependence* strongest = nullptr;
    const auto gaps = train_judge_.channel_gaps(base_.residual);
    double whole = 0.0;
    for (const auto& [name, gap] : gaps) whole += excess(gap, kRealGap);
    for (const Dependence& d : answer.remaining) {
      for (const auto& [name, gap] : gaps) {
        if (d.channel.rfind(name, 0) != 0 || d.share < 0.05 || !(whole > 0.0)) continue;
        const double part = excess(gap, kRealGap) / whole * d.share;
        if (part > structured) {
          structured = part;
          strongest = &d;
        }
      }
    }
    const bool gap = gap_is_certain();
    if (answer.effects.empty()) {
      answer.verdict = gap ? "unexplained" : "no_missing_effect";
    } else {
      const bool most = answer.remaining_share > kMostRemains && gap;
      answer.verdict = most ? "unexplained" : "effects_found";
      // What is left shows that the law may be another one; at kMostRemains the names go.
      if (gap) {
        for (FoundEffect& effect : answer.effects) {
          effect.probability *= std::max(0.0, 1.0 - answer.remaining_share / kMostRemains);
        }
      }
    }
    if (!gap) {
      answer.remaining_description = "no gap that is certain";
    } else if (strongest) {
      answer.remaining_description = strongest->channel + " depends on " +
                                     (strongest->word == "time" ? "" : strongest->word + " of ") +
                                     strongest->variable;
    } else {
      answer.remaining_description = "depends on none of the measured quantities";
    }
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
