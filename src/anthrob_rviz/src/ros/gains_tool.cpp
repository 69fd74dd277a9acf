#include "ros/gains_tool.h"

#include <ros/param.h>
#include <sys/wait.h>

#include <cstdio>

namespace anthrob {
namespace {

/// As one word for the shell.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

/// Of the node that runs: the simulator, or the driver.
std::string model_of(const std::string& robot) {
  std::string model;
  for (const char* node : {"/simulator", "/driver"}) {
    if (ros::param::get(robot + node + "/model", model)) break;
  }
  return model;
}

std::string last_line(const std::string& text) {
  const std::size_t end = text.find_last_not_of('\n');
  if (end == std::string::npos) return {};
  const std::size_t begin = text.find_last_of('\n', end);
  return text.substr(begin == std::string::npos ? 0 : begin + 1, end - begin);
}

CallResult save(const std::string& robot, const std::string& file) {
  const std::string model = model_of(robot);
  if (model.empty()) {
    return {"save_gains", false, "neither " + robot + "/simulator nor /driver names its model"};
  }
  const std::string command = "rosrun anthrob_control anthrob_gains --robot " +
                              quoted(robot.substr(1)) + " --model " + quoted(model) + " --save " +
                              quoted(file) + " 2>&1";
  FILE* tool = popen(command.c_str(), "r");
  if (tool == nullptr) return {"save_gains", false, "cannot start anthrob_gains"};
  std::string output;
  char buffer[512];
  while (std::fgets(buffer, sizeof(buffer), tool) != nullptr) output += buffer;
  const int status = pclose(tool);
  const bool saved = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  return {"save_gains", saved, saved ? file + " extends " + model : last_line(output)};
}

}  // namespace

TimedCalls::Call call_of_gains_tool(const std::string& robot, const std::string& file) {
  return [=] { return save(robot, file); };
}

}  // namespace anthrob
