#include "report/discovery_findings.h"

#include "anthrob_calib/report/html.h"
#include "judgement/criteria.h"
#include "report/discovery_sentences.h"
#include "report/discovery_summary.h"
#include "report/number_text.h"
#include "report/separating_files.h"
#include "separation/separating_experiment.h"

namespace anthrob {
namespace discovery {

namespace {

std::string parameter_table(const FoundEffect& effect) {
  std::string html =
      "<table><tr><th>parameter</th><th>value</th><th>95 % interval</th><th>unit</th></tr>\n";
  for (const FoundParameter& p : effect.parameters) {
    html += "<tr>" + cell(p.name) + cell(value_text(p)) + cell(range_text(p)) + cell(p.unit) +
            "</tr>\n";
  }
  return html + "</table>\n";
}

/// What speaks against an effect's law, though it was named.
std::string what_is_left(const FoundEffect& effect) {
  if (effect.shows_in.empty()) return "";
  std::string text = " It shows most in " + escaped(effect.shows_in) + " and leaves " +
                     short_number(100.0 * effect.left) + " % of the squared gap there";
  if (effect.left > kEvenOdds) text += ": another law may be at work at this place";
  return text + ".";
}

/// @param number of the effect, from 1
std::string rivals_of(const FoundEffect& effect, std::size_t number, const Answer& answer) {
  if (effect.rivals.empty()) return "";
  // Where too much is left for any of them, they are rivals of something that is not it either.
  std::string html = answer.verdict == Verdict::kUnexplained && effect.left > kEvenOdds
                         ? "<p>Others come as near:</p><ul>\n"
                         : "<p>These data do not exclude:</p><ul>\n";
  for (const Rival& rival : effect.rivals) {
    html += "<li>" + escaped(rival.name) + ": " + escaped(rival.id) + " @ " + escaped(rival.place) +
            ", " + probability_text(rival.probability) + "</li>\n";
  }
  html += "</ul><p>To tell them apart: " + escaped(effect.separating_experiment) + ".</p>\n";
  if (effect.separating_recording.targets.empty()) return html;
  return html + "<p>Or, with the motors on, by a protocol for the recorder: <code>" +
         separating_file(number) + "</code>. As they are fitted now, the two differ there by " +
         short_number(effect.separating_recording.distance()) +
         " nat; fitted to that recording, too, they will differ by less.</p>\n";
}

std::string finding(const FoundEffect& effect, std::size_t number, const Answer& answer) {
  return "<h3>" + escaped(effect.name) + ": " + escaped(effect.id) + " @ " + escaped(effect.place) +
         "</h3>\n" + parameter_table(effect) + "<p>Evidence: " + short_number(effect.evidence) +
         " nat gained in held-out log score, " + probability_text(effect.probability) +
         doubt_clause(effect.at_limit, effect.spoils) + "." + what_is_left(effect) + "</p>\n" +
         rivals_of(effect, number, answer);
}

/// The last candidate that was not named, and why.
std::string refused(const Answer& answer) {
  if (!answer.search.refused) return "";
  const Refused& refused = *answer.search.refused;
  return "<p>" +
         std::string(answer.effects.empty() && answer.search.improbable.empty()
                         ? "Closest to being named"
                         : "Next in line") +
         " was " + escaped(refused.id) + " @ " + escaped(refused.place) + ": " +
         escaped(refused.lack) + ".</p>\n";
}

}  // namespace

std::string gap_table(const Answer& answer) {
  const auto row = [](const std::string& name, const Gap& gap) {
    return "<tr><th>" + name + "</th>" + cell(short_number(gap.before)) +
           cell(short_number(gap.recalibrated)) + cell(short_number(gap.after)) + cell("1") +
           "</tr>\n";
  };
  return "<table><tr><th>gap [floors]</th><th>model as given</th><th>recalibrated"
         "</th><th>with what was found</th><th>noise alone</th></tr>\n" +
         row("held-out recordings", answer.diagnosis.test) +
         row("training recordings", answer.diagnosis.train) +
         "</table>\n<p class=\"small\">Gap: root mean square of simulation minus measurement, all "
         "channels together, in units of the floor, which is what noise alone leaves. Held-out "
         "recordings were never fitted.</p>\n";
}

std::string findings(const Answer& answer, const Question& question) {
  std::string html;
  for (std::size_t e = 0; e < answer.effects.size(); ++e) {
    html += finding(answer.effects[e], e + 1, answer);
  }
  if (answer.effects.empty() && question.max_effects > 0) {
    html += std::string("<p>Nothing ") +
            (question.effects.empty() ? "in the catalogue " : "that --effects lists ") +
            (answer.search.improbable.empty() ? "earned its place" : "is probable enough") +
            ".</p>\n";
  }
  for (const Alternative& alternative : answer.search.alternatives) {
    html += "<p>Or " + escaped(alternative_text(alternative, answer)) + ". To tell them apart: " +
            escaped(separating_experiment(answer.effects[alternative.instead_of[0]].id,
                                          alternative.id)) +
            ".</p>\n";
  }
  for (const std::string& dropped : answer.search.dropped) {
    html += "<p>Named at first, but not needed beside the others: " + escaped(dropped) + ".</p>\n";
  }
  for (const std::string& line : answer.asked)
    html += "<p>Asked after an earlier search: " + escaped(line) + ".</p>\n";
  if (!answer.search.improbable.empty()) html += "<p>" + improbable_sentence(answer) + "</p>\n";
  return html + refused(answer);
}

}  // namespace discovery
}  // namespace anthrob
