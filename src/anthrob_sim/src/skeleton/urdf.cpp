#include "skeleton/urdf.h"

#include <console_bridge/console.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <cmath>
#include <mutex>
#include <sstream>

#include "anthrob_core/errors.h"
#include "skeleton/urdf_sizes.h"
#include "skeleton/urdf_spelling.h"
#include "skeleton/urdf_tree.h"

namespace anthrob {

namespace {

/// Collects what urdfdom would print, so that it can go into one line.
class MessageCollector : public console_bridge::OutputHandler {
 public:
  MessageCollector() { console_bridge::useOutputHandler(this); }
  ~MessageCollector() override { console_bridge::restorePreviousOutputHandler(); }
  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level < console_bridge::CONSOLE_BRIDGE_LOG_ERROR) return;
    if (!text_.empty()) text_ += "; ";
    for (const char c : text) text_ += c == '\n' ? ' ' : c;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

Vec3 to_vec(const urdf::Vector3& v) {
  return {v.x, v.y, v.z};
}

Pose to_pose(const urdf::Pose& pose) {
  double x, y, z, w;
  pose.rotation.getQuaternion(x, y, z, w);
  return {Quat(w, x, y, z).normalized().toRotationMatrix(), to_vec(pose.position)};
}

/// Adds a rigid body with centre of mass and inertia given in the same frame as `body`'s.
void add_mass(BodyModel& body, double mass, const Vec3& com, const Mat3& inertia) {
  const double total = body.mass + mass;
  if (total <= 0.0) return;
  const Vec3 center = (body.mass * body.com_L + mass * com) / total;
  const auto shifted = [&](const Mat3& I, double m, const Vec3& c) -> Mat3 {
    const Vec3 d = c - center;
    return I + m * (d.squaredNorm() * Mat3::Identity() - d * d.transpose());
  };
  body.inertia_L = shifted(body.inertia_L, body.mass, body.com_L) + shifted(inertia, mass, com);
  body.com_L = center;
  body.mass = total;
}

class Builder {
 public:
  Builder(const std::string& file, bool collisions) : file_(file), collisions_(collisions) {}

  UrdfRobot build() {
    const UrdfFile xml(file_);
    refuse_what_is_not_read(xml);
    UrdfTree(xml).require_tree();
    const urdf::ModelInterfaceSharedPtr robot = parsed(xml.text());
    UrdfRobot result;
    result.remarks = odd_sizes(xml);
    model_.bodies.push_back({});
    model_.bodies[0].name = robot->getRoot()->name;
    add_link(*robot->getRoot(), 0, Pose());
    for (auto& body : model_.bodies) {
      if (&body != &model_.bodies[0]) finish_body(body);
    }
    result.skeleton = std::move(model_);
    return result;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw BadInput(file_ + ": " + message);
  }

  /// By urdfdom, after what it would misunderstand was refused.
  urdf::ModelInterfaceSharedPtr parsed(const std::string& text) const {
    static std::mutex one_at_a_time;  // urdfdom reports through a global handler
    const std::lock_guard<std::mutex> lock(one_at_a_time);
    MessageCollector messages;
    urdf::ModelInterfaceSharedPtr robot = urdf::parseURDF(text);
    // A number that cannot be read leaves a robot without what it belongs to.
    if (!robot || !messages.text().empty()) {
      fail("not a valid URDF: " + (messages.text().empty() ? "no XML" : messages.text()));
    }
    return robot;
  }

  void add_collisions(const urdf::Link& link, int body, const Pose& X_LF) {
    for (const auto& collision : link.collision_array) {
      model_.bodies[body].collisions.push_back(
          shape(link.name, *collision, X_LF * to_pose(collision->origin)));
    }
  }

  void add_link(const urdf::Link& link, int body, const Pose& X_LF) {
    model_.frames.push_back({link.name, body, X_LF});
    if (body > 0 && link.inertial) add_inertial(link, body, X_LF);
    if (collisions_) add_collisions(link, body, X_LF);
    for (const auto& joint : link.child_joints) {
      if (joint->type == urdf::Joint::FIXED) {
        add_child(link, *joint, body, X_LF);
      }
    }
    for (const auto& joint : link.child_joints) {
      if (joint->type != urdf::Joint::FIXED) {
        add_child(link, *joint, body, X_LF);
      }
    }
  }

  void add_inertial(const urdf::Link& link, int body, const Pose& X_LF) {
    const auto& inertial = *link.inertial;
    Mat3 I;
    I << inertial.ixx, inertial.ixy, inertial.ixz,  //
        inertial.ixy, inertial.iyy, inertial.iyz,   //
        inertial.ixz, inertial.iyz, inertial.izz;
    const Pose X_LI = X_LF * to_pose(inertial.origin);
    add_mass(model_.bodies[body], inertial.mass, X_LI.p, X_LI.R * I * X_LI.R.transpose());
  }

  void add_child(const urdf::Link& parent, const urdf::Joint& joint, int body, const Pose& X_LF) {
    const urdf::Link* child = nullptr;
    for (const auto& link : parent.child_links) {
      if (link->name == joint.child_link_name) child = link.get();
    }
    const Pose X_LC = X_LF * to_pose(joint.parent_to_joint_origin_transform);
    if (joint.type == urdf::Joint::FIXED) {
      add_link(*child, body, X_LC);
      return;
    }
    JointModel model;
    model.name = joint.name;
    model.parent_link = parent.name;
    model.child_link = joint.child_link_name;
    model.parent = body;
    model.child = static_cast<int>(model_.bodies.size());
    model.X_PC_rest = X_LC;
    switch (joint.type) {
      case urdf::Joint::FLOATING:
        model.type = JointType::kBall;
        break;
      case urdf::Joint::REVOLUTE:
      case urdf::Joint::CONTINUOUS:
        model.type = JointType::kHinge;
        break;
      case urdf::Joint::PRISMATIC:
        model.type = JointType::kPrismatic;
        break;
      default:
        fail("joint " + joint.name +
             ": type: expected revolute, continuous, prismatic, fixed, or floating (a ball joint)");
    }
    if (model.type != JointType::kBall) {
      model.axis_C = to_vec(joint.axis);
      const double norm = model.axis_C.norm();
      if (!(norm > 1e-6))
        fail("joint " + joint.name + ": axis: expected a vector that is not zero");
      model.axis_C /= norm;
    }
    if (joint.mimic)
      fail("joint " + joint.name + ": mimic: expected no mimic joint; these are not simulated");
    if (joint.dynamics) read_dynamics(joint, model);
    if (joint.limits &&
        (joint.type == urdf::Joint::REVOLUTE || model.type == JointType::kPrismatic)) {
      read_limits(joint, model);
    }
    model.position_offset = model_.position_count;
    model.velocity_offset = model_.velocity_count;
    model_.position_count += model.position_size();
    model_.velocity_count += model.dof();
    model_.joints.push_back(model);

    BodyModel child_body;
    child_body.name = child->name;
    model_.bodies.push_back(child_body);
    add_link(*child, model.child, Pose());
  }

  void read_dynamics(const urdf::Joint& joint, JointModel& model) const {
    const auto nonnegative = [&](const char* what, double value) {
      if (value >= 0.0 && std::isfinite(value)) return value;
      fail("joint " + joint.name + ": dynamics: " + what + ": " + std::to_string(value) +
           ": expected a number >= 0");
    };
    model.friction.viscous = nonnegative("damping", joint.dynamics->damping);
    model.friction.static_torque = model.friction.kinetic_torque =
        nonnegative("friction", joint.dynamics->friction);
  }

  void read_limits(const urdf::Joint& joint, JointModel& model) const {
    const double lower = joint.limits->lower, upper = joint.limits->upper;
    const std::string values = "joint " + joint.name + ": limit: lower " + std::to_string(lower) +
                               ", upper " + std::to_string(upper);
    if (!(lower < upper)) fail(values + ": expected lower < upper");
    // At rest every joint stands at zero.
    if (!(lower <= 0.0 && upper >= 0.0)) fail(values + ": expected lower <= 0 <= upper");
    model.stop.enabled = true;
    model.stop.lower = lower;
    model.stop.upper = upper;
  }

  void finish_body(BodyModel& body) {
    if (!(body.mass > 0.0)) {
      fail("link " + body.name +
           ": inertial: missing or without mass; a body that moves needs mass > 0 [kg]");
    }
    if (!body.find_principal_axes()) {
      std::ostringstream value;
      value << body.principal.transpose();
      fail("link " + body.name + ": inertia: principal moments " + value.str() +
           ": expected three numbers > 0, none larger than the other two together [kg m^2]");
    }
  }

  CollisionModel shape(const std::string& link, const urdf::Collision& collision,
                       const Pose& X_LS) {
    CollisionModel model;
    model.X_LS = X_LS;
    switch (collision.geometry->type) {
      case urdf::Geometry::BOX:
        model.type = ShapeType::kBox;
        model.size = to_vec(static_cast<const urdf::Box&>(*collision.geometry).dim);
        break;
      case urdf::Geometry::SPHERE:
        model.type = ShapeType::kSphere;
        model.size = {static_cast<const urdf::Sphere&>(*collision.geometry).radius, 0, 0};
        break;
      case urdf::Geometry::CYLINDER: {
        const auto& cylinder = static_cast<const urdf::Cylinder&>(*collision.geometry);
        model.type = ShapeType::kCylinder;
        model.size = {cylinder.radius, cylinder.length, 0};
        break;
      }
      default:
        fail("link " + link + ": collision: expected a box, a sphere or a cylinder");
    }
    const int sizes = model.type == ShapeType::kBox        ? 3
                      : model.type == ShapeType::kCylinder ? 2
                                                           : 1;
    for (int k = 0; k < sizes; ++k) {
      if (std::isfinite(model.size[k]) && model.size[k] > 0.0) continue;
      fail("link " + link + ": collision: expected sizes > 0 [m]");
    }
    return model;
  }

  std::string file_;
  bool collisions_;
  SkeletonModel model_;
};

}  // namespace

UrdfRobot read_urdf(const std::string& file, bool collisions) {
  return Builder(file, collisions).build();
}

SkeletonModel load_urdf(const std::string& file, bool collisions) {
  return read_urdf(file, collisions).skeleton;
}

}  // namespace anthrob
