#include "report/search_figures.h"

#include <algorithm>
#include <cmath>

#include "anthrob_recording/svg_figure.h"

namespace anthrob {
namespace calibration {

std::string fitness_figure(const std::vector<Generation>& history) {
  SvgFigure figure("Fitness");
  auto& panel = figure.add_panel("evaluations", "log10 of fitness");
  SvgFigure::Line all{"individuals", {}, {}}, best{"best so far", {}, {}};
  all.marks = SvgFigure::Line::kDots;
  all.colour = 10;  // grey
  best.colour = 0;
  for (const Generation& g : history) {
    double evaluation = g.evaluations - static_cast<double>(g.fitness.size());
    for (const double fitness : g.fitness) {
      all.x.push_back(++evaluation);
      all.y.push_back(std::log10(fitness));  // infinite ones are not drawn
    }
    best.x.push_back(g.evaluations);
    best.y.push_back(std::log10(g.best_ever));
  }
  panel.lines = {best, all};
  return figure.render();
}

std::string identifiability_figure(const Identifiability& identifiability,
                                   const std::vector<ModelParameter>& parameters) {
  SvgFigure figure("What the recordings leave of the range of each parameter");
  auto& panel = figure.add_panel("", "left of the range [%]");
  panel.from_zero = true;
  SvgFigure::Line known{"identifiable", {}, {}}, unknown{"not", {}, {}};
  for (SvgFigure::Line* line : {&known, &unknown}) line->marks = SvgFigure::Line::kFilled;
  for (std::size_t i = 0; i < identifiability.parameters.size(); ++i) {
    const ParameterKnowledge& one = identifiability.parameters[i];
    SvgFigure::Line& line = one.identifiable ? known : unknown;
    const double left = 100.0 * std::min(1.0, one.left);
    line.x.push_back(static_cast<double>(i)), line.y.push_back(left);
    line.low.push_back(0.0), line.high.push_back(left);
    panel.names.push_back(parameters[i].name());
  }
  const double last = static_cast<double>(panel.names.size()) - 1.0;
  SvgFigure::Line limit{
      "limit", {0.0, last}, {100.0 * kIdentifiableShare, 100.0 * kIdentifiableShare}, true};
  for (const SvgFigure::Line& line : {known, unknown, limit}) {
    if (!line.x.empty()) panel.lines.push_back(line);
  }
  return figure.render();
}

std::string profile_figure(const Identifiability& identifiability,
                           const std::vector<ModelParameter>& parameters, double best_fitness) {
  SvgFigure figure("Fitness along the least identifiable parameters, the others adjusted");
  for (const Profile& profile : identifiability.profiles) {
    const ModelParameter& p = parameters[profile.parameter];
    auto& panel = figure.add_panel(p.name() + " [" + p.unit + "]", "fitness / best");
    std::vector<double> y;
    for (const double f : profile.fitness) y.push_back(f / best_fitness);
    panel.lines.push_back({"profile", profile.value, y});
  }
  return figure.render();
}

}  // namespace calibration
}  // namespace anthrob
