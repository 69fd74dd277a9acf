#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/simulation.h"
#include "support.h"

namespace anthrob {
namespace testing_support {

constexpr char kRig[] = "two_muscle_rig/model_I.yaml";
constexpr char kArm[] = "anthrob/model_II.yaml";
constexpr double kStep = 1e-3;

/// A robot of config/ with effects.
inline std::shared_ptr<const RobotModel> robot_with(const std::string& file,
                                                    const std::vector<EffectInstance>& effects,
                                                    double step = kStep) {
  LoadOptions options;
  options.step = step;
  options.effects = effects;
  return load_robot_model(config(file), options);
}

/// The same muscle with one effect.
inline MuscleModel muscle_with(const std::string& file, const EffectInstance& effect,
                               const std::string& muscle, double step = kStep) {
  const auto robot = robot_with(file, {effect}, step);
  return robot->muscles[robot->find_muscle(muscle)];
}

/// A typical dose of an effect at a place.
inline EffectInstance dose(const Effect& effect, const RobotModel& robot, const std::string& place,
                           double share = 1.0) {
  EffectInstance instance{effect.info().id, place, {}};
  for (const EffectParameter& p : effect.parameters_at(robot, place)) {
    if (p.kind != EffectParameter::kSize) continue;
    instance.parameters[p.name] = p.neutral + share * (p.typical - p.neutral);
  }
  return instance;
}

/// State of one component, outside a simulation.
class Memory {
 public:
  explicit Memory(std::size_t size) : data_(size + 1, 0.0) {}
  operator StateView() { return StateView(data_.data()); }
  double& at(std::size_t i) { return data_.at(i); }

 private:
  std::vector<double> data_;
};

/// A motion of any robot in config/: all muscles pull in turn, driven joints are pushed.
inline void drive(Simulation& sim) {
  const double t = sim.time();
  for (int m = 0; m < static_cast<int>(sim.muscle_count()); ++m) {
    const MuscleModel& muscle = sim.model().muscles[m];
    if (muscle.actuator->input_high() == 0.0) continue;
    const double wave = std::sin(9.0 * t + 0.7 * m);
    if (muscle.has_controller) {
      sim.command(m, ecu::Mode::kPosition, 0.4 + 0.9 * wave);
    } else {
      sim.command(m, ecu::Mode::kVoltage, 0.3 + 0.2 * wave);
    }
  }
  const auto& joints = sim.model().skeleton->joints;
  for (int j = 0; j < static_cast<int>(joints.size()); ++j) {
    if (joints[j].driven) sim.apply_effort(j, 60.0 * std::sin(5.0 * t + 0.5));
  }
}

inline void run(Simulation& sim, int steps) {
  for (int i = 0; i < steps; ++i) drive(sim), sim.step();
}

/// Everything that a recording of the robot would show now.
inline std::vector<double> channels(const Simulation& sim) {
  std::vector<double> list;
  for (int m = 0; m < static_cast<int>(sim.muscle_count()); ++m) {
    const ecu::Measurement reading = sim.reading(m);
    for (const double x : {reading.position, reading.velocity, reading.current, reading.force,
                           sim.muscle(m).voltage()}) {
      list.push_back(x);
    }
  }
  const double* positions = sim.read_positions();
  list.insert(list.end(), positions, positions + sim.model().skeleton->position_count);
  return list;
}

}  // namespace testing_support
}  // namespace anthrob
