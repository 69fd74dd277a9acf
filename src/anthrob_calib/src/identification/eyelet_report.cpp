#include "identification/eyelet_report.h"

#include <algorithm>
#include <cmath>

#include "anthrob_core/text.h"
#include "anthrob_recording/page.h"
#include "anthrob_recording/svg_figure.h"
#include "identification/number_text.h"
#include "identification/rig_recording.h"

namespace anthrob {
namespace identification {

namespace {

using Line = SvgFigure::Line;
using nlohmann::ordered_json;

/// mu_k / mu_s of the thesis: static friction is not measured by this rig.
constexpr double kStaticRatio = 0.8;

double offset_of(const CapstanFit& fit) {
  return fit.offset ? fit.offset->value : 0.0;
}

/// Force and speed of the recording with the second smallest load, as Figure 7.9b.
void add_example(const EyeletResult& result, bool pulling, SvgFigure& figure) {
  std::vector<std::pair<double, const EyeletRecording*>> candidates;
  for (const EyeletRecording& recording : result.recordings) {
    if (recording.specimen == result.specimen && recording.points.front().pulling == pulling) {
      candidates.emplace_back(recording.points.front().load, &recording);
    }
  }
  if (candidates.empty()) return;
  std::sort(candidates.begin(), candidates.end());
  const auto& [load, recording] = candidates[std::min<std::size_t>(1, candidates.size() - 1)];
  auto& panel =
      figure.add_panel("time [s]", pulling ? "force, pulling [N]" : "force, relaxing [N]");
  Line force, weight, mean;
  force.label = "sensor", weight.label = "load " + significant(load, 3) + " N", mean.label = "mean";
  weight.dashed = true;
  const std::size_t stride = 1 + recording->t.size() / 1500;
  for (std::size_t i = 0; i < recording->t.size(); i += stride) {
    force.x.push_back(recording->t[i]);
    force.y.push_back(recording->force[i]);
  }
  weight.x = mean.x = {recording->t.front(), recording->t.back()};
  weight.y = {load, load};
  mean.y.assign(2, recording->points.front().force.value);
  panel.lines = {force, weight, mean};
}

void add_friction_force(const EyeletResult& result, SvgFigure& figure) {
  auto& panel = figure.add_panel("load [N]", "friction force [N]");
  double most = 0.0;
  for (const bool pulling : {true, false}) {
    Line line;
    line.label = pulling ? "pulling" : "relaxing";
    line.marks = Line::kFilled;
    line.colour = pulling ? 0 : 1;
    for (const SlidingPoint& point : result.fitted) {
      if (point.pulling != pulling) continue;
      most = std::max(most, point.load);
      line.add(point.load, point.force.value - offset_of(result.fit) - point.load,
               0.5 * (point.force.hi - point.force.lo));
    }
    if (line.x.empty()) continue;
    panel.lines.push_back(line);
    Line fit;
    fit.label = "fit";
    fit.colour = line.colour;
    const SlidingPoint end{"", most, result.fitted.front().turning, pulling, {}};
    fit.x = {0.0, most};
    fit.y = {0.0, result.fit.predicted_force(end) - offset_of(result.fit) - most};
    panel.lines.push_back(fit);
  }
}

void add_coefficients(const EyeletResult& result, SvgFigure& figure) {
  auto& panel = figure.add_panel("load [N]", "mu_k [1]");
  for (const bool pulling : {true, false}) {
    Line line;
    line.label = pulling ? "pulling" : "relaxing";
    line.marks = Line::kFilled;
    line.colour = pulling ? 0 : 1;
    for (const SlidingPoint& point : result.fitted) {
      if (point.pulling != pulling) continue;
      line.add(point.load, capstan_coefficient(point, offset_of(result.fit)),
               0.5 * (point.force.hi - point.force.lo) / point.force.value / point.turning);
    }
    if (line.x.empty()) continue;
    panel.lines.push_back(line);
    Line mean;
    mean.colour = line.colour;
    mean.x = {0.0, *std::max_element(line.x.begin(), line.x.end())};
    mean.y.assign(2, (pulling ? result.fit.pulling : result.fit.relaxing)->value);
    panel.lines.push_back(mean);
  }
}

std::string friction_yaml(const CapstanFit& fit) {
  const double mu = fit.both.value;
  return "# Identified by anthrob_identify eyelet. Paste it into a model file. This rig does not "
         "measure static (here\n# kinetic / 0.8, the ratio of the thesis), stribeck_velocity and "
         "steepness.\neyelet_friction:\n  law: smooth_stribeck\n  static: " +
         significant(mu / kStaticRatio, 4) + "  # [1]\n  kinetic: " + significant(mu, 4) +
         "  # [1] 95 %: " + significant(fit.both.lo, 4) + " to " + significant(fit.both.hi, 4) +
         "\n  stribeck_velocity: 0.001  # [m/s]\n  steepness: 10  # [1]\n";
}

ordered_json report_json(const EyeletResult& result) {
  const CapstanFit& fit = result.fit;
  ordered_json out = {{"command", "eyelet"}, {"mu_k", as_json(fit.both, "1")}};
  if (fit.pulling) out["mu_k_pulling"] = as_json(*fit.pulling, "1");
  if (fit.relaxing) out["mu_k_relaxing"] = as_json(*fit.relaxing, "1");
  if (fit.offset) out["force_offset"] = as_json(*fit.offset, "N");
  out["rmse"]["fit_N"] = result.fit_error;
  if (result.validation_error) out["rmse"]["validation_N"] = *result.validation_error;
  for (const auto& [name, points] :
       {std::pair{"points", &result.fitted}, std::pair{"points_of_others", &result.others}}) {
    out[name] = ordered_json::array();
    for (const SlidingPoint& point : *points) {
      out[name].push_back({{"recording", point.recording},
                           {"load_N", point.load},
                           {"direction", point.pulling ? "pulling" : "relaxing"},
                           {"force", as_json(point.force, "N")},
                           {"mu_k", capstan_coefficient(point, offset_of(fit))}});
    }
  }
  return out;
}

}  // namespace

EyeletResult identify_eyelet(std::vector<EyeletRecording> recordings) {
  EyeletResult result;
  result.recordings = std::move(recordings);
  sort_by_specimen(result.recordings);
  int& first = result.specimen;
  first = result.recordings.front().specimen;
  double turning_sigma = 0.0;
  for (const EyeletRecording& recording : result.recordings) {
    first = std::min(first, recording.specimen);
    turning_sigma = std::max(turning_sigma, recording.turning_sigma);
  }
  for (const EyeletRecording& recording : result.recordings) {
    auto& points = recording.specimen == first ? result.fitted : result.others;
    points.insert(points.end(), recording.points.begin(), recording.points.end());
  }
  result.fit = fit_capstan(result.fitted, turning_sigma);
  result.fit_error = capstan_error(result.fit, result.fitted);
  if (!result.others.empty()) result.validation_error = capstan_error(result.fit, result.others);
  return result;
}

OutputFiles report_eyelet(const EyeletResult& result) {
  SvgFigure figure("Friction of an eyelet");
  add_example(result, true, figure);
  add_example(result, false, figure);
  add_friction_force(result, figure);
  add_coefficients(result, figure);
  OutputFiles files = {{"eyelet.svg", figure.render()},
                       {"eyelet_friction.yaml", friction_yaml(result.fit)}};
  ordered_json json = report_json(result);
  json["figures"] = figures_of(files);
  files["report.json"] = json.dump(2) + "\n";
  return files;
}

std::string summary_of_eyelet(const EyeletResult& result) {
  std::string out = "mu_k " + with_error(result.fit.both, 1.0);
  if (result.fit.pulling) out += ", pulling " + with_error(*result.fit.pulling, 1.0);
  if (result.fit.relaxing) out += ", relaxing " + with_error(*result.fit.relaxing, 1.0);
  out += "; RMSE " + significant(result.fit_error, 3) + " N, second specimen ";
  out += result.validation_error ? significant(*result.validation_error, 3) + " N" : "not measured";
  return out + "\n";
}

}  // namespace identification
}  // namespace anthrob
