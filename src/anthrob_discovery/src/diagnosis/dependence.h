#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiment/measured_variable.h"
#include "experiment/noise_floor.h"
#include "options/diagnosis.h"

namespace anthrob {
namespace discovery {

/// What the residual of one channel depends on: the measured quantity that predicts it best, and
/// the curve; and a second quantity with which that curve changes, if there is one.
struct Dependence {
  /// Residual over a variable.
  struct Curve {
    std::vector<double> at;           ///< [unit of the variable]
    std::vector<double> mean, error;  ///< residual and its standard error [unit of the channel]
  };

  /// The curve at one value of the second quantity.
  struct Branch : Curve {
    double second = 0.0;  ///< mean of the second quantity [its unit]; of a sign -1, 0 (still) or 1
  };

  struct Second {
    std::string variable, unit, word;  ///< as of the first
    double share = 0.0;                ///< that both predict together
    std::vector<Branch> branches;      ///< from low to high values of the second quantity
  };

  std::string channel;   ///< "<place>/<quantity>", components of an orientation named x, y, z
  std::string variable;  ///< "biceps_brachii/force"; empty if nothing predicts it
  std::string unit, variable_unit;  ///< of both; empty: not known
  std::string word;                 ///< "sign of velocity", "load", "posture", "time", ...
  /// Share of the squared residual that the curve predicts in blocks to which it was not fitted, in
  /// addition to what a constant predicts.
  double share = 0.0;
  double constant = 0.0;  ///< share of the squared residual that a constant predicts there
  Curve curve;
  std::optional<Second> second;

  /// Share that is predicted in addition to a constant, by the second quantity, too.
  double predicted() const { return second ? second->share : share; }
  /// "sign of velocity of elbow/position and load of biceps_brachii/force"; "time"
  std::string on_what() const;
};

/// Tries every measured quantity of the same place, every joint, and time, with a curve of a few
/// steps fitted on one half of the blocks and judged on the other. Where a quantity predicts
/// something, the others are tried as a second one, whose low, middle and high values have curves
/// of their own.
/// @param residual in units of sigma, as whitened by `whitener`   @param block of time [s]
std::vector<Dependence> find_dependences(const Experiments& experiments,
                                         const std::vector<MeasuredVariable>& variables,
                                         const Eigen::VectorXf& residual,
                                         const Eigen::VectorXf& whitener,
                                         const DependenceOptions& options, double block);

}  // namespace discovery
}  // namespace anthrob
