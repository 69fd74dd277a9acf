#pragma once

#include <optional>

#include "orbit_view.h"

namespace Ogre {
class SceneNode;
}

namespace rviz {
class DisplayContext;
}

namespace anthrob {

/// What the robot models of RViz and the given node fill of the scene; none while that is not
/// loaded.
/// @param node an Ogre::SceneNode, updated as all nodes are
std::optional<Box> robot_box(rviz::DisplayContext& context, Ogre::SceneNode& node);

/// Moves RViz's camera, if it is one that orbits about a point of the fixed frame.
void fit_camera(rviz::DisplayContext& context, const Box& box);

}  // namespace anthrob
