#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "measurement/controlled_muscles.h"

namespace anthrob {
namespace discovery {

/// What of a control law differs from the model's, apart from its gains.
enum class LawForm {
  kModel,                      ///< only gains
  kDerivativeOnError,          ///< K_D (reference rate - velocity)
  kFilteredDerivative,         ///< of the velocity, by a first-order filter
  kFilteredDerivativeOnError,  ///< of both
  kFilteredVoltage,            ///< all of it, by a first-order filter
};

/// A number with its standard error.
struct LawNumber {
  double value = 0.0, sigma = 0.0;
};

/// The numbers of a law for one muscle.
struct MuscleLaw {
  enum Number { kProportional, kDerivative, kForce, kOffset };
  std::string name;
  std::array<double, 4> model;       ///< [V/rad, Vs/rad, V/N, V]
  std::array<LawNumber, 4> found;    ///< the same
  std::array<double, 4> voltages{};  ///< rms of a number's term, in noise of the voltages, by unit
  bool is_determined = false;        ///< else `found` is the model's

  /// Whether a number is certainly another, and the voltages show it.
  bool differs(std::size_t number, const ControllerAlgebraOptions& options) const;
  /// What was found where that is certainly another number, else the model's.
  double used(std::size_t number, const ControllerAlgebraOptions& options) const {
    return differs(number, options) ? found[number].value : model[number];
  }
};

/// A law that gives recorded voltages from recorded references and measurements:
///   V(t) = K_P (r - position) + K_D d + K_f force + offset
/// at t - tick, or at t if voltages are logged after the tick, where d is as LawForm says and any
/// filter is y' = (u - y) / tau.
struct ControlLaw {
  LawForm form = LawForm::kModel;
  LawNumber time_constant;  ///< tau [s]; 0: no filter
  double tick = 0.0;        ///< of the controllers [s]
  bool after_tick = false;
  std::vector<MuscleLaw> muscles;
  Squares squares;
};

/// The simplest law of least squares, where noise of the measurements is known and so makes no gain
/// smaller. Time constants are searched on a grid, numbers follow from normal equations by blocks,
/// errors from the jackknife over blocks.
/// @return nothing if only the model's own law is left, or none
std::optional<ControlLaw> find_control_law(const ControlledMuscles& data);

}  // namespace discovery
}  // namespace anthrob
