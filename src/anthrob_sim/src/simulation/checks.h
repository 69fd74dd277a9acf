#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "anthrob_sim/simulation.h"

namespace anthrob {

// Called in every step: text is made of the names only where there is something to say.

inline bool is_sensible(double value) {
  return std::abs(value) < Simulation::kSensible;  // false if it is not a number
}

void expect_finite(double value, const char* kind, const std::string& name, const char* what);

void expect_sensible(double value, const char* kind, const std::string& name, const char* what);

/// A Hill muscle can pull its tendon in only so far; recorded positions have noise.
void expect_reachable(double position, const char* kind, const MuscleModel& muscle,
                      const char* what);

/// @throws BadInput unless `q` can be a posture of the skeleton
void expect_posture(const std::vector<double>& q, const SkeletonModel& skeleton);

/// @throws BadInput unless 0 <= index < count   @param kind "muscle"
void expect_index(int index, std::size_t count, const char* kind);

}  // namespace anthrob
