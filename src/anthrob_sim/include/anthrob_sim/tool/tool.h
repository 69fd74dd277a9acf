#pragma once

#include <memory>
#include <string>
#include <vector>

#include "anthrob_config/command_line.h"
#include "anthrob_sim/model/robot_model.h"

namespace anthrob {
namespace tool {

/// The model file that the options `--robot` and `--model` of a tool name.
/// @param robot name of a folder of robots, or with a '/' the path of the robot's folder. Names are
/// looked up under $ANTHROB_CONFIG, else under config/ of the package anthrob_bringup.
/// @param model name ("II" for model_II.yaml in the robot's folder), or the path of an existing
/// file (with a '/' or ending in .yaml); `robot` is then not used
/// @throws BadInput naming what was looked for and where
std::string find_model_file(const std::string& robot, const std::string& model);

/// Prints remarks on input files on standard error, one line each.
void say(const CLI::App& app, const std::vector<std::string>& remarks);

/// Loads a model file. Prints the model's remarks (odd input that was used anyway) on standard
/// error, one line each.
std::shared_ptr<const RobotModel> load_model(const CLI::App& app, const std::string& file,
                                             const LoadOptions& options = {});

/// Splits "a=1,2,3" into name and numbers. @throws BadInput for any other form
struct Assignment {
  std::string name;
  std::vector<double> values;
};
Assignment parse_assignment(const std::string& option, const std::string& text);

/// Splits "elbow=0:2:50" into name, ends and number of points.
/// @throws BadInput for any other form, or if the points are not 2 to kMostPoints
struct Range {
  std::string name;
  double from = 0.0, to = 0.0;
  int points = 0;
};
constexpr int kMostPoints = 100000;
Range parse_range(const std::string& option, const std::string& text);

/// Shows progress on standard error if that is a terminal: share done and time left.
class Progress {
 public:
  explicit Progress(const std::string& what);
  ~Progress();
  void update(double share);
  /// For work whose share done is not known: shows a text instead.
  void show(const std::string& state);
  double elapsed() const;  ///< [s]

 private:
  std::string what_;
  double start_, last_ = 0.0;
  bool visible_;
};

/// "37 %, 20 s left", or the time elapsed if the time left is not known. @param elapsed [s]
std::string progress_text(double share, double elapsed);

}  // namespace tool
}  // namespace anthrob
