#include "anthrob_calib/discovery/location/dependence.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "anthrob_calib/discovery/experiment/measured_variable.h"
#include "anthrob_calib/discovery/judgement/judge.h"

namespace anthrob {
namespace discovery {

namespace {

constexpr std::size_t kSteps = 9;  ///< of a curve
constexpr double kFew = 2.0;       ///< fewest samples of a mean
constexpr double kStill = 0.02;    ///< [largest speed] below it, the sign of a speed means nothing

/// One sample: a bin of the channel.
struct Sample {
  double x, y;
  bool odd;  ///< block of time
};

/// Means of y over steps of x with equal numbers of samples.
struct Steps {
  std::vector<double> edges;                       ///< upper ones, but the last
  std::vector<double> count, mean, error, centre;  ///< where there are a few samples at least

  std::size_t of(double x) const {
    return static_cast<std::size_t>(std::upper_bound(edges.begin(), edges.end(), x) -
                                    edges.begin());
  }

  /// Of values of the steps, those of steps with enough samples.
  std::vector<double> filled(const std::vector<double>& values) const {
    std::vector<double> some;
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (count[k] >= kFew) some.push_back(values[k]);
    }
    return some;
  }
};

Steps steps_of(const std::vector<Sample>& samples, bool sign, double largest) {
  Steps steps;
  if (sign) {
    steps.edges = {-kStill * largest, kStill * largest};
  } else {
    std::vector<double> x;
    for (const Sample& s : samples) x.push_back(s.x);
    std::sort(x.begin(), x.end());
    for (std::size_t k = 1; k < kSteps; ++k) {
      const double edge = x[k * x.size() / kSteps];
      if (steps.edges.empty() || edge > steps.edges.back()) steps.edges.push_back(edge);
    }
  }
  return steps;
}

void fill(Steps& steps, const std::vector<Sample>& samples, bool odd) {
  const std::size_t n = steps.edges.size() + 1;
  std::vector<double> sum(n, 0.0), square(n, 0.0), x(n, 0.0);
  std::vector<double>& count = steps.count;
  count.assign(n, 0.0);
  for (const Sample& s : samples) {
    if (s.odd != odd) continue;
    const std::size_t k = steps.of(s.x);
    sum[k] += s.y;
    square[k] += s.y * s.y;
    x[k] += s.x;
    count[k] += 1.0;
  }
  steps.mean.assign(n, 0.0);
  steps.error.assign(n, 0.0);
  steps.centre.assign(n, 0.0);
  for (std::size_t k = 0; k < n; ++k) {
    if (count[k] < kFew) continue;
    steps.mean[k] = sum[k] / count[k];
    steps.centre[k] = x[k] / count[k];
    steps.error[k] =
        std::sqrt(std::max(0.0, square[k] / count[k] - steps.mean[k] * steps.mean[k]) / count[k]);
  }
}

/// Shares of the squares of one half that are predicted by the other.
struct Shares {
  double constant = 0.0;  ///< by its mean
  double curve = 0.0;     ///< by the curve, beyond that
};

Shares predicted(const Steps& steps, const std::vector<Sample>& samples, bool odd) {
  double sum = 0.0, count = 0.0;
  for (const Sample& s : samples) {
    if (s.odd != odd) sum += s.y, count += 1.0;
  }
  const double mean = count > 0.0 ? sum / count : 0.0;
  double by_mean = 0.0, by_curve = 0.0, whole = 0.0;
  for (const Sample& s : samples) {
    if (s.odd != odd) continue;
    const double m = s.y - mean, e = s.y - steps.mean[steps.of(s.x)];
    by_mean += m * m;
    by_curve += e * e;
    whole += s.y * s.y;
  }
  if (!(whole > 0.0)) return {};
  return {1.0 - by_mean / whole, (by_mean - by_curve) / whole};
}

std::vector<Sample> samples_of(const Experiments& experiments, const Channel& channel,
                               const MeasuredVariable& variable, const Eigen::VectorXf& residual,
                               const Eigen::VectorXf& whitener) {
  std::vector<Sample> samples;
  std::size_t offset = 0;
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    const Experiment& experiment = *experiments[e];
    const Channel* c = find_channel(experiment, channel);
    for (std::size_t b = 0; c && b < c->count; ++b) {
      const auto i = static_cast<Eigen::Index>(offset + c->offset + b);
      if (!(whitener[i] > 0.0f)) continue;
      const bool odd =
          (static_cast<std::size_t>(experiment.bin_time(b) / Judge::kBlock) + e) % 2 == 1;
      samples.push_back({variable.values[e][b], double(residual[i] / whitener[i]), odd});
    }
    offset += experiment.size();
  }
  return samples;
}

}  // namespace

std::vector<Dependence> find_dependences(const Experiments& experiments,
                                         const std::vector<MeasuredVariable>& variables,
                                         const Eigen::VectorXf& residual,
                                         const Eigen::VectorXf& whitener) {
  std::vector<Dependence> found;
  for (const Channel& channel : channels_of(experiments)) {
    Dependence best;
    best.channel = channel.name();
    best.unit = channel.unit;
    if (channel.quantity == "orientation") {
      best.channel += std::string("/") + static_cast<char>('x' + channel.component);
    }
    for (const MeasuredVariable& variable : variables) {
      // Quantities of other muscles explain a muscle too easily by chance; joints move all muscles.
      const bool own = variable.owner() == channel.place || variable.name == "time";
      const bool muscle =
          variable.word == "load" || variable.word == "current" || variable.word == "wrap angle";
      if (!own && muscle) continue;
      const auto samples = samples_of(experiments, channel, variable, residual, whitener);
      if (samples.size() < 10 * kSteps) continue;
      double largest = 0.0;
      for (const Sample& s : samples) largest = std::max(largest, std::abs(s.x));
      Steps steps = steps_of(samples, variable.sign, largest);
      fill(steps, samples, false);
      const Shares odd = predicted(steps, samples, true);
      fill(steps, samples, true);
      const Shares even = predicted(steps, samples, false);
      if (variable.name == "time") best.constant = 0.5 * (odd.constant + even.constant);
      const double share = 0.5 * (odd.curve + even.curve);
      if (share > best.share + 0.02) {
        best.share = share;
        best.variable = variable.name;
        best.variable_unit = variable.unit;
        best.word = variable.word;
        best.at = steps.filled(steps.centre);
        best.curve = steps.filled(steps.mean);
        best.error = steps.filled(steps.error);
      }
    }
    found.push_back(std::move(best));
  }
  return found;
}

}  // namespace discovery
}  // namespace anthrob
