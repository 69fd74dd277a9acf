#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "anthrob_recording/dataset.h"
#include "anthrob_sim/model/robot_model.h"

namespace anthrob {
namespace calibration {

/// What was measured at some instants: one row each.
struct Samples {
  std::vector<double> t;     ///< [s] since the first command
  double window = 0.0;       ///< each row is a mean over this time, t is its middle [s]
  Eigen::MatrixXd q;         ///< joint positions as in Simulation::configuration()
  Eigen::MatrixXd force;     ///< by muscle [N]
  Eigen::MatrixXd position;  ///< of actuators, by muscle [rad]; no columns: not measured
  /// Of so many measurements each row is a mean: of the slowest sensor's.
  double posture_measurements = 1.0, force_measurements = 1.0;

  int count() const { return static_cast<int>(t.size()); }
};

/// References of all muscles, in force from a time on.
struct Command {
  double t = 0.0;                 ///< [s] since the first command
  std::vector<double> reference;  ///< by muscle [rad]
};

/// A recording as calibration uses it: a robot at rest, commands, and the measured response.
/// Time starts when the references first change.
struct MeasuredRun {
  std::string name;
  bool is_trajectory = false;        ///< else: an equilibrium
  std::vector<double> start;         ///< references at which the robot was at rest [rad]
  std::vector<Command> commands;     ///< the first one at t = 0
  Samples before;                    ///< one row, the posture at rest; none for an equilibrium
  Samples path;                      ///< evenly spaced; none for an equilibrium
  Samples after;                     ///< one row: the posture at the end
  double settle = 5.0;               ///< time at `start` before the recording began [s]
  double lead = 0.0;                 ///< time from then to the first command [s]
  double duration = 0.0;             ///< time from the first command to the end [s]
  std::uint64_t content = 0;         ///< resume::content_fingerprint of its recording
  std::vector<std::string> remarks;  ///< of its recording
};

struct SamplingOptions {
  double rate = 100.0;    ///< of path [Hz]
  double average = 0.1;   ///< postures at rest are means over this time [s]
  double shortest = 0.5;  ///< least duration of a recording after its first command [s]
};

/// @throws BadInput with one line if the recording is not a run of this robot under position
/// control, or lacks columns that calibration needs
MeasuredRun read_run(const Dataset& recording, const std::shared_ptr<const RobotModel>& model,
                     const SamplingOptions& options = {});

/// @throws BadInput if one cannot be used, or if two are the same (for example a bag and the folder
/// that it was converted to)
std::vector<MeasuredRun> read_runs(const std::vector<Dataset>& recordings,
                                   const std::shared_ptr<const RobotModel>& model,
                                   const SamplingOptions& options = {});

}  // namespace calibration
}  // namespace anthrob
