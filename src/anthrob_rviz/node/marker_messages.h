#pragma once

#include <visualization_msgs/InteractiveMarker.h>
#include <visualization_msgs/Marker.h>

#include <optional>
#include <string>
#include <vector>

#include "touch/pull_spring.h"
#include "touch/skeleton.h"

namespace anthrob {

std_msgs::ColorRGBA colour_of(double r, double g, double b, double a);
geometry_msgs::Point point_of(const Vec3& vector);
geometry_msgs::Pose message_of(const Pose& pose);
/// None of what is no pose.
std::optional<Pose> pose_from(const geometry_msgs::Pose& message);
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
std::vector<visualization_msgs::Marker> erased_arrow(const std::string& root,
                                                     const std::string& link);
visualization_msgs::Marker text_at(const std::string& root, const std::string& ns,
                                   const Vec3& point_W, const std::string& text);

/// A ring for a hinge, three for a ball joint, arrows for a slide; by the name of the link that
/// hangs on the joint.
visualization_msgs::InteractiveMarker joint_handle(const std::string& root,
                                                   const SkeletonLink& link);
/// Where that handle is, in the root: at the joint, with the axes of the link.
Pose handle_pose(const LinkJoint& joint, const Pose& X_WL);
/// All links that move, in another posture.
std::vector<visualization_msgs::Marker> ghost_of(const Skeleton& skeleton,
                                                 const std::vector<Pose>& X_WL,
                                                 const std_msgs::ColorRGBA& colour);

}  // namespace anthrob
