#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <vector>

#include "experiment/excerpt.h"
#include "fit/candidate.h"
#include "fit/model_fit.h"
#include "judgement/judge.h"
#include "options/hypotheses.h"

namespace anthrob {
namespace discovery {

/// Score of a candidate before it is fitted.
struct Score {
  std::size_t candidate = 0;
  double gain = 0.0;           ///< in log likelihood, with free ordinary parameters [nat]
  std::vector<double> amount;  ///< suggested size of each size parameter, in doses
  /// Standard deviation of its most visible size parameter [doses], with free ordinary parameters,
  /// and the index of that parameter. Infinite if ordinary parameters can imitate all that a dose
  /// changes.
  double uncertainty = 0.0;
  std::size_t size = 0;
  double seconds = 0.0;  ///< length of the recordings that were used; `gain` is scaled to the
                         ///< shortest such length
};

/// Simulates a unit dose of every candidate and removes what ordinary parameters can imitate.
///
/// This is a score test (Lagrange multiplier): all candidates are compared at the fit without them,
/// in linear approximation. Sizes whose range begins at neutral count in one direction only. A dose
/// is simulated along the first seconds of the recordings; one of a slow effect, or one that
/// changes nothing there, along a longer part.
class Screening {
 public:
  /// Simulates a dose of each size of each candidate on top of a fitted variant.
  /// @param quick, slow the parts of the recordings of `fit` that are simulated
  Screening(const ModelFit& fit, const Fitted& base, const std::vector<Candidate>& candidates,
            const Excerpt& quick, const Excerpt& slow, const ScreeningOptions& options);

  /// Scores of all candidates, largest gain first. `base` may differ from the one for which the
  /// doses were simulated.
  std::vector<Score> scores(const Fitted& base) const;
  /// Simulates the doses of the first `count` candidates of `best` again, on top of another base.
  void renew(const Fitted& base, const std::vector<Score>& best, std::size_t count);
  /// How many doses of each score's most visible size are needed until some channel reaches its
  /// level [floors] although ordinary parameters are fitted again.
  /// @param judge of the recordings of the fit
  std::vector<double> doses_to_a_gap(const Fitted& base, const std::vector<Score>& scores,
                                     const Judge& judge,
                                     const std::map<std::string, double>& levels) const;
  /// Groups of candidates whose responses, without what ordinary parameters can imitate, are nearly
  /// proportional: nothing in these recordings tells them apart.
  std::vector<std::vector<std::size_t>> alike(const Fitted& base) const;

 private:
  /// A dose of one size of one candidate.
  struct Column {
    const EffectParameter* size;
    double lower, upper;  ///< of the amount, in doses
    bool simulated;
  };
  /// Candidates that are simulated along one excerpt.
  struct Look {
    ModelFit fit;
    const Excerpt& excerpt;
    std::vector<std::size_t> candidates;
    std::vector<char> moved;                ///< looked at elsewhere
    std::vector<std::size_t> first_column;  ///< of each, and the number of columns
    std::vector<Column> columns;
    Eigen::MatrixXf responses;

    /// Where a candidate is among them; nothing if it is not looked at here.
    std::optional<std::size_t> index_of(std::size_t candidate) const;
  };

  void add_look(const ModelFit& fit, const Fitted& base, const Excerpt& excerpt,
                std::vector<std::size_t> candidates);
  /// Takes away those that hardly change anything.
  std::vector<std::size_t> take_faint(Look& look) const;
  void simulate(Look& look, const Fitted& base, const std::vector<std::size_t>& which);
  /// Where ordinary parameters imitate most of a dose, what they leave may be no more than what is
  /// not linear in it: such doses are simulated to the other side, too.
  void take_both_sides(Look& look, const Fitted& base, const std::vector<std::size_t>& which);
  /// What some ordinary parameters can imitate of a look's responses S.
  struct Projection {
    Eigen::MatrixXf J;
    Eigen::MatrixXd covariance;    ///< (J'J + P)^-1
    Eigen::MatrixXd JS, absorbed;  ///< J' S and (J'J + P)^-1 J' S
    Eigen::VectorXd gradient;      ///< of the cost to the amounts
    Eigen::VectorXd precision;     ///< diagonal of P

    /// Square of what is left of a response, S - J absorbed.
    /// @param whole its own square
    double left(Eigen::Index response, double whole) const;

    /// Imitates one response without one of the parameters. Leaves the gradient.
    void hold(Eigen::Index unknown, Eigen::Index response);
  };
  /// @param share of what the parameters are expected to be that counts
  Projection project(const Look& look, const Fitted& base,
                     const std::vector<Eigen::Index>& unknowns, double share) const;
  /// Of a look in all that was recorded: there expectations count the less, the more there is.
  static double share_of_whole(const Look& look, const Fitted& base);
  /// By all of them, also those at a bound: it may be the imitation of an effect that took them
  /// there. But a candidate that is the same quantity as one of them (at most one) without that. As
  /// far as they can in all that was recorded, of which the look is a part.
  Projection project_whole(const Look& look, const Fitted& base) const;
  void score(const Look& look, const Fitted& base, std::vector<Score>& scores) const;

  const std::vector<Candidate>& candidates_;
  ScreeningOptions options_;
  std::vector<Look> looks_;
};

}  // namespace discovery
}  // namespace anthrob
