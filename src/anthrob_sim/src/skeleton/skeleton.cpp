#include "skeleton/skeleton.h"

#include <BulletDynamics/MLCPSolvers/btDantzigSolver.h>
#include <BulletDynamics/MLCPSolvers/btMLCPSolver.h>
#include <btBulletDynamicsCommon.h>

#include "skeleton/prismatic_constraint.h"
#include "skeleton/tree_constraint_solver.h"

namespace anthrob {

namespace {

/// Share of a joint's position error that Bullet's world takes out in one step.
constexpr double kErrorReduction = 0.2;

btVector3 to_bullet(const Vec3& v) {
  return {v[0], v[1], v[2]};
}
Vec3 from_bullet(const btVector3& v) {
  return {v[0], v[1], v[2]};
}

btMatrix3x3 to_bullet(const Mat3& m) {
  return {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)};
}

btTransform to_bullet(const Pose& pose) {
  return btTransform(to_bullet(pose.R), to_bullet(pose.p));
}

Pose from_bullet(const btTransform& transform) {
  Pose pose;
  for (int i = 0; i < 3; ++i) pose.R.row(i) = from_bullet(transform.getBasis()[i]);
  pose.p = from_bullet(transform.getOrigin());
  return pose;
}

/// A frame at `origin` whose z (hinge) or x (slider) axis is `axis`.
btTransform frame_about(const Vec3& origin, const Vec3& axis, const Vec3& across, bool axis_is_z) {
  Mat3 R;
  if (axis_is_z) {
    R << across, axis.cross(across), axis;
  } else {
    R << axis, across, axis.cross(across);
  }
  return to_bullet(Pose{R, origin});
}

std::unique_ptr<btTypedConstraint> make_constraint(const JointModel& joint, const Pose& X_LB_parent,
                                                   const Pose& X_LB_child, btRigidBody& a,
                                                   btRigidBody& b) {
  const Pose X_PL = X_LB_parent.inverse() * joint.X_PC_rest;
  const Pose X_CL = X_LB_child.inverse();
  const Vec3 center_P = X_PL * joint.center_C, center_C = X_CL * joint.center_C;
  if (joint.type == JointType::kBall) {
    return std::make_unique<btPoint2PointConstraint>(a, b, to_bullet(center_P),
                                                     to_bullet(center_C));
  }
  const Vec3 across = joint.axis_C.unitOrthogonal();
  const bool hinge = joint.type == JointType::kHinge;
  const btTransform frame_P = frame_about(center_P, X_PL.R * joint.axis_C, X_PL.R * across, hinge);
  const btTransform frame_C = frame_about(center_C, X_CL.R * joint.axis_C, X_CL.R * across, hinge);
  if (hinge) {
    auto constraint = std::make_unique<btHingeConstraint>(a, b, frame_P, frame_C);
    constraint->setLimit(1.0, -1.0);  // free: stops are springs on the joint
    constraint->setUseFrameOffset(false);
    return constraint;
  }
  return std::make_unique<PrismaticConstraint>(a, b, frame_P, frame_C);
}

std::unique_ptr<btCollisionShape> make_shape(const CollisionModel& model) {
  switch (model.type) {
    case ShapeType::kBox:
      return std::make_unique<btBoxShape>(to_bullet(Vec3(0.5 * model.size)));
    case ShapeType::kSphere:
      return std::make_unique<btSphereShape>(model.size[0]);
    case ShapeType::kCylinder:
      break;
  }
  return std::make_unique<btCylinderShapeZ>(
      btVector3(model.size[0], model.size[0], 0.5 * model.size[1]));
}

}  // namespace

/// What Bullet needs to find and solve contacts. Nothing of it may remember earlier steps, so that
/// a restored snapshot continues with the same bits: pairs are sorted, and all that they found is
/// made anew, for the order in which several shapes of two bodies first met is memory, too.
struct ContactWorld {
  ContactWorld() : solver(&dantzig), world(&dispatcher, &broadphase, &solver, &configuration) {
    world.getDispatchInfo().m_deterministicOverlappingPairs = true;
  }
  void forget_contacts() {
    btOverlappingPairCache& pairs = *broadphase.getOverlappingPairCache();
    for (int i = 0; i < pairs.getNumOverlappingPairs(); ++i) {
      pairs.cleanOverlappingPair(pairs.getOverlappingPairArray()[i], &dispatcher);
    }
  }

  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btSimpleBroadphase broadphase;
  btDantzigSolver dantzig;
  btMLCPSolver solver;
  btDiscreteDynamicsWorld world;
};

struct Skeleton::Bullet {
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  std::vector<std::unique_ptr<btRigidBody>> bodies;
  std::vector<std::unique_ptr<btTypedConstraint>> constraints;
  std::vector<btRigidBody*> moving;
  std::unique_ptr<TreeConstraintSolver> joints;  // without contacts
  std::unique_ptr<ContactWorld> contacts;        // with contacts

  Bullet(const SkeletonModel& model, const Vec3& gravity, bool collisions) {
    for (std::size_t i = 0; i < model.bodies.size(); ++i)
      add_body(model.bodies[i], i > 0, collisions);
    for (const auto& joint : model.joints) {
      constraints.push_back(make_constraint(joint, model.bodies[joint.parent].X_LB,
                                            model.bodies[joint.child].X_LB, *bodies[joint.parent],
                                            *bodies[joint.child]));
    }
    if (collisions) {
      contacts = std::make_unique<ContactWorld>();
      contacts->world.getSolverInfo().m_erp = kErrorReduction;
      contacts->world.setGravity(to_bullet(gravity));
      for (auto& body : bodies) contacts->world.addRigidBody(body.get());
      for (auto& constraint : constraints) contacts->world.addConstraint(constraint.get(), true);
    } else {
      std::vector<btTypedConstraint*> list;
      std::vector<int> parents;
      for (std::size_t i = 0; i < model.joints.size(); ++i) {
        list.push_back(constraints[i].get());
        parents.push_back(model.joints[i].parent - 1);
      }
      joints = std::make_unique<TreeConstraintSolver>(list, parents);
    }
  }

  ~Bullet() {
    if (!contacts) return;
    for (auto& constraint : constraints) contacts->world.removeConstraint(constraint.get());
    for (auto& body : bodies) contacts->world.removeRigidBody(body.get());
  }

  void add_body(const BodyModel& model, bool moves, bool collisions) {
    btCollisionShape* shape;
    if (collisions && !model.collisions.empty()) {
      auto compound = std::make_unique<btCompoundShape>();
      for (const auto& part : model.collisions) {
        shapes.push_back(make_shape(part));
        compound->addChildShape(to_bullet(model.X_LB.inverse() * part.X_LS), shapes.back().get());
      }
      shapes.push_back(std::move(compound));
    } else {
      shapes.push_back(std::make_unique<btEmptyShape>());
    }
    shape = shapes.back().get();
    const btVector3 inertia = moves ? to_bullet(model.principal) : btVector3(0, 0, 0);
    const btRigidBody::btRigidBodyConstructionInfo construction(moves ? model.mass : 0.0, nullptr,
                                                                shape, inertia);
    bodies.push_back(std::make_unique<btRigidBody>(construction));
    btRigidBody& body = *bodies.back();
    body.setActivationState(DISABLE_DEACTIVATION);
    body.setDamping(0.0, 0.0);
    body.setFlags(BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY);
    if (moves) moving.push_back(&body);
  }

  void step_with_contacts(double step) {
    contacts->forget_contacts();
    contacts->world.stepSimulation(step, 0);
  }
};

Skeleton::Skeleton(const SkeletonModel& model, const Vec3& gravity, double step, bool collisions)
    : model_(model),
      gravity_(gravity),
      step_(step),
      bodies_(model.bodies.size()),
      forces_(model.bodies.size(), Vec3::Zero()),
      torques_(model.bodies.size(), Vec3::Zero()),
      bullet_(std::make_unique<Bullet>(model, gravity, collisions)) {}

Skeleton::~Skeleton() = default;

void Skeleton::set_bodies(const std::vector<BodyState>& bodies) {
  bodies_ = bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    btRigidBody& body = *bullet_->bodies[i];
    body.setCenterOfMassTransform(to_bullet(bodies[i].X_WB));
    body.setLinearVelocity(to_bullet(bodies[i].v_W));
    body.setAngularVelocity(to_bullet(bodies[i].w_W));
    body.clearForces();
  }
}

void Skeleton::clear_wrenches() {
  for (auto& force : forces_) force.setZero();
  for (auto& torque : torques_) torque.setZero();
}

void Skeleton::step() {
  for (std::size_t i = 1; i < bodies_.size(); ++i) {
    btRigidBody& body = *bullet_->bodies[i];
    // With contacts Bullet's world adds gravity itself.
    const Vec3 weight =
        bullet_->contacts ? Vec3(Vec3::Zero()) : Vec3(model_.bodies[i].mass * gravity_);
    body.applyCentralForce(to_bullet(Vec3(forces_[i] + weight)));
    body.applyTorque(to_bullet(torques_[i]));
  }
  if (bullet_->contacts) {
    bullet_->step_with_contacts(step_);
  } else {
    bullet_->joints->step(step_, bullet_->moving);
  }
  for (std::size_t i = 1; i < bodies_.size(); ++i) {
    const btRigidBody& body = *bullet_->bodies[i];
    bodies_[i].X_WB = from_bullet(body.getCenterOfMassTransform());
    bodies_[i].v_W = from_bullet(body.getLinearVelocity());
    bodies_[i].w_W = from_bullet(body.getAngularVelocity());
  }
}

}  // namespace anthrob
