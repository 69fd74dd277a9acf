// Reads, changes and saves the gains of a robot that runs, simulated or real.
#include <anthrob_msgs/Gains.h>
#include <ros/ros.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "anthrob_core/command_line.h"
#include "anthrob_core/config_node.h"
#include "anthrob_core/errors.h"
#include "anthrob_core/files.h"
#include "anthrob_ecu/gains.h"
#include "anthrob_ros/master_uri.h"
#include "gains_file.h"

namespace {

namespace fs = std::filesystem;
using anthrob::BadInput;
using anthrob_msgs::Gains;

constexpr double kPatience = 5.0;  // [s] for the robot's service

struct Arguments {
  std::string robot = "anthrob", save, model;
  std::vector<std::string> changes;
};

/// "MUSCLE/GAIN=VALUE"
void read_change(const std::string& text, Gains::Request& request) {
  const std::size_t slash = text.find('/'), equals = text.find('=');
  char* end = nullptr;
  const double value =
      equals == std::string::npos ? 0.0 : std::strtod(text.c_str() + equals + 1, &end);
  if (slash == std::string::npos || equals == std::string::npos || slash > equals ||
      end == text.c_str() + equals + 1 || *end != 0) {
    throw BadInput(text + ": expected MUSCLE/GAIN=VALUE or all/GAIN=VALUE");
  }
  const std::string muscle = text.substr(0, slash);
  // The service takes an empty name for all muscles: an unset variable of a shell must not.
  if (muscle.empty()) throw BadInput(text + ": no muscle; expected MUSCLE/GAIN=VALUE or all/...");
  request.muscle.push_back(muscle == "all" ? "" : muscle);
  request.gain.push_back(text.substr(slash + 1, equals - slash - 1));
  request.value.push_back(value);
}

Gains::Response ask(const std::string& robot, Gains::Request& request) {
  if (!ros::master::check())
    throw std::runtime_error("no ROS master: start the robot or the simulator first");
  const std::string service = "/" + robot + "/gains";
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(kPatience);
  while (!ros::service::exists(service, false)) {
    if (ros::WallTime::now() > end)
      throw std::runtime_error(service + ": no robot answers; is --robot its namespace?");
    ros::WallDuration(0.1).sleep();
  }
  Gains::Response response;
  if (!ros::service::call(service, request, response)) {
    throw std::runtime_error(service + ": the call failed");
  }
  return response;
}

/// Finds what the robot would refuse, before it is asked to change anything.
/// @param held the robot's reply to a request without changes
void check(const Gains::Request& request, const Gains::Response& held) {
  const auto known = [](const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  for (std::size_t i = 0; i < request.muscle.size(); ++i) {
    const anthrob::ecu::ParameterInfo* info = anthrob::ecu::find_gain(request.gain[i]);
    if (!request.muscle[i].empty() && !known(held.held_muscle, request.muscle[i])) {
      throw BadInput(request.muscle[i] + ": unknown muscle; expected one of the robot's, or all");
    }
    if (!info || !known(held.held_gain, request.gain[i])) {
      throw BadInput(request.gain[i] + ": unknown gain; expected e.g. position_proportional");
    }
    const double value = request.value[i];
    if (value >= info->lowest && value <= info->highest) continue;
    char text[160];
    std::snprintf(text, sizeof(text), "%s=%g: expected %g to %g %s", info->name, value,
                  static_cast<double>(info->lowest), static_cast<double>(info->highest),
                  info->unit);
    throw BadInput(text);
  }
}

/// @throws BadInput if --save would overwrite the model or a file that it extends
std::shared_ptr<const anthrob::RobotModel> load(const Arguments& arguments) {
  const auto model = anthrob::load_robot_model(arguments.model);
  const std::string out = anthrob::place_of(arguments.save).string();
  for (const std::string& file : anthrob::extended_files(arguments.model)) {
    if (file == out) {
      throw BadInput("--save " + arguments.save +
                     ": expected another file than the model "
                     "and those that it extends");
    }
  }
  return model;
}

/// @throws BadInput if the model is another robot's
std::string file_of(const Gains::Response& response, const anthrob::RobotModel& model,
                    const Arguments& arguments) {
  anthrob::HeldGains held;
  for (std::size_t i = 0; i < response.held_muscle.size(); ++i) {
    held[response.held_muscle[i]][response.held_gain[i]] = response.held_value[i];
  }
  const fs::path base = fs::absolute(arguments.model), out = fs::absolute(arguments.save);
  return anthrob::gains_file(model, held, fs::proximate(base, out.parent_path()).string());
}

void save(const Gains::Response& response, const anthrob::RobotModel& model,
          const Arguments& arguments) {
  anthrob::write_file_atomically(arguments.save, file_of(response, model, arguments));
}

int run(const Arguments& arguments) {
  if (arguments.save.empty() != arguments.model.empty()) {
    throw BadInput("--save FILE and --model FILE: expected both or neither");
  }
  const auto model = arguments.save.empty() ? nullptr : load(arguments);
  Gains::Request request, nothing;
  for (const std::string& change : arguments.changes) read_change(change, request);
  Gains::Response response = ask(arguments.robot, nothing);
  check(request, response);
  if (model) file_of(response, *model, arguments);  // refuses before anything is changed
  if (!arguments.changes.empty()) response = ask(arguments.robot, request);
  for (std::size_t i = 0; i < response.held_muscle.size(); ++i) {
    std::printf("%s/%s=%.9g\n", response.held_muscle[i].c_str(), response.held_gain[i].c_str(),
                response.held_value[i]);
  }
  if (!response.success) throw std::runtime_error(response.message);
  if (model) save(response, *model, arguments);
  return anthrob::tool::kDone;
}

}  // namespace

int main(int argc, char** argv) {
  const auto wrong = anthrob::wrong_master_uri({argv + 1, argv + argc});
  if (!wrong) {
    ros::init(argc, argv, "gains",
              ros::init_options::AnonymousName | ros::init_options::NoSigintHandler);
  }
  CLI::App app(
      "Reads, changes and saves the gains of a running robot or simulator. Without arguments it "
      "changes nothing. It prints all gains that are in force afterwards, as MUSCLE/GAIN=VALUE.",
      "anthrob_gains");
  Arguments arguments;
  app.add_option("changes", arguments.changes,
                 "gains to change: MUSCLE/GAIN=VALUE or all/GAIN=VALUE");
  app.add_option("--robot", arguments.robot, "namespace of the robot")->capture_default_str();
  app.add_option("--save", arguments.save,
                 "model file to write: extends --model by the gains that differ from it");
  app.add_option("--model", arguments.model, "model that the robot was started with")
      ->transform(anthrob::tool::model_or_file());
  return anthrob::tool::run(app, argc, argv, [&] {
    if (wrong) throw BadInput(*wrong);
    return run(arguments);
  });
}
