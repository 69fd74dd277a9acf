#pragma once

#include <string>

namespace anthrob {

// Quantities that a recording may contain of a muscle, a ball joint, and any other joint.
bool is_muscle_quantity(const std::string& quantity);
bool is_ball_quantity(const std::string& quantity);
bool is_joint_quantity(const std::string& quantity);

}  // namespace anthrob
