// Records a robot by protocol. After an interruption, the same command continues.
#include <filesystem>

#include "anthrob_core/errors.h"
#include "anthrob_ros/parameters.h"
#include "anthrob_ros/run_node.h"
#include "recorder.h"

namespace {

constexpr double kPatience = 30.0;  // [s] of wall time that a robot may take to appear

/// @return false if ROS shut down first
/// @throws std::runtime_error if no robot answers, or if it refuses
bool enable(ros::NodeHandle& nh) {
  std_srvs::Trigger call;
  const std::string name = nh.resolveName("enable");
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(kPatience);
  // In short waits of wall time: a long wait of ROS time would never end while its clock stands.
  while (ros::ok() && !ros::service::exists(name, false) && ros::WallTime::now() < end)
    ros::WallDuration(0.1).sleep();
  if (!ros::ok()) return false;
  if (!ros::service::call(name, call)) {
    if (!ros::ok()) return false;
    throw std::runtime_error(name + ": no robot answers; start the driver or the simulator first");
  }
  if (!call.response.success) throw std::runtime_error("enable: " + call.response.message);
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  anthrob::NodeInfo info;
  info.name = "recorder";
  info.ends_by_itself = true;
  info.role = anthrob::NodeInfo::Role::kCommander;
  info.purpose = "Records equilibria or trajectories of a robot by protocol.";
  info.parameters = {
      {"model", "model file, or a name such as anthrob/II (required)"},
      {"protocol", "path of a protocol file (required)"},
      {"out", "folder to record into, as a whole path (required)"},
      {"robot_model",
       "path of the model that is simulated, which must be the same where a session goes on "
       "(default: not checked)"},
      {"approach_speed",
       "[rad/s] of the motors on the way to the rest posture at first (default: 1)"},
      {"enable", "true: enable the motors first (default: false)"},
      {"lock_step", "true: the recorder steps the simulator (default: false)"},
      {"steps", "with lock_step: simulation steps per reference (default: 5)"},
  };
  return anthrob::run_node(argc, argv, info, [](ros::NodeHandle& nh, ros::NodeHandle& settings) {
    const auto model = anthrob::load_robot_model(anthrob::required_model(settings));
    const auto protocol = anthrob::Protocol::load(
        anthrob::required(settings, "protocol", "a protocol file (launch files: protocol:=NAME)"),
        model);
    const std::string folder = anthrob::required(settings, "out", "a folder to record into");
    if (!std::filesystem::path(folder).is_absolute()) {
      // roslaunch starts nodes in a folder of its own.
      throw anthrob::BadInput("parameter ~out: " + folder +
                              ": expected a whole path, such as /home/me/run");
    }
    anthrob::RobotLink::Options options;
    anthrob::take(settings, "lock_step", anthrob::truth_of, options.lock_step);
    anthrob::take(settings, "steps", anthrob::positive_whole_number_of, options.steps);
    double approach_speed = anthrob::Approach::kSpeed;
    anthrob::take(settings, "approach_speed", anthrob::positive_number_of, approach_speed);
    bool enable_first = false;
    anthrob::take(settings, "enable", anthrob::truth_of, enable_first);
    if (options.lock_step && protocol.kind == anthrob::Protocol::Kind::kZeroGravity) {
      throw anthrob::BadInput(
          "parameter ~lock_step: true: expected false for a zero_gravity protocol, in which only "
          "the controller may step the simulator");
    }
    std::string robot_model;
    anthrob::take(settings, "robot_model", anthrob::text_of, robot_model);
    anthrob::Recorder recorder(nh, settings, model, protocol, folder, options, approach_speed,
                               robot_model);
    ROS_INFO_STREAM("recording into " << folder);
    const bool ready = !enable_first || enable(nh);
    return ready && recorder.run() ? 0 : 130;
  });
}
