#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "anthrob_sim/muscle/muscle.h"
#include "anthrob_sim/sensing/sensor.h"
#include "anthrob_sim/simulation.h"
#include "friction/resistance_solver.h"
#include "simulation/reading_chain.h"
#include "skeleton/joint_loads.h"
#include "skeleton/skeleton.h"

namespace anthrob {

/// What a simulation is made of, and how it takes a step.
class Simulation::Parts {
 public:
  explicit Parts(std::shared_ptr<const RobotModel> model);

  void step_once();
  /// Puts skeleton and sensors into the posture q_, at rest, after the muscles were placed there.
  void settle_in(const std::vector<BodyState>& bodies);

  double time() const { return static_cast<double>(step_index_) * model_->step; }
  ecu::Measurement reading(std::size_t muscle) const {
    return readings_.empty() ? muscles_[muscle].truth() : readings_.muscle(muscle);
  }
  /// Simulation::lacking_effort()
  LackingEffort lacking_effort(int joint, double rest) const;
  double bristle_energy() const { return resistance_.bristle_energy(bristles()); }
  const double* read_positions() const {
    return readings_.empty() ? q_.data() : readings_.positions();
  }

 private:
  friend class Simulation;

  void reserve_effects();
  void reset_effects();
  void add_joint_torques();
  ResistanceSolver::JointInputs joint_inputs() const;
  BristleState* bristles() const { return &store_.at(bristles_offset_).as<BristleState>(); }
  void head_for_posture();
  /// Efforts that the joints lack to go on with `heading_`, without friction and stops.
  void find_lacking_efforts();
  void move_skeleton();
  /// What arrives at the motors' terminals in this step.
  void find_voltages();
  void advance_actuators();
  ReadingChain::Truth truth() const { return {muscles_, q_, tree_}; }
  void apply_wrenches();
  void apply_joint_efforts();
  void sense();
  /// By how much the position of a joint with a drive is ahead: it advances by the velocity of the
  /// step's end, which shows beside its motor, whose equations are solved exactly [rad, m].
  double lead(std::size_t joint) const;
  void check_finite() const;

  std::shared_ptr<const RobotModel> model_;
  mutable StateStore store_;  ///< components hold views of it
  Skeleton skeleton_;
  KinematicTree tree_;
  ResistanceSolver resistance_;
  std::vector<Muscle> muscles_;
  ReadingChain readings_;
  MuscleInputs muscle_inputs_;
  ImposedPosture posture_;
  ExternalWrenches wrenches_;
  std::vector<SlidingTendon*> sliding_;
  std::vector<DriveShaft*> shafts_;
  std::vector<double> driving_;  ///< scratch: torques of drives, by joint; empty without drives
  std::vector<bool> has_drive_;  ///< by joint; empty without drives
  std::vector<Sensor> joint_sensors_;
  std::vector<double> q_, effort_, load_;
  std::vector<double> acting_;       ///< scratch: efforts that act
  Eigen::VectorXd way_;              ///< scratch: velocities to the imposed posture, child axes
  std::vector<double> heading_;      ///< scratch: the same, ball joints in world axes
  std::vector<BodyState> arriving_;  ///< scratch: body states at it
  std::size_t measured_offset_;      ///< measured joint positions
  std::vector<std::size_t> joint_sensor_offsets_;
  Eigen::VectorXd tau_;
  Eigen::VectorXd acceleration_, inertial_,
      lacking_;                          ///< by generalised velocity, while a posture is imposed
  std::vector<double> left_;             ///< scratch: joint positions before it was imposed
  std::optional<JointLoads> reactions_;  ///< once somebody asked for them
  // Of effects: empty in a plain model.
  JointLoads joint_loads_;
  Eigen::VectorXd joint_torque_;  ///< of joint_torques
  std::vector<PowerLine> lines_;  ///< scratch: one a muscle
  std::size_t loads_offset_ = 0;
  std::size_t bristles_offset_ = 0;
  std::vector<std::size_t> power_offsets_;
  std::size_t dissipation_offset_ = 0;
  std::uint64_t step_index_ = 0;
};

}  // namespace anthrob
