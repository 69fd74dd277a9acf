#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "anthrob_reference/joint_law.h"
#include "anthrob_reference/muscle.h"
#include "anthrob_reference/parameters.h"
#include "anthrob_reference/rosenbrock.h"
#include "anthrob_reference/skeleton.h"

namespace anthrob::reference {

/// The whole arm as one differential equation under held voltages. State: shoulder quaternion
/// (w, x, y, z), elbow, four velocities, then the MuscleState of each muscle. Contacts on cylinders
/// are constant here; update_contacts() belongs between the steps. The stiff part is friction of
/// eyelets (up to 1e5 / s) and joints, and the motors without load (1.5e4 / s).
class Dynamics final : public StiffSystem {
 public:
  explicit Dynamics(const ArmParameters& parameters);

  Eigen::Index size() const;
  JointState joints(const Eigen::VectorXd& x) const;
  void set_joints(const JointState& joints, Eigen::VectorXd* x) const;
  MuscleState muscle_state(const Eigen::VectorXd& x, std::size_t i) const;
  void set_muscle_state(std::size_t i, const MuscleState& state, Eigen::VectorXd* x) const;

  const Skeleton& skeleton() const { return skeleton_; }
  const std::vector<Muscle>& muscles() const { return muscles_; }
  void set_voltage(std::size_t i, double voltage) { voltages_[i] = voltage; }
  double voltage(std::size_t i) const { return voltages_[i]; }
  void scale_eyelet_friction(double factor);
  void add_law(std::size_t i, std::shared_ptr<MuscleLaw> law);
  void add_law(std::shared_ptr<JointLaw> law);
  /// Tells the laws that a step of h [s] has led to x.
  void settle(double h, const Eigen::VectorXd& x);

  void reset_contacts(const JointState& joints);
  void update_contacts(const JointState& joints);
  MuscleSolution solve_muscle(const Eigen::VectorXd& x, std::size_t i) const;
  /// The same for all muscles; the result lives until the next call on this object.
  const std::vector<MuscleSolution>& solve_muscles(const Eigen::VectorXd& x);

  void rate(const Eigen::VectorXd& x, Eigen::VectorXd* dx) override;
  void rate_and_prepare(const Eigen::VectorXd& x, double shift, Eigen::VectorXd* dx) override;
  void solve(Eigen::VectorXd* w) const override;

  /// All evaluations since the last rate_and_prepare() found the same rings taut and the same elbow
  /// stop pushing: the step that they belong to saw a smooth equation.
  bool smooth() const { return smooth_; }

 private:
  void note_regime(const JointState& state);
  Eigen::Vector3d shoulder_load(const JointState& state) const;

  Skeleton skeleton_;
  std::vector<Muscle> muscles_;
  std::vector<double> voltages_;
  std::vector<std::shared_ptr<JointLaw>> joint_laws_;
  bool has_laws_ = false;
  std::vector<MuscleSolution> solutions_;  // scratch, kept to avoid allocation
  Matrix4 mass_ = Matrix4::Identity();     // of the last rate()
  std::vector<bool> regime_;               // of the last rate(): rings taut, stop pushing
  std::vector<bool> first_regime_;
  bool smooth_ = true;
  double shift_ = 0.0;
  Matrix4 velocity_solver_ = Matrix4::Identity();
};

}  // namespace anthrob::reference
