// Tests the tendons of a robot for a minute, and adds what it finds to the robot's history.
#include <filesystem>

#include "anthrob_core/errors.h"
#include "anthrob_core/progress_lines.h"
#include "anthrob_ros/parameters.h"
#include "anthrob_ros/run_node.h"
#include "health/health_report.h"
#include "health_run.h"

namespace {

using namespace anthrob;

constexpr double kDegree = M_PI / 180.0;

int test(ros::NodeHandle& nh, ros::NodeHandle& settings) {
  const auto model = load_robot_model(required_model(settings));
  const std::string folder = required(settings, "out", "a folder for the robot's history");
  if (!std::filesystem::path(folder).is_absolute()) {
    throw BadInput("parameter ~out: " + folder +
                   ": expected a whole path, such as /home/me/health");
  }
  RobotLink::Options link;
  take(settings, "lock_step", truth_of, link.lock_step);
  health::HealthOptions options;
  double largest = options.largest_turn / kDegree;
  take(settings, "largest_turn", positive_number_of, largest);
  options.largest_turn = largest * kDegree;
  require_writable(folder);
  health::History::load(folder +
                        "/health.csv");  // one that is broken is told before anything moves

  HealthRun run(nh, model, link, options);
  const auto recording = run.run();
  if (!recording) return 130;
  recording->save(folder + "/last_test");
  const auto report = health::add_to_history(folder, model->name, health::present_day(),
                                             health::measure(run.protocol(), *recording), options);
  ROS_INFO_STREAM(report.headline);
  for (const std::string& line : report.lines) ROS_WARN_STREAM(line);
  tool::progress_lines::headline(report.headline);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  anthrob::NodeInfo info;
  info.name = "health_test";
  info.ends_by_itself = true;
  info.role = anthrob::NodeInfo::Role::kCommander;
  info.purpose = "Tests the tendons of a robot at rest for a minute (docs/health.md).";
  info.parameters = {
      {"model", "model file, or a name such as anthrob/II (required)"},
      {"out", "folder of the robot's history, as a whole path (required)"},
      {"largest_turn", "[degrees] by which a joint may move, else the test ends (default: 2)"},
      {"lock_step", "true: the test steps the simulator (default: false)"},
  };
  return anthrob::run_node(argc, argv, info, [](ros::NodeHandle& nh, ros::NodeHandle& settings) {
    try {
      return test(nh, settings);
    } catch (const std::exception& error) {
      anthrob::tool::progress_lines::error(error.what());
      throw;
    }
  });
}
