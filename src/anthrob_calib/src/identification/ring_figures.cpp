#include "identification/ring_figures.h"

#include <algorithm>
#include <cmath>

#include "anthrob_core/text.h"
#include "anthrob_recording/svg_figure.h"
#include "identification/number_text.h"

namespace anthrob {
namespace identification {

namespace {

using Line = SvgFigure::Line;

constexpr double kMega = 1e6;
constexpr double kMean = 0.1;  ///< initial and settled stress are means over this [s]
/// Strains whose relaxation is shown, as in Figures 7.5b and 7.5c.
constexpr double kShown[] = {0.25, 1.5};

Line dots(const std::string& label, Line::Marks marks, int colour) {
  Line line;
  line.label = label;
  line.marks = marks;
  line.colour = colour;
  return line;
}

Line curve(const std::string& label, int colour, bool dashed = false) {
  Line line;
  line.label = label;
  line.colour = colour;
  line.dashed = dashed;
  return line;
}

double mean_force(const RelaxationTest& test, double from, double to) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = test.hold; i < test.t.size(); ++i) {
    if (test.t[i] < from || test.t[i] > to) continue;
    sum += test.force[i];
    ++count;
  }
  return count > 0 ? sum / count : NAN;
}

/// Stress measured and by the model in one test, thinned for drawing.
void add_relaxation(const RingRecording& recording, const ViscoelasticFit& fit, double strain,
                    SvgFigure& figure) {
  const auto nearest = std::min_element(
      recording.tests.begin(), recording.tests.end(), [&](const auto& a, const auto& b) {
        return std::abs(a.strain - strain) < std::abs(b.strain - strain);
      });
  const auto force = predicted_force(fit.model(), fit.zero_or_none(), recording, *nearest);
  auto& panel = figure.add_panel("time [s]", "stress [MPa]");
  Line measured = curve("measured, strain " + significant(nearest->strain, 3), 10);
  Line model = curve("model", 1);
  const double scale = 1.0 / (recording.specimen.area() * kMega);
  const std::size_t stride = 1 + (force.size() - nearest->hold) / 1000;
  for (std::size_t i = nearest->hold; i < force.size(); i += stride) {
    measured.x.push_back(nearest->t[i]);
    measured.y.push_back(scale * nearest->force[i]);
    model.x.push_back(nearest->t[i]);
    model.y.push_back(scale * force[i]);
  }
  panel.lines = {measured, model};
}

/// One quantity of stage 1 over the strain; those that were not used are open.
template <class Value, class Error>
void add_stage1(const ViscoelasticFit& fit, const std::string& label, const Value& value,
                const Error& error, SvgFigure::Panel& panel) {
  Line used = dots(label, Line::kFilled, 0), ignored = dots("not used", Line::kOpen, 0);
  for (const LevelFit& level : fit.levels) {
    Line& line = level.used ? used : ignored;
    line.add(level.strain, value(level), error(level));
  }
  panel.lines = {used, ignored};
}

void add_parameter(const ViscoelasticFit& fit, std::size_t i, const std::string& name,
                   SvgFigure& figure) {
  const bool modulus = name[0] == 'E';
  const double unit = modulus ? kMega : 1.0;
  auto& panel = figure.add_panel("strain [1]", name + (modulus ? " [MPa]" : " [s]"));
  add_stage1(
      fit, "stage 1, 95 %", [&](const LevelFit& level) { return level.parameters[i].value / unit; },
      [&](const LevelFit& level) {
        return 0.5 * (level.parameters[i].hi - level.parameters[i].lo) / unit;
      },
      panel);
  Line both = curve("stage 2", 1);
  both.x = {kEllipseStrain, fit.levels.back().strain};
  both.y.assign(2, fit.parameters[i].value / unit);
  panel.lines.push_back(both);
}

Line error_dots(const std::string& label, const std::map<double, double>& errors, int colour) {
  Line line = dots(label, Line::kFilled, colour);
  for (const auto& [strain, error] : errors) {
    line.x.push_back(strain);
    line.y.push_back(error);
  }
  return line;
}

}  // namespace

std::string stress_strain_figure(const RingResult& ring) {
  SvgFigure figure("Ring " + ring.ring + ": stress over strain");
  auto& panel = figure.add_panel("strain [1]", "stress [MPa]");
  int colour = 0;
  for (const RingRecording& recording : ring.recordings) {
    const std::string label = "no. " + std::to_string(recording.specimen.number) + ", run " +
                              std::to_string(recording.run);
    Line initial = dots(label + ", initial", Line::kFilled, colour);
    Line settled = dots(label + ", settled", Line::kOpen, colour++);
    const double scale = 1.0 / (recording.specimen.area() * kMega);
    for (const RelaxationTest& test : recording.tests) {
      const double begin = test.t[test.hold], end = test.t.back();
      initial.x.push_back(test.strain);
      initial.y.push_back(scale * mean_force(test, begin, begin + kMean));
      settled.x.push_back(test.strain);
      settled.y.push_back(scale * mean_force(test, end - kMean, end));
    }
    panel.lines.push_back(initial);
    panel.lines.push_back(settled);
  }
  return figure.render();
}

std::string model_figure(const RingResult& ring, const RingModelResult& model) {
  const ViscoelasticFit& fit = *model.fit;
  SvgFigure figure("Ring " + ring.ring +
                   (model.arms == 1 ? ": Zener model (model 1)" : ": Wiechert model (model 2)"));
  for (const double strain : kShown) {
    add_relaxation(ring.recordings[ring.fitted], fit, strain, figure);
  }
  add_stage1(
      fit, "stage 1", [](const LevelFit& level) { return level.r_squared; },
      [](const LevelFit&) { return 0.0; }, figure.add_panel("strain [1]", "R^2 [1]"));
  const auto names = parameter_names(model.arms);
  for (std::size_t i = 0; i < names.size(); ++i) add_parameter(fit, i, names[i], figure);
  auto& panel = figure.add_panel("strain [1]", "RMSE [N]");
  panel.lines.push_back(error_dots("fitted ring", model.fit_error, 0));
  if (!model.validation_error.empty()) {
    panel.lines.push_back(error_dots("other rings", model.validation_error, 1));
  }
  return figure.render();
}

std::string error_figure(const std::vector<RingResult>& rings) {
  std::string order;
  for (const RingResult& ring : rings) order += (order.empty() ? "" : ", ") + ring.ring;
  SvgFigure figure("RMSE of all rings: " + order);
  for (const bool validation : {false, true}) {
    auto& panel = figure.add_panel("ring", validation ? "RMSE, validation [N]" : "RMSE, fit [N]");
    for (std::size_t m = 0; m < 2; ++m) {
      Line line = dots(m == 0 ? "Zener" : "Wiechert", Line::kFilled, static_cast<int>(m));
      for (std::size_t i = 0; i < rings.size(); ++i) {
        const RingModelResult& model = rings[i].models[m];
        const auto error = validation ? model.mean_validation_error() : model.mean_fit_error();
        if (!error) continue;
        line.x.push_back(static_cast<double>(i + 1));
        line.y.push_back(*error);
      }
      panel.lines.push_back(line);
    }
  }
  return figure.render();
}

}  // namespace identification
}  // namespace anthrob
