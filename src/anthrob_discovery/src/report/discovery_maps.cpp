#include "report/discovery_maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "anthrob_calib/report/html.h"
#include "anthrob_recording/svg_figure.h"
#include "diagnosis/seams.h"
#include "judgement/criteria.h"
#include "report/discovery_sentences.h"
#include "report/number_text.h"

namespace anthrob {
namespace discovery {

namespace {

const char* const kAboutRegimes =
    R"(<p>Gap of each place (recalibrated model, all channels of the place). The recordings are cut
into thirds: by speed (low is backwards), by load (of a joint: by posture), by the angle over which
the tendon wraps, and by time.</p>
)";

const char* const kAboutSeams =
    R"(<p>Gap of each channel when the recalibrated model is replayed four times: from its commands;
from measured voltages; from measured motor positions; and, for forces, from measured motor positions
and postures (what noise of the postures adds is subtracted). Where a gap disappears from one column
to the next, its cause is in the part that measurements replaced. A force that is still red in the
last column is wrong because of something between motor and force sensor; there it may be up to twice
as large as before, because an imposed posture does not give way to a wrong force. What has grown
otherwise (grey) says nothing: motors fed with voltages drift away from the measured ones, and
measured postures have errors of their own.</p>
)";

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

std::string grey_cell(double gap) {
  return "<td style=\"background:#eeeeee\">" + short_number(gap) + "</td>";
}

/// Gaps of one channel from left to right. Only a fall tells: what has grown is grey, not red.
std::string seam_cells(const SeamGap& seam) {
  std::string html;
  double left = HUGE_VAL;
  for (const double gap : {seam.commands, seam.voltages, seam.positions}) {
    html += gap > left ? grey_cell(gap) : heat_cell(gap);
    if (gap >= 0.0) left = std::min(left, gap);
  }
  return html + (postures_mislead(seam) ? grey_cell(seam.postures) : heat_cell(seam.postures));
}

/// Of the places that disagree, first what explains most of the gap; elsewhere a curve through
/// noise says nothing.
std::vector<Dependence> dependences_where(const Answer& answer) {
  std::vector<std::pair<double, Dependence>> found;
  for (const Dependence& d : answer.diagnosis.dependences) {
    for (const Place& place : answer.diagnosis.where) {
      if (d.channel.rfind(place.place + "/" + place.channel, 0) != 0) continue;
      found.emplace_back(place.share * d.predicted(), d);
      break;
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Dependence> ordered;
  for (auto& [explained, dependence] : found) ordered.push_back(std::move(dependence));
  return ordered;
}

std::string in_unit(const std::string& unit) {
  return unit.empty() ? "" : " [" + unit + "]";
}

SvgFigure::Line line_of(const std::string& label, const Dependence::Curve& curve) {
  SvgFigure::Line line{label, curve.at, curve.mean};
  line.marks = SvgFigure::Line::kFilled;
  line.error = curve.error;
  return line;
}

std::vector<SvgFigure::Line> lines_of(const Dependence& d) {
  if (!d.second) return {line_of("", d.curve)};
  std::vector<SvgFigure::Line> lines;
  for (const Dependence::Branch& branch : d.second->branches) {
    const std::string value = with_unit(branch.second, d.second->unit);
    lines.push_back(line_of(d.second->word + " " + value, branch));
  }
  return lines;
}

std::string about_prediction(const Dependence& d) {
  std::string text = "In blocks of time that they were not fitted to, these means predict " +
                     short_number(100.0 * d.predicted()) +
                     " % of the squared gap, in addition to a constant.";
  if (d.second) {
    text += " There is a curve for each range of " + escaped(d.second->variable) + " (" +
            escaped(d.second->word) + "); one for all would predict " +
            short_number(100.0 * d.share) + " %.";
  }
  return text;
}

/// Of the first three curves that tell something.
std::string dependence_figures(const std::vector<Dependence>& dependences) {
  std::string html;
  int shown = 0;
  for (const Dependence& d : dependences) {
    if (d.share <= Dependence::kTelling) continue;
    if (++shown > 3) break;
    const bool other = d.second && d.second->word != d.word;  // axis and text say which quantities
    SvgFigure figure(d.channel + " depends on " + d.word +
                     (other ? " and " + d.second->word : std::string()));
    auto& panel = figure.add_panel(d.variable + in_unit(d.variable_unit) + " (" + d.word + ")",
                                   "simulated minus measured" + in_unit(d.unit));
    panel.lines = lines_of(d);
    html += figure.render() + "<p class=\"small\">" + about_prediction(d) + "</p>\n";
  }
  return html;
}

}  // namespace

std::string where_table(const Answer& answer) {
  if (answer.diagnosis.where.empty()) {
    return "<p>Nowhere beyond the noise, in the recordings that were fitted.</p>\n";
  }
  std::string html =
      "<table "
      "class=\"where\"><tr><th>place</th><th>channel</th><th>rmse</th><th>floor</th><th>share</"
      "th><th>"
      "significance</th><th>subsystem</th><th>depends on</th></tr>\n";
  for (std::size_t i = 0; i < answer.diagnosis.where.size() && i < 12; ++i) {
    const Place& place = answer.diagnosis.where[i];
    html +=
        "<tr>" + cell(place.place) + cell(place.channel) + cell(with_unit(place.rmse, place.unit)) +
        cell(with_unit(place.noise_floor, place.unit)) + cell(with_unit(100.0 * place.share, "%")) +
        cell(std::isnan(place.significance) ? std::string("too little data")
                                            : with_unit(place.significance, "sigma")) +
        cell(place.subsystem) + cell(place.regime) + "</tr>\n";
  }
  return html + "</table>\n";
}

std::string regime_map(const Answer& answer) {
  struct Row {
    std::string place;
    std::array<const RegimeGap*, 4> by{};
    double largest = 0.0;
  };
  std::vector<Row> rows;
  for (const RegimeGap& gap : answer.diagnosis.regimes) {
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
  std::string html = kAboutRegimes +
                     std::string(
                         "<table><tr><th rowspan=\"2\">place</th><th colspan=\"3\">speed</th>"
                         "<th colspan=\"3\">load or posture</th><th colspan=\"3\">wrap angle</th>"
                         "<th colspan=\"3\">time</th></tr>\n<tr>") +
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

std::string seam_map(const Answer& answer) {
  if (answer.diagnosis.seams.empty()) return "";
  std::string html =
      kAboutSeams +
      std::string(
          "<table>"
          "<tr><th>place / channel</th><th>commands</th><th>voltages</th><th>positions</th><th>"
          "postures</th></tr>\n");
  for (const SeamGap& seam : answer.diagnosis.seams) {
    const double largest = std::max({seam.commands, seam.voltages, seam.positions, seam.postures});
    if (largest < kFaintGap) continue;
    html += "<tr><th>" + escaped(seam.place + "/" + seam.channel) + "</th>";
    html += seam_cells(seam) + "</tr>\n";
  }
  return html + "</table>\n";
}

std::string dependences_of_gaps(const Answer& answer) {
  return dependence_figures(dependences_where(answer));
}

std::string dependences_of_rest(const Answer& answer) {
  return dependence_figures(answer.remaining.dependences);
}

}  // namespace discovery
}  // namespace anthrob
