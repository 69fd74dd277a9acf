#pragma once

#include <string>
#include <vector>

#include "anthrob_recording/dataset.h"
#include "anthrob_sim/model/robot_model.h"
#include "options/measurement.h"

namespace anthrob {
namespace discovery {

/// A value between two rows.
struct Interpolated {
  double value;
  double variance;  ///< of it, for rows with independent noise of variance 1
};
Interpolated interpolated(const Series& series, double time);

using Squares = std::vector<double>;  ///< by block of time
double sum_of(const std::vector<double>& squares);

/// One recording of a muscle under position control.
struct ControlledMuscle {
  std::string name;
  ecu::PositionGains gains;  ///< of the model
  Series voltage, reference, position, velocity, force;
  double voltage_noise = 0.0;  ///< squared [V^2]
  double weight = 0.0;         ///< 1 / (voltage_noise rows) [1/V^2]
  /// Squared, of the measurements [rad^2, (rad/s)^2, N^2].
  double position_noise = 0.0, velocity_noise = 0.0, force_noise = 0.0;
  std::vector<std::size_t> rows;                ///< of `voltage`, that are looked at
  std::size_t first_block = 0, last_block = 0;  ///< of its recording

  std::size_t block_of(std::size_t row, double length) const;
  /// Squares that this leaves in the voltages that these gains give [V^2].
  double noise(const ecu::PositionGains& of, double position_variance, double force_variance) const;
};

/// What says whether a control law gives the recorded voltages.
class ControlledMuscles {
 public:
  /// @param recordings that were taken alike; kept as copies of what is needed
  ControlledMuscles(const RobotModel& robot, const std::vector<const Dataset*>& recordings,
                    const ControllerAlgebraOptions& options);

  /// Whether the recordings have what a law needs.
  bool is_known() const { return noise_.size() >= options_.fewest_blocks && !muscles_.empty(); }
  const std::vector<ControlledMuscle>& muscles() const { return muscles_; }
  const ControllerAlgebraOptions& options() const { return options_; }
  double tick() const { return tick_; }  ///< [s]
  std::size_t blocks() const { return noise_.size(); }
  /// Of each recording, and the number of all.
  const std::vector<std::size_t>& first_blocks() const { return first_blocks_; }
  /// In standard errors over blocks, by how much the first leaves more than the second. Logarithms,
  /// because most of the squares may be in few blocks.
  double sureness(const Squares& first, const Squares& second) const;
  /// Squares in standard deviations of the voltages' own noise.
  double left(const Squares& squares) const;

 private:
  void add(const MuscleModel& muscle, const Dataset& recording, std::size_t most_rows);

  ControllerAlgebraOptions options_;
  double tick_ = 0.0;
  std::vector<std::size_t> first_blocks_;
  Squares noise_;  ///< that noise of the measurements leaves
  std::vector<ControlledMuscle> muscles_;
};

}  // namespace discovery
}  // namespace anthrob
