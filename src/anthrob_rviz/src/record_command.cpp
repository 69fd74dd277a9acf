#include "record_command.h"

namespace anthrob {

std::vector<std::string> record_command(const std::string& robot, Recorded what,
                                        const std::string& file, int duration) {
  // Not `rosbag record`: that waits for the recorder and would have to hand the signal on.
  std::vector<std::string> command = {"rosrun", "rosbag", "record", "--output-name=" + file};
  if (duration > 0) command.push_back("--duration=" + std::to_string(duration));
  if (what == Recorded::kEverything) {
    command.push_back("--regex");
    command.push_back("(" + robot + "/.*|/tf|/tf_static|/clock|/diagnostics)");
    return command;
  }
  // From the root: a bag of relative names does not know its robot.
  for (const char* topic : {"muscle_command", "joint_effort_command", "muscle_states",
                            "joint_states", "spherical_joint_states", "external_wrenches"}) {
    command.push_back(robot + "/" + topic);
  }
  return command;
}

}  // namespace anthrob
