// The calibration node: copies of the model beside a robot, calibration, discovery and tests of
// tendons on request. Only the test of tendons moves the robot.
#include <ros/ros.h>

#include "anthrob_core/errors.h"
#include "anthrob_ros/parameters.h"
#include "anthrob_ros/run_node.h"
#include "health_board.h"
#include "job_servers.h"
#include "twin_node.h"

namespace {

anthrob::twin::Feed feed_of(const std::string& key, const XmlRpc::XmlRpcValue& value) {
  using namespace anthrob::twin;
  const std::string word = anthrob::text_of(key, value);
  for (const Feed feed : kFeeds) {
    if (word == kFeedNames[static_cast<std::size_t>(feed)]) return feed;
  }
  throw anthrob::BadInput("parameter ~" + key + ": '" + word +
                          "': expected commands, voltages, positions or postures");
}

}  // namespace

int main(int argc, char** argv) {
  anthrob::NodeInfo info;
  info.name = "calibrator";
  info.purpose =
      "Copies of the model beside a robot: what they say now, and where both part. Calibrates and "
      "discovers on request (actions calibrate, discover), and tests tendons (health/test).";
  info.parameters = {
      {"model", "model file, or a name such as anthrob/II (default: none, and no copies)"},
      {"feed",
       "what drives the copy that is shown as twin/...: commands, voltages, positions or postures "
       "(default: commands)"},
      {"rate", "of twin/... [Hz of measured time], at most that of the measurement (default: 100)"},
      {"warn", "gap [floors] over 10 s from which on it is warned of (default: 4)"},
      {"largest_gap", "in the measurement [s] beyond which the robot was lost (default: 0.25)"},
      {"settle", "[s] after a start that do not count (default: 2)"},
      {"health", "folder of the robot's history of health/test, as a whole path (default: none)"},
      {"floors", "path of a file with floors that are not to be learned (default: none)"},
  };
  return anthrob::run_node(argc, argv, info, [](ros::NodeHandle& nh, ros::NodeHandle& settings) {
    anthrob::jobs::HealthOrder health;
    anthrob::take(settings, "model", anthrob::text_of, health.model);
    anthrob::take(settings, "health", anthrob::text_of, health.out);
    health.robot = nh.getNamespace();
    const anthrob::JobServers servers(nh, health);
    anthrob::TwinNode::Options options;
    anthrob::take(settings, "feed", feed_of, options.feed);
    anthrob::take(settings, "rate", anthrob::positive_number_of, options.rate);
    anthrob::take(settings, "warn", anthrob::positive_number_of, options.twins.warn);
    anthrob::take(settings, "largest_gap", anthrob::positive_number_of, options.twins.largest_gap);
    anthrob::take(settings, "settle", anthrob::nonnegative_number_of, options.twins.settle);
    anthrob::take(settings, "floors", anthrob::text_of, options.floors);
    if (!settings.hasParam("model")) {
      const anthrob::HealthBoard board(nh, health.out, "world");
      ros::spin();
      return 0;
    }
    const auto model = anthrob::load_robot_model(anthrob::required_model(settings));
    const anthrob::HealthBoard board(nh, health.out, model->skeleton->bodies[0].name);
    anthrob::TwinNode twins(model, options, nh);
    twins.run();
    return 0;
  });
}
