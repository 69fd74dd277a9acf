#include "identification/relaxation_response.h"

#include <algorithm>
#include <cmath>

namespace anthrob {
namespace identification {

namespace {

/// h after a step of length dt: keep * h + gain * (change of strain); and what tau does to both.
struct StepMap {
  double keep, gain, keep_slope, gain_slope;

  StepMap(double dt, double tau) {
    const double x = dt / tau;
    keep = std::exp(-x);
    gain = -std::expm1(-x) / x;
    keep_slope = keep * x / tau;
    // The difference of two nearly equal numbers for small x: there its series.
    gain_slope = x > 1e-3 ? (gain - keep) / tau : x * (0.5 - x / 3.0) / tau;
  }
};

}  // namespace

RelaxationResponse relaxation_response(const std::vector<double>& t,
                                       const std::vector<double>& strain, double tau) {
  RelaxationResponse response;
  response.h.assign(t.size(), 0.0);
  response.slope.assign(t.size(), 0.0);
  double known_dt = t.size() > 1 ? t[1] - t[0] : 1.0;
  StepMap map(known_dt, tau);
  for (std::size_t i = 1; i < t.size(); ++i) {
    const double dt = t[i] - t[i - 1];
    // Differences of decimal times scatter by rounding; those do not need a new exponential.
    if (std::abs(dt - known_dt) > 1e-12 * (1.0 + t[i])) {
      known_dt = dt;
      map = StepMap(dt, tau);
    }
    const double change = strain[i] - strain[i - 1];
    response.h[i] = map.keep * response.h[i - 1] + map.gain * change;
    response.slope[i] = map.keep * response.slope[i - 1] + map.keep_slope * response.h[i - 1] +
                        map.gain_slope * change;
  }
  return response;
}

void average_backwards(std::vector<double>& series, std::size_t count) {
  if (count <= 1) return;
  std::vector<double> ring(count, 0.0);
  double sum = 0.0;
  for (std::size_t i = 0; i < series.size(); ++i) {
    double& oldest = ring[i % count];
    sum += series[i] - oldest;
    oldest = series[i];
    series[i] = sum / static_cast<double>(std::min(i + 1, count));
  }
}

}  // namespace identification
}  // namespace anthrob
