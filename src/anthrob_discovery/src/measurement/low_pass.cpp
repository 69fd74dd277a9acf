#include "measurement/low_pass.h"

#include <algorithm>
#include <cmath>

namespace anthrob {
namespace discovery {

LowPass::LowPass(const Series& series, double time_constant, BetweenRows between)
    : series_(series), time_constant_(time_constant), between_(between) {
  outputs_.push_back(series.values.front());
  for (std::size_t i = 1; i < series.t.size(); ++i) {
    outputs_.push_back(advanced(i - 1, series.t[i] - series.t[i - 1]));
  }
}

double LowPass::advanced(std::size_t row, double seconds) const {
  const double u = series_.values[row];
  const bool goes_on = between_ == BetweenRows::kLinear && row + 1 < series_.t.size();
  const double rise =
      goes_on ? (series_.values[row + 1] - u) / std::max(1e-9, series_.t[row + 1] - series_.t[row])
              : 0.0;
  // Of a ramp the filter ends up tau behind.
  const double behind = rise * time_constant_;
  return u + rise * seconds - behind +
         (outputs_[row] - u + behind) * std::exp(-seconds / time_constant_);
}

double LowPass::at(double time) const {
  const auto next = std::upper_bound(series_.t.begin(), series_.t.end(), time + 1e-9);
  if (next == series_.t.begin()) return outputs_.front();
  const auto row = static_cast<std::size_t>(next - series_.t.begin()) - 1;
  return advanced(row, std::max(0.0, time - series_.t[row]));
}

double LowPass::variance() const {
  if (series_.t.size() < 2) return 1.0;
  const double period =
      (series_.t.back() - series_.t.front()) / static_cast<double>(series_.t.size() - 1);
  const double kept = std::exp(-period / time_constant_);
  return (1.0 - kept) / (1.0 + kept);
}

}  // namespace discovery
}  // namespace anthrob
