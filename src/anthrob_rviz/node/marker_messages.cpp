#include "marker_messages.h"

#include <cmath>

#include "anthrob_core/text.h"

namespace anthrob {
namespace {

using visualization_msgs::InteractiveMarkerControl;
using visualization_msgs::Marker;

template <class Message>
Message vector_message(const Vec3& vector) {
  Message message;
  message.x = vector.x();
  message.y = vector.y();
  message.z = vector.z();
  return message;
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
  marker.scale = vector_message<geometry_msgs::Vector3>(
      mesh ? Vec3(kMeshGrowth * shape.size) : Vec3(shape.size.array() + 2.0 * growth));
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
  return vector_message<geometry_msgs::Point>(vector);
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

std::optional<Pose> pose_from(const geometry_msgs::Pose& message) {
  const geometry_msgs::Quaternion& o = message.orientation;
  const Quat q(o.w, o.x, o.y, o.z);
  const Vec3 p(message.position.x, message.position.y, message.position.z);
  if (!p.allFinite() || !(std::abs(q.norm() - 1.0) < 1e-3)) return std::nullopt;
  return Pose{q.normalized().toRotationMatrix(), p};
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
  Marker size =
      text_at(root, link, mouse_W + Vec3(0.0, 0.0, 0.03),
              significant(pull.force_W.norm(), 2) + " N" + (pull.limited ? " (limit)" : ""));
  size.id = 1;
  size.color = arrow.color;
  return {arrow, size};
}

std::vector<Marker> erased_arrow(const std::string& root, const std::string& link) {
  Marker marker;
  marker.header.frame_id = root;  // RViz waits for ever without
  marker.ns = link;
  marker.action = Marker::DELETE;
  std::vector<Marker> both(2, marker);
  both[1].id = 1;
  return both;
}

Marker text_at(const std::string& root, const std::string& ns, const Vec3& point_W,
               const std::string& text) {
  Marker marker;
  marker.header.frame_id = root;
  marker.ns = ns;
  marker.type = Marker::TEXT_VIEW_FACING;
  marker.pose.position = point_of(point_W);
  marker.pose.orientation.w = 1.0;
  marker.scale.z = 0.03;
  marker.color = colour_of(1.0, 1.0, 1.0, 1.0);
  marker.text = text;
  return marker;
}

visualization_msgs::InteractiveMarker joint_handle(const std::string& root,
                                                   const SkeletonLink& link) {
  visualization_msgs::InteractiveMarker marker;
  marker.header.frame_id = root;
  marker.name = link.name;
  marker.pose.orientation.w = 1.0;
  marker.scale = link.joint.kind == JointKind::kBall ? 0.16F : 0.12F;
  InteractiveMarkerControl control;
  control.interaction_mode = link.joint.kind == JointKind::kSlide
                                 ? InteractiveMarkerControl::MOVE_AXIS
                                 : InteractiveMarkerControl::ROTATE_AXIS;
  std::vector<Vec3> axes{link.joint.axis};
  if (link.joint.kind == JointKind::kBall) axes = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  for (const Vec3& axis : axes) {
    Pose turned;
    turned.R = Quat::FromTwoVectors(Vec3::UnitX(), axis).toRotationMatrix();
    control.name = "axis_" + std::to_string(marker.controls.size());
    control.orientation = message_of(turned).orientation;
    marker.controls.push_back(control);
  }
  return marker;
}

Pose handle_pose(const LinkJoint& joint, const Pose& X_WL) {
  return {X_WL.R, X_WL * joint.center};
}

std::vector<Marker> ghost_of(const Skeleton& skeleton, const std::vector<Pose>& X_WL,
                             const std_msgs::ColorRGBA& colour) {
  std::vector<Marker> ghost;
  for (std::size_t i = 0; i < X_WL.size(); ++i) {
    const SkeletonLink& link = skeleton.links()[i];
    if (!link.moves) continue;
    for (Marker& marker : markers_of(link, 0.0, colour)) {
      marker.header.frame_id = skeleton.links()[0].name;
      marker.ns = "ghost";
      marker.id = static_cast<int>(ghost.size());
      marker.pose = message_of(X_WL[i] * pose_from(marker.pose).value());
      ghost.push_back(marker);
    }
  }
  return ghost;
}

}  // namespace anthrob
