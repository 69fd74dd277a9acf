#include "skeleton/tree_constraint_solver.h"

#include <LinearMath/btTransformUtil.h>

#include <cmath>

namespace anthrob {

namespace {

/// Change of angular velocity by the gyroscopic torque over one step, for a mean angular velocity.
btVector3 gyroscopic_change(const btRigidBody& body, const btVector3& mean, btScalar step) {
  const btMatrix3x3& R = body.getWorldTransform().getBasis();
  const btVector3& inverse = body.getInvInertiaDiagLocal();
  const btVector3 w = mean * R;
  const btVector3 momentum(w.x() / inverse.x(), w.y() / inverse.y(), w.z() / inverse.z());
  return R * (inverse * momentum.cross(w)) * step;
}

btTransform moved(const btRigidBody& body, const btTransform& from, btScalar step) {
  btTransform to;
  btTransformUtil::integrateTransform(from, body.getLinearVelocity(), body.getAngularVelocity(),
                                      step, to);
  return to;
}

/// value - a . b. The sum stays in a register, as it cannot in an element of what `a` and `b` may
/// be parts of.
double less(double value, const double* a, const double* b, int count) {
  for (int k = 0; k < count; ++k) value -= a[k] * b[k];
  return value;
}

/// Stays what it is: only limits and motors, which these joints lack, come and go.
int row_count(btTypedConstraint& constraint) {
  btTypedConstraint::btConstraintInfo1 size;
  constraint.getInfo1(&size);
  return size.m_numConstraintRows;
}

}  // namespace

TreeConstraintSolver::TreeConstraintSolver(const std::vector<btTypedConstraint*>& constraints,
                                           const std::vector<int>& parent_joint) {
  nodes_.resize(constraints.size());
  starts_.resize(constraints.size());
  for (Row& row : trial_) row.clear();
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    Node& node = nodes_[i];
    for (Row& row : node.rows) row.clear();
    node.constraint = constraints[i];
    node.parent_moves = parent_joint[i] >= 0;
    node.count = row_count(*node.constraint);
    if (!node.parent_moves) continue;
    node.couplings.push_back({parent_joint[i], false, {}});
    for (std::size_t k = 0; k < i; ++k) {
      if (parent_joint[k] == parent_joint[i]) {
        node.couplings.push_back({static_cast<int>(k), true, {}});
      }
    }
  }
}

void TreeConstraintSolver::Row::clear() {
  linear_a.setZero(), angular_a.setZero();
  linear_b.setZero(), angular_b.setZero();
  error = cfm = 0.0;
  low = -SIMD_INFINITY, high = SIMD_INFINITY;
}

void TreeConstraintSolver::step(double step, const std::vector<btRigidBody*>& bodies) {
  for (std::size_t i = 0; i < bodies.size(); ++i) apply_forces(*bodies[i], starts_[i], step);
  for (Node& node : nodes_) {
    read_rows(node, step, node.rows);
    add_responses(node);
  }
  for (Node& node : nodes_) assemble(node);
  factor();
  hold_joints_at_end(step, bodies);
  correct_gyroscopic_torque(step, bodies);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bodies[i]->proceedToTransform(moved(*bodies[i], starts_[i].pose, step));
    bodies[i]->clearForces();
  }
}

void TreeConstraintSolver::apply_forces(btRigidBody& body, Start& start, double step) {
  start.pose = body.getWorldTransform();
  start.spin = body.getAngularVelocity();
  start.gyroscopic = gyroscopic_change(body, start.spin, step);
  body.setLinearVelocity(body.getLinearVelocity() +
                         body.getTotalForce() * (body.getInvMass() * step));
  body.setAngularVelocity(start.spin + start.gyroscopic +
                          body.getInvInertiaTensorWorld() * body.getTotalTorque() * step);
}

void TreeConstraintSolver::hold_joints_at_end(double step,
                                              const std::vector<btRigidBody*>& bodies) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bodies[i]->setWorldTransform(moved(*bodies[i], starts_[i].pose, step));
  }
  for (Node& node : nodes_) {
    read_rows(node, step, trial_);
    for (int i = 0; i < node.count; ++i) node.rhs[i] = trial_[i].error;
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) bodies[i]->setWorldTransform(starts_[i].pose);
  substitute();
  apply_impulses();
}

void TreeConstraintSolver::correct_gyroscopic_torque(double step,
                                                     const std::vector<btRigidBody*>& bodies) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const btVector3 spin = bodies[i]->getAngularVelocity();
    const btVector3 mean = 0.5 * (starts_[i].spin + spin);
    starts_[i].correction = gyroscopic_change(*bodies[i], mean, step) - starts_[i].gyroscopic;
    bodies[i]->setAngularVelocity(spin + starts_[i].correction);
  }
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    Node& node = nodes_[n];
    const int parent = node.parent_moves ? node.couplings.front().later : -1;
    for (int i = 0; i < node.count; ++i) {
      node.rhs[i] = -node.rows[i].angular_b.dot(starts_[n].correction);
      if (parent >= 0) node.rhs[i] -= node.rows[i].angular_a.dot(starts_[parent].correction);
    }
  }
  substitute();
  apply_impulses();
}

void TreeConstraintSolver::read_rows(Node& node, double step, Row* rows) {
  btTypedConstraint::btConstraintInfo2 data;
  data.fps = 1.0 / step;
  data.erp = 1.0;
  data.m_J1linearAxis = rows->linear_a;
  data.m_J1angularAxis = rows->angular_a;
  data.m_J2linearAxis = rows->linear_b;
  data.m_J2angularAxis = rows->angular_b;
  data.rowskip = sizeof(Row) / sizeof(btScalar);
  data.m_constraintError = &rows->error;
  data.cfm = &rows->cfm;
  data.m_lowerLimit = &rows->low;
  data.m_upperLimit = &rows->high;
  data.m_numIterations = 1;
  data.m_damping = 1.0;
  node.constraint->getInfo2(&data);
}

void TreeConstraintSolver::add_responses(Node& node) {
  const btRigidBody& a = node.constraint->getRigidBodyA();
  const btRigidBody& b = node.constraint->getRigidBodyB();
  for (int i = 0; i < node.count; ++i) {
    Row& row = node.rows[i];
    if (node.parent_moves) row.response_a = a.getInvInertiaTensorWorld() * row.angular_a;
    row.response_b = b.getInvInertiaTensorWorld() * row.angular_b;
  }
}

void TreeConstraintSolver::assemble(Node& node) {
  const btScalar mass_a = node.constraint->getRigidBodyA().getInvMass();
  const btScalar mass_b = node.constraint->getRigidBodyB().getInvMass();
  for (int i = 0; i < node.count; ++i) {
    const Row& p = node.rows[i];
    for (int j = 0; j <= i; ++j) {
      const Row& q = node.rows[j];
      double sum = mass_b * p.linear_b.dot(q.linear_b) + p.response_b.dot(q.angular_b);
      if (node.parent_moves) {
        sum += mass_a * p.linear_a.dot(q.linear_a) + p.response_a.dot(q.angular_a);
      }
      node.diagonal[i][j] = node.diagonal[j][i] = sum;
    }
  }
  // The shared body is always body A of `node`.
  for (Coupling& coupling : node.couplings) {
    const Node& later = nodes_[coupling.later];
    for (int i = 0; i < later.count; ++i) {
      const Row& p = later.rows[i];
      const btVector3& linear = coupling.sibling ? p.linear_a : p.linear_b;
      const btVector3& angular = coupling.sibling ? p.angular_a : p.angular_b;
      for (int j = 0; j < node.count; ++j) {
        const Row& q = node.rows[j];
        coupling.block[i][j] = mass_a * linear.dot(q.linear_a) + angular.dot(q.response_a);
      }
    }
  }
}

TreeConstraintSolver::Block& TreeConstraintSolver::block(int later, int earlier) {
  for (Coupling& coupling : nodes_[earlier].couplings) {
    if (coupling.later == later) return coupling.block;
  }
  return nodes_[later].diagonal;
}

void TreeConstraintSolver::factor() {
  // Leaves first: diagonal = L L^T, coupling blocks become Y = A L^-T.
  for (int index = static_cast<int>(nodes_.size()) - 1; index >= 0; --index) {
    Node& node = nodes_[index];
    Block& L = node.diagonal;
    const int n = node.count;
    for (int j = 0; j < n; ++j) {
      node.inverse_pivot[j] = 1.0 / std::sqrt(less(L[j][j], L[j], L[j], j));
      for (int i = j + 1; i < n; ++i) {
        L[i][j] = less(L[i][j], L[i], L[j], j) * node.inverse_pivot[j];
      }
    }
    for (Coupling& coupling : node.couplings) {
      Block& Y = coupling.block;
      for (int i = 0; i < nodes_[coupling.later].count; ++i) {
        for (int j = 0; j < n; ++j) {
          Y[i][j] = less(Y[i][j], Y[i], L[j], j) * node.inverse_pivot[j];
        }
      }
    }
    for (Coupling& first : node.couplings) {
      for (Coupling& second : node.couplings) {
        if (second.later < first.later) continue;  // each pair once
        Block& target = block(first.later, second.later);
        for (int i = 0; i < nodes_[first.later].count; ++i) {
          for (int j = 0; j < nodes_[second.later].count; ++j) {
            target[i][j] = less(target[i][j], first.block[i], second.block[j], n);
          }
        }
      }
    }
  }
}

void TreeConstraintSolver::substitute() {
  for (int index = static_cast<int>(nodes_.size()) - 1; index >= 0; --index) {
    Node& node = nodes_[index];
    for (int j = 0; j < node.count; ++j) {
      node.rhs[j] = less(node.rhs[j], node.diagonal[j], node.rhs, j) * node.inverse_pivot[j];
    }
    for (const Coupling& coupling : node.couplings) {
      Node& later = nodes_[coupling.later];
      for (int i = 0; i < later.count; ++i) {
        later.rhs[i] = less(later.rhs[i], coupling.block[i], node.rhs, node.count);
      }
    }
  }
  for (Node& node : nodes_) {
    for (const Coupling& coupling : node.couplings) {
      const Node& later = nodes_[coupling.later];
      for (int j = 0; j < node.count; ++j) {
        double rest = node.rhs[j];
        for (int i = 0; i < later.count; ++i) rest -= coupling.block[i][j] * later.rhs[i];
        node.rhs[j] = rest;
      }
    }
    for (int j = node.count - 1; j >= 0; --j) {
      double rest = node.rhs[j];
      for (int i = j + 1; i < node.count; ++i) rest -= node.diagonal[i][j] * node.rhs[i];
      node.rhs[j] = rest * node.inverse_pivot[j];
    }
  }
}

void TreeConstraintSolver::apply_impulses() {
  for (Node& node : nodes_) {
    push(node, node.constraint->getRigidBodyB(), &Row::linear_b, &Row::response_b);
    if (!node.parent_moves) continue;
    push(node, node.constraint->getRigidBodyA(), &Row::linear_a, &Row::response_a);
  }
}

void TreeConstraintSolver::push(const Node& node, btRigidBody& body, btVector3 Row::*direction,
                                btVector3 Row::*response) {
  btVector3 linear(0, 0, 0), angular(0, 0, 0);
  for (int i = 0; i < node.count; ++i) {
    linear += node.rows[i].*direction * node.rhs[i];
    angular += node.rows[i].*response * node.rhs[i];
  }
  body.setLinearVelocity(body.getLinearVelocity() + linear * body.getInvMass());
  body.setAngularVelocity(body.getAngularVelocity() + angular);
}

}  // namespace anthrob
