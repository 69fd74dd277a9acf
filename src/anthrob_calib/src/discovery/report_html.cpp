#include <algorithm>
#include <array>
#include <cmath>

#include "anthrob_calib/discovery/criteria.h"
#include "anthrob_calib/discovery/report.h"
#include "anthrob_calib/discovery/verdict.h"
#include "anthrob_calib/report/html.h"
#include "anthrob_sim/report/svg_figure.h"

namespace anthrob {
namespace discovery {

namespace {

std::string cell(const std::string& text) {
  return "<td>" + escaped(text) + "</td>";
}

/// Not to be broken between lines.
std::string with_unit(double value, const std::string& unit) {
  return short_number(value) + (unit == "1" ? "" : "\u00a0" + unit);
}

const char* const kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>What the model misses</title><style>
body{font-family:sans-serif;max-width:60em;margin:2em auto;padding:0 1em;color:#222;line-height:1.45}
h1{margin-bottom:.2em}table{border-collapse:collapse;margin:1em 0}
td,th{border:1px solid #ccc;padding:.25em .6em;text-align:left}th{background:#f2f2f2}
.answer{font-size:1.25em;border-left:.4em solid #1f77b4;padding:.3em 1em;background:#f5f9fd}
.small{color:#555;font-size:.9em}svg{max-width:100%;height:auto}
</style></head><body>
)";

std::string range_text(const FoundParameter& p) {
  return short_number(p.low) + " to " + short_number(p.high);
}

/// Why the rest has no name.
std::string nameless(const Answer& answer, const Question& question) {
  if (answer.effects.size() >= static_cast<std::size_t>(question.max_effects)) {
    return "Something is missing beyond the " + std::to_string(question.max_effects) +
           " effects that --max-effects let be named. ";
  }
  if (!question.effects.empty()) {
    return "Something is missing that is not among what --effects let be looked for. ";
  }
  return "Something is missing that no law of the catalogue, as it was fitted, explains" +
         std::string(answer.effects.empty() ? ". " : " completely. ");
}

/// Channels that are more than noise at the end, where none of them is so for certain.
std::string uncertain_gaps(const Answer& answer) {
  constexpr std::size_t kMost = 5;
  std::vector<std::pair<double, std::string>> gaps;
  for (const auto& [name, gap] : answer.per_channel) {
    if (gap.after > kRealGap) gaps.emplace_back(-gap.after, name);
  }
  if (gaps.empty()) return "";
  std::sort(gaps.begin(), gaps.end());
  std::string text = " Above " + short_number(kRealGap) + " times the floor, but not for certain: ";
  for (std::size_t i = 0; i < gaps.size() && i < kMost; ++i) {
    text +=
        (i > 0 ? ", " : "") + escaped(gaps[i].second) + " (" + short_number(-gaps[i].first) + ")";
  }
  if (gaps.size() > kMost) text += " and " + std::to_string(gaps.size() - kMost) + " more";
  return text + ".";
}

/// An effect with its size and probability, as a sentence.
std::string named(const FoundEffect& effect) {
  std::string text = "<b>" + escaped(effect.name) + "</b> at <b>" + escaped(effect.place) + "</b>";
  if (!effect.parameters.empty()) {
    const FoundParameter& p = effect.parameters.front();
    text += " (" + escaped(p.name) + " " + escaped(with_unit(p.value, p.unit)) + ", " +
            (p.known ? "taken as known" : "95 % interval " + range_text(p)) + ")";
  }
  return text + ", " + probability_text(effect.probability) + ". ";
}

/// What speaks against an effect's law, though it was named.
std::string what_is_left(const FoundEffect& effect) {
  if (effect.shows_in.empty()) return "";
  std::string text = " It shows most in " + escaped(effect.shows_in) + ", and leaves " +
                     short_number(100.0 * effect.left) + " % of the squared gap there";
  if (effect.left > kEvenOdds) text += ": the law at this place may be another one";
  return text + ".";
}

std::string where_it_ends(const std::string& parameter) {
  return parameter.empty()
             ? ""
             : ", its " + escaped(parameter) +
                   " at the end of its range, as of a law that does another one's work";
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
      either +=
          "The model misses one of two, which these data do not tell apart: " + named(effect) +
          "Or <b>" + escaped(rival.id) + "</b> at <b>" + escaped(rival.place) + "</b>, " +
          probability_text(rival.probability) + ". ";
    } else {
      alike += named(effect);
    }
  }
  if (!probable.empty()) probable = "The model misses: " + probable;
  if (!alike.empty()) alike = "The model misses this or something like it: " + alike;
  return probable + either + alike;
}

/// What earned its place, and leaves too much to be right.
std::string too_improbable(const Answer& answer) {
  std::string text;
  for (const Improbable& law : answer.improbable) {
    text += (text.empty() ? "" : "; ") + escaped(law.name) + " at " + escaped(law.place) + ", " +
            probability_text(law.probability) + where_it_ends(law.at_limit);
    if (law.shows_in.empty()) continue;
    text += ", which leaves " + short_number(100.0 * law.left) + " % of the squared gap of " +
            escaped(law.shows_in);
  }
  return text.empty() ? text : "Looked at, but too improbable to be added: " + text + ". ";
}

/// The answer in one or two sentences.
std::string sentence(const Answer& answer, const Question& question) {
  if (answer.verdict == "no_missing_effect") {
    return "No gap that is certain between the model, with its ordinary parameters fitted, and the "
           "held-out recordings (all channels together " +
           short_number(answer.test.recalibrated) + " times the floor)." + uncertain_gaps(answer);
  }
  std::string text;
  for (const Alternative& other : answer.alternatives) {
    const FoundEffect &one = answer.effects[other.instead_of[0]],
                      &two = answer.effects[other.instead_of[1]];
    text += "Or, instead of " + escaped(one.name) + " and " + escaped(two.name) + ", <b>" +
            escaped(other.id) + "</b> at <b>" + escaped(other.place) + "</b> alone, " +
            probability_text(other.probability) + " against those two. ";
  }
  if (answer.verdict == "effects_found") {
    const bool falls = answer.test.after < answer.test.recalibrated;
    return found(answer) + text + (answer.effects.size() > 1 ? "With them" : "With it") +
           ", the held-out gap " + (falls ? "falls" : "does not fall: it goes") + " from " +
           short_number(answer.test.recalibrated) + " to " + short_number(answer.test.after) +
           " times the floor; of the square of what stood above the noise " +
           short_number(100.0 * answer.remaining_share) + " % is left." +
           (answer.remaining_description == kNoCertainGap ? uncertain_gaps(answer) : "");
  }
  if (!answer.effects.empty()) {
    std::string offers = "The catalogue offers: ";
    for (const FoundEffect& effect : answer.effects) offers += named(effect);
    text = offers + text;
  }
  return nameless(answer, question) + text +
         (answer.effects.empty() ? too_improbable(answer) : "") + "Held-out gap " +
         short_number(answer.test.after) + " times the floor, where the recalibrated model has " +
         short_number(answer.test.recalibrated) +
         "; what is left: " + escaped(answer.remaining_description) + ".";
}

std::string gap_table(const Answer& answer) {
  const auto row = [](const std::string& name, const Gap& gap) {
    return "<tr><th>" + name + "</th>" + cell(short_number(gap.before)) +
           cell(short_number(gap.recalibrated)) + cell(short_number(gap.after)) + cell("1") +
           "</tr>\n";
  };
  return "<table><tr><th>gap, in units of the floor</th><th>model as given</th><th>recalibrated"
         "</th><th>with what was found</th><th>floor</th></tr>\n" +
         row("recordings never fitted", answer.test) +
         row("recordings learned from", answer.train) + "</table>\n";
}

/// The last candidate that was not named, and why.
std::string refused(const Answer& answer) {
  const Refused& refused = answer.refused;
  if (refused.id.empty()) return "";
  return "<p>" +
         std::string(answer.effects.empty() && answer.improbable.empty() ? "Closest to being named"
                                                                         : "Next in line") +
         " was " + escaped(refused.id) + " @ " + escaped(refused.place) + ": " +
         escaped(refused.lack) + ".</p>\n";
}

std::string effects_table(const Answer& answer) {
  const std::string improbable =
      answer.improbable.empty() ? "" : "<p>" + too_improbable(answer) + "</p>\n";
  std::string asked;
  for (const std::string& line : answer.asked) asked += "<p>Before: " + escaped(line) + ".</p>\n";
  if (answer.effects.empty()) {
    const char* const what = improbable.empty() ? "earned its place" : "is probable enough";
    return "<p>Nothing in the catalogue " + std::string(what) + ".</p>\n" + asked + improbable +
           refused(answer);
  }
  std::string html;
  std::size_t number = 0;
  for (const FoundEffect& effect : answer.effects) {
    ++number;
    html += "<h3>" + escaped(effect.name) + ": " + escaped(effect.id) + " @ " +
            escaped(effect.place) +
            "</h3>\n<table><tr><th>parameter</th><th>value</th><th>95 % "
            "interval</th><th>unit</th></tr>\n";
    for (const FoundParameter& p : effect.parameters) {
      html += "<tr>" + cell(p.name) + cell(short_number(p.value)) +
              cell(p.known ? "taken as known" : range_text(p)) + cell(p.unit) + "</tr>\n";
    }
    html += "</table>\n<p>Gain in held-out log score " + short_number(effect.evidence) + " nat, " +
            probability_text(effect.probability) + where_it_ends(effect.at_limit) + "." +
            what_is_left(effect) + "</p>\n";
    if (effect.rivals.empty()) continue;
    // Where too much is left for any of them, they are rivals of something that is not it either.
    html += answer.verdict == "unexplained" && effect.left > kEvenOdds
                ? "<p>Others that come as near:</p><ul>\n"
                : "<p>These data do not exclude:</p><ul>\n";
    for (const Rival& rival : effect.rivals) {
      html += "<li>" + escaped(rival.id) + " @ " + escaped(rival.place) + ", " +
              probability_text(rival.probability) + "</li>\n";
    }
    html +=
        "</ul><p>What would tell them apart: " + escaped(effect.separating_experiment) + ".</p>\n";
    if (!effect.separating_recording.targets.empty()) {
      html += "<p>As a protocol of the recorder: " + separating_file(number) +
              ", expected to tell " + short_number(effect.separating_recording.distance()) +
              " nat.</p>\n";
    }
  }
  for (const Alternative& alternative : answer.alternatives) {
    html += "<p>Or " + escaped(alternative_text(alternative, answer)) +
            ". What would tell: " + escaped(alternative.separating_experiment) + ".</p>\n";
  }
  for (const std::string& dropped : answer.dropped) {
    html += "<p>Named at first, but not needed beside the others: " + escaped(dropped) + ".</p>\n";
  }
  html +=
      "<p>The model with this is <code>model.yaml</code>, which extends the examined one.</p>\n";
  return html + asked + improbable + refused(answer);
}

std::string colour_of(double gap) {
  if (gap < 0.0) return "#ffffff";
  const double heat = std::clamp(std::log(std::max(gap, 1.0)) / std::log(20.0), 0.0, 1.0);
  char text[16];
  std::snprintf(text, sizeof(text), "#ff%02x%02x", static_cast<int>(255 - 190 * heat),
                static_cast<int>(255 - 215 * heat));
  return text;
}

std::string heat_cell(double gap) {
  return "<td style=\"background:" + colour_of(gap) + "\">" +
         (gap < 0.0 ? std::string() : short_number(gap)) + "</td>";
}

/// Place x regime: its speed, its load or else posture, its wrap angle, time, each in three levels.
std::string regime_map(const Answer& answer) {
  struct Row {
    std::string place;
    std::array<const RegimeGap*, 4> by{};
    double largest = 0.0;
  };
  std::vector<Row> rows;
  for (const RegimeGap& gap : answer.regimes) {
    if (rows.empty() || rows.back().place != gap.place) rows.push_back({gap.place});
    Row& row = rows.back();
    row.by[gap.word == "speed"        ? 0
           : gap.word == "wrap angle" ? 2
           : gap.word == "time"       ? 3
                                      : 1] = &gap;
    row.largest = std::max(row.largest, *std::max_element(gap.gap.begin(), gap.gap.end()));
  }
  if (rows.empty()) return "";
  const std::string levels = "<th>low</th><th>middle</th><th>high</th>";
  std::string html =
      "<p>Gap of every place (recalibrated model, all its channels) when its speed, its load (of a "
      "joint: posture), the angle by which its tendon wraps or the time is low (speed: backwards), "
      "in the middle and high; a third of the recordings each.</p>\n<table><tr><th "
      "rowspan=\"2\">place</th><th colspan=\"3\">speed"
      "</th><th colspan=\"3\">load or posture</th><th colspan=\"3\">wrap angle</th>"
      "<th colspan=\"3\">time</th></tr>\n<tr>" +
      levels + levels + levels + levels + "</tr>\n";
  for (const Row& row : rows) {
    if (row.largest < kFaintGap) continue;
    html += "<tr><th>" + escaped(row.place) + "</th>";
    for (const RegimeGap* by : row.by) {
      for (std::size_t level = 0; level < kLevels; ++level) {
        html += heat_cell(by ? by->gap[level] : -1.0);
      }
    }
    html += "</tr>\n";
  }
  return html + "</table>\n";
}

/// Gaps of one channel from left to right. Only a fall tells: what has grown is grey, not red.
std::string seam_cells(const SeamGap& seam) {
  std::string html;
  double left = HUGE_VAL;
  for (const double gap : {seam.commands, seam.voltages, seam.positions, seam.postures}) {
    if (gap > left) {
      html += "<td style=\"background:#eeeeee\">" + short_number(gap) + "</td>";
    } else {
      html += heat_cell(gap);
    }
    if (gap >= 0.0) left = gap;
  }
  return html;
}

/// Where x which input is fed: a gap that vanishes to the right belongs to what was cut off.
std::string seam_map(const Answer& answer) {
  if (answer.seams.empty()) return "";
  std::string html =
      "<p>Gap of every channel (recalibrated model) when the chain is fed with commands, with "
      "measured voltages, with measured motor positions, with these and measured postures (of "
      "forces; what noise of the postures does is taken off). Only a fall tells: what turns white "
      "belongs to the part that was cut off there; forces that are still red on the right are "
      "wrong by what lies between motor and force sensor. What grows, grey, tells nothing: motors "
      "that are fed with voltages drift away "
      "from where the measured ones were.</p>\n<table>"
      "<tr><th>place / channel</th><th>commands</th><th>voltages</th><th>positions</th><th>"
      "postures</th></tr>\n";
  for (const SeamGap& seam : answer.seams) {
    const double largest = std::max({seam.commands, seam.voltages, seam.positions, seam.postures});
    if (largest < kFaintGap) continue;
    html += "<tr><th>" + escaped(seam.place + "/" + seam.channel) + "</th>";
    html += seam_cells(seam) + "</tr>\n";
  }
  return html + "</table>\n";
}

std::string where_table(const Answer& answer) {
  if (answer.where.empty()) return "<p>Nowhere beyond the floor.</p>\n";
  std::string html =
      "<table><tr><th>place</th><th>channel</th><th>rmse</th><th>floor</th><th>share</th><th>"
      "significance</th><th>subsystem</th><th>depends on</th></tr>\n";
  for (std::size_t i = 0; i < answer.where.size() && i < 12; ++i) {
    const Place& place = answer.where[i];
    html +=
        "<tr>" + cell(place.place) + cell(place.channel) + cell(with_unit(place.rmse, place.unit)) +
        cell(with_unit(place.noise_floor, place.unit)) + cell(with_unit(100.0 * place.share, "%")) +
        cell(std::isnan(place.significance) ? std::string("cannot be told")
                                            : with_unit(place.significance, "sigma")) +
        cell(place.subsystem) + cell(place.regime) + "</tr>\n";
  }
  return html + "</table>\n";
}

std::string example_figures(const Answer& answer) {
  std::string html;
  for (const Example& example : answer.examples) {
    SvgFigure figure("simulated minus measured, held-out recording");
    auto& panel = figure.add_panel("time [s]", example.channel + " [" + example.unit + "]");
    panel.lines.push_back({"recalibrated", example.t, example.recalibrated});
    if (!answer.effects.empty()) {
      panel.lines.push_back({"with what was found", example.t, example.after});
    }
    html += figure.render() + "\n";
  }
  return html;
}

/// Of the places that disagree; elsewhere a curve through noise says nothing.
std::vector<Dependence> dependences_where(const Answer& answer) {
  std::vector<Dependence> found;
  for (const Dependence& d : answer.dependences) {
    const bool disagrees =
        std::any_of(answer.where.begin(), answer.where.end(), [&](const Place& place) {
          return d.channel.rfind(place.place + "/" + place.channel, 0) == 0;
        });
    if (disagrees) found.push_back(d);
  }
  return found;
}

std::string dependence_figures(const std::vector<Dependence>& dependences) {
  std::vector<const Dependence*> strongest;
  for (const Dependence& d : dependences) {
    if (d.share > Dependence::kTelling) strongest.push_back(&d);
  }
  std::sort(strongest.begin(), strongest.end(),
            [](const Dependence* a, const Dependence* b) { return a->share > b->share; });
  std::string html;
  for (std::size_t i = 0; i < strongest.size() && i < 3; ++i) {
    const Dependence& d = *strongest[i];
    SvgFigure figure(d.channel + " depends on " + d.word);
    auto& panel = figure.add_panel(d.variable + " (" + d.word + ")", "simulated minus measured");
    SvgFigure::Line line{"", d.at, d.curve};
    line.marks = SvgFigure::Line::kFilled;
    line.error = d.error;
    panel.lines.push_back(line);
    html += figure.render() + "<p class=\"small\">The curve predicts " +
            short_number(100.0 * d.share) +
            " % of the square in blocks it was not fitted to, beyond what a constant does.</p>\n";
  }
  return html;
}

/// Channels that the corrected model has worse than the recalibrated one, above their floors.
std::string worse_channels(const Answer& answer) {
  constexpr double kWorse = 1.05;
  std::string text;
  for (const auto& [name, gap] : answer.per_channel) {
    if (gap.after < kWorse * gap.recalibrated || gap.after < 1.0) continue;
    text += (text.empty() ? "" : ", ") + escaped(name) + " (" + short_number(gap.recalibrated) +
            " to " + short_number(gap.after) + ")";
  }
  if (text.empty()) return "";
  return "<p>Worse by more than 5 % and above the floor with what was found: " + text + ".</p>\n";
}

std::string channel_table(const Answer& answer) {
  std::string html =
      "<table><tr><th>channel</th><th>as given</th><th>recalibrated</th><th>with what was found"
      "</th></tr>\n";
  for (const auto& [name, gap] : answer.per_channel) {
    html += "<tr>" + cell(name) + cell(short_number(gap.before)) +
            cell(short_number(gap.recalibrated)) + cell(short_number(gap.after)) + "</tr>\n";
  }
  return html + "</table>\n";
}

std::string visibility_table(const std::vector<Visibility>& effects) {
  std::string html =
      "<table><tr><th>effect</th><th>place</th><th>smallest size that would show</th></tr>\n";
  for (const Visibility& effect : effects) {
    html += "<tr>" + cell(effect.id) + cell(effect.place) +
            cell(std::isfinite(effect.smallest_visible)
                     ? short_number(effect.smallest_visible) + " " + effect.unit
                     : "none") +
            "</tr>\n";
  }
  return html + "</table>\n";
}

/// A long list that is shown on demand.
std::string folded(const std::string& title, const std::string& content) {
  return "<details><summary>" + title + "</summary>\n" + content + "</details>\n";
}

std::string preflight(const Answer& answer, const Question& question) {
  std::string html;
  if (answer.not_visible.empty()) {
    html += std::string("<p>Everything ") +
            (question.effects.empty() ? "in the catalogue" : "that --effects asks for") +
            " would have shown.</p>\n";
  } else {
    html += folded(std::to_string(answer.not_visible.size()) +
                       " effects and places could not have shown, or only a large one",
                   visibility_table(answer.not_visible));
  }
  html += folded(std::to_string(answer.visible.size()) + " would have shown from a size on",
                 visibility_table(answer.visible));
  if (answer.alike.empty()) return html;
  std::string groups = "<ul>\n";
  for (const auto& group : answer.alike) {
    groups += "<li>";
    for (std::size_t i = 0; i < group.size(); ++i) {
      groups += (i > 0 ? ", " : "") + escaped(group[i].id + " @ " + group[i].place);
    }
    groups += "</li>\n";
  }
  return html + folded(std::to_string(answer.alike.size()) +
                           " groups could not have been told apart, whatever the size",
                       groups + "</ul>\n");
}

const char* const kWords = R"(<h2>Words</h2><ul>
<li>floor: what a gap is that is noise alone, from repeats of the same commands or from how
neighbouring values scatter, with the errors of rounding and of the simulation; gaps are counted in
it</li>
<li>recalibrated: the given model with its ordinary parameters, those of calibration.yaml, fitted to
what was learned from, and no effect added</li>
<li>share: of the square of what all gaps together are more than noise, the part of this channel</li>
<li>significance: by how many standard errors (sigma), over blocks of 2 s, a channel stands above
what a wrong floor may look like</li>
<li>squared gap: what of the square of a gap stands above what noise may look like (1.15 floors)</li>
<li>probability: how likely this law at this place is the right one, among those that were fitted
and none; what it leaves lowers it. The rest, up to 1, belongs to rivals and to laws that the
catalogue lacks</li>
<li>nat: a log score that is one higher means that the recordings are 2.7 times as probable</li>
</ul>
)";

}  // namespace

std::string report_html(const Answer& answer, const Question& question, double runtime) {
  std::string recordings;
  for (const Dataset& r : question.train)
    recordings += "<li>learned from: " + escaped(r.folder) + "</li>";
  for (const Dataset& r : question.test)
    recordings += "<li>judged by: " + escaped(r.folder) + "</li>";
  for (const Dataset& r : question.repeats)
    recordings += "<li>repeat: " + escaped(r.folder) + "</li>";
  for (const std::string& remark : answer.remarks) {
    recordings += "<li>" + escaped(remark) + "</li>";
  }
  const std::string cap = cap_remark(answer, question);
  return std::string(kHead) + "<h1>What the model misses</h1>\n<p class=\"small\">" +
         escaped(question.model_file) + ", seed " + std::to_string(question.seed) + ", " +
         short_number(runtime) + " s</p>\n<p class=\"answer\">" + sentence(answer, question) +
         "</p>\n" + gap_table(answer) + example_figures(answer) + "<h2>What</h2>\n" +
         effects_table(answer) + "<h2>Where the recalibrated model disagrees</h2>\n" +
         where_table(answer) + regime_map(answer) + seam_map(answer) +
         dependence_figures(dependences_where(answer)) + "<h2>What is left</h2>\n<p>" +
         escaped(answer.remaining_description) + (cap.empty() ? "" : "; " + escaped(cap)) +
         ".</p>\n" + dependence_figures(answer.remaining) + "<h2>Held-out gap by channel</h2>\n" +
         worse_channels(answer) + channel_table(answer) +
         "<h2>What these recordings can show</h2>\n" + preflight(answer, question) +
         "<h2>Recordings</h2><ul>" + recordings + "</ul>\n" + kWords + "</body></html>\n";
}

}  // namespace discovery
}  // namespace anthrob
