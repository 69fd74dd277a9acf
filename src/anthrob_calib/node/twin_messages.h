#pragma once

#include <anthrob_msgs/MuscleStates.h>

#include "anthrob_sim/simulation.h"

namespace anthrob {

/// Muscles of a copy of the model.
/// @param imposed whether its motors are moved: what moves them is not their windings
anthrob_msgs::MuscleStates twin_muscle_states(const Simulation& sim, bool imposed,
                                              const ros::Time& stamp);

}  // namespace anthrob
