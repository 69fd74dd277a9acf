#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "anthrob_core/testing/random.h"
#include "anthrob_sim/model/robot_model.h"

namespace anthrob {
namespace testing_support {

inline std::string config(const std::string& file) {
  return std::string(ANTHROB_CONFIG_DIR) + "/" + file;
}

/// A robot folder that exists as long as the object.
class TemporaryRobot {
 public:
  TemporaryRobot(const std::string& urdf, const std::string& model) {
    static int count = 0;
    folder_ = std::filesystem::temp_directory_path() /
              ("anthrob_test_" + std::to_string(getpid()) + "_" + std::to_string(count++));
    std::filesystem::create_directories(folder_);
    write("robot.urdf", urdf);
    write("model.yaml", model);
  }
  ~TemporaryRobot() { std::filesystem::remove_all(folder_); }
  TemporaryRobot(const TemporaryRobot&) = delete;
  TemporaryRobot& operator=(const TemporaryRobot&) = delete;

  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
  }
  std::string file() const { return (folder_ / "model.yaml").string(); }
  std::shared_ptr<const RobotModel> load(double step = 1e-3,
                                         std::map<std::string, double> overrides = {}) const {
    return load_robot_model(file(), {step, std::move(overrides)});
  }

 private:
  std::filesystem::path folder_;
};

/// Postures of Anthrob's work space: shoulder within 60 degrees of rest, elbow 2 to 130 degrees.
inline std::vector<double> random_posture(Random& random) {
  const Quat shoulder(Eigen::AngleAxisd(random.uniform(-1.05, 1.05), random.direction()));
  return {shoulder.w(), shoulder.x(), shoulder.y(), shoulder.z(), random.uniform(0.035, 2.27)};
}

}  // namespace testing_support
}  // namespace anthrob
