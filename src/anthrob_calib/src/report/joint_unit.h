#pragma once

#include "anthrob_sim/skeleton/skeleton_model.h"

namespace anthrob {

/// What a joint's positions are shown in, degrees or millimetres.
struct JointUnit {
  double scale;  ///< from rad or m
  const char* name;
};

inline JointUnit unit_of(const JointModel& joint) {
  if (joint.type == JointType::kPrismatic) return {1000.0, "mm"};
  return {kDegrees, "deg"};
}

}  // namespace anthrob
