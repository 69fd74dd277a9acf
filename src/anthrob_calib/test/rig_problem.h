// Calibration problems of the two-muscle rig.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "problem/problem.h"
#include "two_muscle_rig.h"

namespace anthrob {
namespace calibration {

const char* const kParameters = R"(
parameters:
  - {path: "muscles.*.rest_tendon_length", unit: m, range: 0.006, step: 0.001}
  - {path: "muscles.*.spindle_radius", unit: m, low: 0.006, high: 0.0075, step: 0.0002}
)";

/// Five recordings of both motors, of different pulls.
/// @param noise of the sensors, in 0.01 rad and 0.2 N
inline std::vector<MeasuredRun> runs_of(const std::shared_ptr<const RobotModel>& truth,
                                        const std::string& kind, double noise = 0.0) {
  std::vector<MeasuredRun> runs;
  int k = 0;
  for (const double shift : {-2.0, -1.0, 0.5, 1.0, 2.0}) {
    RecordingPlan p = plan(1.5 + shift, 1.5 - shift, kind);
    p.angle_noise = 0.01 * noise;
    p.force_noise = 0.2 * noise;
    p.seed = static_cast<std::uint64_t>(++k);
    runs.push_back(read_run(record_simulation(truth, p), rig()));
  }
  return runs;
}

inline Problem problem_of(std::vector<MeasuredRun> runs,
                          const std::string& parameters = kParameters, const Weights& weights = {},
                          const SimulationOptions& options = {}) {
  const ConfigNode model = ConfigNode::load(kModelFile);
  ParameterSpace space(ConfigNode::parse(parameters, "c.yaml"), model);
  return {model, space, std::move(runs), weights, options};
}

/// Rest and motion as long as the robot's: differences are noise only.
inline SimulationOptions as_recorded() {
  SimulationOptions options;
  options.settle = options.motion = 5.0;
  return options;
}

}  // namespace calibration
}  // namespace anthrob
