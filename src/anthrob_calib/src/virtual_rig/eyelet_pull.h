#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "anthrob_recording/dataset.h"

namespace anthrob {
namespace virtual_rig {

/// The protocol of section 7.2.4, and the deviations of a real rig from its drawing.
struct PullOptions {
  std::uint64_t seed = 1;
  int specimen = 1;    ///< the first eyelet has the known friction, others are of the same batch
  double load = 36.4;  ///< [N]
  bool pulling = true;
  double friction = 0.156;  ///< mu_k of this direction
  double duration = 2.5;    ///< of the motion [s]

  double batch_sigma = 0.03;        ///< relative, of mu_k of eyelets of one type
  double unevenness = 0.01;         ///< of mu_k along the line
  double turning_sigma = 0.0175;    ///< of the angle by which the eyelet turns the line [rad]
  double force_offset_sigma = 0.5;  ///< [N]
};

/// The four weights: the least, the greatest and the example of the thesis, and one more [N].
std::vector<double> thesis_loads();

/// Simulates one recording: stand, pull or relax at constant voltage, stand. Deviations of the rig
/// belong to the seed, those of the eyelet to seed and specimen.
Dataset pull_over_eyelet(const std::string& rig, const PullOptions& options);

}  // namespace virtual_rig
}  // namespace anthrob
