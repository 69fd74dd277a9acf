#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "protocol.h"

namespace anthrob {
namespace testing_support {

inline std::string anthrob_folder() {
  return std::string(ANTHROB_CONFIG_DIR) + "/anthrob/";
}

inline std::shared_ptr<const RobotModel> tier1() {
  return load_robot_model(anthrob_folder() + "model_I_tier1.yaml");
}

inline std::string content(const std::string& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A folder that exists as long as the object.
class Folder {
 public:
  Folder() {
    static int count = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("anthrob_record_" + std::to_string(getpid()) + "_" + std::to_string(count++));
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  std::string file(const std::string& name) const { return (path_ / name).string(); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
  }

 private:
  std::filesystem::path path_;
};

/// The robot standing still at a target.
inline RobotMeasurement standing(const RobotModel& model, const Protocol::Target& target) {
  RobotMeasurement measured{target.q, Eigen::VectorXd::Zero(model.skeleton->velocity_count), {}};
  for (const double reference : target.reference)
    measured.muscles.push_back({reference, 0.0, 0.0, 5.0});
  return measured;
}

}  // namespace testing_support
}  // namespace anthrob
