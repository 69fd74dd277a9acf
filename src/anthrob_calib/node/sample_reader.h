#pragma once

#include <anthrob_msgs/ExternalWrenches.h>
#include <anthrob_msgs/MuscleStates.h>
#include <anthrob_msgs/SphericalJointStates.h>
#include <sensor_msgs/JointState.h>

#include <optional>
#include <string>
#include <vector>

#include "twin/samples.h"

namespace anthrob {

/// Turns a robot's messages into samples. What the model does not have is left out.
class SampleReader {
 public:
  /// @param model must outlive it
  explicit SampleReader(const RobotModel& model);

  /// The result is valid until the next call. Null: a message whose lists differ in length.
  const twin::MuscleSample* read(const anthrob_msgs::MuscleStates& message);
  const twin::JointSample* read(const sensor_msgs::JointState& message);
  const twin::JointSample* read(const anthrob_msgs::SphericalJointStates& message);
  std::optional<twin::PushSample> read(const anthrob_msgs::ExternalWrenches& message) const;

 private:
  /// Places of names in the model, found anew only if they change.
  struct Places {
    std::vector<std::string> names;
    std::vector<int> found;
  };
  const std::vector<int>& muscles_of(const std::vector<std::string>& names);
  const std::vector<int>& joints_of(const std::vector<std::string>& names, Places& places,
                                    bool balls) const;

  const RobotModel& model_;
  const twin::MuscleSample no_muscles_;
  const twin::JointSample no_joints_;
  twin::MuscleSample muscles_;
  twin::JointSample joints_, balls_;
  Places muscle_places_, joint_places_, ball_places_;
};

}  // namespace anthrob
