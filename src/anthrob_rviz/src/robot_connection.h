#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnostics.h"
#include "muscle_groups.h"
#include "muscle_reading.h"
#include "muscle_row.h"
#include "player_reading.h"
#include "reference_limits.h"
#include "timed_calls.h"
#include "twin_reading.h"

namespace anthrob {

/// What came from a robot since the last look.
struct News {
  std::optional<MuscleReadings> muscles;  ///< the newest
  std::vector<Diagnosis> diagnostics;
  std::vector<CallResult> answers;
  std::vector<MuscleGroup> antagonists;  ///< once, soon after connect()
  std::optional<PlayerReading> player;   ///< the newest, where a recording is played
  std::optional<GapReading> gap;         ///< the newest, where a twin runs
  std::optional<HealthReading> health;   ///< the newest, after a test of the tendons
  std::vector<JobReading> jobs;          ///< of the calibration node
};

/// A call of one of the robot's services, or of the tool that saves its gains: "save_gains".
struct ServiceRequest {
  std::string service;           ///< in the robot's namespace: "sim/pause"
  double limit = 5.0;            ///< [s] of wall time
  bool pause = false;            ///< of sim/pause and player/pause
  int steps = 1;                 ///< of sim/step
  double factor = 1.0;           ///< of sim/set_rate and player/set_rate
  double position = 0.0;         ///< of player/seek [s]
  std::string name = {};         ///< of sim/save and sim/restore; file of save_gains
  std::vector<Gain> gains = {};  ///< of gains: to be changed
};

/// A robot as a panel sees it. Nothing here waits, and all is called by the GUI's thread, except
/// that another one may send().
class RobotConnection {
 public:
  virtual ~RobotConnection() = default;

  /// @param robot its namespace from the root: "/anthrob"
  virtual void connect(const std::string& robot) = 0;
  virtual News look() = 0;
  virtual void send(const std::vector<Reference>& references) = 0;
  /// The answer comes with the news. @return false while a call of that service is under way
  virtual bool call(const ServiceRequest& request) = 0;
  /// A stop that asks for no answer, for when the service gives none: the topic emergency_stop.
  virtual void shout_stop() = 0;
  /// Asks a job of the calibration node (JobReading::job) to end with what it has.
  virtual void cancel(const std::string& job) = 0;
  /// The simulator's services are there.
  virtual bool simulated() const = 0;
  virtual ReferenceLimits limits() const = 0;
};

/// The namespace from the root that a user's text names; none if it cannot be one.
std::optional<std::string> robot_namespace(const std::string& text);

}  // namespace anthrob
