#include "anthrob_sim/skeleton/kinematic_tree.h"

#include <cmath>

namespace anthrob {

namespace {

constexpr double kTwoPi = 2.0 * M_PI;

}  // namespace

KinematicTree::UnitMotion KinematicTree::unit_motion(const JointModel& joint, const JointView& view,
                                                     int k) {
  if (joint.type == JointType::kPrismatic) return {Vec3::Zero(), view.axis_W};
  const Vec3 w = joint.type == JointType::kBall ? Vec3(Vec3::Unit(k)) : view.axis_W;
  return {w, view.center_W.cross(w)};
}

KinematicTree::KinematicTree(const SkeletonModel& model) : model_(model) {
  const std::size_t bodies = model.bodies.size();
  for (const auto& joint : model.joints) {
    const Pose X_PL = model.bodies[joint.parent].X_LB.inverse();
    const Pose X_CL = model.bodies[joint.child].X_LB.inverse();
    JointGeometry g;
    g.center_P = X_PL * (joint.X_PC_rest * joint.center_C);
    g.center_C = X_CL * joint.center_C;
    g.R_PC_rest = X_PL.R * joint.X_PC_rest.R * X_CL.R.transpose();
    g.R_P_rest = X_PL.R * joint.X_PC_rest.R;
    g.R_CL = X_CL.R;
    g.axis_P = X_PL.R * joint.X_PC_rest.R * joint.axis_C;
    const Vec3 mark_L = joint.axis_C.unitOrthogonal();
    g.mark_P = X_PL.R * joint.X_PC_rest.R * mark_L;
    g.mark_C = X_CL.R * mark_L;
    geometry_.push_back(g);
  }
  views_.resize(model.joints.size());
  u_.resize(model.velocity_count, 0.0);
  unit_motions_.resize(model.velocity_count);
  mass_.setZero(model.velocity_count, model.velocity_count);
  bias_.setZero(model.velocity_count);
  composite_.resize(bodies);
  alpha_.resize(bodies, Vec3::Zero());
  accel_.resize(bodies, Vec3::Zero());
  force_.resize(bodies, Vec3::Zero());
  torque_.resize(bodies, Vec3::Zero());
}

void KinematicTree::place(const std::vector<double>& q, const std::vector<double>& u,
                          std::vector<BodyState>& bodies) const {
  bodies.resize(model_.bodies.size());
  bodies[0] = BodyState();
  for (std::size_t i = 0; i < model_.joints.size(); ++i) {
    const JointModel& joint = model_.joints[i];
    const JointGeometry& g = geometry_[i];
    const BodyState& parent = bodies[joint.parent];
    BodyState& child = bodies[joint.child];
    const double* p = &q[joint.position_offset];
    const Mat3& R_LB = model_.bodies[joint.child].X_LB.R;

    Mat3 R_q = Mat3::Identity();  // in the child's link axes
    Vec3 shift_C = Vec3::Zero();
    if (joint.type == JointType::kBall) {
      R_q = Quat(p[0], p[1], p[2], p[3]).normalized().toRotationMatrix();
    } else if (joint.type == JointType::kHinge) {
      R_q = Eigen::AngleAxisd(p[0], joint.axis_C).toRotationMatrix();
    } else {
      shift_C = R_LB.transpose() * joint.axis_C * p[0];
    }
    child.X_WB.R = parent.X_WB.R * g.R_PC_rest * (R_LB.transpose() * R_q * R_LB);
    const Vec3 center_W = parent.X_WB * g.center_P;
    child.X_WB.p = center_W - child.X_WB.R * (g.center_C - shift_C);

    child.v_W.setZero();
    child.w_W.setZero();
    if (u.empty()) continue;
    const double* s = &u[joint.velocity_offset];
    const Vec3 axis_W = parent.X_WB.R * g.axis_P;
    child.w_W = parent.w_W;
    child.v_W = parent.v_W + parent.w_W.cross(child.X_WB.p - parent.X_WB.p);
    if (joint.type == JointType::kPrismatic) {
      child.v_W += axis_W * s[0];
    } else {
      const Vec3 relative =
          joint.type == JointType::kBall ? Vec3(s[0], s[1], s[2]) : Vec3(axis_W * s[0]);
      child.w_W += relative;
      child.v_W += relative.cross(child.X_WB.p - center_W);
    }
  }
}

void KinematicTree::update(const std::vector<BodyState>& bodies, std::vector<double>& q) {
  for (std::size_t i = 0; i < model_.joints.size(); ++i) {
    const JointModel& joint = model_.joints[i];
    const JointGeometry& g = geometry_[i];
    const BodyState& parent = bodies[joint.parent];
    const BodyState& child = bodies[joint.child];
    JointView& view = views_[i];
    view.center_W = parent.X_WB * g.center_P;
    double* s = &u_[joint.velocity_offset];
    double* p = &q[joint.position_offset];
    const Vec3 relative = child.w_W - parent.w_W;
    if (joint.type == JointType::kBall) {
      s[0] = relative[0], s[1] = relative[1], s[2] = relative[2];
      view.R_WC = child.X_WB.R * g.R_CL;
      const Quat turn = canonical(Quat(Mat3((parent.X_WB.R * g.R_P_rest).transpose() * view.R_WC)));
      p[0] = turn.w(), p[1] = turn.x(), p[2] = turn.y(), p[3] = turn.z();
      continue;
    }
    view.axis_W = parent.X_WB.R * g.axis_P;
    p[0] = position(static_cast<int>(i), bodies, p[0]);
    if (joint.type == JointType::kHinge) {
      s[0] = view.axis_W.dot(relative);
    } else {
      s[0] =
          view.axis_W.dot(child.v_W - parent.v_W - parent.w_W.cross(child.X_WB.p - parent.X_WB.p));
    }
  }
}

double KinematicTree::position(int i, const std::vector<BodyState>& bodies, double last) const {
  const JointModel& joint = model_.joints[i];
  const JointGeometry& g = geometry_[i];
  const Pose& X_WP = bodies[joint.parent].X_WB;
  const Pose& X_WC = bodies[joint.child].X_WB;
  const Vec3 axis_W = X_WP.R * g.axis_P;
  if (joint.type == JointType::kPrismatic) {
    return axis_W.dot(X_WC * g.center_C - X_WP * g.center_P);
  }
  const Vec3 from = X_WP.R * g.mark_P;
  const Vec3 to = X_WC.R * g.mark_C;
  const double angle = std::atan2(axis_W.dot(from.cross(to)), from.dot(to));
  return angle + kTwoPi * std::round((last - angle) / kTwoPi);
}

void KinematicTree::update_dynamics(const std::vector<BodyState>& bodies, const Vec3& gravity) {
  const int count = static_cast<int>(model_.bodies.size());

  // Velocity-product accelerations outwards, then the wrenches they and gravity need, inwards.
  for (int b = 1; b < count; ++b) {
    const JointModel& joint = model_.joints[b - 1];
    const JointView& view = views_[b - 1];
    const BodyState& parent = bodies[joint.parent];
    const BodyState& child = bodies[b];
    const Vec3 relative = child.w_W - parent.w_W;
    const Vec3 to_joint = view.center_W - parent.X_WB.p;
    const Vec3 from_joint = child.X_WB.p - view.center_W;
    alpha_[b] = alpha_[joint.parent];
    if (joint.type == JointType::kHinge) alpha_[b] += parent.w_W.cross(relative);
    accel_[b] = accel_[joint.parent] + alpha_[joint.parent].cross(to_joint) +
                parent.w_W.cross(parent.w_W.cross(to_joint)) + alpha_[b].cross(from_joint) +
                child.w_W.cross(child.w_W.cross(from_joint));
    if (joint.type == JointType::kPrismatic) {
      accel_[b] += 2.0 * u_[joint.velocity_offset] * parent.w_W.cross(view.axis_W);
    }

    const BodyModel& body = model_.bodies[b];
    const Mat3 inertia = child.X_WB.R * body.principal.asDiagonal() * child.X_WB.R.transpose();
    force_[b] = body.mass * (accel_[b] - gravity);
    torque_[b] =
        inertia * alpha_[b] + child.w_W.cross(inertia * child.w_W) + child.X_WB.p.cross(force_[b]);

    const Vec3& p = child.X_WB.p;
    composite_[b].mass = body.mass;
    composite_[b].moment = body.mass * p;
    composite_[b].inertia =
        inertia + body.mass * (p.squaredNorm() * Mat3::Identity() - p * p.transpose());
  }

  for (int b = 1; b < count; ++b) {
    const JointModel& joint = model_.joints[b - 1];
    for (int k = 0; k < joint.dof(); ++k) {
      unit_motions_[joint.velocity_offset + k] = unit_motion(joint, views_[b - 1], k);
    }
  }
  mass_.setZero();
  for (int b = count - 1; b >= 1; --b) {
    const JointModel& joint = model_.joints[b - 1];
    const CompositeInertia& c = composite_[b];
    for (int k = 0; k < joint.dof(); ++k) {
      const int row = joint.velocity_offset + k;
      const UnitMotion& motion = unit_motions_[row];
      bias_[row] = motion.w.dot(torque_[b]) + motion.v.dot(force_[b]);
      const Vec3 momentum = c.mass * motion.v + motion.w.cross(c.moment);
      const Vec3 spin = c.inertia * motion.w + c.moment.cross(motion.v);
      // Against this joint and every joint it hangs on.
      for (int a = b; a >= 1; a = model_.joints[a - 1].parent) {
        const JointModel& other = model_.joints[a - 1];
        const int columns = a == b ? k + 1 : other.dof();
        for (int l = 0; l < columns; ++l) {
          const int column = other.velocity_offset + l;
          const UnitMotion& m = unit_motions_[column];
          mass_(row, column) = mass_(column, row) = m.w.dot(spin) + m.v.dot(momentum);
        }
      }
    }
    if (joint.parent == 0) continue;
    force_[joint.parent] += force_[b];
    torque_[joint.parent] += torque_[b];
    composite_[joint.parent].mass += c.mass;
    composite_[joint.parent].moment += c.moment;
    composite_[joint.parent].inertia += c.inertia;
  }
}

Vec3 KinematicTree::ball_velocity(int joint) const {
  const double* s = &u_[model_.joints[joint].velocity_offset];
  return views_[joint].R_WC.transpose() * Vec3(s[0], s[1], s[2]);
}

}  // namespace anthrob
