#pragma once

#include <btBulletDynamicsCommon.h>

#include <vector>

namespace anthrob {

/// Advances a tree of bodies under Bullet's joint constraints by one step, in place of Bullet's
/// iterative solvers.
///
/// Bodies are first moved as if there were no joints. Impulses along the constraints' directions at
/// the start of the step then remove the joints' position errors after that motion (SHAKE; Ryckaert
/// et al. 1977). So positions, not only velocities, satisfy the joints, energy does not drift, and
/// no error reduction parameter is needed. Gyroscopic torques follow the midpoint rule: Bullet's
/// implicit rule damps fast spin, its explicit one amplifies it.
///
/// The system (J M^-1 J^T + cfm) lambda = rhs couples two joints only if they share a body, so a
/// block Cholesky factorisation that starts at the leaves has no fill-in and costs O(joints).
/// Bullet's own solvers reach the same accuracy with 20 or more sweeps, or with a general LCP at
/// several times the cost. Rows must be equalities: contacts belong to Bullet's solvers (Skeleton
/// chooses).
class TreeConstraintSolver {
 public:
  static constexpr int kMaxRows = 6;

  /// @param constraints joint i, between body A (towards the root) and body B, which joint i moves
  /// @param parent_joint of joint i: the joint that moves its body A, or -1 if A is the world
  TreeConstraintSolver(const std::vector<btTypedConstraint*>& constraints,
                       const std::vector<int>& parent_joint);

  /// Applied forces, gyroscopic torque, joints, new poses. Applied forces are cleared.
  /// @param step [s]   @param bodies body i is moved by joint i
  void step(double step, const std::vector<btRigidBody*>& bodies);

 private:
  /// One constraint row as Bullet fills it in, and the response of the bodies to a unit impulse.
  struct Row {
    btVector3 linear_a, angular_a, linear_b, angular_b;
    btVector3 response_a, response_b;  ///< inverse inertia times angular_a, angular_b
    btScalar error, cfm, low, high;

    /// Called once: a joint fills in the same elements in every step.
    void clear();
  };
  using Block = double[kMaxRows][kMaxRows];
  /// Block (later, node) of the matrix, for a joint nearer the root that shares a body with `node`.
  struct Coupling {
    int later;
    bool sibling;  ///< both hang on the same body; otherwise `later` moves the body A of `node`
    Block block;
  };
  struct Node {
    btTypedConstraint* constraint;
    bool parent_moves;
    int count;
    Row rows[kMaxRows];
    Block diagonal;
    double rhs[kMaxRows];
    double inverse_pivot[kMaxRows];
    std::vector<Coupling> couplings;
  };

  /// A body at the start of a step.
  struct Start {
    btTransform pose;
    btVector3 spin;        ///< angular velocity
    btVector3 gyroscopic;  ///< change of spin by the gyroscopic torque, first guess
    btVector3 correction;  ///< to that guess
  };

  static void apply_forces(btRigidBody& body, Start& start, double step);
  void hold_joints_at_end(double step, const std::vector<btRigidBody*>& bodies);
  void correct_gyroscopic_torque(double step, const std::vector<btRigidBody*>& bodies);
  static void read_rows(Node& node, double step, Row* rows);
  static void add_responses(Node& node);
  void assemble(Node& node);
  void factor();
  /// Turns right-hand sides into impulses.
  void substitute();
  void apply_impulses();
  /// Impulses of all rows of a joint on one of its bodies.
  static void push(const Node& node, btRigidBody& body, btVector3 Row::*direction,
                   btVector3 Row::*response);
  Block& block(int later, int earlier);

  std::vector<Node> nodes_;
  std::vector<Start> starts_;
  Row trial_[kMaxRows];
};

}  // namespace anthrob
