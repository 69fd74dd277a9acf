#pragma once

#include <string>
#include <vector>

#include "anthrob_recording/dataset.h"
#include "anthrob_sim/model/robot_model.h"
#include "options/experiment.h"

namespace anthrob {
namespace discovery {

/// How driven axes are compared: the same for all recordings.
struct AxisPlan {
  double bin = 0.0;  ///< [s]
  /// Joints whose effort hardly depends on acceleration: no inertia can be read off them, so that
  /// the given one must not count.
  std::vector<int> hidden_inertia;
};

/// Chooses them by the recordings alone, whatever the model says.
///
/// Short bins leave the noise of the encoder in the acceleration, long ones blur the motion. Taken
/// is the length for which the effort that is left of a smooth curve, for an inertia that is
/// estimated with it, tells most: scatter times the square root of the length is smallest. Where in
/// such bins many motions begin or end, a shorter one that is about as good.
/// @param recordings of `--train`
AxisPlan plan_axes(const RobotModel& model, const std::vector<Dataset>& recordings,
                   const AxisOptions& options);

/// What users should know of it.
std::vector<std::string> remarks_on_plan(const RobotModel& model, const AxisPlan& plan);

}  // namespace discovery
}  // namespace anthrob
