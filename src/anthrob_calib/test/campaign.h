#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "identification/estimate.h"

namespace anthrob {

/// Seeds of a recovery test: a few as a rule, as many as ANTHROB_SEEDS says in a campaign.
inline int seed_count(int usual) {
  const char* text = std::getenv("ANTHROB_SEEDS");
  return text ? std::atoi(text) : usual;
}

/// What became of one parameter over many seeds, against the known value.
struct Recovery {
  std::string name;
  double truth = 0.0, allowed = 0.0;
  int count = 0, covered = 0;
  double squares = 0.0, worst = 0.0;
  double scores = 0.0;  ///< squares of errors in standard errors
  double reach = 0.0;   ///< of the intervals to either side, summed

  void add(const identification::Estimate& estimate) {
    const double error = estimate.value - truth;
    ++count;
    covered += estimate.lo <= truth && truth <= estimate.hi ? 1 : 0;
    squares += error * error;
    scores += error * error / (estimate.sigma * estimate.sigma);
    reach += 0.5 * (estimate.hi - estimate.lo);
    // NaN stays: it would pass for small.
    if (std::abs(error) > worst || std::isnan(error)) worst = std::abs(error);
  }
  double rms() const { return std::sqrt(squares / count); }
  /// Errors over those that were claimed: 1 where claims are honest, little where they are
  /// cautious.
  double score() const { return std::sqrt(scores / count); }
  double mean_reach() const { return reach / count; }
  /// A row of the table in studies/measurements.md.
  void print() const {
    std::printf("| %s | %.6g | %.3g | %.2g | %.2g | %d/%d |\n", name.c_str(), truth, allowed, rms(),
                worst, covered, count);
  }
};

}  // namespace anthrob
