#pragma once

#include <functional>
#include <string>
#include <vector>

#include "calibration_robot.h"
#include "posture_reference.h"
#include "recording.h"

namespace anthrob::virtual_robot {

/// A posture of equilibria_tier*.yaml.
struct Target {
  std::string name;
  Pose pose;
};
std::vector<Target> load_targets(const std::string& file, double lowest_tension);

/// A recording session with a virtual robot, as anthrob_recorder does it: every run starts at E0,
/// at rest. The references for a posture are first computed from the believed geometry, and then
/// corrected by the measured error of the posture that they lead to.
class Session final {
 public:
  /// @param robot builds the robot; a new number each time gives other noise
  /// @param believed the geometry from which references are computed
  Session(std::function<Robot(std::uint64_t)> robot, const reference::ArmParameters& believed,
          const CalibrationRobotSettings& settings, bool has_elbow);

  /// Finds the references of all targets; the first one is the rest posture.
  void find_references(const std::vector<Target>& targets);

  /// E0 to every posture, "E3_run1"; a posture at the end of each.
  void record_equilibria(const std::string& folder);
  /// "E0_to_E3_run1" and "E3_to_E0_run1" for these postures, or for all if `names` is empty: there
  /// and, from where that ended, back.
  void record_trajectories(const std::vector<std::string>& names, const std::string& folder);
  /// Through these postures and back to E0, `each` [s] for every posture.
  void record_tour(const std::vector<std::string>& names, double each, const std::string& name,
                   const std::string& folder);

 private:
  struct Known {
    Target target;
    std::vector<double> references;
  };
  const Known& known(const std::string& name) const;
  void run(const std::vector<Command>& commands, double seconds, const std::string& kind,
           const std::string& folder);
  void write(const Recording& recording, const std::string& kind, const std::string& folder) const;

  std::function<Robot(std::uint64_t)> robot_;
  PostureReference reference_;
  CalibrationRobotSettings settings_;
  bool has_elbow_;
  std::vector<std::string> muscles_;
  std::vector<Known> known_;
  std::uint64_t runs_ = 0;
};

}  // namespace anthrob::virtual_robot
