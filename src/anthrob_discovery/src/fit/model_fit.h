#pragma once

#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "experiment/evaluator.h"
#include "experiment/excerpt.h"
#include "experiment/noise_floor.h"
#include "options/fit.h"

namespace anthrob {
namespace discovery {

/// A number to be found: an ordinary parameter of the model, or one of an effect.
struct Unknown {
  int nuisance = -1;      ///< index among Evaluator::nuisances(), or -1
  int effect = -1;        ///< index among Variant::effects, or -1
  std::string parameter;  ///< name of the parameter of that effect
  double lower = 0.0, upper = 0.0;
  double scale = 1.0;     ///< size of an ordinary change: the unit in which equations are solved
  double finest = 0.0;    ///< lower limit of the scale in polish()
  double expected = 0.0;  ///< before any data were seen
  double spread = 0.0;    ///< standard deviation of that expectation; 0: none
  std::optional<double> neutral;  ///< of a size of an effect: the value at which it does nothing
  std::optional<double> plain;    ///< of a shape of an effect: the value of its simplest form

  double read(const Variant& variant) const;
  void write(double value, Variant& variant) const;
};

/// A variant that cannot be built or simulated.
class NotSimulated : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Of each ordinary parameter along which the residual curvatures smoothly: half its second
/// derivative, in units of the scale. Null or missing if not known.
using Curvatures = std::vector<std::shared_ptr<const Eigen::VectorXf>>;

/// A variant of the model, its free numbers, and how well it fits.
struct Fitted {
  Variant variant;
  std::vector<Unknown> unknowns;
  Eigen::VectorXf residual;     ///< whitened
  Eigen::MatrixXf sensitivity;  ///< of the residual to the unknowns, each in units of its scale:
                                ///< size of residual x unknowns
  double cost = 0.0;            ///< half the sum of squares, expectations included
  Curvatures curvatures;        ///< of the residual, found on the way

  double misfit() const;               ///< half the sum of squares, without expectations
  Eigen::VectorXd scaled() const;      ///< the unknowns' values in units of their scales
  Eigen::VectorXd expected() const;    ///< their expected values, in the same units
  Eigen::VectorXd lower_room() const;  ///< distances to their lower bounds, <= 0, in the same units
  Eigen::VectorXd upper_room() const;  ///< distances to their upper bounds, >= 0
  Eigen::VectorXd precision() const;   ///< 1 / spread^2 in these units; 0 without spread
  /// @param share_of_scale nearer to a bound is at it [scales]
  bool at_bound(std::size_t unknown, double share_of_scale) const;
};

/// Unknowns of the ordinary parameters: within their ranges, expected where the model has them.
std::vector<Unknown> nuisance_unknowns(const Evaluator& evaluator);

/// Least squares in the full simulation: Levenberg-Marquardt with bounds. Sensitivities are
/// simulated once and then updated by the effect of each step (Broyden). Those to effects, which
/// are few and less linear, are simulated once more after the first step.
class ModelFit {
 public:
  /// @param coarse longer step for simulations of which only differences are used, as in changes()
  /// [s]; 0: the usual step
  ModelFit(const Evaluator& evaluator, Experiments experiments, Eigen::VectorXf whitener,
           const FitOptions& options, double coarse = 0.0)
      : evaluator_(evaluator),
        experiments_(std::move(experiments)),
        whitener_(std::move(whitener)),
        options_(options),
        coarse_(coarse) {}

  /// Starts from a variant and its unknowns, and simulates all sensitivities.
  /// @throws NotSimulated
  Fitted start(const Variant& variant, std::vector<Unknown> unknowns) const;
  /// Iterates until nothing is gained any more.
  void improve(Fitted& fitted, int iterations) const;
  /// @param enough stops at a smaller relative reduction of the cost
  /// @param rival the cost of another fit: stops when the iterations left would not reach it, if
  /// each of them gained as much as the last one
  void improve(Fitted& fitted, int iterations, double enough, double rival = HUGE_VAL) const;
  /// Moves to another variant with the same unknowns; sensitivities stay. @return whether it could
  /// be simulated
  bool move(Fitted& fitted, const Variant& variant) const;
  /// How sensitivities are simulated: by a change to one side, good enough for the first steps; by
  /// changes to both sides, because friction that sticks a little earlier or later makes the cost
  /// rugged; or so with the usual step, which avoids the error of the coarse step. Where changes to
  /// both sides have shown a smooth curvature, it is taken off, and one side is enough from then
  /// on, unless what is left is so large that all slopes matter to the last.
  enum class Slopes { kOneSide, kBothSides, kExact, kExactToBothSides };
  /// What earlier rounds of polish() have simulated.
  struct RefreshedJacobian {
    Slopes slopes;
    std::vector<double> at;  ///< where each unknown was then
  };
  /// Simulates sensitivities again, then makes a few more iterations.
  /// @param before of the rounds before this one, if nothing else has happened in between: then
  /// sensitivities to ordinary parameters that have hardly moved since are good enough. Is updated
  void polish(Fitted& fitted, int iterations, Slopes slopes = Slopes::kBothSides,
              std::optional<RefreshedJacobian>* before = nullptr) const;
  /// Simulates the sensitivities to effects again, by exact slopes.
  void renew_effects(Fitted& fitted) const;
  /// The same fit with more unknowns, whose sensitivities are simulated.
  /// @throws NotSimulated
  Fitted extend(const Fitted& fitted, const Variant& variant,
                const std::vector<Unknown>& more) const;

  /// The same on a part of the recordings.
  ModelFit part(const Excerpt& excerpt) const;
  /// The same with every residual multiplied by a factor.
  ModelFit weighted(const Eigen::VectorXf& factor) const;

  Eigen::VectorXf residual(const Variant& variant) const;  ///< empty if it cannot be simulated
  std::vector<Eigen::VectorXf> residuals(const std::vector<Variant>& variants) const;
  /// How the residual changes from one variant, whose residual is given, to others. Simulated with
  /// the coarse step if possible, whose error cancels in the difference. Empty for a variant that
  /// cannot be simulated.
  std::vector<Eigen::VectorXf> changes(const Variant& from, const Eigen::VectorXf& residual,
                                       std::vector<Variant> to) const;
  /// See Evaluator::fit_side_by_side().
  void side_by_side(std::size_t count, const std::function<void(std::size_t)>& work) const {
    evaluator_.fit_side_by_side(count, work);
  }
  const FitOptions& options() const { return options_; }
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

  /// Repeats a step with growing length as long as the cost falls.
  void extend_line(Fitted& fitted, Eigen::VectorXd step) const;

  /// How the residual changes to variants, by the usual step.
  std::vector<Eigen::VectorXf> exact_changes(const Eigen::VectorXf& residual,
                                             const std::vector<Variant>& to) const;
  /// Of the unknowns from that one on, by the usual step of the simulation.
  void simulate_sensitivity(Fitted& fitted, std::size_t from) const;
  /// Of these unknowns.
  void refresh_jacobian(Fitted& fitted, Slopes slopes, const std::vector<std::size_t>& which) const;
  double cost_of(const Fitted& fitted, const Variant& variant,
                 const Eigen::VectorXf& residual) const;

  const Evaluator& evaluator_;
  Experiments experiments_;
  Eigen::VectorXf whitener_;
  FitOptions options_;
  double coarse_;
};

}  // namespace discovery
}  // namespace anthrob
