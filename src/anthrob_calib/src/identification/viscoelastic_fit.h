#pragma once

#include <optional>
#include <string>
#include <vector>

#include "identification/estimate.h"
#include "identification/ring_force.h"
#include "identification/ring_recording.h"

namespace anthrob {
namespace identification {

/// Stage 1: the parameters of one strain.
struct LevelFit {
  double strain = 0.0;
  bool used = true;  ///< in stage 2
  std::vector<Estimate> parameters;
  double r_squared = 0.0;
};

/// Both stages of section 7.2.3.
struct ViscoelasticFit {
  std::vector<LevelFit> levels;
  /// Mean and deviation of stage 1 over the strains used, as Tables C.4 and C.5 list them.
  std::vector<Spread> over_levels;
  /// Stage 2: one set for all strains used. The thesis takes the mean; here all samples are fitted
  /// at once, together with the zero of the expansion, which otherwise bends E_0 over the strain.
  std::vector<Estimate> parameters;
  std::optional<Estimate> zero;  ///< [m]; one strain alone does not tell it

  ViscoelasticModel model() const;
  double zero_or_none() const { return zero ? zero->value : 0.0; }
  /// Whether no modulus or time of an arm may as well be nothing.
  bool shows_its_arms() const;
};

/// @param arms 1 or 2
/// @throws BadInput if no test lies above kEllipseStrain
/// @throws std::runtime_error naming the recording if a fit fails
ViscoelasticFit fit_viscoelastic(const RingRecording& recording, std::size_t arms);

}  // namespace identification
}  // namespace anthrob
