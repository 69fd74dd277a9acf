#include "marker_messages.h"

#include "anthrob_core/text.h"

namespace anthrob {
namespace {

using visualization_msgs::InteractiveMarkerControl;
using visualization_msgs::Marker;

geometry_msgs::Vector3 scale_of(const Vec3& vector) {
  geometry_msgs::Vector3 scale;
  scale.x = vector.x();
  scale.y = vector.y();
  scale.z = vector.z();
  return scale;
}

int type_of(LinkShape::Kind kind) {
  switch (kind) {
    case LinkShape::Kind::kBox:
      return Marker::CUBE;
    case LinkShape::Kind::kCylinder:
      return Marker::CYLINDER;
    case LinkShape::Kind::kSphere:
      return Marker::SPHERE;
    case LinkShape::Kind::kMesh:
      break;
  }
  return Marker::MESH_RESOURCE;
}

LinkShape ball_at(const Vec3& middle) {
  LinkShape shape;
  shape.kind = LinkShape::Kind::kSphere;
  shape.size = Vec3::Constant(0.04);
  shape.X_LS.p = middle;
  return shape;
}

Marker marker_of(const LinkShape& shape, double growth, const std_msgs::ColorRGBA& colour) {
  // Meshes have no size to which something could be added.
  constexpr double kMeshGrowth = 1.01;
  const bool mesh = shape.kind == LinkShape::Kind::kMesh;
  Marker marker;
  marker.type = type_of(shape.kind);
  marker.pose = message_of(shape.X_LS);
  marker.scale =
      scale_of(mesh ? Vec3(kMeshGrowth * shape.size) : Vec3(shape.size.array() + 2.0 * growth));
  marker.mesh_resource = shape.mesh;
  marker.color = colour;
  return marker;
}

}  // namespace

std_msgs::ColorRGBA colour_of(double r, double g, double b, double a) {
  std_msgs::ColorRGBA colour;
  colour.r = static_cast<float>(r);
  colour.g = static_cast<float>(g);
  colour.b = static_cast<float>(b);
  colour.a = static_cast<float>(a);
  return colour;
}

geometry_msgs::Point point_of(const Vec3& vector) {
  geometry_msgs::Point point;
  point.x = vector.x();
  point.y = vector.y();
  point.z = vector.z();
  return point;
}

geometry_msgs::Pose message_of(const Pose& pose) {
  const Quat q = canonical(Quat(pose.R));
  geometry_msgs::Pose message;
  message.position = point_of(pose.p);
  message.orientation.w = q.w();
  message.orientation.x = q.x();
  message.orientation.y = q.y();
  message.orientation.z = q.z();
  return message;
}

std::vector<Marker> markers_of(const SkeletonLink& link, double growth,
                               const std_msgs::ColorRGBA& colour) {
  std::vector<Marker> markers;
  for (const LinkShape& shape : link.shapes) markers.push_back(marker_of(shape, growth, colour));
  if (markers.empty()) markers.push_back(marker_of(ball_at(link.middle), growth, colour));
  return markers;
}

visualization_msgs::InteractiveMarker pullable(const SkeletonLink& link) {
  // RViz lights up what the mouse is over, and draws this where the mouse has it; the link itself
  // is to be seen through it.
  constexpr double kGlass = 0.1;
  constexpr double kGrowth = 0.001;  // [m]
  visualization_msgs::InteractiveMarker marker;
  marker.header.frame_id = link.name;  // without stamp: follows the link
  marker.name = link.name;
  marker.scale = 0.1F;
  marker.pose.orientation.w = 1.0;
  InteractiveMarkerControl control;
  control.name = "pull";
  // Not MOVE_3D: RViz takes the direction of view for one of the marker's frame, which is turned.
  control.interaction_mode = InteractiveMarkerControl::MOVE_PLANE;
  control.orientation_mode = InteractiveMarkerControl::VIEW_FACING;
  control.orientation.w = 1.0;
  control.independent_marker_orientation = 1;
  control.markers = markers_of(link, kGrowth, colour_of(1.0, 1.0, 1.0, kGlass));
  marker.controls.push_back(control);
  return marker;
}

std::vector<Marker> arrow_of(const std::string& root, const std::string& link,
                             const Vec3& grabbed_W, const Vec3& mouse_W, const Pull& pull) {
  Marker arrow;
  arrow.header.frame_id = root;
  arrow.ns = link;
  arrow.id = 0;
  arrow.type = Marker::ARROW;
  arrow.pose.orientation.w = 1.0;
  arrow.points = {point_of(grabbed_W), point_of(mouse_W)};
  arrow.scale.x = 0.006;
  arrow.scale.y = 0.014;
  arrow.scale.z = 0.03;
  arrow.color = pull.limited ? colour_of(1.0, 0.3, 0.2, 1.0) : colour_of(1.0, 0.8, 0.2, 1.0);
  Marker size = arrow;
  size.id = 1;
  size.type = Marker::TEXT_VIEW_FACING;
  size.points.clear();
  size.pose.position = point_of(mouse_W + Vec3(0.0, 0.0, 0.03));
  size.scale.z = 0.03;
  size.text = significant(pull.force_W.norm(), 2) + " N" + (pull.limited ? " (limit)" : "");
  return {arrow, size};
}

}  // namespace anthrob
