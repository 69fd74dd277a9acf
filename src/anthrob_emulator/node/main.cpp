// All ECUs of a robot in software on a CAN interface: what `backend:=emulated` starts, and a bench
// to try adapters and drivers with no robot and no ROS master.
#include <geometry_msgs/TransformStamped.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <tf2_ros/transform_broadcaster.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <iostream>
#include <memory>

#include "anthrob_core/monotonic_clock.h"
#include "anthrob_driver/emulation/emulator.h"
#include "anthrob_driver/emulation/tendon_plant.h"
#include "anthrob_driver/realtime.h"
#include "anthrob_ros/ball_joint_publisher.h"
#include "anthrob_ros/master_uri.h"
#include "anthrob_ros/single_backend.h"
#include "anthrob_sim/conversions.h"
#include "anthrob_sim/tool.h"
#include "simulator_plant.h"

namespace anthrob {
namespace {

struct Arguments {
  std::string hardware, model, can = "vcan0";
  bool hand = false, realtime = false, ros = false, clock = false, homed = false, physical = false;
  double rate = 100.0, pace = 1.0;
};

/// Stands in for motion capture: ball joints of the simulated robot, as the simulator's
/// sensors see them.
class BallJoints {
 public:
  explicit BallJoints(const Simulation& simulation)
      : simulation_(simulation), publisher_(robot_, "", 10) {}

  void publish() {
    const ros::Time now = ros::Time::now();
    for (const geometry_msgs::TransformStamped& turned : ball_joint_transforms(simulation_, now)) {
      transforms_.sendTransform(turned);
    }
    publisher_.publish(spherical_joint_states(simulation_, now));
  }

 private:
  const Simulation& simulation_;
  ros::NodeHandle robot_;
  BallJointPublisher publisher_;
  tf2_ros::TransformBroadcaster transforms_;
};

/// The robot's time as ROS time, so that controllers, too, have the pace of the robot. It is the
/// driver's time: the machine's monotonic clock, slowed down.
class RobotClock {
 public:
  explicit RobotClock(double pace)
      : pace_(pace), publisher_(ros::NodeHandle().advertise<rosgraph_msgs::Clock>("/clock", 100)) {}

  void publish() {
    rosgraph_msgs::Clock message;
    message.clock.fromSec(1.0 + pace_ * monotonic_now());  // zero would mean: unknown
    publisher_.publish(message);
  }

 private:
  double pace_;
  ros::Publisher publisher_;
};

/// Differs from start to start (it repeats after 64 s): after a restart of the emulator the driver
/// must notice that these are not the ECUs that it knew.
std::uint8_t session_now() {
  using Quarters = std::chrono::duration<std::int64_t, std::ratio<1, 4>>;
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return static_cast<std::uint8_t>(std::chrono::duration_cast<Quarters>(now).count());
}

int run(const Arguments& arguments) {
  driver::refuse_physical_bus(arguments.can, arguments.physical);
  if ((arguments.ros || arguments.clock) && name_is_taken()) {
    restore_time();
    return tool::kBadInput;
  }
  const bool hand = arguments.hand && driver::has_hand(arguments.hardware);
  const driver::Hardware hardware = driver::load_hardware(arguments.hardware, hand);
  std::unique_ptr<driver::Plant> plant;
  std::unique_ptr<BallJoints> balls;
  std::unique_ptr<RobotClock> clock;
  if (arguments.model.empty()) {
    plant = std::make_unique<driver::TendonPlant>(hardware);
  } else {
    auto simulated = std::make_unique<SimulatorPlant>(load_robot_model(arguments.model), hardware);
    if (arguments.ros) balls = std::make_unique<BallJoints>(simulated->simulation());
    plant = std::move(simulated);
  }
  driver::SocketCanBus bus(arguments.can);
  driver::Rack rack(hardware, *plant, bus, session_now());
  if (arguments.homed) rack.set_zeros();
  if (arguments.realtime) {
    const auto refused = driver::become_realtime(driver::Emulator::kPriority);
    if (refused) std::cerr << "anthrob_emulator: " << *refused << "\n";
  }
  const int ticks_per_message = std::max(1, static_cast<int>(1000.0 / arguments.rate));
  constexpr int kTicksPerClock = 2;
  int tick = 0;
  const auto each_tick = [&] {
    ++tick;
    // A driver that is refused sends no SYNC: then time and ball joints of this namespace are a
    // robot's.
    if (!rack.sync_seen()) return;
    if (arguments.clock && !clock) clock = std::make_unique<RobotClock>(arguments.pace);
    if (clock && tick % kTicksPerClock == 0) clock->publish();
    if (balls && tick % ticks_per_message == 0) balls->publish();
  };
  const auto quit = [&] {
    return tool::interrupted() || ((balls || arguments.clock) && !ros::ok());
  };
  driver::Emulator(rack, bus, arguments.pace).run(quit, each_tick);
  return tool::kDone;
}

}  // namespace
}  // namespace anthrob

int main(int argc, char** argv) {
  const auto wrong = anthrob::wrong_master_uri({argv + 1, argv + argc});
  if (!wrong) ros::init(argc, argv, "emulated_ecus", ros::init_options::NoSigintHandler);
  anthrob::Arguments arguments;
  CLI::App app("Emulated ECUs of a robot on a CAN interface", "anthrob_emulator");
  app.add_option("--hardware", arguments.hardware, "hardware.yaml of the robot")->required();
  app.add_option("--model", arguments.model,
                 "model for the simulator's physics; default: a test bench of motors and springs")
      ->transform(anthrob::tool::model_or_file());
  app.add_option("--can", arguments.can, "CAN interface; must be a vcan, see --physical")
      ->capture_default_str();
  app.add_flag("--physical", arguments.physical,
               "allow a physical interface; no robot may be connected to it");
  app.add_option("--rate", arguments.rate, "[Hz] of spherical_joint_states")
      ->capture_default_str()
      ->check(anthrob::tool::within(1.0, 1000.0));
  app.add_option("--pace", arguments.pace,
                 "speed relative to real time; set the driver's ~pace alike")
      ->capture_default_str()
      ->check(anthrob::tool::within(0.01, 1.0));
  app.add_flag("--hand", arguments.hand, "with the hand's muscles, if the robot has a hand");
  app.add_flag("--homed", arguments.homed,
               "the ECUs know the model's zero from the start; otherwise POSITION needs `home`");
  app.add_flag("--realtime", arguments.realtime,
               "real-time scheduling (SCHED_FIFO) and locked memory");
  app.add_flag("--ros", arguments.ros,
               "publish the ball joints, as motion capture would, once a driver sends SYNC");
  app.add_flag("--clock", arguments.clock,
               "publish /clock, the robot's time at --pace, once a driver sends SYNC");
  const auto body = [&] {
    if (wrong) throw anthrob::BadInput(*wrong);
    return anthrob::run(arguments);
  };
  return anthrob::tool::run(app, argc, argv, body, anthrob::tool::kDone);
}
