#include "report/discovery_channels.h"

#include <cmath>

#include "anthrob_calib/report/html.h"
#include "anthrob_recording/svg_figure.h"
#include "judgement/criteria.h"
#include "report/number_text.h"

namespace anthrob {
namespace discovery {

namespace {

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

}  // namespace

std::string example_figures(const Answer& answer) {
  std::string html;
  for (const Example& example : answer.diagnosis.examples) {
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

/// Channels that the corrected model has worse than the recalibrated one, above their floors, and
/// how certain that is.
std::string worse_channels(const Answer& answer) {
  constexpr double kWorse = 1.05;
  std::string text;
  for (const auto& [name, gap] : answer.diagnosis.per_channel) {
    if (gap.after < kWorse * gap.recalibrated || gap.after < 1.0) continue;
    text += (text.empty() ? "" : ", ") + escaped(name) + " (" + short_number(gap.recalibrated) +
            " to " + short_number(gap.after);
    const auto growth = answer.diagnosis.growth.find(name);
    if (growth != answer.diagnosis.growth.end()) {
      text += growth->second < kSure ? ", maybe by chance" : ", not by chance";
    }
    text += ")";
  }
  if (text.empty()) return "";
  return "<p>With what was found, these channels are more than 5 % worse and above the floor: " +
         text + ".</p>\n";
}

std::string channel_table(const Answer& answer) {
  std::string html =
      "<table><tr><th>channel</th><th>as given</th><th>recalibrated</th><th>with what was found"
      "</th></tr>\n";
  for (const auto& [name, gap] : answer.diagnosis.per_channel) {
    html += "<tr>" + cell(name) + cell(short_number(gap.before)) +
            cell(short_number(gap.recalibrated)) + cell(short_number(gap.after)) + "</tr>\n";
  }
  return html + "</table>\n";
}

std::string visibility(const Answer& answer, const Question& question) {
  std::string html;
  if (answer.detectability.not_visible.empty()) {
    html += std::string("<p>Everything ") +
            (question.effects.empty() ? "in the catalogue" : "that --effects asks for") +
            " would have shown.</p>\n";
  } else {
    html += folded(
        std::to_string(answer.detectability.not_visible.size()) +
            " effects (each at one place) would not have shown at all, or only if very large",
        visibility_table(answer.detectability.not_visible));
  }
  html += folded(std::to_string(answer.detectability.visible.size()) +
                     " effects (each at one place) would have shown from this size on",
                 visibility_table(answer.detectability.visible));
  if (answer.detectability.alike.empty()) return html;
  std::string groups = "<ul>\n";
  for (const auto& group : answer.detectability.alike) {
    groups += "<li>";
    for (std::size_t i = 0; i < group.size(); ++i) {
      groups += (i > 0 ? ", " : "") + escaped(group[i].id + " @ " + group[i].place);
    }
    groups += "</li>\n";
  }
  return html +
         folded(
             std::to_string(answer.detectability.alike.size()) +
                 " groups of effects that these recordings cannot tell apart, whatever their size",
             groups + "</ul>\n");
}

}  // namespace discovery
}  // namespace anthrob
