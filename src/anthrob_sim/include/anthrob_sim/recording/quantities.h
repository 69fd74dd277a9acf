#pragma once

#include <string>

namespace anthrob {

// What a recording may tell of a muscle, of a ball joint, of another joint.
bool is_muscle_quantity(const std::string& quantity);
bool is_ball_quantity(const std::string& quantity);
bool is_joint_quantity(const std::string& quantity);

}  // namespace anthrob
