#pragma once

#include <array>
#include <string>
#include <vector>

#include "anthrob_sim/model/robot_model.h"
#include "twin/feed.h"
#include "twin/samples.h"
#include "twin/twin_options.h"

namespace anthrob {
namespace twin {

enum class Quantity { kForce, kPosition, kCurrent, kJointPosition, kRotation };

/// What is measured and simulated, and compared.
struct Channel {
  std::string owner, name, unit;  ///< "elbow", "elbow/position", "rad"
  Quantity quantity = Quantity::kForce;
  int index = 0;  ///< of the muscle or joint
  Topic topic = Topic::kMuscles;
  std::size_t value = 0;   ///< first of its numbers in `Channels::values`: 1, or w, x, y, z
  std::size_t series = 0;  ///< first of its differences: 1, or a rotation vector's 3
  int components = 1;
  std::array<bool, kFeedCount> told = {};  ///< by which feeds: not where it is imposed
  double least = 0.0;      ///< its floor at least: the error of its sensor's counts, or an option
  double cut_noise = 0.0;  ///< noise of a force sensor before it is cut off at zero [N]
};

/// All channels of a robot: forces, motor positions and currents by muscle, then joints.
struct Channels {
  Channels(const RobotModel& model, const TwinOptions& options);

  std::vector<Channel> all;
  std::size_t values = 0, series = 0;  ///< numbers of all
};

/// Mean of the readings of a sensor that never reports less than zero.
/// @param value true one   @param noise its standard deviation
double mean_above_zero(double value, double noise);

/// What a channel measured minus what a twin has: one number, or a rotation vector in the child's
/// axes; NaN where it was not measured.
/// @param values the twin's, with all its channels
void difference(const Channel& channel, const MuscleSample& measured,
                const std::vector<double>& values, double* result);
void difference(const Channel& channel, const JointModel& joint, const JointSample& measured,
                const std::vector<double>& values, double* result);

}  // namespace twin
}  // namespace anthrob
