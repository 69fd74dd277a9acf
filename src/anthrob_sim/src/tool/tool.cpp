#include "anthrob_sim/tool/tool.h"

#include <ros/package.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <sstream>
#include <vector>

#include "anthrob_sim/core/errors.h"

namespace anthrob {
namespace tool {

namespace {

volatile std::sig_atomic_t interrupt_seen = 0;

std::string one_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  for (char& c : text) {
    if (c == '\n') c = ' ';
  }
  return text;
}

/// What roslaunch adds to a command line: "__name:=discover", "__log:=..."
bool is_remapping(const std::string& argument) {
  return argument.rfind("__", 0) == 0 && argument.find(":=") != std::string::npos;
}

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

int run(CLI::App& app, int argc, char** argv, const std::function<int()>& body) {
  std::vector<char*> arguments;
  std::copy_if(argv, argv + argc, std::back_inserter(arguments),
               [](const char* argument) { return !is_remapping(argument); });
  try {
    app.parse(static_cast<int>(arguments.size()), arguments.data());
    return body();
  } catch (const CLI::Success& e) {
    app.exit(e);
    return kDone;
  } catch (const CLI::ParseError& e) {
    std::cerr << app.get_name() << ": " << one_line(e.what()) << " (--help explains)\n";
    return kBadInput;
  } catch (const BadInput& e) {
    std::cerr << app.get_name() << ": " << e.what() << "\n";
    return kBadInput;
  } catch (const std::exception& e) {
    std::cerr << app.get_name() << ": " << one_line(e.what()) << "\n";
    return kFailed;
  }
}

bool interrupted() {
  static const bool kListening = [] {
    std::signal(SIGINT, [](int) { interrupt_seen = 1; });
    std::signal(SIGTERM, [](int) { interrupt_seen = 1; });
    return true;
  }();
  return kListening && interrupt_seen != 0;
}

std::string find_model_file(const std::string& robot, const std::string& model) {
  namespace fs = std::filesystem;
  fs::path folder;
  if (robot.find('/') != std::string::npos) {
    folder = robot;
  } else {
    const char* config = std::getenv("ANTHROB_CONFIG");
    const std::string bringup = config ? "" : ros::package::getPath("anthrob_bringup");
    if (!config && bringup.empty()) {
      throw BadInput(
          "--robot " + robot +
          ": the package anthrob_bringup is not found; source the workspace's setup.bash or set "
          "ANTHROB_CONFIG to the folder of robots");
    }
    folder = (config ? fs::path(config) : fs::path(bringup) / "config") / robot;
  }
  if (!fs::is_directory(folder)) {
    throw BadInput("--robot " + robot + ": expected a folder " + folder.string());
  }
  const fs::path file = folder / ("model_" + model + ".yaml");
  if (!fs::exists(file)) {
    std::string known;
    for (const auto& entry : fs::directory_iterator(folder)) {
      const std::string stem = entry.path().stem().string();
      if (stem.rfind("model_", 0) == 0) known += (known.empty() ? "" : ", ") + stem.substr(6);
    }
    throw BadInput("--model " + model + ": no " + file.string() + "; this robot has: " + known);
  }
  return file.string();
}

void say(const CLI::App& app, const std::vector<std::string>& remarks) {
  for (const std::string& remark : remarks) std::cerr << app.get_name() << ": " << remark << "\n";
}

std::shared_ptr<const RobotModel> load_model(const CLI::App& app, const std::string& file,
                                             const LoadOptions& options) {
  auto model = load_robot_model(file, options);
  say(app, model->remarks);
  return model;
}

Assignment parse_assignment(const std::string& option, const std::string& text) {
  const auto fail = [&] {
    throw BadInput(option + " " + text + ": expected NAME=NUMBER or NAME=NUMBER,NUMBER,...");
  };
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0) fail();
  Assignment assignment{text.substr(0, equals), {}};
  std::istringstream values(text.substr(equals + 1));
  std::string value;
  while (std::getline(values, value, ',')) {
    std::size_t used = 0;
    try {
      assignment.values.push_back(std::stod(value, &used));
    } catch (const std::exception&) {
      fail();
    }
    if (used != value.size() || !std::isfinite(assignment.values.back())) fail();
  }
  if (assignment.values.empty()) fail();
  return assignment;
}

Progress::Progress(const std::string& what)
    : what_(what), start_(now()), visible_(isatty(2) == 1) {}

Progress::~Progress() {
  if (visible_) std::fprintf(stderr, "\r\033[K");
}

void Progress::update(double share) {
  const double t = now();
  if (!visible_ || t - last_ < 0.2) return;
  last_ = t;
  const double left = share > 0.0 ? (t - start_) * (1.0 - share) / share : 0.0;
  std::fprintf(stderr, "\r\033[K%s: %3.0f %%, %.0f s left", what_.c_str(), 100.0 * share, left);
}

}  // namespace tool
}  // namespace anthrob
