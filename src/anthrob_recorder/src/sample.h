#pragma once

#include <string>
#include <vector>

#include "anthrob_control/robot_state.h"

namespace anthrob {

/// An equilibrium E = (theta, f, q) as measured (section 7.5.1).
struct Sample {
  double time = 0.0;             ///< [s] of ROS time
  std::vector<double> position;  ///< theta, by muscle [rad]
  std::vector<double> force;     ///< f, by muscle [N]
  std::vector<double> q;         ///< joint positions, as in a configuration
};

/// Mean of many measurements.
class SampleMean {
 public:
  explicit SampleMean(std::shared_ptr<const RobotModel> model);
  void reset();
  void add(const RobotMeasurement& measured);
  bool empty() const { return count_ == 0; }
  Sample mean(double time) const;

 private:
  std::shared_ptr<const RobotModel> model_;
  std::vector<double> position_, force_, first_q_;
  std::vector<double> forces_;        ///< how many numbers are in force_
  Eigen::VectorXd offset_, scratch_;  ///< sum of the differences from the first joint positions
  int count_ = 0;
};

/// The largest difference between two postures over all joints, and which joint has it.
double largest_difference(const RobotModel& model, const Sample& a, const Sample& b,
                          std::string& joint);

/// As a flow map: {position: {muscle: rad}, force: {muscle: N}, joints: {elbow: rad, shoulder: [w,
/// x, y, z]}}.
std::string sample_yaml(const RobotModel& model, const Sample& sample);
/// The inverse. @throws BadInput
Sample read_sample(const ConfigNode& node, const RobotModel& model);

}  // namespace anthrob
