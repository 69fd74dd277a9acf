#pragma once

#include <memory>
#include <string>
#include <vector>

#include "anthrob_config/command_line.h"
#include "anthrob_sim/model/robot_model.h"

namespace anthrob {
namespace tool {

/// `--robot NAME` or folder, and `--model NAME` ("II" for model_II.yaml): the model file.
/// Robots are folders under $ANTHROB_CONFIG, else under config/ of the package anthrob_bringup.
/// @throws BadInput naming what was looked for and where
std::string find_model_file(const std::string& robot, const std::string& model);

/// Remarks on what was read, on standard error, one line each.
void say(const CLI::App& app, const std::vector<std::string>& remarks);

/// The model in a file; what was odd in it but put right is said on standard error, one line each.
std::shared_ptr<const RobotModel> load_model(const CLI::App& app, const std::string& file,
                                             const LoadOptions& options = {});

/// "a=1,2,3" into name and numbers.
/// @throws BadInput
struct Assignment {
  std::string name;
  std::vector<double> values;
};
Assignment parse_assignment(const std::string& option, const std::string& text);

/// Progress on standard error, if that is a terminal: share done and time left.
class Progress {
 public:
  explicit Progress(const std::string& what);
  ~Progress();
  void update(double share);
  /// Where no share is known.
  void show(const std::string& state);
  double elapsed() const;  ///< [s]

 private:
  std::string what_;
  double start_, last_ = 0.0;
  bool visible_;
};

/// "37 %, 20 s left"; without time left where nothing tells it. @param elapsed [s]
std::string progress_text(double share, double elapsed);

}  // namespace tool
}  // namespace anthrob
