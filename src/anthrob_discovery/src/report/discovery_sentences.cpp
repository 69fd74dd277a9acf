#include "report/discovery_sentences.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "anthrob_calib/report/html.h"
#include "conclusion/verdict.h"
#include "judgement/criteria.h"
#include "report/number_text.h"
#include "report/separating_files.h"

namespace anthrob {
namespace discovery {

namespace {

std::string place_text(const std::string& name, const std::string& place) {
  return "<b>" + escaped(name) + "</b> at <b>" + escaped(place) + "</b>";
}

/// Why the rest has no name.
std::string nameless(const Answer& answer, const Question& question) {
  if (question.max_effects == 0) {
    return "Something is missing; no effect was looked for, as --max-effects says. ";
  }
  if (answer.effects.empty() && !answer.remaining.certain && !answer.diagnosis.one_sided.empty()) {
    return "The recordings that were fitted and the held-out ones differ in a way that this model "
           "does "
           "not explain. ";
  }
  if (answer.search.end == SearchEnd::kFull) {
    return "Something else is missing, beyond the " + std::to_string(question.max_effects) +
           (question.max_effects == 1 ? " effect" : " effects") +
           " with which --max-effects ended the search. ";
  }
  return std::string("Something is missing that no law ") +
         (question.effects.empty() ? "of the catalogue" : "that --effects lists") +
         ", as fitted here, explains" + (answer.effects.empty() ? ". " : " completely. ");
}

/// That not the whole catalogue was tried; empty if it was.
std::string restriction(const Question& question) {
  if (question.effects.empty()) return "";
  std::string list;
  for (const std::string& id : question.effects) list += (list.empty() ? "" : ", ") + escaped(id);
  return " Looked for were only the effects that --effects lists: " + list + ".";
}

/// Where the fit does not carry over; empty if it does.
std::string one_sided(const Answer& answer) {
  if (answer.diagnosis.one_sided.empty()) return "";
  std::string list;
  for (const OneSidedGap& gap : answer.diagnosis.one_sided) {
    list += (list.empty() ? "" : ", ") + escaped(gap.channel) + " (" + short_number(gap.learned) +
            " floors where it was fitted, " + short_number(gap.held_out) + " held out)";
  }
  return " What was learned does not carry over: " + list +
         ". Either something changed between these recordings, or ordinary parameters stand in for "
         "what is missing.";
}

/// Channels that are more than noise at the end, where none of them is so for certain.
std::string uncertain_gaps(const Answer& answer) {
  constexpr std::size_t kMost = 5;
  std::vector<std::pair<double, std::string>> gaps;
  for (const auto& [name, gap] : answer.diagnosis.per_channel) {
    if (gap.after > kRealGap) gaps.emplace_back(-gap.after, name);
  }
  if (gaps.empty()) return "";
  std::sort(gaps.begin(), gaps.end());
  std::string text = " Above " + short_number(kRealGap) + " times the floor, but not certain: ";
  for (std::size_t i = 0; i < gaps.size() && i < kMost; ++i) {
    text +=
        (i > 0 ? ", " : "") + escaped(gaps[i].second) + " (" + short_number(-gaps[i].first) + ")";
  }
  if (gaps.size() > kMost) text += " and " + std::to_string(gaps.size() - kMost) + " more";
  return text + ".";
}

/// The first size, or a larger one of the same unit: of laws with one for each direction, one may
/// be 0.
const FoundParameter& largest_of(const std::vector<FoundParameter>& parameters) {
  const FoundParameter* largest = &parameters.front();
  for (const FoundParameter& p : parameters) {
    const bool comparable = p.unit == largest->unit && !p.known && !largest->known;
    if (comparable && parameters.front().value == 0.0 &&
        std::abs(p.value) > std::abs(largest->value)) {
      largest = &p;
    }
  }
  return *largest;
}

/// An effect with its size and probability, as a sentence.
std::string named(const FoundEffect& effect) {
  std::string text = place_text(effect.name, effect.place);
  if (!effect.parameters.empty()) {
    const FoundParameter& p = largest_of(effect.parameters);
    const std::string unit = p.unit == "1" ? "" : "\u00a0" + p.unit;
    text += " (" + escaped(p.name) + " " + escaped(value_text(p) + unit) + ", " +
            (p.has_interval() ? "95 % interval " : "") + range_text(p) + ")";
  }
  return text + ", " + probability_text(effect.probability) + ". ";
}

/// Whether nothing but one rival speaks against an effect.
bool has_equal(const FoundEffect& effect) {
  constexpr double kAsMuch = 0.8, kTogether = 0.7;
  if (effect.rivals.empty()) return false;
  const double rival = effect.rivals.front().probability;
  return rival >= kAsMuch * effect.probability && effect.probability + rival >= kTogether;
}

/// What was found: that, one of two, or something like that.
std::string found(const Answer& answer) {
  std::string probable, either, alike;
  for (const FoundEffect& effect : answer.effects) {
    if (effect.probability >= 0.5) {
      probable += named(effect);
    } else if (has_equal(effect)) {
      const Rival& rival = effect.rivals.front();
      either += "The model misses one of two effects, which these data cannot tell apart: " +
                named(effect) + "Or " + place_text(rival.name, rival.place) + ", " +
                probability_text(rival.probability) + ". ";
    } else {
      alike += named(effect);
    }
  }
  if (!probable.empty()) probable = "The model misses: " + probable;
  if (!alike.empty()) alike = "The model misses this or something similar: " + alike;
  return probable + either + alike;
}

std::string alternatives(const Answer& answer) {
  std::string text;
  for (const Alternative& other : answer.search.alternatives) {
    const FoundEffect &one = answer.effects[other.instead_of[0]],
                      &two = answer.effects[other.instead_of[1]];
    text += "Or, instead of " + escaped(one.name) + " and " + escaped(two.name) + ", " +
            place_text(other.name, other.place) + " alone, " + probability_text(other.probability) +
            " against those two. ";
  }
  return text;
}

}  // namespace

std::string with_unit(double value, const std::string& unit) {
  return short_number(value) + (unit == "1" || unit.empty() ? "" : "\u00a0" + unit);
}

std::string doubt_clause(const std::string& at_limit, const std::string& spoils) {
  std::string signs;
  if (!at_limit.empty()) signs = escaped(at_limit) + " at the end of its range";
  if (!spoils.empty()) {
    signs += (signs.empty() ? "" : " and ") + escaped(spoils) + " clearly worse than without it";
  }
  return signs.empty()
             ? ""
             : ", with " + signs + ", which suggests that the law stands in for another one";
}

std::string improbable_sentence(const Answer& answer) {
  std::string text;
  for (const Improbable& law : answer.search.improbable) {
    text += (text.empty() ? "" : "; ") + escaped(law.name) + " at " + escaped(law.place) + ", " +
            probability_text(law.probability) + doubt_clause(law.at_limit, law.spoils);
    if (law.shows_in.empty()) continue;
    text += ", which leaves " + short_number(100.0 * law.left) + " % of the squared gap of " +
            escaped(law.shows_in);
  }
  return text.empty() ? text : "Tried, but too improbable to be added: " + text + ". ";
}

std::string answer_sentences(const Answer& answer, const Question& question) {
  if (answer.verdict == Verdict::kNoMissingEffect) {
    return "No missing effect found: with its ordinary parameters fitted, the model has no channel "
           "with a certain gap both in the recordings that were fitted and in the held-out ones "
           "(there, all channels together " +
           short_number(answer.diagnosis.test.recalibrated) + " times the floor)." +
           uncertain_gaps(answer) + restriction(question);
  }
  if (answer.verdict == Verdict::kEffectsFound) {
    const bool falls = answer.diagnosis.test.after < answer.diagnosis.test.recalibrated;
    return found(answer) + alternatives(answer) +
           (answer.effects.size() > 1 ? "With them" : "With it") + ", the held-out gap " +
           (falls ? "falls" : "does not fall: it goes") + " from " +
           short_number(answer.diagnosis.test.recalibrated) + " to " +
           short_number(answer.diagnosis.test.after) + " times the floor; " +
           short_number(100.0 * answer.remaining.share) +
           " % of the squared gap above the noise remain." +
           (!answer.diagnosis.one_sided.empty() ? one_sided(answer)
            : !answer.remaining.certain         ? uncertain_gaps(answer)
                                                : "") +
           restriction(question);
  }
  std::string offers;
  if (!answer.effects.empty()) {
    offers = "What comes nearest: ";
    for (const FoundEffect& effect : answer.effects) offers += named(effect);
  }
  return nameless(answer, question) + offers + alternatives(answer) +
         (answer.effects.empty() ? improbable_sentence(answer) : "") + "The held-out gap is " +
         short_number(answer.diagnosis.test.after) + " times the floor (recalibrated model: " +
         short_number(answer.diagnosis.test.recalibrated) +
         "). What remains: " + escaped(answer.remaining.description) + "." + one_sided(answer) +
         restriction(question);
}

std::string next_steps(const Answer& answer, const Question& question) {
  std::vector<std::string> steps;
  if (!answer.effects.empty()) {
    const bool enough = answer.verdict == Verdict::kEffectsFound;
    steps.push_back(
        std::string("<code>model.yaml</code> in this folder is the examined model with what was "
                    "found") +
        (enough ? ": simulate, control and calibrate with it." : ". More than that is missing."));
  }
  for (std::size_t e = 0; e < answer.effects.size(); ++e) {
    const FoundEffect& effect = answer.effects[e];
    if (effect.rivals.empty() || effect.separating_recording.targets.empty()) continue;
    steps.push_back("To tell " + escaped(effect.name) + " from its rivals, record <code>" +
                    separating_file(e + 1) +
                    "</code> on the robot (its first lines say how) and run discovery again.");
  }
  if (answer.verdict == Verdict::kNoMissingEffect) {
    steps.push_back(
        "See below, <i>What these recordings can show</i>, how large each effect would have to be "
        "to show: smaller ones are not excluded.");
  }
  if (answer.verdict == Verdict::kUnexplained) {
    steps.push_back(
        "See below where the gap is and what it depends on. Check columns, signs and delays of the "
        "recordings and the ranges of ordinary parameters; otherwise " +
        std::string(answer.search.end != SearchEnd::kNoMore
                        ? "run again with a larger <code>--max-effects</code>."
                    : question.effects.empty() ? "the law is one that the catalogue lacks."
                                               : "run again without <code>--effects</code>."));
  }
  std::string list;
  for (const std::string& step : steps) list += "<li>" + step + "</li>\n";
  return list.empty() ? list : "<ul>\n" + list + "</ul>\n";
}

}  // namespace discovery
}  // namespace anthrob
