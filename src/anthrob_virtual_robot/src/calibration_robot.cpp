#include "calibration_robot.h"

#include <algorithm>
#include <cmath>

#include "hidden_law.h"
#include "places.h"

namespace anthrob::virtual_robot {
namespace {

constexpr double kLargestPointError = 0.0025;  // range of the tables [m]

/// Coulomb friction of one eyelet, the sign made smooth.
class LeavingEyelet final : public reference::MuscleLaw {
 public:
  LeavingEyelet(std::size_t eyelet, double mu) : eyelet_(eyelet), mu_(mu) {}
  double friction(std::size_t eyelet, double v, double before) const override {
    return eyelet == eyelet_ ? before + mu_ * std::tanh(v / kSmooth) : before;
  }
  double friction_slope(std::size_t eyelet, double v, double before) const override {
    const double t = std::tanh(v / kSmooth);
    return eyelet == eyelet_ ? before + mu_ * (1.0 - t * t) / kSmooth : before;
  }

 private:
  static constexpr double kSmooth = 3e-4;  // [m/s]
  std::size_t eyelet_;
  double mu_;
};

void add_errors(const CalibrationRobotSettings& s, Random random,
                reference::MuscleParameters* muscle) {
  muscle->rest_tendon_length += s.scale * random.uniform(-1.0, 1.0) * s.rest_tendon_length;
  muscle->spindle_radius += s.scale * random.uniform() * s.spindle_radius;
  Eigen::Vector3d& point = muscle->path[leaving_segment(*muscle)].position;
  for (int k = 0; k < 3; ++k) {
    const double error = s.scale * random.uniform(-1.0, 1.0) * s.path_point;
    point(k) += std::clamp(error, -kLargestPointError, kLargestPointError);
  }
  const double shrunk = 1.0 - std::min(0.6, s.scale * random.uniform() * s.cylinder_radius);
  for (reference::PathEntry& entry : muscle->path) {
    if (entry.cylinder) entry.cylinder->radius *= shrunk;
  }
}

}  // namespace

CalibrationRobotSettings CalibrationRobotSettings::load(const std::string& file) {
  const ConfigNode node = ConfigNode::load(file);
  CalibrationRobotSettings s;
  s.scale = node.number("scale", Bounds::nonnegative(), "1");
  const ConfigNode errors = node.at("errors");
  s.rest_tendon_length = errors.number("rest_tendon_length", Bounds::nonnegative(), "m");
  s.spindle_radius = errors.number("spindle_radius", Bounds::nonnegative(), "m");
  s.path_point = errors.number("path_point", Bounds::nonnegative(), "m");
  s.cylinder_radius = errors.number("cylinder_radius", Bounds::between(0.0, 1.0), "1");
  s.viscous_low = errors.at("viscous").number("low", Bounds::positive(), "Nms/rad");
  s.viscous_high = errors.at("viscous").number("high", Bounds::positive(), "Nms/rad");
  const ConfigNode hidden = node.at("hidden");
  s.sticking = hidden.number("sticking", Bounds::nonnegative(), "m");
  s.leaving_friction = hidden.number("leaving_friction", Bounds::nonnegative(), "1");
  s.tendon_compliance = hidden.number("tendon_compliance", Bounds::nonnegative(), "1/N");
  const ConfigNode search = node.at("search");
  s.lowest_tension = search.number("lowest_tension", Bounds::nonnegative(), "N");
  s.tries = search.at("tries").as_integer(1, 100);
  s.close = search.number("close", Bounds::positive(), "rad");
  node.refuse_unknown_keys();
  return s;
}

reference::ArmParameters detached(const reference::ArmParameters& arm) {
  reference::ArmParameters result = arm;
  constexpr std::size_t kShoulderMuscles = 8;
  result.muscles.resize(kShoulderMuscles);
  // Minimal coordinates want a forearm: a light one that its damping holds still.
  reference::BodyParameters& forearm = result.skeleton.forearm;
  constexpr double kNothing = 1e-6;
  forearm.mass *= kNothing;
  forearm.inertia *= kNothing;
  // No stop for it to chatter at.
  result.skeleton.elbow_stop.lower = -M_PI;
  result.skeleton.elbow_stop.upper = M_PI;
  return result;
}

reference::ArmParameters with_table_errors(const reference::ArmParameters& arm,
                                           const CalibrationRobotSettings& settings,
                                           std::uint64_t seed) {
  reference::ArmParameters result = arm;
  for (std::size_t i = 0; i < result.muscles.size(); ++i) {
    add_errors(settings, Random(seed, i), &result.muscles[i]);
  }
  Random random(seed, 1000);
  const double viscous = random.log_uniform(settings.viscous_low, settings.viscous_high);
  result.skeleton.shoulder_friction.viscous = viscous;
  result.skeleton.elbow_friction.viscous = viscous / 6.0;
  return result;
}

Draft with_hidden(const reference::ArmParameters& arm, const CalibrationRobotSettings& settings) {
  Draft draft;
  draft.arm = arm;
  build_in({"eyelet_presliding", "all", {{"distance", settings.sticking}}}, &draft);
  build_in({"tendon_elasticity", "all", {{"compliance", settings.tendon_compliance}}}, &draft);
  for (std::size_t i = 0; i < arm.muscles.size(); ++i) {
    const std::size_t leaving = leaving_segment(arm.muscles[i]);
    if (leaving == 0) continue;
    draft.muscle_laws.emplace_back(
        i, std::make_shared<LeavingEyelet>(leaving - 1, settings.leaving_friction));
  }
  return draft;
}

}  // namespace anthrob::virtual_robot
