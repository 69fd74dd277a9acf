#pragma once

#include <Eigen/Core>
#include <vector>

#include "anthrob_calib/discovery/candidate.h"
#include "anthrob_calib/discovery/model_fit.h"

namespace anthrob {
namespace discovery {

/// What the data say about a candidate before it is fitted.
struct Score {
  std::size_t candidate = 0;
  double gain = 0.0;           ///< of the log likelihood, ordinary parameters free [nat]
  std::vector<double> amount;  ///< of each size, in doses
  /// Standard deviation of its first size, in doses; infinite if a dose changes nothing.
  double uncertainty = 0.0;
};

/// Every candidate's unit dose, simulated; what ordinary parameters can imitate is taken off.
///
/// A score test (Lagrange multiplier): all candidates are weighed at the fit without them, in
/// linear approximation. Sizes that begin at neutral count in one direction only. A dose is
/// simulated along the first recordings only, as many as make kEnough seconds.
class Screening {
 public:
  static constexpr double kEnough = 20.0;  ///< [s]

  /// Simulates a dose of each size of each candidate on top of a fitted variant.
  Screening(const ModelFit& fit, const Fitted& base, const std::vector<Candidate>& candidates);

  /// In order of falling gain. The base may have moved on since the doses were simulated.
  std::vector<Score> scores(const Fitted& base);
  double duration() const { return total_duration(fit_.experiments()); }  ///< simulated [s]
  /// The same doses again, of some candidates only, on top of another base.
  void renew(const Fitted& base, const std::vector<Score>& best, std::size_t count);

 private:
  struct Column {
    std::size_t candidate;
    const EffectParameter* size;
    double lower, upper;  ///< of the amount, in doses
    bool simulated;
  };

  void simulate(const Fitted& base, const std::vector<std::size_t>& columns);
  void project(const Fitted& base);

  const ModelFit fit_;
  const std::vector<Candidate>& candidates_;
  std::vector<Column> columns_;
  std::vector<std::size_t> first_column_;  ///< by candidate
  Eigen::MatrixXf responses_;
  Eigen::MatrixXd gram_;      ///< of the responses, what ordinary parameters imitate taken off
  Eigen::MatrixXd absorbed_;  ///< A^-1 J' S
  std::vector<Eigen::Index> free_;  ///< unknowns of the base that are not at a bound
};

}  // namespace discovery
}  // namespace anthrob
