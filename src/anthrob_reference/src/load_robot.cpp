#include <urdf_parser/urdf_parser.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <stdexcept>

#include "load.h"

namespace anthrob::reference {
namespace {

Eigen::Vector3d eigen(const urdf::Vector3& v) {
  return {v.x, v.y, v.z};
}

Eigen::Isometry3d eigen(const urdf::Pose& pose) {
  Eigen::Quaterniond q;
  pose.rotation.getQuaternion(q.x(), q.y(), q.z(), q.w());
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() = q.normalized().toRotationMatrix();
  X.translation() = eigen(pose.position);
  return X;
}

/// A URDF file, and errors that name it.
class Robot {
 public:
  explicit Robot(const std::string& file) : file_(file) {
    if (!std::filesystem::exists(file)) fail("no such file");
    model_ = urdf::parseURDFFile(file);
    if (!model_) fail("not a URDF file");
  }

  [[noreturn]] void fail(const std::string& reason) const {
    throw std::runtime_error(file_ + ": " + reason);
  }

  urdf::LinkConstSharedPtr link(const std::string& name) const {
    const urdf::LinkConstSharedPtr found = model_->getLink(name);
    if (!found) fail("link " + name + " is missing");
    return found;
  }

  // Joint above the link, which hangs on `parent`.
  urdf::JointConstSharedPtr joint(const std::string& name, const std::string& parent) const {
    const urdf::JointConstSharedPtr found = link(name)->parent_joint;
    if (!found || found->parent_link_name != parent)
      fail(name + " must be a child link of " + parent);
    return found;
  }

  Eigen::Isometry3d base_in_world() const {
    const urdf::JointConstSharedPtr above = link("base")->parent_joint;
    if (!above) return Eigen::Isometry3d::Identity();
    if (above->type != urdf::Joint::FIXED || link(above->parent_link_name)->parent_joint) {
      fail("link base must be the root, or fixed to it");
    }
    return eigen(above->parent_to_joint_origin_transform);
  }

  BodyParameters body(const std::string& name) const {
    const urdf::InertialSharedPtr inertial = link(name)->inertial;
    if (!inertial) fail("link " + name + " has no inertial element");
    Eigen::Matrix3d inertia;
    inertia << inertial->ixx, inertial->ixy, inertial->ixz,  //
        inertial->ixy, inertial->iyy, inertial->iyz,         //
        inertial->ixz, inertial->iyz, inertial->izz;
    const Eigen::Isometry3d X = eigen(inertial->origin);
    return {inertial->mass, X.translation(), X.linear() * inertia * X.linear().transpose()};
  }

 private:
  std::string file_;
  urdf::ModelInterfaceSharedPtr model_;
};

}  // namespace

void load_robot(const std::string& urdf_file, SkeletonParameters* skeleton) {
  const Robot robot(urdf_file);
  const urdf::JointConstSharedPtr shoulder = robot.joint("humerus", "base");
  const urdf::JointConstSharedPtr elbow = robot.joint("forearm", "humerus");
  if (shoulder->type != urdf::Joint::FLOATING) robot.fail("the shoulder must be a floating joint");
  if (elbow->type != urdf::Joint::REVOLUTE) robot.fail("the elbow must be a revolute joint");
  skeleton->X_WB = robot.base_in_world();
  skeleton->X_WH_rest = skeleton->X_WB * eigen(shoulder->parent_to_joint_origin_transform);
  skeleton->X_HF_zero = eigen(elbow->parent_to_joint_origin_transform);
  skeleton->elbow_axis_F = eigen(elbow->axis).normalized();
  skeleton->elbow_stop.lower = elbow->limits->lower;
  skeleton->elbow_stop.upper = elbow->limits->upper;
  skeleton->humerus = robot.body("humerus");
  skeleton->forearm = robot.body("forearm");
}

}  // namespace anthrob::reference
