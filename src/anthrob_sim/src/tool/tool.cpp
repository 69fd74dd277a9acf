#include "anthrob_sim/tool/tool.h"

#include <ros/package.h>
#include <unistd.h>

#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <vector>

#include "anthrob_sim/core/errors.h"

namespace anthrob {
namespace tool {

namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Whether all of a text is one finite number.
bool read_number(const std::string& text, double& value) {
  std::size_t used = 0;
  try {
    value = std::stod(text, &used);
  } catch (const std::exception&) {
    return false;
  }
  return used == text.size() && std::isfinite(value);
}

}  // namespace

std::string find_model_file(const std::string& robot, const std::string& model) {
  namespace fs = std::filesystem;
  if (fs::path(model).extension() == ".yaml" || model.find('/') != std::string::npos) {
    if (fs::is_regular_file(model)) return model;
    throw BadInput("--model " + model +
                   ": no such file; expected an existing .yaml file, or a name such as II");
  }
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
    throw BadInput("--robot " + robot + ": no such folder: " + folder.string());
  }
  const fs::path file = folder / ("model_" + model + ".yaml");
  if (!fs::exists(file)) {
    std::string known;
    for (const auto& entry : fs::directory_iterator(folder)) {
      const std::string stem = entry.path().stem().string();
      if (stem.rfind("model_", 0) == 0) known += (known.empty() ? "" : ", ") + stem.substr(6);
    }
    throw BadInput("--model " + model + ": no file " + file.string() +
                   (known.empty() ? "; expected a folder of a robot, with a file model_NAME.yaml"
                                  : "; this robot has: " + known));
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
    assignment.values.emplace_back();
    if (!read_number(value, assignment.values.back())) fail();
  }
  if (assignment.values.empty()) fail();
  return assignment;
}

Range parse_range(const std::string& option, const std::string& text) {
  const auto fail = [&](const std::string& expected) {
    throw BadInput(option + " " + text + ": expected " + expected);
  };
  const auto equals = text.find('=');
  const auto first = text.find(':', equals == std::string::npos ? 0 : equals),
             second = first == std::string::npos ? first : text.find(':', first + 1);
  Range range;
  const bool split = equals != std::string::npos && equals > 0 && second != std::string::npos;
  if (!split || !read_number(text.substr(equals + 1, first - equals - 1), range.from) ||
      !read_number(text.substr(first + 1, second - first - 1), range.to)) {
    fail("NAME=FROM:TO:POINTS");
  }
  range.name = text.substr(0, equals);
  const char* end = text.data() + text.size();
  const auto points = std::from_chars(text.data() + second + 1, end, range.points);
  if (points.ec != std::errc() || points.ptr != end || range.points < 2 ||
      range.points > kMostPoints) {
    fail("a whole number of POINTS from 2 to " + std::to_string(kMostPoints));
  }
  return range;
}

Progress::Progress(const std::string& what)
    : what_(what), start_(now()), visible_(isatty(2) == 1) {}

Progress::~Progress() {
  if (visible_) std::fprintf(stderr, "\r\033[K");
}

void Progress::update(double share) {
  show(progress_text(share, elapsed()));
}

void Progress::show(const std::string& state) {
  const double t = now();
  if (!visible_ || t - last_ < 0.2) return;
  last_ = t;
  std::fprintf(stderr, "\r\033[K%s: %s", what_.c_str(), state.c_str());
}

double Progress::elapsed() const {
  return now() - start_;
}

std::string progress_text(double share, double elapsed) {
  char text[80];
  if (share > 0.0 && share < 1.0) {
    std::snprintf(text, sizeof(text), "%3.0f %%, %.0f s left", 100.0 * share,
                  elapsed * (1.0 - share) / share);
  } else {
    // Nothing is known of what is left: it has just begun, or takes longer than was reckoned.
    std::snprintf(text, sizeof(text), "%3.0f %%, %.0f s so far", 100.0 * share, elapsed);
  }
  return text;
}

}  // namespace tool
}  // namespace anthrob
