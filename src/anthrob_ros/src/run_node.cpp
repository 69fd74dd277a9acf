#include "anthrob_ros/run_node.h"

#include <algorithm>
#include <iostream>
#include <sstream>

#include "anthrob_core/errors.h"
#include "anthrob_core/signals.h"
#include "anthrob_core/version.h"
#include "anthrob_ros/descriptor_watch.h"
#include "anthrob_ros/master_uri.h"
#include "anthrob_ros/parameters.h"
#include "anthrob_ros/registration_watch.h"
#include "anthrob_ros/single_backend.h"

namespace anthrob {

namespace {

constexpr double kWatchPeriod = 5.0;  // [s] of the registration watch of nodes that move nothing
constexpr int kDone = 0, kFailed = 1, kBadInput = 2, kInterrupted = 130;

const NodeInfo::Parameter kBackEndParameter = {
    "back_end",
    "name of the only back end that may be commanded, such as simulator (default: any)"};

bool asks_for_help(const std::string& argument) {
  return argument == "--help" || argument == "-h";
}

std::string program_of(const std::string& path) {
  return path.substr(path.rfind('/') + 1);
}

std::string keys_of(const NodeInfo& info) {
  std::string keys;
  for (const auto& parameter : info.parameters) {
    keys += (keys.empty() ? "~" : ", ~") + parameter.key;
  }
  return keys;
}

bool begins(const std::string& text, const std::string& beginning) {
  return text.rfind(beginning, 0) == 0;
}

/// A master keeps the parameters of a node that has ended. roslaunch, which gives its nodes a log
/// file, sets what they need; a command line sets what it names.
bool is_left_over(const std::string& key, const std::vector<std::string>& arguments) {
  return std::none_of(arguments.begin(), arguments.end(), [&](const std::string& argument) {
    return begins(argument, "__log:=") || begins(argument, "_" + key + ":=");
  });
}

std::string value_of(const std::string& parameter) {
  XmlRpc::XmlRpcValue value;
  ros::param::get(parameter, value);
  std::ostringstream text;
  text << value;
  return text.str();
}

void warn_of_odd_parameters(const NodeInfo& info, const std::string& own,
                            const std::vector<std::string>& arguments) {
  std::vector<std::string> names;
  ros::param::getParamNames(names);
  for (const std::string& name : names) {
    if (name.compare(0, own.size() + 1, own + "/") != 0) continue;
    const std::string key = name.substr(own.size() + 1);
    // Keys with a slash belong to libraries, such as image_transport.
    if (key.find('/') != std::string::npos) continue;
    const std::string remove = " (to remove it: rosparam delete " + name + ")";
    if (!info.has(key)) {
      ROS_WARN_STREAM("parameter ~" << key << ": ignored; this node only knows " << keys_of(info)
                                    << remove);
    } else if (is_left_over(key, arguments)) {
      ROS_WARN_STREAM("parameter ~" << key << ": " << value_of(name)
                                    << ", from the parameter server, not from this command line; "
                                       "an earlier run may have left it there"
                                    << remove);
    }
  }
}

}  // namespace

bool NodeInfo::has(const std::string& key) const {
  return std::any_of(parameters.begin(), parameters.end(),
                     [&](const Parameter& parameter) { return parameter.key == key; });
}

std::string help_of(const NodeInfo& info, const std::string& program) {
  std::size_t width = 0;
  for (const auto& parameter : info.parameters) width = std::max(width, parameter.key.size());
  std::string text = info.purpose + "\nUsage: " + program_of(program) +
                     " _PARAMETER:=VALUE ... [__ns:=ROBOT] [__name:=NAME]\n\nParameters:\n";
  for (const auto& [key, meaning] : info.parameters) {
    text += "  _" + key + std::string(width + 2 - key.size(), ' ') + meaning + "\n";
  }
  return text;
}

std::optional<std::string> wrong_argument(const NodeInfo& info,
                                          const std::vector<std::string>& arguments) {
  for (const std::string& argument : arguments) {
    const std::size_t assignment = argument.find(":=");
    if (assignment == std::string::npos) {
      return "argument '" + argument + "': expected _PARAMETER:=VALUE, --help or --version";
    }
    const bool is_parameter = argument[0] == '_' && argument[1] != '_';
    const std::string key = argument.substr(1, assignment - 1);
    if (is_parameter && !info.has(key)) {
      return "parameter ~" + key + ": unknown; expected one of " + keys_of(info);
    }
  }
  return std::nullopt;
}

int run_node(int argc, char** argv, NodeInfo info, const NodeBody& body) {
  const bool commands = info.role == NodeInfo::Role::kCommander;
  if (commands) info.parameters.push_back(kBackEndParameter);
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (std::any_of(arguments.begin(), arguments.end(), asks_for_help)) {
    std::cout << help_of(info, argv[0]);
    return 0;
  }
  if (std::find(arguments.begin(), arguments.end(), "--version") != arguments.end()) {
    std::cout << version_of(program_of(argv[0])) << "\n";
    return 0;
  }
  if (const auto wrong = wrong_argument(info, arguments)) {
    std::cerr << *wrong << "\n";
    return kBadInput;
  }
  if (const auto wrong = wrong_master_uri(arguments)) {
    std::cerr << *wrong << "\n";
    return kBadInput;
  }
  leave_when_stopped(info.ends_by_itself ? kInterrupted : kDone);
  raise_descriptor_limit();
  try {
    // ROS would listen to Ctrl-C only, and only once there is a master.
    ros::init(argc, argv, info.name, info.options | ros::init_options::NoSigintHandler);
  } catch (const ros::Exception& error) {  // not a valid name
    std::cerr << error.what() << "\n";
    return kBadInput;
  }
  if (name_is_taken()) {
    if (info.role != NodeInfo::Role::kOther) restore_time();
    return kBadInput;
  }
  // These handles outlive those of the body: without any handle nothing is logged.
  ros::NodeHandle nh, settings("~");
  on_stop([](int) { ros::requestShutdown(); });
  try {
    warn_of_odd_parameters(info, settings.getNamespace(), arguments);
    if (commands) {
      std::string own;
      take(settings, kBackEndParameter.key, text_of, own);
      refuse_other_back_ends(nh, own);
    }
    // Back ends and commanders have a watch that stops what they do; all others only need to be
    // found again.
    std::optional<RegistrationWatch> watch;
    if (info.role == NodeInfo::Role::kOther) watch.emplace(RegistrationWatch::Lost(), kWatchPeriod);
    return body(nh, settings);
  } catch (const BadInput& error) {
    ROS_FATAL_STREAM(error.what());
    return kBadInput;
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(info.name << ": " << error.what());
    return kFailed;
  }
}

}  // namespace anthrob
