#include "skeleton/prismatic_constraint.h"

namespace anthrob {

namespace {

void set(btScalar* target, const btVector3& value) {
  for (int i = 0; i < 3; ++i) target[i] = value[i];
}

/// Axis times angle of a small rotation.
btVector3 rotation_vector(const btMatrix3x3& R) {
  btQuaternion q;
  R.getRotation(q);
  const btScalar sign = q.w() < 0 ? -1.0 : 1.0;
  const btVector3 axis = sign * btVector3(q.x(), q.y(), q.z());
  const btScalar sine = axis.length();
  return sine > 1e-12 ? axis * (2.0 * btAtan2(sine, sign * q.w()) / sine) : 2.0 * axis;
}

}  // namespace

void PrismaticConstraint::getInfo1(btConstraintInfo1* info) {
  info->m_numConstraintRows = 5;
  info->nub = 1;
}

void PrismaticConstraint::getInfo2(btConstraintInfo2* info) {
  const btTransform& X_WA = m_rbA.getCenterOfMassTransform();
  const btTransform& X_WB = m_rbB.getCenterOfMassTransform();
  const btTransform a = X_WA * frame_a_, b = X_WB * frame_b_;
  const btScalar rate = info->fps * info->erp;
  for (int i = 0; i < 2; ++i) {
    const int row = i * info->rowskip;
    const btVector3 n = a.getBasis().getColumn(i + 1);
    set(info->m_J1linearAxis + row, -n);
    set(info->m_J2linearAxis + row, n);
    set(info->m_J1angularAxis + row, -(b.getOrigin() - X_WA.getOrigin()).cross(n));
    set(info->m_J2angularAxis + row, (b.getOrigin() - X_WB.getOrigin()).cross(n));
    info->m_constraintError[row] = -rate * n.dot(b.getOrigin() - a.getOrigin());
  }
  const btVector3 turn = rotation_vector(b.getBasis() * a.getBasis().transpose());
  for (int i = 0; i < 3; ++i) {
    const int row = (2 + i) * info->rowskip;
    btVector3 axis(0, 0, 0);
    axis[i] = 1.0;
    set(info->m_J1angularAxis + row, -axis);
    set(info->m_J2angularAxis + row, axis);
    info->m_constraintError[row] = -rate * turn[i];
  }
}

}  // namespace anthrob
