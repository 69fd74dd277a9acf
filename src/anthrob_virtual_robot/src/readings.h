#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace anthrob::virtual_robot {

/// What can be measured of a muscle.
struct MuscleReading {
  double position = 0.0;  ///< gear output, winding in positive [rad]
  double velocity = 0.0;  ///< [rad/s]
  double current = 0.0;   ///< [A]
  double force = 0.0;     ///< tension of the first segment [N]
};

/// What can be measured of the robot at one time.
struct Readings {
  double t = 0.0;  ///< [s] since the robot was placed
  std::vector<MuscleReading> muscles;
  Eigen::Quaterniond shoulder = Eigen::Quaterniond::Identity();  ///< from rest, w >= 0
  double elbow = 0.0;                                            ///< [rad]
};

/// A law that changes the true values before the sensors measure them; applied once per ECU period,
/// in the order of installation.
class ReadingLaw {
 public:
  virtual ~ReadingLaw() = default;
  /// The robot was placed: forget earlier readings.
  virtual void start() {}
  virtual void apply(Readings* readings) = 0;
};

/// A law that changes the voltages between control law and motors, once per ECU period.
class PowerLaw {
 public:
  virtual ~PowerLaw() = default;
  /// @param seconds since the last call  @param true_readings of the same time
  virtual void apply(double seconds, const Readings& true_readings,
                     std::vector<double>* voltages) = 0;
};

/// A law that changes the references between commands and control law, once per ECU period.
class CommandLaw {
 public:
  virtual ~CommandLaw() = default;
  virtual void apply(double t, std::vector<double>* references) = 0;
};

}  // namespace anthrob::virtual_robot
