#include "touch/skeleton.h"

#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>

#include "anthrob_core/errors.h"

namespace anthrob {
namespace {

Vec3 vector_of(const urdf::Vector3& v) {
  return {v.x, v.y, v.z};
}

Pose pose_of_urdf(const urdf::Pose& pose) {
  const urdf::Rotation& r = pose.rotation;
  return {Quat(r.w, r.x, r.y, r.z).toRotationMatrix(), vector_of(pose.position)};
}

JointKind kind_of(const urdf::Joint& joint) {
  switch (joint.type) {
    case urdf::Joint::FIXED:
      return JointKind::kFixed;
    case urdf::Joint::REVOLUTE:
    case urdf::Joint::CONTINUOUS:
      return JointKind::kHinge;
    case urdf::Joint::PRISMATIC:
      return JointKind::kSlide;
    case urdf::Joint::FLOATING:
      return JointKind::kBall;
    default:
      throw BadInput("robot_description: joint " + joint.name +
                     ": expected revolute, continuous, prismatic, fixed or floating");
  }
}

LinkJoint joint_of(const urdf::Joint& read, const std::map<std::string, Vec3>& centers) {
  LinkJoint joint;
  joint.name = read.name;
  joint.kind = kind_of(read);
  joint.X_PC_rest = pose_of_urdf(read.parent_to_joint_origin_transform);
  joint.axis = vector_of(read.axis).normalized();
  const auto center = centers.find(read.name);
  if (center != centers.end()) joint.center = center->second;
  if (read.limits && read.type != urdf::Joint::CONTINUOUS) {
    joint.lo = read.limits->lower;
    joint.hi = read.limits->upper;
  }
  return joint;
}

std::optional<LinkShape> shape_of(const urdf::Visual& visual) {
  if (!visual.geometry) return std::nullopt;
  LinkShape shape;
  shape.X_LS = pose_of_urdf(visual.origin);
  if (const auto* box = dynamic_cast<const urdf::Box*>(visual.geometry.get())) {
    shape.kind = LinkShape::Kind::kBox;
    shape.size = vector_of(box->dim);
  } else if (const auto* rod = dynamic_cast<const urdf::Cylinder*>(visual.geometry.get())) {
    shape.kind = LinkShape::Kind::kCylinder;
    shape.size = {2.0 * rod->radius, 2.0 * rod->radius, rod->length};
  } else if (const auto* ball = dynamic_cast<const urdf::Sphere*>(visual.geometry.get())) {
    shape.kind = LinkShape::Kind::kSphere;
    shape.size = Vec3::Constant(2.0 * ball->radius);
  } else if (const auto* mesh = dynamic_cast<const urdf::Mesh*>(visual.geometry.get())) {
    shape.kind = LinkShape::Kind::kMesh;
    shape.size = vector_of(mesh->scale);
    shape.mesh = mesh->filename;
  }
  return shape;
}

SkeletonLink link_of(const urdf::Link& read, const std::map<std::string, Vec3>& centers) {
  SkeletonLink link;
  link.name = read.name;
  if (read.parent_joint) link.joint = joint_of(*read.parent_joint, centers);
  if (read.inertial) link.middle = vector_of(read.inertial->origin.position);
  for (const auto& visual : read.visual_array) {
    if (const auto shape = shape_of(*visual)) link.shapes.push_back(*shape);
  }
  return link;
}

}  // namespace

Skeleton::Skeleton(const std::string& text, const std::map<std::string, Vec3>& centers) {
  const urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(text);
  if (!model || !model->getRoot()) {
    throw BadInput("robot_description: not a URDF; expected the robot's, as sim.launch sets it");
  }
  std::vector<urdf::LinkConstSharedPtr> found{model->getRoot()};
  links_.push_back(link_of(*found[0], centers));
  for (std::size_t parent = 0; parent < found.size(); ++parent) {
    for (const auto& child : found[parent]->child_links) {
      SkeletonLink link = link_of(*child, centers);
      link.parent = parent;
      link.moves = links_[parent].moves || link.joint.kind != JointKind::kFixed;
      links_.push_back(link);
      found.push_back(child);
    }
  }
}

std::optional<std::size_t> Skeleton::find(const std::string& name) const {
  for (std::size_t i = 0; i < links_.size(); ++i) {
    if (links_[i].name == name) return i;
  }
  return std::nullopt;
}

std::optional<std::size_t> Skeleton::child_of(const std::string& joint) const {
  for (std::size_t i = 1; i < links_.size(); ++i) {
    if (links_[i].joint.name == joint) return i;
  }
  return std::nullopt;
}

bool Skeleton::has(JointKind kind) const {
  return std::any_of(links_.begin(), links_.end(),
                     [&](const SkeletonLink& link) { return link.joint.kind == kind; });
}

std::vector<Pose> Skeleton::poses(const Posture& posture) const {
  std::vector<Pose> X_WL(links_.size());
  for (std::size_t i = 1; i < links_.size(); ++i) {
    X_WL[i] = X_WL[*links_[i].parent] * pose_of(links_[i].joint, posture[i]);
  }
  return X_WL;
}

Pose Skeleton::pose(std::size_t link, const Posture& posture) const {
  Pose X_AL;
  for (std::size_t i = link; links_[i].parent; i = *links_[i].parent) {
    X_AL = pose_of(links_[i].joint, posture[i]) * X_AL;
  }
  return X_AL;
}

Pose pose_of(const LinkJoint& joint, const JointPosition& position) {
  Pose moved;
  switch (joint.kind) {
    case JointKind::kFixed:
      break;
    case JointKind::kHinge:
      moved.R = Eigen::AngleAxisd(position.q, joint.axis).toRotationMatrix();
      break;
    case JointKind::kSlide:
      moved.p = position.q * joint.axis;
      break;
    case JointKind::kBall:
      moved.R = position.rotation.toRotationMatrix();
      moved.p = joint.center - moved.R * joint.center;
      break;
  }
  return joint.X_PC_rest * moved;
}

}  // namespace anthrob
