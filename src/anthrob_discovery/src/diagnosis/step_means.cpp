#include "diagnosis/step_means.h"

#include <algorithm>
#include <cmath>

namespace anthrob {
namespace discovery {

namespace {

Steps between(const std::vector<double>& x, const std::vector<double>& edges) {
  Steps steps;
  steps.count = edges.size() + 1;
  for (const double value : x) {
    const auto above = std::upper_bound(edges.begin(), edges.end(), value);
    steps.of.push_back(static_cast<std::size_t>(above - edges.begin()));
  }
  return steps;
}

Predicted predicted(const ChannelResidual& residual, const Steps& steps, double fewest,
                    const Steps* wider, bool odd) {
  const StepMeans means = means_of(residual, steps, !odd, fewest);
  const StepMeans wide = wider ? means_of(residual, *wider, !odd, fewest) : StepMeans{};
  const StepMeans all =
      means_of(residual, {std::vector<std::size_t>(residual.y.size(), 0), 1}, !odd, fewest);
  double by_constant = 0.0, by_steps = 0.0, whole = 0.0;
  for (std::size_t i = 0; i < residual.y.size(); ++i) {
    if (residual.is_odd(i) != odd) continue;
    const double y = residual.y[i], off = y - all.mean[0];
    const std::size_t step = steps.of[i];
    const double e = y - (means.has(step) || !wider ? means.mean[step] : wide.mean[wider->of[i]]);
    by_constant += off * off;
    by_steps += e * e;
    whole += y * y;
  }
  if (!(whole > 0.0)) return {};
  // A constant that predicts worse than none is none.
  by_constant = std::min(by_constant, whole);
  return {1.0 - by_constant / whole, (by_constant - by_steps) / whole};
}

/// From what the bins of each block deviate together (cluster-robust).
void add_errors(const ChannelResidual& residual, const Steps& steps, bool odd, StepMeans& means) {
  const std::size_t count = residual.y.size();
  std::vector<double> squares(steps.count, 0.0), blocks = squares, together = squares;
  std::vector<char> touched(steps.count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    if (residual.is_odd(i) != odd) continue;
    together[steps.of[i]] += residual.y[i] - means.mean[steps.of[i]];
    touched[steps.of[i]] = 1;
    if (i + 1 < count && residual.block[i + 1] == residual.block[i]) continue;
    for (std::size_t k = 0; k < steps.count; ++k) {
      if (!touched[k]) continue;
      squares[k] += together[k] * together[k];
      blocks[k] += 1.0;
      together[k] = 0.0;
      touched[k] = 0;
    }
  }
  for (std::size_t k = 0; k < steps.count; ++k) {
    if (!means.has(k)) continue;
    // Of a single block nothing is known.
    means.error[k] = blocks[k] < 2.0
                         ? std::abs(means.mean[k])
                         : std::sqrt(squares[k] * blocks[k] / (blocks[k] - 1.0)) / means.count[k];
  }
}

}  // namespace

Steps equal_steps(const std::vector<double>& x, std::size_t most) {
  std::vector<double> sorted = x, edges;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t k = 1; k < most && !sorted.empty(); ++k) {
    const double edge = sorted[k * sorted.size() / most];
    if (edges.empty() || edge > edges.back()) edges.push_back(edge);
  }
  return between(x, edges);
}

Steps sign_steps(const std::vector<double>& x, double still) {
  return between(x, {-still, still});
}

Steps crossed(const Steps& one, const Steps& other) {
  Steps cells;
  cells.count = one.count * other.count;
  for (std::size_t i = 0; i < one.of.size(); ++i) {
    cells.of.push_back(one.of[i] * other.count + other.of[i]);
  }
  return cells;
}

bool StepMeans::has(std::size_t step) const {
  return count[step] >= fewest;
}

StepMeans means_of(const ChannelResidual& residual, const Steps& steps, bool odd, double fewest) {
  StepMeans means;
  means.fewest = fewest;
  means.count.assign(steps.count, 0.0);
  means.mean = means.error = means.count;
  for (std::size_t i = 0; i < residual.y.size(); ++i) {
    if (residual.is_odd(i) != odd) continue;
    means.mean[steps.of[i]] += residual.y[i];
    means.count[steps.of[i]] += 1.0;
  }
  for (std::size_t k = 0; k < steps.count; ++k) {
    means.mean[k] = means.has(k) ? means.mean[k] / means.count[k] : 0.0;
  }
  add_errors(residual, steps, odd, means);
  return means;
}

std::vector<double> centres_of(const std::vector<double>& x, const ChannelResidual& residual,
                               const Steps& steps, bool odd, double fewest) {
  return means_of({x, residual.block}, steps, odd, fewest).mean;
}

Predicted predicted(const ChannelResidual& residual, const Steps& steps, double fewest,
                    const Steps* wider) {
  const Predicted odd = predicted(residual, steps, fewest, wider, true),
                  even = predicted(residual, steps, fewest, wider, false);
  return {0.5 * (odd.constant + even.constant), 0.5 * (odd.steps + even.steps)};
}

}  // namespace discovery
}  // namespace anthrob
