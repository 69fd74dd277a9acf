#pragma once

#include <anthrob_msgs/Predict.h>

#include "twin/twins.h"

namespace anthrob {

/// Answers the service `predict`: runs a copy of the model ahead of the robot.
anthrob_msgs::Predict::Response predict(const twin::Twins& twins,
                                        const anthrob_msgs::Predict::Request& request);

}  // namespace anthrob
