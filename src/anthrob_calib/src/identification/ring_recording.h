#pragma once

#include <string>
#include <vector>

#include "anthrob_recording/dataset.h"

namespace anthrob {
namespace identification {

/// The rubber ring in a stretcher (Figure 7.3).
struct RingSpecimen {
  std::string ring;               ///< its type: "10x5"
  int number = 1;                 ///< which one of its type
  double rest_length = 0.0;       ///< l_0, inner diameter [m]
  double section_diameter = 0.0;  ///< d [m]
  int strands = 2;

  double area() const;  ///< of all strands [m^2]
};

/// Strains up to this are not used in fits: the ring bends into an ellipse first (7.2).
constexpr double kEllipseStrain = 0.57;

/// One relaxation test: what went before since the ring was last released, then a stretch to a
/// strain that is held. What was held before is thinned out: little happens in it.
struct RelaxationTest {
  double strain = 0.0;            ///< mean while held
  std::vector<double> t;          ///< [s]
  std::vector<double> expansion;  ///< beyond l_0, by the spindle [m]
  std::vector<double> force;      ///< without the sensor's offset [N]
  std::size_t hold = 0;           ///< first sample of the hold
  bool used = true;               ///< strain > kEllipseStrain
};

/// A recording of one test or many: as in section 7.2.3 with recoveries between them, or as a
/// staircase.
struct RingRecording {
  std::string name;
  RingSpecimen specimen;
  int run = 1;
  double period = 0.0;        ///< between samples while stretched [s]
  int force_average = 1;      ///< samples that the force sensor's filter averages
  double scale_sigma = 0.0;   ///< relative standard error of strain and section: radius, calliper
  double force_offset = 0.0;  ///< shown while nothing pulls [N]
  std::vector<RelaxationTest> tests;

  /// Reads columns `ring/position` and `ring/force` and the keys `specimen`, `rig`, `protocol` and
  /// `run` of meta.yaml (docs/calibration.md).
  /// @throws BadInput with one line if it is not such a recording, or a part of it is missing
  static RingRecording read(const Dataset& recording);
};

}  // namespace identification
}  // namespace anthrob
