#include <ros/ros.h>

#include "anthrob_core/errors.h"
#include "anthrob_core/robots.h"
#include "anthrob_ros/clock_wait.h"
#include "anthrob_ros/parameters.h"
#include "anthrob_ros/run_node.h"
#include "anthrob_ros/single_backend.h"
#include "driver_node.h"

namespace {

bool is_virtual(const std::string& can) {
  return can.rfind("vcan", 0) == 0;
}

/// What is only true of emulated ECUs is not said of a robot's, and they stay off its bus.
/// @throws anthrob::BadInput
void check_kind_of_ecus(const ros::NodeHandle& settings, const std::string& can) {
  using namespace anthrob;
  bool emulated = false, homed = false;
  take(settings, "emulated", truth_of, emulated);
  take(settings, "homed", truth_of, homed);
  if (emulated && !is_virtual(can)) {
    throw BadInput("parameter ~can: " + can +
                   ": expected a virtual interface, vcan0 or the like, since emulated ECUs would "
                   "disturb a robot on this bus");
  }
  if (homed && !emulated) {
    throw BadInput(
        "parameter ~homed: true: expected false, since a robot finds its zero by home; only "
        "emulated ECUs can know it from the start");
  }
}

}  // namespace

int main(int argc, char** argv) {
  anthrob::NodeInfo info;
  info.name = "driver";
  info.purpose = "Drives the robot's motors through their ECUs on a CAN bus.";
  info.role = anthrob::NodeInfo::Role::kBackEnd;
  info.parameters = {
      {"hardware", "path of hardware.yaml (required)"},
      {"model",
       "path of a model; refused unless its muscles, gains and limits are those of the model that "
       "hardware.yaml names (default: that model)"},
      {"can", "CAN interface (default: can0)"},
      {"emulated",
       "whether the ECUs are emulated; then ~can must be a virtual interface (default: false)"},
      {"homed", "whether the ECUs know their zero from the start; only emulated (default: false)"},
      {"hand", "whether the hand is attached (default: false)"},
      {"rate", "[Hz] of bus cycles and published states, 100 to 1000 (default: 200)"},
      {"command_timeout", "[s] without a fresh command after which the motors stop (default: 0.5)"},
      {"check_stamps",
       "whether commands stamped more than command_timeout ago or ahead are refused (default: "
       "true)"},
      {"first_step",
       "[rad] that a muscle's first POSITION reference may be away from its position; 0: no limit "
       "(default: 0.5; 0 on a vcan)"},
      {"realtime", "whether to ask for SCHED_FIFO and locked memory (default: false)"},
      {"pace",
       "speed of emulated ECUs relative to real time, in (0, 1]; a robot needs 1 (default: 1)"},
  };
  return anthrob::run_node(argc, argv, info, [](ros::NodeHandle& nh, ros::NodeHandle& settings) {
    using namespace anthrob;
    using namespace anthrob::driver;
    // Claim first: our first SYNC would stop another driver's motors, and our launch file may have
    // set /use_sim_time.
    const ros::Publisher claim = claim_robot(nh);
    const std::string file = required(settings, "hardware", "the path of hardware.yaml");
    std::string can = "can0";
    take(settings, "can", text_of, can);
    check_kind_of_ecus(settings, can);
    bool hand = false;
    take(settings, "hand", truth_of, hand);
    DriverThread::Options options;
    options.driver.first_step = is_virtual(can) ? 0.0 : 0.5;
    take(settings, "rate", number_of, options.driver.rate);
    take(settings, "command_timeout", number_of, options.driver.command_timeout);
    take(settings, "first_step", number_of, options.driver.first_step);
    bool check_stamps = true;
    take(settings, "check_stamps", truth_of, check_stamps);
    take(settings, "realtime", truth_of, options.realtime);
    take(settings, "pace", number_of, options.pace);
    if (!(options.pace > 0.0 && options.pace <= 1.0) || (options.pace < 1.0 && !is_virtual(can))) {
      throw BadInput("parameter ~pace: " + std::to_string(options.pace) + " with ~can " + can +
                     ": expected 1, or a number in (0, 1] on a vcan");
    }
    const Hardware hardware = load_hardware(file, hand);
    std::string model;
    take(settings, "model", text_of, model);
    if (!model.empty()) model = find_model_file(model);
    const auto other_than_wired =
        model.empty() ? std::nullopt : difference(hardware, load_hardware(file, hand, model));
    if (other_than_wired) {
      throw BadInput("parameter ~model: " + model +
                     ": expected the muscles, gains and limits of the model that " + file +
                     " names; different: " + *other_than_wired);
    }
    // A clock of another pace comes with the emulated units, which start when we do.
    const std::string no_time = options.pace < 1.0 ? "" : standing_clock(ros::WallDuration(5.0));
    if (!no_time.empty()) throw BadInput("measurements cannot be stamped: " + no_time);
    DriverNode node(hardware, options, can, check_stamps, nh);
    node.run();
    return 0;
  });
}
