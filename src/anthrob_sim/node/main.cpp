#include <ros/ros.h>

#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "anthrob_core/errors.h"
#include "anthrob_ros/parameters.h"
#include "anthrob_ros/run_node.h"
#include "anthrob_ros/single_backend.h"
#include "simulator_node.h"

namespace {

/// @return whether the word says that motion capture measures the ball joints
bool measured_by_cameras(const std::string& key, const XmlRpc::XmlRpcValue& value) {
  const std::string word = anthrob::text_of(key, value);
  if (word == "virtual") return true;
  if (word == "none") return false;
  throw anthrob::BadInput("parameter ~" + key + ": '" + word +
                          "': expected virtual or none (launch files: true or false, too)");
}

std::vector<std::string> words_of(const std::string& key, const XmlRpc::XmlRpcValue& value) {
  std::istringstream text(anthrob::text_of(key, value));
  return {std::istream_iterator<std::string>(text), {}};
}

}  // namespace

int main(int argc, char** argv) {
  anthrob::NodeInfo info;
  info.name = "simulator";
  info.purpose =
      "The simulated robot: simulates physics, sensors and controllers instead of the hardware.";
  info.role = anthrob::NodeInfo::Role::kBackEnd;
  info.parameters = {
      {"model", "model file, or a name such as anthrob/II (required)"},
      {"step", "simulation step [s], in [1e-07, 0.1] (default: 0.001)"},
      {"rate", "real-time factor, 0: as fast as possible (default: 1)"},
      {"state_rate", "rate of states and clock [Hz of simulated time], at least 1 (default: 500)"},
      {"paused", "start paused: sim/step advances time, sim/pause lets it run (default: false)"},
      {"mocap",
       "virtual: cameras measure the ball joints, and the simulator's own go to "
       "sim/spherical_joint_states; none: they do not (default: none)"},
      {"quantities", "paths of what sim/quantities publishes, separated by spaces (default: none)"},
      {"auto_enable", "enable the motors at the start (default: true)"},
      {"command_timeout",
       "motors stop after this time without commands [s], 0: never (default: 0.5)"},
      {"hint", "what to try next, said once the robot runs (default: nothing)"},
  };
  return anthrob::run_node(argc, argv, info, [](ros::NodeHandle& nh, ros::NodeHandle& settings) {
    using namespace anthrob;
    // First of all: whatever else is wrong, our launch file may have set the time of a robot.
    const ros::Publisher claim = claim_robot(nh);
    const std::string file = required_model(settings);
    LoadOptions load;
    take(settings, "step", number_of, load.step);
    if (!(load.step >= kMinimumStep && load.step <= kMaximumStep)) {
      throw BadInput("parameter ~step: " + std::to_string(load.step) +
                     ": expected a number in [1e-07, 0.1] [s]");
    }
    SimulatorNode::Options options;
    take(settings, "rate", nonnegative_number_of, options.rate);
    if (options.rate > 0.0 && options.rate < SimulatorNode::kSlowest) {
      throw BadInput("parameter ~rate: " + std::to_string(options.rate) +
                     ": expected 0, for as fast as possible, or at least 0.001");
    }
    take(settings, "state_rate", number_of, options.state_rate);
    take(settings, "paused", truth_of, options.paused);
    take(settings, "mocap", measured_by_cameras, options.motion_capture);
    take(settings, "quantities", words_of, options.quantities);
    options.supervisor.auto_enable = true;
    take(settings, "auto_enable", truth_of, options.supervisor.auto_enable);
    take(settings, "command_timeout", nonnegative_number_of, options.supervisor.command_timeout);
    take(settings, "hint", text_of, options.hint);
    if (!(options.state_rate >= 1.0))
      throw BadInput("parameter ~state_rate: " + std::to_string(options.state_rate) +
                     ": expected a number >= 1 [Hz]");
    const auto model = load_robot_model(file, load);
    for (const std::string& remark : model->remarks) ROS_WARN_STREAM(remark);
    SimulatorNode node(model, options, nh);
    node.run();
    return 0;
  });
}
