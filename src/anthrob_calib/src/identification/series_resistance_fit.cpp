#include "identification/series_resistance_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "anthrob_core/errors.h"
#include "anthrob_core/text.h"
#include "identification/least_squares.h"
#include "identification/number_text.h"
#include "identification/rig_recording.h"

namespace anthrob {
namespace identification {

namespace {

/// At the end of a level of the reference [s]: 500 periods of the pulse width modulation.
constexpr double kAverage = 0.01;

/// A load has the voltage and the current that the reference asks for.
void require_signs(const LoadRecording& recording) {
  double by_voltage = 0.0, by_current = 0.0;
  for (const LoadPoint& point : recording.points) {
    by_voltage += point.reference * point.voltage;
    by_current += point.reference * point.current;
  }
  for (const auto& [column, product] :
       {std::pair{"voltage", by_voltage}, std::pair{"current", by_current}}) {
    if (product >= 0.0) continue;
    throw BadInput(recording.name + ": oscilloscope/" + column +
                   ": has the opposite sign of resistor/reference: expected the same; reverse the "
                   "sign of the column");
  }
}

}  // namespace

LoadRecording LoadRecording::read(const Dataset& recording) {
  const RigColumns columns =
      read_columns(recording, "ECU with load resistor",
                   {"resistor/reference", "oscilloscope/voltage", "oscilloscope/current"});
  const ConfigNode meta = rig_meta(recording);
  LoadRecording result;
  result.name = recording_name(recording);
  result.specimen = meta.at("specimen").at("number").as_integer(1, 1000000);
  result.load_resistance = meta.at("rig").number("load_resistance", Bounds::positive(), "ohm");
  result.current_gain_sigma =
      meta.at("rig").number_or("current_gain_sigma", 0.0, Bounds::nonnegative(), "1");
  for (const char* part : {"specimen", "rig"}) meta.at(part).refuse_unknown_keys();

  const auto& reference = columns.values[0];
  const auto window =
      std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(kAverage / columns.period())));
  for (std::size_t begin = 0, end = 0; begin < reference.size(); begin = end) {
    while (end < reference.size() && reference[end] == reference[begin]) ++end;
    if (end - begin < 2 * window) {
      throw BadInput(result.name + ": at t = " + exact_text(columns.t[begin]) +
                     " s: resistor/reference holds for less than 20 ms: expected levels of 20 ms "
                     "or more; is the recording cut off?");
    }
    result.points.push_back({reference[begin], mean(columns.values[1], end - window, end),
                             mean(columns.values[2], end - window, end)});
  }
  require_signs(result);
  return result;
}

double SeriesResistanceFit::predicted_voltage(const LoadPoint& point) const {
  return (1.0 + (gain ? gain->value : 0.0)) * (point.reference - resistance.value * point.current) +
         offset.value;
}

SeriesResistanceFit fit_series_resistance(const std::vector<LoadRecording>& recordings) {
  std::vector<LoadPoint> points;
  double least = HUGE_VAL, most = 0.0, gain_sigma = 0.0;
  for (const LoadRecording& recording : recordings) {
    points.insert(points.end(), recording.points.begin(), recording.points.end());
    least = std::min(least, recording.load_resistance);
    most = std::max(most, recording.load_resistance);
    gain_sigma = std::max(gain_sigma, recording.current_gain_sigma);
  }
  const bool fit_gain = most > 1.2 * least;
  const std::size_t n = fit_gain ? 3 : 2;
  if (points.size() <= n) {
    throw BadInput(std::to_string(points.size()) + " levels of the reference voltage: expected " +
                   std::to_string(n + 1) + " or more");
  }
  LeastSquares problem;
  problem.residual_count = points.size();
  problem.parameters = {{0.1, 0.1, -10.0, 10.0}, {0.0, 0.1, -10.0, 10.0}, {0.0, 0.01, -0.9, 10.0}};
  problem.parameters.resize(n);
  problem.evaluate = [&](const double* p, double* r, double* j) {
    const double gain = 1.0 + (fit_gain ? p[2] : 0.0);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double ideal = points[i].reference - p[0] * points[i].current;
      r[i] = gain * ideal + p[1] - points[i].voltage;
      if (!j) continue;
      j[i * n] = -gain * points[i].current;
      j[i * n + 1] = 1.0;
      if (fit_gain) j[i * n + 2] = ideal;
    }
  };
  const Fit fit = solve(problem);
  SeriesResistanceFit result;
  result.resistance = widened(fit.estimate(0), gain_sigma * fit.values[0]);
  result.offset = fit.estimate(1);
  if (fit_gain) result.gain = fit.estimate(2);
  if (fit.at_bound || !(fit.values[0] > 0.0)) {
    throw BadInput(recordings.front().name + ": oscilloscope/current: R_ECU would be " +
                   significant(fit.values[0], 3) +
                   " ohm: expected a positive number within the bounds of the fit; check the signs "
                   "and units of oscilloscope/current and oscilloscope/voltage");
  }
  return result;
}

double series_resistance_error(const SeriesResistanceFit& fit,
                               const std::vector<LoadRecording>& recordings) {
  double squares = 0.0;
  std::size_t count = 0;
  for (const LoadRecording& recording : recordings) {
    for (const LoadPoint& point : recording.points) {
      const double error = fit.predicted_voltage(point) - point.voltage;
      squares += error * error;
      ++count;
    }
  }
  return std::sqrt(squares / static_cast<double>(count));
}

}  // namespace identification
}  // namespace anthrob
