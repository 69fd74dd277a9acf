#include "report/muscle_sweep.h"

#include <algorithm>
#include <cmath>

#include "anthrob_sim/placement.h"
#include "anthrob_sim/simulation.h"

namespace anthrob {

namespace {

void check_range(const JointModel& joint, const SweepAxis& axis, double from, double to,
                 int count) {
  if (count < 2 || !std::isfinite(from) || !std::isfinite(to) || !(from < to)) {
    throw BadInput("sweep of " + axis.name + ": expected FROM < TO and at least 2 points");
  }
  if (joint.type == JointType::kBall && (from < -M_PI || to > M_PI)) {
    throw BadInput("sweep of " + axis.name + ": expected a range from -pi to pi [rad]");
  }
  if (joint.type != JointType::kBall && joint.stop.enabled &&
      (from < joint.stop.lower || to > joint.stop.upper)) {
    throw BadInput("sweep of " + axis.name + ": expected a range within the joint's limits " +
                   std::to_string(joint.stop.lower) + " to " + std::to_string(joint.stop.upper));
  }
}

/// @throws BadInput for a posture beyond the joint's stop
void set_axis(const JointModel& joint, const SweepAxis& axis, double value,
              const std::vector<double>& start, Placement& posture) {
  if (joint.type != JointType::kBall) return posture.set_joint(joint.name, value);
  const double* from = &start[joint.position_offset];
  const Quat turn(Eigen::AngleAxisd(value, Vec3::Unit(axis.component)));
  posture.set_ball_joint(joint.name, Quat(from[0], from[1], from[2], from[3]) * turn);
}

}  // namespace

MuscleSweep sweep_muscles(const std::shared_ptr<const RobotModel>& model,
                          const std::vector<double>& q, const std::vector<double>& actuators,
                          const SweepAxis& axis, double from, double to, int count) {
  const JointModel& joint = model->skeleton->joints[axis.joint];
  check_range(joint, axis, from, to, count);
  Simulation sim(model);
  MuscleSweep sweep{axis, {}, std::vector<MuscleCurve>(model->muscles.size())};
  for (std::size_t m = 0; m < model->muscles.size(); ++m) {
    sweep.muscles[m].muscle = model->muscles[m].name;
  }
  Placement posture(*model, q);
  for (int i = 0; i < count; ++i) {
    const double value = from + (to - from) * i / (count - 1);
    set_axis(joint, axis, value, q, posture);
    sim.place(posture.q(), actuators);
    sweep.position.push_back(value);
    for (std::size_t m = 0; m < sweep.muscles.size(); ++m) {
      const Muscle& muscle = sim.muscle(static_cast<int>(m));
      MuscleCurve& curve = sweep.muscles[m];
      curve.length.push_back(muscle.length());
      curve.expansion.push_back(muscle.expansion());
      curve.force.push_back(muscle.spring_tension());
      curve.moment_arm.push_back(
          sim.moment_arms(static_cast<int>(m))[joint.velocity_offset + axis.component]);
    }
  }
  return sweep;
}

SvgFigure draw_sweep(const MuscleSweep& sweep, const std::vector<std::string>& only) {
  SvgFigure figure("muscles over " + sweep.axis.name);
  const auto draw = [&](const std::string& label, double scale,
                        std::vector<double> MuscleCurve::*values) {
    SvgFigure::Panel& panel = figure.add_panel(sweep.axis.name + " [rad, m]", label);
    for (const MuscleCurve& curve : sweep.muscles) {
      if (!only.empty() && std::find(only.begin(), only.end(), curve.muscle) == only.end())
        continue;
      std::vector<double> scaled;
      for (const double value : curve.*values) scaled.push_back(scale * value);
      panel.lines.push_back({curve.muscle, sweep.position, scaled});
    }
  };
  draw("length [mm]", 1e3, &MuscleCurve::length);
  draw("moment arm [mm]", 1e3, &MuscleCurve::moment_arm);
  draw("force [N]", 1.0, &MuscleCurve::force);
  return figure;
}

}  // namespace anthrob
