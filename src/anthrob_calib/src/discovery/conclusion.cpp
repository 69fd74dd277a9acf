#include "anthrob_calib/discovery/conclusion.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "anthrob_calib/discovery/fit/bootstrap.h"
#include "anthrob_calib/discovery/fit/flat_range.h"
#include "anthrob_calib/discovery/judgement/criteria.h"
#include "anthrob_calib/discovery/judgement/verdict.h"
#include "anthrob_calib/discovery/location/examples.h"
#include "anthrob_calib/discovery/location/location.h"
#include "anthrob_calib/discovery/location/seams.h"
#include "anthrob_calib/discovery/location/wrap_angle.h"
#include "anthrob_calib/discovery/number_text.h"
#include "anthrob_calib/discovery/search/common_law.h"
#include "anthrob_calib/discovery/search/found_effect.h"
#include "anthrob_calib/discovery/separation/separating_experiment.h"

namespace anthrob {
namespace discovery {

namespace {

/// Whether only the bound of its range keeps a size from going on. Where nothing is, it does not.
bool is_at_end(double value, const Unknown& u) {
  const double close = 1e-6 * (u.upper - u.lower);
  return (value <= u.lower + close && u.lower != 0.0) ||
         (value >= u.upper - close && u.upper != 0.0);
}

/// Values and intervals of all effects in the model as it is at the end: later ones have moved
/// earlier ones.
void measure_effects(const SearchSetup& setup, WorkingModel& model) {
  if (model.named.empty()) return;
  model.note_limits();
  model.charge_for_spoilt_channels(model.base);
  // The last steps have blurred them: what depends on nothing must not seem to.
  setup.train.renew_effects(model.base.fit);
  const Fitted& fit = model.base.fit;
  const auto ranges =
      bootstrap_intervals(fit, setup.train.experiments(), setup.variables, setup.question.seed);
  for (std::size_t e = 0; e < model.named.size(); ++e) {
    for (const EffectParameter& p : setup.candidates[model.named[e].candidate].parameters) {
      const double value = fit.variant.effects[e].parameters.at(p.name);
      FoundParameter found{p.name, p.unit, value, value, value, true, false};
      for (std::size_t i = 0; i < ranges.size(); ++i) {
        const Unknown& u = fit.unknowns[i];
        if (u.effect != static_cast<int>(e) || u.parameter != p.name) continue;
        found.known = false;
        const bool flat = is_flat(fit, i);
        std::tie(found.low, found.high) = flat ? flat_range(setup.train, fit, i) : ranges[i];
        const bool spans = found.low <= u.lower && found.high >= u.upper;
        found.at_bound = spans && is_at_end(value, u);
        found.undetermined = spans && !found.at_bound;
        // Where nothing is, no range ends: there is no less than that.
        found.low_ends = found.low <= u.lower && u.lower != 0.0;
        found.high_ends = found.high >= u.upper && u.upper != 0.0;
      }
      model.named[e].found.parameters.push_back(std::move(found));
    }
  }
}

Gap gap_of(const Judge& judge, const Eigen::VectorXf& given, const Eigen::VectorXf& recalibrated,
           const Eigen::VectorXf& after) {
  return {judge.gap(given), judge.gap(recalibrated), judge.gap(after), 1.0};
}

void compare_gaps(const SearchSetup& setup, const WorkingModel& model, Answer& answer) {
  answer.train = gap_of(setup.train_judge, model.given_train, model.recalibrated.fit.residual,
                        model.base.fit.residual);
  answer.test =
      gap_of(setup.test_judge, model.given_test, model.recalibrated.test, model.base.test);
  const auto given = setup.test_judge.channel_gaps(model.given_test),
             recalibrated = setup.test_judge.channel_gaps(model.recalibrated.test),
             after = setup.test_judge.channel_gaps(model.base.test);
  for (const auto& [name, value] : given) {
    answer.per_channel[name] = {value, recalibrated.at(name), after.at(name), 1.0};
  }
  answer.growth = setup.test_judge.growth_significance(model.recalibrated.test, model.base.test);
}

/// What speaks against the recordings or the floors, seen only now.
void remark_on_gaps(const SearchSetup& setup, const WorkingModel& model, Answer& answer) {
  constexpr double kTooGood = 0.3;  // [floors] rounding of the coarsest sensors alone leaves more
  answer.one_sided =
      one_sided_gaps(setup.train_judge, model.base.fit.residual, setup.test_judge, model.base.test);
  for (const OneSidedGap& gap : answer.one_sided) answer.remarks.push_back(remark_on(gap));
  for (const auto& [channel, gap] : setup.train_judge.channel_gaps(model.base.fit.residual)) {
    const auto held_out = answer.per_channel.find(channel);
    if (held_out == answer.per_channel.end()) continue;
    const double least = std::min(gap, held_out->second.after);
    if (least > kTooGood) continue;
    answer.remarks.push_back(
        channel + ": a gap of only " + short_number(least) +
        " floors: the floor is too high and hides what may be missing; " +
        (setup.question.repeats.empty()
             ? "check the units and the noise of all recordings"
             : "check the units of all recordings, and that --repeat shows the "
               "same robot"));
  }
}

void locate_gap(const SearchSetup& setup, const WorkingModel& model, Answer& answer) {
  setup.stage("locating the gap");
  const Experiments& train = setup.recordings.train;
  const Eigen::VectorXf &whitening = setup.train.whitening(),
                        &recalibrated = model.recalibrated.fit.residual;
  std::vector<MeasuredVariable> variables = setup.variables;
  for (MeasuredVariable& angle :
       wrap_angles(setup.evaluator, setup.question.train, train, answer.recalibrated)) {
    variables.push_back(std::move(angle));
  }
  answer.regimes = regime_gaps(train, variables, recalibrated, whitening, setup.scales);
  answer.dependences = find_dependences(train, variables, recalibrated, whitening);
  answer.remaining = find_dependences(train, variables, model.base.fit.residual, whitening);
  answer.seams = seam_gaps(setup.evaluator, setup.question, setup.recordings, setup.scales,
                           answer.recalibrated);
  answer.where = locate(setup.train_judge, recalibrated, least_gap(answer), setup.scales,
                        answer.seams, answer.dependences);
}

}  // namespace

double least_gap(const Answer& answer) {
  return answer.effects.empty() ? kRealGap : kFaintGap;
}

void find_alternatives(const SearchSetup& setup, const WorkingModel& model, Screening& screening,
                       Answer& answer) {
  const auto& named = model.named;
  const auto& candidates = setup.candidates;
  const CommonLaw common(setup.context, screening);
  for (std::size_t later = 1; later < named.size(); ++later) {
    for (std::size_t earlier = 0; earlier < later; ++earlier) {
      const CommonLaw::Part a{earlier, named[earlier].candidate}, b{later, named[later].candidate};
      for (std::size_t law = 0; law < candidates.size(); ++law) {
        if (model.is_named(law) || !common.may_be(law, a.candidate, b.candidate)) continue;
        const Candidate& alone = candidates[law];
        setup.stage("checking whether " + alone.name() + " alone can replace " +
                    candidates[a.candidate].name() + " and " + candidates[b.candidate].name());
        const auto instead = common.instead(law, model.base, {a, b});
        if (!instead || instead->odds.probability < kMentioned) continue;
        const std::string& id = alone.effect->info().id;
        answer.alternatives.push_back({id,
                                       alone.effect->info().name,
                                       alone.place,
                                       {earlier, later},
                                       instead->odds.probability,
                                       instead->odds.evidence,
                                       separating_experiment(named[earlier].found.id, id)});
      }
    }
  }
}

void conclude(const SearchSetup& setup, WorkingModel& model, Answer& answer) {
  answer.extended = model.base.fit.variant;
  measure_effects(setup, model);
  for (const NamedEffect& effect : model.named) answer.effects.push_back(effect.found);
  compare_gaps(setup, model, answer);
  remark_on_gaps(setup, model, answer);
  const double least = least_gap(answer), first = model.gaps.first_excess(least);
  answer.remaining_share = first > 0.0 ? model.gaps.excess_of(model.base.test, least) / first : 0.0;
  locate_gap(setup, model, answer);
  answer.examples = examples_of(*setup.recordings.test.front(), setup.test.whitening(),
                                model.recalibrated.test, model.base.test, answer.per_channel);
  fill_in_verdict(setup.train_judge.channel_gaps(model.base.fit.residual),
                  model.gaps.certain(model.base), answer);
}

}  // namespace discovery
}  // namespace anthrob
