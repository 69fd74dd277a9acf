// Plays a recording as if its robot were there.
#include "anthrob_core/errors.h"
#include "anthrob_ros/parameters.h"
#include "anthrob_ros/run_node.h"
#include "player.h"

int main(int argc, char** argv) {
  anthrob::NodeInfo info;
  info.name = "player";
  info.ends_by_itself = true;
  info.purpose =
      "Plays a robot's state from a bag into this namespace, and the clock of that time. "
      "Offers the services seek, pause and set_rate, and the topic state.";
  info.parameters = {
      {"bag", "the recording, as a whole path (required)"},
      {"rate", "factor of the recorded speed (default: 1)"},
      {"loop", "begin again at the end (default: true); false: end there"},
  };
  return anthrob::run_node(argc, argv, info, [](ros::NodeHandle& nh, ros::NodeHandle& settings) {
    const std::string file = anthrob::required(
        settings, "bag", "the whole path of a bag (play.launch: bag:=$PWD/run.bag)");
    anthrob::Playback::Options options;
    anthrob::take(settings, "rate", anthrob::positive_number_of, options.rate);
    anthrob::take(settings, "loop", anthrob::truth_of, options.loop);
    anthrob::PlayedBag bag(file, nh.getNamespace().substr(1));
    anthrob::Player player(nh, settings, bag, options);
    return player.run() ? 0 : 130;
  });
}
