#pragma once

#include <memory>
#include <string>
#include <vector>

#include "anthrob_recording/svg_figure.h"
#include "anthrob_sim/model/robot_model.h"

namespace anthrob {

/// Curves of one muscle along a sweep, with relaxed springs and without friction.
struct MuscleCurve {
  std::string muscle;
  std::vector<double> length;      ///< l_M [m]
  std::vector<double> expansion;   ///< of the spring [m]
  std::vector<double> force;       ///< relaxed (E_0) [N]
  std::vector<double> moment_arm;  ///< -dl/dq about the swept axis [m]
};

struct MuscleSweep {
  SweepAxis axis;
  std::vector<double> position;  ///< [rad] or [m]
  std::vector<MuscleCurve> muscles;
};

/// @param q posture of the other joints   @param actuators positions, one per muscle [rad]
/// @param from, to, count positions of the swept axis, evenly spaced, count >= 2
/// @throws BadInput if the range leaves a joint's limits
MuscleSweep sweep_muscles(const std::shared_ptr<const RobotModel>& model,
                          const std::vector<double>& q, const std::vector<double>& actuators,
                          const SweepAxis& axis, double from, double to, int count);

/// Figure of length, moment arm and force over the axis.
/// @param only names of the muscles to draw; empty: all
SvgFigure draw_sweep(const MuscleSweep& sweep, const std::vector<std::string>& only);

}  // namespace anthrob
