#include "experiment/regimes.h"

#include <algorithm>
#include <cmath>

namespace anthrob {
namespace discovery {

namespace {

std::array<std::optional<double>, kLevels> gaps_of(const std::string& place, const Regime& regime,
                                                   const Experiments& experiments,
                                                   const Eigen::VectorXf& residual,
                                                   const Eigen::VectorXf& whitener,
                                                   const Scales& scales) {
  std::array<double, kLevels> square{}, count{};
  std::array<std::optional<double>, kLevels> gap{};
  std::size_t offset = 0;
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    for (const Channel& channel : experiments[e]->channels()) {
      if (channel.place != place) continue;
      const auto scale = scales.find(channel.name());
      const double inflation = scale == scales.end() ? 1.0 : scale->second.inflation;
      for (std::size_t b = 0; b < channel.count; ++b) {
        const auto at = static_cast<Eigen::Index>(offset + channel.offset + b);
        if (!(whitener[at] > 0.0f)) continue;
        const auto level = static_cast<std::size_t>(regime.levels[e][b]);
        square[level] += inflation * std::pow(static_cast<double>(residual[at]), 2);
        count[level] += 1.0;
      }
    }
    offset += experiments[e]->size();
  }
  for (std::size_t k = 0; k < gap.size(); ++k) {
    if (count[k] > 0.0) gap[k] = std::sqrt(square[k] / count[k]);
  }
  return gap;
}

}  // namespace

Regime regime_of(const MeasuredVariable& variable) {
  std::vector<double> sorted;
  for (const auto& values : variable.values) {
    sorted.insert(sorted.end(), values.begin(), values.end());
  }
  std::sort(sorted.begin(), sorted.end());
  const double lower = sorted[sorted.size() / kLevels], upper = sorted[2 * sorted.size() / kLevels];
  Regime regime{variable.word, {}};
  for (const auto& values : variable.values) {
    regime.levels.emplace_back();
    for (const double value : values) {
      regime.levels.back().push_back(value > upper ? 2 : value >= lower ? 1 : 0);
    }
  }
  return regime;
}

std::vector<Regime> regimes_of(const std::string& place,
                               const std::vector<MeasuredVariable>& variables) {
  const MeasuredVariable *speed = nullptr, *load = nullptr, *posture = nullptr;
  for (const MeasuredVariable& variable : variables) {
    if (variable.owner() != place) continue;
    if (!speed && variable.word == "speed") speed = &variable;
    if (!load && variable.word == "load") load = &variable;
    if (!posture && variable.word == "posture") posture = &variable;
  }
  std::vector<Regime> regimes;
  for (const MeasuredVariable* variable : {speed, load ? load : posture}) {
    if (variable) regimes.push_back(regime_of(*variable));
  }
  return regimes;
}

std::vector<RegimeGap> regime_gaps(const Experiments& experiments,
                                   const std::vector<MeasuredVariable>& variables,
                                   const Eigen::VectorXf& residual, const Eigen::VectorXf& whitener,
                                   const Scales& scales) {
  std::vector<std::string> places;
  for (const Channel& channel : channels_of(experiments)) {
    if (std::find(places.begin(), places.end(), channel.place) == places.end()) {
      places.push_back(channel.place);
    }
  }
  std::vector<RegimeGap> rows;
  for (const std::string& place : places) {
    std::vector<Regime> regimes = regimes_of(place, variables);
    for (const MeasuredVariable& variable : variables) {
      const bool wrapping = variable.word == "wrap angle" && variable.owner() == place;
      if (wrapping || variable.word == "time") regimes.push_back(regime_of(variable));
    }
    for (const Regime& regime : regimes) {
      rows.push_back(
          {place, regime.word, gaps_of(place, regime, experiments, residual, whitener, scales)});
    }
  }
  return rows;
}

}  // namespace discovery
}  // namespace anthrob
