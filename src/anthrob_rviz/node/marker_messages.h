#pragma once

#include <visualization_msgs/InteractiveMarker.h>
#include <visualization_msgs/Marker.h>

#include <string>
#include <vector>

#include "touch/pull_spring.h"
#include "touch/skeleton.h"

namespace anthrob {

std_msgs::ColorRGBA colour_of(double r, double g, double b, double a);
geometry_msgs::Point point_of(const Vec3& vector);
geometry_msgs::Pose message_of(const Pose& pose);
/// What is seen of a link, relative to the link and a little larger: it lies in front of the link
/// itself. A small ball if nothing is.
/// @param growth [m]
std::vector<visualization_msgs::Marker> markers_of(const SkeletonLink& link, double growth,
                                                   const std_msgs::ColorRGBA& colour);
/// A link that the mouse can pull in the plane of the picture.
visualization_msgs::InteractiveMarker pullable(const SkeletonLink& link);
/// Arrow and size of a pull, in the root's frame.
std::vector<visualization_msgs::Marker> arrow_of(const std::string& root, const std::string& link,
                                                 const Vec3& grabbed_W, const Vec3& mouse_W,
                                                 const Pull& pull);

}  // namespace anthrob
