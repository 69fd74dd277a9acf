#pragma once

#include <vector>

#include "anthrob_sim/effects/effect.h"
#include "anthrob_sim/model/robot_model.h"
#include "anthrob_sim/muscle/muscle.h"
#include "anthrob_sim/skeleton/kinematic_tree.h"

namespace anthrob {

/// Applies the reading effects of a model to the true values, one after the other; the result is
/// what sensors measure. Empty without such effects: sensors then measure the true values directly.
class ReadingChain {
 public:
  struct Truth {
    const std::vector<Muscle>& muscles;
    const std::vector<double>& q;  ///< as Simulation::configuration
    const KinematicTree& tree;
  };

  /// @param model, store must outlive it
  ReadingChain(const RobotModel& model, StateStore& store);

  bool empty() const { return effects_.empty(); }
  /// The robot was placed.
  void reset(const Truth& truth);
  /// Once a step.
  void update(const Truth& truth);

  // Readings; only valid if not empty().
  const ecu::Measurement& muscle(std::size_t i) const { return readings().muscles[i]; }
  const double* positions() const { return readings().positions; }
  const double* velocities() const { return readings().velocities; }

  // The functions of ReadingEffect, for all effects together.
  double position_delay(std::size_t muscle) const;
  double true_position(std::size_t muscle, double position) const;
  double joint_delay() const;
  void true_joint_positions(double* positions) const;

 private:
  Readings readings() const;
  Readings true_readings(const Truth& truth) const;

  const SkeletonModel& skeleton_;
  const std::vector<std::shared_ptr<const ReadingEffect>>& effects_;
  StateStore& store_;
  std::size_t muscle_count_;
  std::size_t readings_offset_ = 0;
  std::vector<std::size_t> offsets_;  ///< of the effects' states
};

}  // namespace anthrob
