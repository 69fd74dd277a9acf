#include "admission/movement.h"

#include <algorithm>
#include <cmath>

#include "anthrob_core/errors.h"
#include "anthrob_recording/resolution.h"
#include "experiment/poses.h"

namespace anthrob {
namespace discovery {

namespace {

/// Whether a muscle moves, or its motor at least tries to.
bool muscle_moves(const Dataset& recording, const std::string& muscle,
                  const MovementOptions& options) {
  const auto series = [&](const char* quantity) { return recording.series(muscle + quantity); };
  const Series position = series("/position");
  const auto shows = [&](const Series& values, double least) {
    return moves(values, least, options);
  };
  if (shows(position, options.least_turn) || shows(series("/force"), options.least_force)) {
    return true;
  }
  const double asked = range_of(series("/reference"));
  if (position.empty()) return asked > options.least_turn;
  // The motor may not have followed: it was disabled, or what was measured stood still.
  if (asked <= options.least_followed) return false;
  return shows(position, 0.0) || shows(series("/force"), 0.0) || shows(series("/voltage"), 0.0) ||
         shows(series("/current"), 0.0);
}

}  // namespace

double range_of(const Series& series) {
  if (series.empty()) return 0.0;
  const auto [low, high] = std::minmax_element(series.values.begin(), series.values.end());
  return *high - *low;
}

bool moves(const Series& series, double least, const MovementOptions& options) {
  if (series.empty()) return false;
  const auto size = static_cast<Eigen::Index>(series.values.size());
  const Eigen::Map<const Eigen::VectorXd> values(series.values.data(), size);
  // From the first value on, so that a small motion far from zero keeps its digits.
  const Eigen::VectorXd own = values.array() - values[0];
  const auto in_a_mean = static_cast<Eigen::Index>(
      std::clamp<std::size_t>(own.size() / options.means, 1, options.most_in_a_mean));
  Eigen::ArrayXd means(size / in_a_mean);
  for (Eigen::Index i = 0; i < means.size(); ++i) {
    means[i] = own.segment(i * in_a_mean, in_a_mean).mean();
  }
  if (!(means.maxCoeff() - means.minCoeff() > least)) return false;
  const double spread = std::sqrt((means - means.mean()).square().mean());
  const double noise = white_noise(own.cast<float>()) / std::sqrt(static_cast<double>(in_a_mean));
  return spread > options.beyond_noise * noise;
}

void refuse_stillness(const RobotModel& robot, const std::vector<Dataset>& recordings,
                      const MovementOptions& options) {
  for (const Dataset& recording : recordings) {
    if (holds_poses(robot, recording)) return;  // they tell friction even at one place
    for (const MuscleModel& muscle : robot.muscles) {
      if (muscle_moves(recording, muscle.name, options)) return;
    }
    for (const JointModel& joint : robot.skeleton->joints) {
      if (joint.driven &&
          moves(recording.series(joint.name + "/position"), options.least_driven, options)) {
        return;
      }
    }
  }
  const std::string name = recordings.front().folder;
  throw BadInput(name +
                 (robot.muscles.empty()
                      ? ": the axis does not move, so friction and inertia are not identifiable; "
                        "expected motion over the range of interest"
                      : ": no muscle moves, so friction, springs and motors are not "
                        "identifiable; expected motion over the range of interest"));
}

}  // namespace discovery
}  // namespace anthrob
