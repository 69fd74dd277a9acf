#pragma once

#include <string>
#include <vector>

#include "diagnostics.h"

namespace anthrob {

/// Muscles that belong together in some way.
struct MuscleGroup {
  std::string name;
  std::vector<std::string> muscles;

  bool has(const std::string& muscle) const;
};

/// For each axis those that turn it one way, "elbow +", and their antagonists, "elbow -": with at
/// least a tenth of the axis's largest moment arm.
/// @param arms [m] row by row, one row a muscle, as in a message moment_arms   @return empty if the
/// sizes do not fit
std::vector<MuscleGroup> groups_by_axis(const std::vector<std::string>& muscles,
                                        const std::vector<std::string>& axes,
                                        const std::vector<double>& arms);
/// By the motor unit on which they hang, as far as diagnostics say that.
std::vector<MuscleGroup> groups_by_unit(const Diagnostics& diagnostics, const std::string& robot,
                                        const std::vector<std::string>& muscles, double now);

}  // namespace anthrob
