#pragma once

#include <Eigen/Core>
#include <vector>

#include "anthrob_sim/friction/friction_law.h"
#include "anthrob_sim/skeleton/kinematic_tree.h"
#include "friction/bristle.h"
#include "friction/drive_shaft.h"
#include "friction/sliding_tendon.h"

namespace anthrob {

/// Finds, in joint coordinates, the velocity at the end of a step under everything that resists
/// motion: viscous and dry joint friction (3.6), drag, joint stops, tendons sliding over eyelets
/// (4.75), (4.76), and the motors of drives. All are taken at the end of the step, so that steep
/// friction neither rings nor creeps at a step of 1 ms:
///   M (u' - u) = h (tau - bias + resistance(u'))
/// Newton's method on that equation, primal-dual in the friction of tendons; joints held by dry
/// friction are an active set. Where friction falls with speed faster than inertia allows, the
/// equation has several solutions, and the method goes on to a stable one.
///
/// Dry joint friction acts like a joint motor with target speed zero and a bounded torque
/// (section 3.2). It is solved here and not by Bullet's motors because Bullet's rows cannot see the
/// tendons, whose friction works on the same joints. The bound is isotropic for ball joints, where
/// (3.7), (3.8) take a box.
class ResistanceSolver {
 public:
  /// What friction depends on beside motion, by joint; null: nothing of that kind.
  struct JointInputs {
    const double* loads = nullptr;                     ///< forces that joints carry [N]
    const double* efforts = nullptr;                   ///< that drive them [Nm, N]
    BristleState* bristles = nullptr;                  ///< one after the other, joint by joint
    const std::vector<DriveShaft*>* shafts = nullptr;  ///< of drives: get their torques
  };

  ResistanceSolver(const SkeletonModel& model, double step);

  /// @param tau generalised forces that do not depend on the solution, without bias forces [Nm, N]
  /// @param tendons get their tensions and sliding speeds filled in
  /// @param q joint positions
  void solve(const KinematicTree& tree, const std::vector<double>& q, const Eigen::VectorXd& tau,
             const std::vector<SlidingTendon*>& tendons, const JointInputs& inputs);

  /// The same for a given velocity at the end of the step, with which the tendons slide. Joint
  /// friction and stops could not change that velocity and are left out.
  void follow(const KinematicTree& tree, const std::vector<double>& velocity,
              const std::vector<SlidingTendon*>& tendons, const JointInputs& inputs);

  /// Generalised forces of friction and stops of one joint, hinge or prismatic, at a given velocity
  /// at the end of the step, of which only so much is certain.
  /// @param velocity as in follow()   @param sliding velocity at which friction is taken
  /// @param rest speed below which the joint may be at rest: dry
  /// friction is then any of those that can hold it [rad/s, m/s]
  /// @param inputs as in solve(), after the step
  ForceRange resistance_at(const std::vector<double>& q, int joint, double velocity, double sliding,
                           double rest, const JointInputs& inputs) const;

  /// How many bristles all joints have.
  std::size_t bristle_count() const { return bristles_.size(); }
  /// The most that they can give back [J].
  double bristle_energy(const BristleState* states) const;

  /// Velocity at the end of the step.
  const Eigen::VectorXd& velocity() const { return u_; }
  /// Generalised forces of joint friction and stops that belong to it, without those of drives.
  const Eigen::VectorXd& joint_torque() const { return joint_torque_; }
  /// How many sweeps the last solve took.
  int iterations() const { return iterations_; }

 private:
  /// A joint with dry friction: held at rest, or sliding against a known torque.
  struct DryJoint {
    int joint;
    bool held;
    Vec3 direction;       ///< of motion while sliding, unit; x only for one degree of freedom
    double level;         ///< friction while sliding [Nm]
    double proportional;  ///< part of it that goes with load and effort [Nm]
    double speed;         ///< to which `direction` belongs; 0 when it comes from rest [rad/s, m/s]
  };

  /// Bristles of a joint, and what the last sweep took for them.
  struct BristleJoint {
    int joint, dof;
    Bristle law;
    double state;                 ///< z at the beginning of the step
    double torque, slope, speed;  ///< [Nm], [Nms], [rad/s]
  };

  /// One side of a joint stop; constant in all sweeps of a step except for `push`. The push along
  /// `direction` is inside + slope * speed, where that is positive.
  struct Stop {
    int dof, count;
    Vec3 direction;        ///< in which the joint moves into it; x only for one degree of freedom
    double inside, slope;  ///< [Nm, Nms]
    double push;           ///< in the last sweep [Nm]
  };

  void start(const KinematicTree& tree, const Eigen::VectorXd& tau);
  void begin_bending(const JointInputs& inputs);
  void bend(BristleJoint& bristle, bool first);
  void find_stops(const KinematicTree& tree, const std::vector<double>& q);
  Stop stop_of(const JointModel& joint, const Vec3& direction, double depth) const;
  double push_of(const Stop& stop) const;
  void slide(SlidingTendon& tendon, bool first);
  void assemble(const KinematicTree& tree, const std::vector<SlidingTendon*>& tendons);
  void add_push(Stop& stop);
  void add_tendon(const SlidingTendon& tendon);
  void add_dry_friction();
  void add_turning(const DryJoint& dry, const JointModel& joint);
  bool solve_linear(const JointInputs& inputs);
  void turn_shafts(const std::vector<DriveShaft*>& shafts);
  void leave_unstable_speed(const KinematicTree& tree, const std::vector<SlidingTendon*>& tendons,
                            const JointInputs& inputs);
  bool revise_dry_friction();
  bool is_solved(const KinematicTree& tree) const;
  void finish(const std::vector<SlidingTendon*>& tendons, const JointInputs& inputs);
  void commit(const std::vector<SlidingTendon*>& tendons, const JointInputs& inputs);

  const SkeletonModel& model_;
  double step_;
  std::vector<DryJoint> dry_;
  std::vector<BristleJoint> bristles_;
  std::vector<Stop> stops_;
  std::vector<char> held_;  ///< by generalised velocity
  Eigen::VectorXd constant_, rhs_, u_, next_, joint_torque_;
  Eigen::VectorXd damping_;  ///< of this step, viscous and quadratic [Nms/rad, Ns/m]
  Eigen::VectorXd
      surprise_;  ///< torque of tendons and bristles that the last sweep did not predict [Nm, N]
  Eigen::MatrixXd responses_;        ///< of velocities to the torques of drives, by column
  Eigen::MatrixXd system_, factor_;  ///< above the diagonal complete only where joints are dry
  int iterations_ = 0;
  bool falling_ = false;  ///< allow negative friction slopes in the linearisation
};

}  // namespace anthrob
