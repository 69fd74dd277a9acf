#include "report/discovery_summary.h"

#include "anthrob_core/text.h"
#include "report/number_text.h"

namespace anthrob {
namespace discovery {

std::string cap_remark(const Answer& answer, const Question& question) {
  if (answer.search.end != SearchEnd::kFull) {
    return answer.search.end == SearchEnd::kRounds
               ? "the search ended with the rounds that --max-effects " +
                     std::to_string(question.max_effects) +
                     " allows; with a larger number it would go on"
               : "";
  }
  return "the search ended with the " + std::to_string(question.max_effects) +
         (question.max_effects == 1 ? " effect" : " effects") +
         " that --max-effects allows; no further one was looked for";
}

std::string alternative_text(const Alternative& alternative, const Answer& answer) {
  const auto name = [&](std::size_t e) {
    return answer.effects[e].id + " @ " + answer.effects[e].place;
  };
  return alternative.id + " @ " + alternative.place + " instead of both " +
         name(alternative.instead_of[0]) + " and " + name(alternative.instead_of[1]) + ", " +
         probability_text(alternative.probability) + " against those two";
}

std::string headline(const Answer& answer) {
  std::vector<std::string> found;
  for (const FoundEffect& effect : answer.effects)
    found.push_back(effect.id + " @ " + effect.place);
  const std::string verdict = verdict_name(answer.verdict);
  return found.empty() ? verdict : verdict + ": " + joined(found);
}

std::string summary(const Answer& answer) {
  std::string text = verdict_name(answer.verdict) + "\n";
  for (const FoundEffect& effect : answer.effects) {
    text += "  " + effect.id + " @ " + effect.place + ", " + probability_text(effect.probability) +
            "\n";
    for (const FoundParameter& p : effect.parameters) {
      text += "    " + p.name + " " + interval_text(p) + "\n";
    }
    for (const Rival& rival : effect.rivals) {
      text += "    or " + rival.id + " @ " + rival.place + ", " +
              probability_text(rival.probability) + "\n";
    }
  }
  for (const Alternative& alternative : answer.search.alternatives) {
    text += "  or " + alternative_text(alternative, answer) + "\n";
  }
  for (const Improbable& law : answer.search.improbable) {
    text += "  too improbable to be added: " + law.id + " @ " + law.place + ", " +
            probability_text(law.probability) + "\n";
  }
  for (const std::string& dropped : answer.search.dropped) {
    text += "  no longer needed: " + dropped + "\n";
  }
  if (const auto& refused = answer.search.refused) {
    text += "  refused " + refused->id + " @ " + refused->place + ": " + refused->lack + "\n";
  }
  text += "  gap to the held-out recordings, in units of the noise floor: " +
          short_number(answer.diagnosis.test.before) + " as given, " +
          short_number(answer.diagnosis.test.recalibrated) + " recalibrated, " +
          short_number(answer.diagnosis.test.after) +
          " with what was found; remaining: " + answer.remaining.description + "\n";
  return text;
}

}  // namespace discovery
}  // namespace anthrob
