#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "identification/viscoelastic_fit.h"

namespace anthrob {
namespace identification {

/// One of the two models, fitted to a ring.
struct RingModelResult {
  std::size_t arms = 1;  ///< 1: Zener, 2: Wiechert
  std::optional<ViscoelasticFit> fit;
  std::string failure;  ///< why there is no fit
  /// Root mean square error [N] by strain: of the run that was fitted, and of the second specimen.
  std::map<double, double> fit_error, validation_error;

  const char* name() const { return arms == 1 ? "zener" : "wiechert"; }
  /// Means over the strains used; nothing if there are none.
  std::optional<double> mean_fit_error() const;
  std::optional<double> mean_validation_error() const;
};

/// Everything about one type of ring.
struct RingResult {
  std::string ring;
  std::vector<RingRecording> recordings;  ///< by specimen and run
  std::size_t fitted = 0;                 ///< of `recordings`: the first specimen's last run
  std::vector<RingModelResult> models;    ///< Zener, Wiechert

  bool has_fit() const;  ///< of any model
  /// The Zener model unless a second arm shows, and errs less: on the second specimen, if there is
  /// one. Null if no model fits.
  const RingModelResult* better() const;
};

/// Sorts recordings by ring, specimen and run, as section 7.2.3 uses them: fits the first
/// specimen's last run, validates on the last runs of all other specimens, with the parameters and
/// the zero as they are.
/// @throws BadInput for two recordings of the same ring, specimen and run
std::vector<RingResult> identify_rings(std::vector<RingRecording> recordings);

}  // namespace identification
}  // namespace anthrob
