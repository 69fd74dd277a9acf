#include "experiment/measured_variable.h"

#include <algorithm>
#include <map>

#include "anthrob_recording/orientation_series.h"

namespace anthrob {
namespace discovery {

namespace {

std::vector<double> at_bins(const Experiment& experiment, const Series& series) {
  std::vector<double> values;
  const std::size_t bins = experiment.channels().front().count;
  for (std::size_t b = 0; b < bins; ++b) values.push_back(series.at(experiment.bin_time(b)));
  return values;
}

/// A column of a recording. A quaternion and its negative are the same orientation: taken is the
/// one that begins with w >= 0, without sudden changes of sign.
Series series_of(const Dataset& recording, const Column& column) {
  const std::string quantity = column.quantity();
  const std::size_t k = std::string("wxyz").find(quantity);
  if (quantity.size() != 1 || k == std::string::npos) return recording.series(column.name);
  OrientationSeries turns = OrientationSeries::read(
      recording, column.name.substr(0, column.name.size() - quantity.size() - 1));
  if (turns.empty()) return {};
  if (turns.number[0].values.front() < 0.0) {
    for (double& value : turns.number[k].values) value = -value;
  }
  return turns.number[k];
}

/// That of the channel of the same name: what is no channel has none here.
std::string unit_of(const std::string& column, const Experiments& experiments) {
  for (const Channel& channel : channels_of(experiments)) {
    if (channel.column() == column) return channel.unit;
  }
  return "";
}

std::vector<double> rate_of(const std::vector<double>& values, double bin, std::size_t reach) {
  std::vector<double> rate(values.size(), 0.0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t a = i < reach ? 0 : i - reach;
    const std::size_t b = std::min(values.size() - 1, i + reach);
    if (b > a) rate[i] = (values[b] - values[a]) / (bin * static_cast<double>(b - a));
  }
  return rate;
}

/// Of a joint in poses: the direction from which it came, as there is no rate.
std::vector<double> directions_of(const Experiment& experiment, const Dataset& recording,
                                  const std::string& joint) {
  const Series series = recording.series(joint + "/direction");
  if (!series.empty()) return at_bins(experiment, series);
  return std::vector<double>(experiment.channels().front().count, 0.0);
}

bool are_of_poses(const std::shared_ptr<const Experiment>& experiment) {
  return experiment->of_poses();
}

MeasuredVariable time_of(const Experiments& experiments) {
  MeasuredVariable time{"time", "time", {}, false, "s"};
  for (const auto& experiment : experiments) {
    std::vector<double> t;
    for (std::size_t b = 0; b < experiment->channels().front().count; ++b) {
      t.push_back(experiment->bin_time(b));
    }
    time.values.push_back(t);
  }
  return time;
}

}  // namespace

std::vector<MeasuredVariable> measured_variables(const Experiments& experiments,
                                                 const std::vector<Dataset>& recordings,
                                                 const ExperimentOptions& options) {
  std::vector<MeasuredVariable> variables;
  const bool any_poses = std::any_of(experiments.begin(), experiments.end(), are_of_poses),
             all_poses = std::all_of(experiments.begin(), experiments.end(), are_of_poses);
  if (!any_poses) variables.push_back(time_of(experiments));
  const std::map<std::string, std::string> words = {
      {"position", "posture"}, {"force", "load"}, {"current", "current"}, {"effort", "load"},
      {"x", "posture"},        {"y", "posture"},  {"z", "posture"}};
  for (const Table& table : recordings.front().tables) {
    for (const Column& column : table.columns) {
      const auto word = words.find(column.quantity());
      if (word == words.end()) continue;
      const std::string unit = unit_of(column.name, experiments);
      MeasuredVariable variable{column.name, word->second, {}, false, unit};
      for (std::size_t e = 0; e < experiments.size(); ++e) {
        const Series series = series_of(recordings[e], column);
        if (series.empty()) break;
        variable.values.push_back(at_bins(*experiments[e], series));
      }
      if (variable.values.size() < experiments.size()) continue;
      if (column.quantity() == "position" || word->second == "posture") {
        const std::string rate_unit = unit.empty() ? "" : unit + "/s";
        MeasuredVariable speed{column.name, "speed", {}, false, rate_unit},
            sign{column.name, "sign of velocity", {}, true, ""};
        for (std::size_t e = 0; e < experiments.size(); ++e) {
          speed.values.push_back(
              experiments[e]->of_poses()
                  ? directions_of(*experiments[e], recordings[e], column.owner())
                  : rate_of(variable.values[e], experiments[e]->bin(), options.rate_reach));
        }
        sign.values = speed.values;
        if (!all_poses) variables.push_back(speed);
        variables.push_back(sign);
      }
      variables.push_back(std::move(variable));
    }
  }
  return variables;
}

}  // namespace discovery
}  // namespace anthrob
