#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "anthrob_sim/model/robot_model.h"
#include "anthrob_sim/path/muscle_path.h"
#include "anthrob_sim/skeleton/kinematic_tree.h"

namespace anthrob {

/// Evaluates the model in a measured posture: moment arms, muscle lengths, gravity, inertia. All
/// quantities of ball joints are in the child's axes. Wrapping follows the motion from posture to
/// posture, as on the robot; a large change of posture is divided into small steps.
class PostureModel {
 public:
  /// Starts at rest.
  explicit PostureModel(std::shared_ptr<const RobotModel> model);

  /// @param q joint positions, size position_count   @param u velocities, size velocity_count
  /// @throws std::invalid_argument if sizes differ or a number is not finite
  void update(const std::vector<double>& q, const Eigen::VectorXd& u);

  const RobotModel& model() const { return *model_; }
  const std::vector<double>& configuration() const { return q_; }
  /// -dl/dq: one row per joint velocity, one column per muscle [m].
  const Eigen::MatrixXd& moment_arms() const { return arms_; }
  /// Joint torques that balance gravity and centrifugal forces [Nm].
  const Eigen::VectorXd& load() const { return load_; }
  const Eigen::MatrixXd& mass_matrix() const { return mass_; }
  double muscle_length(std::size_t muscle) const { return paths_[muscle].length(); }

 private:
  void place(const std::vector<double>& q, const std::vector<double>& u);
  void turn_into_child_axes();

  std::shared_ptr<const RobotModel> model_;
  KinematicTree tree_;
  std::vector<BodyState> bodies_;
  std::vector<MusclePath> paths_;
  std::vector<std::vector<double>> path_states_;
  std::vector<double> q_, way_, u_world_, zero_;
  Eigen::MatrixXd arms_, mass_;
  Eigen::VectorXd load_;
};

}  // namespace anthrob
