#include "identification/ecu_report.h"

#include <algorithm>

#include "anthrob_core/text.h"
#include "anthrob_recording/page.h"
#include "anthrob_recording/svg_figure.h"
#include "identification/number_text.h"
#include "identification/rig_recording.h"

namespace anthrob {
namespace identification {

namespace {

using nlohmann::ordered_json;

std::string drop_figure(const EcuResult& result) {
  using Line = SvgFigure::Line;
  SvgFigure figure("Voltage drop of the power stage");
  auto& panel = figure.add_panel("current [A]", "V_ref - V_L [V]");
  double least = 0.0, most = 0.0;
  int colour = 0;
  for (const LoadRecording& recording : result.fitted) {
    Line line;
    line.label = "R_L = " + significant(recording.load_resistance, 3) + " ohm";
    line.marks = colour % 2 == 0 ? Line::kFilled : Line::kOpen;
    line.colour = colour++;
    for (const LoadPoint& point : recording.points) {
      line.x.push_back(point.current);
      line.y.push_back(point.reference - point.voltage);
      least = std::min(least, point.current), most = std::max(most, point.current);
    }
    panel.lines.push_back(line);
  }
  Line fit;
  fit.label = "R_ECU = " + significant(result.fit.resistance.value, 3) + " ohm";
  fit.colour = colour;
  fit.x = {least, most};
  fit.y = {result.fit.resistance.value * least, result.fit.resistance.value * most};
  panel.lines.push_back(fit);
  return figure.render();
}

std::string power_stage_yaml(const Estimate& resistance) {
  return "# Identified by anthrob_identify ecu. Paste it into an actuator of a model "
         "file.\npower_stage:\n  resistance: " +
         significant(resistance.value, 4) + "  # [ohm] 95 %: " + significant(resistance.lo, 4) +
         " to " + significant(resistance.hi, 4) + "\n";
}

ordered_json report_json(const EcuResult& result) {
  ordered_json out = {{"command", "ecu"}, {"R_ECU", as_json(result.fit.resistance, "ohm")}};
  if (result.fit.gain) out["voltage_gain_error"] = as_json(*result.fit.gain, "1");
  out["offset"] = as_json(result.fit.offset, "V");
  out["rmse"]["fit_V"] = result.fit_error;
  if (result.validation_error) out["rmse"]["validation_V"] = *result.validation_error;
  out["recordings"] = ordered_json::array();
  for (const auto* list : {&result.fitted, &result.others}) {
    for (const LoadRecording& recording : *list) {
      ordered_json points = ordered_json::array();
      for (const LoadPoint& point : recording.points) {
        points.push_back({{"reference_V", point.reference},
                          {"voltage_V", point.voltage},
                          {"current_A", point.current}});
      }
      out["recordings"].push_back({{"recording", recording.name},
                                   {"specimen", recording.specimen},
                                   {"load_resistance_ohm", recording.load_resistance},
                                   {"points", points}});
    }
  }
  return out;
}

}  // namespace

EcuResult identify_ecu(std::vector<LoadRecording> recordings) {
  EcuResult result;
  sort_by_specimen(recordings);
  int first = recordings.front().specimen;
  for (const LoadRecording& recording : recordings) first = std::min(first, recording.specimen);
  for (LoadRecording& recording : recordings) {
    auto& list = recording.specimen == first ? result.fitted : result.others;
    list.push_back(std::move(recording));
  }
  result.fit = fit_series_resistance(result.fitted);
  result.fit_error = series_resistance_error(result.fit, result.fitted);
  if (!result.others.empty()) {
    result.validation_error = series_resistance_error(result.fit, result.others);
  }
  return result;
}

OutputFiles report_ecu(const EcuResult& result) {
  OutputFiles files = {{"ecu.svg", drop_figure(result)},
                       {"power_stage.yaml", power_stage_yaml(result.fit.resistance)}};
  ordered_json json = report_json(result);
  json["figures"] = figures_of(files);
  files["report.json"] = json.dump(2) + "\n";
  return files;
}

std::string summary_of_ecu(const EcuResult& result) {
  std::string out = "R_ECU " + with_error(result.fit.resistance, 1.0) + " ohm; RMSE " +
                    significant(result.fit_error, 3) + " V, second specimen ";
  out += result.validation_error ? significant(*result.validation_error, 3) + " V" : "not measured";
  return out + "\n";
}

}  // namespace identification
}  // namespace anthrob
