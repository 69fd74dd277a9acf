#pragma once

#include <vector>

#include "anthrob_recording/series.h"

namespace anthrob {
namespace discovery {

/// How a series goes on between its rows.
enum class BetweenRows { kLinear, kHeld };

/// A first-order filter of a recorded series, y' = (u - y) / tau, exact between rows. It begins at
/// the first value.
class LowPass {
 public:
  /// @param series not empty; must outlive this   @param time_constant tau [s], > 0
  LowPass(const Series& series, double time_constant, BetweenRows between);

  double at(double time) const;
  /// Of the output, for rows with independent noise of variance 1.
  double variance() const;

 private:
  double advanced(std::size_t row, double seconds) const;

  const Series& series_;
  double time_constant_;
  BetweenRows between_;
  std::vector<double> outputs_;  ///< at the rows
};

}  // namespace discovery
}  // namespace anthrob
