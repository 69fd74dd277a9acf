#pragma once

#include <vector>

#include "anthrob_sim/skeleton/skeleton_model.h"
#include "twin/samples.h"
#include "twin/timeline.h"

namespace anthrob {
namespace twin {

/// A measured motor position between two messages [rad]; NaN: not measured.
double position_at(const Timeline<MuscleSample>& timeline, std::size_t muscle, Nanoseconds time);
/// The same for a joint: its numbers in `q` are set.
void joint_at(const Timeline<JointSample>& timeline, const JointModel& joint, Nanoseconds time,
              std::vector<double>& q);

/// Moves an imposed motor position by one step, from `time` on: by the measured speed, and towards
/// the measured position within `smooth`. A sensor that counts jumps where the motor does not, and
/// friction follows the sign of the motion. Where no speed is measured, as position_at().
/// @return the position at the end of the step
double smooth_position(const Timeline<MuscleSample>& timeline, std::size_t muscle, Nanoseconds time,
                       Nanoseconds step, double smooth, Nanoseconds average, double position);
/// The same for a joint: its numbers in `q` move on.
void smooth_joint(const Timeline<JointSample>& timeline, const JointModel& joint, Nanoseconds time,
                  Nanoseconds step, double smooth, std::vector<double>& q);

}  // namespace twin
}  // namespace anthrob
