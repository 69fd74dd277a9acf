#pragma once

#include <string>
#include <vector>

#include "excitation.h"
#include "robot.h"

namespace anthrob::virtual_robot {

/// A row of a recording.
struct Sample {
  double t = 0.0;  ///< [s] since the recording began
  Readings readings;
  std::vector<double> voltages;
};

struct Recording {
  std::vector<Command> commands;
  std::vector<Sample> samples;
};

struct RecordingSettings {
  double settle = 5.0;     ///< at the first command [s]
  int muscle_divider = 5;  ///< a row every so many ECU periods
  int mocap_divider = 20;
};

/// Settles at the first command, then follows all commands as follow() does.
Recording record(Robot* robot, const std::vector<Command>& commands, double seconds,
                 const RecordingSettings& settings);

/// Continues from the present state of the robot; `t` of the commands counts from now.
Recording follow(Robot* robot, const std::vector<Command>& commands, double seconds,
                 const RecordingSettings& settings);

/// What meta.yaml says of a dataset folder.
struct Meta {
  std::string kind = "trajectory";
  double settle = 5.0;
  std::string sensors;  ///< YAML, indented by two
  bool has_elbow = true;
};

/// @throws std::runtime_error naming the file that cannot be written
void write_dataset(const Recording& recording, const std::vector<std::string>& muscle_names,
                   const RecordingSettings& settings, const Meta& meta, const std::string& folder);

}  // namespace anthrob::virtual_robot
