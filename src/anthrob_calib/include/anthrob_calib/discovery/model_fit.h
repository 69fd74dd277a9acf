#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "anthrob_calib/discovery/evaluator.h"
#include "anthrob_calib/discovery/excerpt.h"
#include "anthrob_calib/discovery/noise_floor.h"

namespace anthrob {
namespace discovery {

/// A number to be found: an ordinary parameter of the model, or one of an effect.
struct Unknown {
  int nuisance = -1;      ///< index among Evaluator::nuisances(), or
  int effect = -1;        ///< index among Variant::effects, and
  std::string parameter;  ///< of that effect
  double lower = 0.0, upper = 0.0;
  double scale = 1.0;             ///< size of an ordinary change: the unit in which it is solved
  double finest = 0.0;            ///< polishing makes the scale no smaller
  double expected = 0.0;          ///< before any data were seen
  double spread = 0.0;            ///< standard deviation of that expectation; 0: none
  std::optional<double> neutral;  ///< of an effect's size: the value that does nothing

  double read(const Variant& variant) const;
  void write(double value, Variant& variant) const;
};

/// A variant that cannot be built or simulated.
class NotSimulated : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A variant, what is free in it, and how it fits.
struct Fitted {
  Variant variant;
  std::vector<Unknown> unknowns;
  Eigen::VectorXf residual;     ///< whitened
  Eigen::MatrixXf sensitivity;  ///< of the residual to the unknowns, each in units of its scale
  double cost = 0.0;            ///< half the sum of squares, expectations included

  Eigen::VectorXd scaled() const;      ///< the unknowns' values in units of their scales
  Eigen::VectorXd expected() const;    ///< the same of what is expected
  Eigen::VectorXd lower_room() const;  ///< to their lower bounds, <= 0, in these units
  Eigen::VectorXd upper_room() const;  ///< to their upper bounds, >= 0
  Eigen::VectorXd precision() const;   ///< of the expectations, in these units
  bool at_bound(std::size_t unknown) const;
};

/// Unknowns of the ordinary parameters: within their ranges, expected where the model has them.
std::vector<Unknown> nuisance_unknowns(const Evaluator& evaluator);

/// Least squares in the full simulation: Levenberg-Marquardt with bounds. Sensitivities are
/// simulated once and then carried along by what each step really did (Broyden); those to effects,
/// which are few and less linear, once more after the first step.
class ModelFit {
 public:
  /// @param coarse step of simulations whose differences only count, as in changes() [s]; 0: as
  /// usual
  ModelFit(const Evaluator& evaluator, Experiments experiments, Eigen::VectorXf whitener,
           double coarse = 0.0)
      : evaluator_(evaluator),
        experiments_(std::move(experiments)),
        whitener_(std::move(whitener)),
        coarse_(coarse) {}

  /// From a variant and its unknowns, all sensitivities simulated.
  /// @throws NotSimulated
  Fitted start(const Variant& variant, std::vector<Unknown> unknowns) const;
  /// Goes on until nothing is gained any more.
  /// @param enough relative gain that is not worth another iteration
  void improve(Fitted& fitted, int iterations, double enough = 3e-3) const;
  /// To another variant with the same unknowns; sensitivities stay. @return whether it can be
  bool move(Fitted& fitted, const Variant& variant) const;
  /// How the slopes of the valley are found: by steps to one side, good for the first steps; to
  /// both sides, as friction that sticks a little earlier or later makes its ground rugged; to both
  /// sides in the simulation as it is, which tells what the coarse step has wrong.
  enum class Slopes { kOneSide, kBothSides, kExact };
  /// All sensitivities simulated anew, then a few more iterations.
  void polish(Fitted& fitted, int iterations, Slopes slopes = Slopes::kBothSides) const;
  /// The same fit with more unknowns; those after the present ones are simulated.
  /// @throws NotSimulated
  Fitted extend(const Fitted& fitted, const Variant& variant,
                const std::vector<Unknown>& more) const;

  /// The same on a part of the recordings.
  ModelFit part(const Excerpt& excerpt) const;
  /// The same with every residual multiplied by a factor.
  ModelFit weighted(const Eigen::VectorXf& factor) const;

  Eigen::VectorXf residual(const Variant& variant) const;  ///< empty if it cannot be simulated
  std::vector<Eigen::VectorXf> residuals(const std::vector<Variant>& variants) const;
  /// How the residual changes from one variant, whose residual is known, to others; with the coarse
  /// step, whose error is in both, where it can be simulated with that. Empty if it cannot at all.
  std::vector<Eigen::VectorXf> changes(const Variant& from, const Eigen::VectorXf& residual,
                                       std::vector<Variant> to) const;
  /// See Evaluator::side_by_side().
  void side_by_side(std::size_t count, const std::function<void(std::size_t)>& work) const {
    evaluator_.side_by_side(count, work);
  }
  const Experiments& experiments() const { return experiments_; }
  const Eigen::VectorXf& whitening() const { return whitener_; }
  double coarse_step() const { return coarse_; }  ///< of changes() [s]; 0: the usual one

 private:
  /// Where a step leads.
  struct Trial {
    Variant variant;
    Eigen::VectorXd step;
    Eigen::VectorXf residual;
    double cost = 0.0;  ///< infinite if it cannot be simulated
  };
  Trial try_step(const Fitted& fitted, const Eigen::VectorXd& step) const;

  /// Goes on in a direction, in ever longer steps, while that leads down.
  void stride(Fitted& fitted, Eigen::VectorXd step) const;

  /// How the residual changes to variants, by the usual step.
  std::vector<Eigen::VectorXf> exact_changes(const Eigen::VectorXf& residual,
                                             const std::vector<Variant>& to) const;
  /// Of the unknowns from that one on, by the usual step of the simulation.
  void simulate_sensitivity(Fitted& fitted, std::size_t from) const;
  /// Of all unknowns.
  void survey(Fitted& fitted, Slopes slopes) const;
  double cost_of(const Fitted& fitted, const Variant& variant,
                 const Eigen::VectorXf& residual) const;

  const Evaluator& evaluator_;
  Experiments experiments_;
  Eigen::VectorXf whitener_;
  double coarse_;
};

/// Adds a little of the largest to the diagonal, so that what nothing depends on has a solution.
void regularise(Eigen::MatrixXd& system);

/// Minimises 1/2 x' A x + g' x within bounds (projected active set).
Eigen::VectorXd bounded_minimum(const Eigen::MatrixXd& A, const Eigen::VectorXd& g,
                                const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);

}  // namespace discovery
}  // namespace anthrob
