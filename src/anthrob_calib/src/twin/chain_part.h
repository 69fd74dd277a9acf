#pragma once

#include <string>
#include <vector>

#include "twin/channels.h"

namespace anthrob {
namespace twin {

/// Parts of the chain from command to motion.
enum class Part { kController, kMotor, kJoint, kSpring };

/// "spring or tendon"
const char* words(Part part);

/// A muscle or joint at which model and robot part.
struct Finding {
  std::string owner;
  Part part = Part::kSpring;
  double gap = 0.0;  ///< the largest that says so [floors]
};

/// Names the part of the chain: that with which a gap begins if the twins are fed with less and
/// less of what was measured.
///   force of a muscle by postures                 -> spring or tendon
///   position of a joint by positions, no spring   -> joint or load
///   position or current of a motor by voltages,
///     and its force is right by positions         -> motor or gear
///   position or current of a motor by commands,
///     and neither of the above                    -> controller
/// @param gap by channel and feed, [floors]; NaN: not told, which is no gap
/// @param warn [floors] from which on it is a gap
/// @return at most one for each muscle and joint, in the order of the channels
std::vector<Finding> judge(const std::vector<Channel>& channels, const std::vector<double>& gap,
                           double warn);

}  // namespace twin
}  // namespace anthrob
