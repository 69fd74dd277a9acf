#include "report/discovery_figures.h"

#include <algorithm>
#include <utility>

#include "anthrob_core/text.h"
#include "anthrob_recording/svg_figure.h"

namespace anthrob {
namespace discovery {

namespace {

/// "0.05 Nm", not to be broken between lines; without unit where there is none.
std::string with_unit(double value, const std::string& unit) {
  return short_number(value) + (unit == "1" || unit.empty() ? "" : "\u00a0" + unit);
}

std::string in_unit(const std::string& unit) {
  return unit.empty() ? "" : " [" + unit + "]";
}

std::string example_figure(const Example& example, bool any_effect) {
  SvgFigure figure(example.channel + ", held-out recording");
  if (!example.measured.empty()) {
    const auto simulated = [&](std::vector<double> difference) {
      for (std::size_t i = 0; i < difference.size(); ++i) difference[i] += example.measured[i];
      return difference;
    };
    auto& values = figure.add_panel("time [s]", "value" + in_unit(example.unit));
    values.lines.push_back({"recalibrated", example.t, simulated(example.recalibrated)});
    if (any_effect) {
      values.lines.push_back({"with what was found", example.t, simulated(example.after)});
    }
    values.lines.push_back({"measured", example.t, example.measured, true});
  }
  auto& panel = figure.add_panel("time [s]", "simulated minus measured" + in_unit(example.unit));
  panel.lines.push_back({"recalibrated", example.t, example.recalibrated});
  if (any_effect) panel.lines.push_back({"with what was found", example.t, example.after});
  return figure.render();
}

SvgFigure::Line line_of(const std::string& label, const Dependence::Curve& curve) {
  SvgFigure::Line line{label, {}, {}};
  line.marks = SvgFigure::Line::kFilled;
  for (std::size_t i = 0; i < curve.at.size(); ++i) {
    line.add(curve.at[i], curve.mean[i], curve.error[i]);
  }
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

std::string dependence_figure(const Dependence& d) {
  const bool other = d.second && d.second->word != d.word;  // axis and text say which quantities
  SvgFigure figure(d.channel + " depends on " + d.word +
                   (other ? " and " + d.second->word : std::string()));
  auto& panel = figure.add_panel(d.variable + in_unit(d.variable_unit) + " (" + d.word + ")",
                                 "simulated minus measured" + in_unit(d.unit));
  panel.lines = lines_of(d);
  return figure.render();
}

std::string file_of(const std::string& kind, std::size_t index) {
  return "figures/" + kind + "_" + std::to_string(index + 1) + ".svg";
}

void add_curves(const std::vector<Dependence>& dependences, const std::string& kind,
                std::size_t most, OutputFiles& files) {
  for (std::size_t i = 0; i < std::min(dependences.size(), most); ++i) {
    files[file_of(kind, i)] = dependence_figure(dependences[i]);
  }
}

}  // namespace

OutputFiles discovery_figures(const Answer& answer, const DiagnosisOptions& options) {
  OutputFiles files;
  const std::vector<Example>& examples = answer.diagnosis.examples;
  for (std::size_t i = 0; i < examples.size(); ++i) {
    files[file_of("example", i)] = example_figure(examples[i], !answer.effects.empty());
  }
  add_curves(telling_dependences_of_gaps(answer, options.dependence), "gap", options.curves, files);
  add_curves(telling_dependences_of_rest(answer, options.dependence), "rest", options.curves,
             files);
  return files;
}

const std::set<std::string>& kinds_of_figures() {
  static const std::set<std::string> kinds = {"example", "gap", "rest", "robot"};
  return kinds;
}

std::vector<Dependence> telling_dependences_of_gaps(const Answer& answer,
                                                    const DependenceOptions& options) {
  std::vector<std::pair<double, const Dependence*>> found;
  for (const Dependence& d : answer.diagnosis.dependences) {
    if (d.share <= options.telling) continue;
    for (const Place& place : answer.diagnosis.where) {
      if (d.channel.rfind(place.place + "/" + place.channel, 0) != 0) continue;
      found.emplace_back(place.share * d.predicted(), &d);
      break;
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Dependence> ordered;
  for (const auto& [explained, dependence] : found) ordered.push_back(*dependence);
  return ordered;
}

std::vector<Dependence> telling_dependences_of_rest(const Answer& answer,
                                                    const DependenceOptions& options) {
  std::vector<Dependence> telling;
  for (const Dependence& d : answer.remaining.dependences) {
    if (!d.variable.empty() && d.share > options.telling) telling.push_back(d);
  }
  return telling;
}

}  // namespace discovery
}  // namespace anthrob
