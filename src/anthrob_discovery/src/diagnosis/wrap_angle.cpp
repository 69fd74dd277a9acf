#include "diagnosis/wrap_angle.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "anthrob_sim/core/errors.h"
#include "experiment/posture_noise.h"

namespace anthrob {
namespace discovery {

namespace {

double wrap_angle(const Muscle& muscle) {
  double turning = 0.0;
  for (const auto& obstacle : muscle.path().obstacles()) turning += obstacle.turning;
  return turning;
}

/// @param values by muscle and bin, filled in
void follow(const std::shared_ptr<const RobotModel>& model, const Dataset& recording,
            const Experiment& experiment, const PostureNoiseOptions& options,
            std::vector<std::vector<double>>& values) {
  const Replay input(model, with_smooth_postures(*model, recording, options), ReplayMode::kPosture);
  Simulation sim(model);
  input.start(sim);
  Replay::Run run(input, sim);
  const std::size_t bins = experiment.channels().front().count;
  std::int64_t done = 0;
  for (std::size_t b = 0; b < bins; ++b) {
    const auto steps = std::llround(experiment.bin_time(b) / model->step);
    for (; done < steps; ++done) {
      run.drive(static_cast<double>(done) * model->step);
      sim.step();
    }
    for (std::size_t m = 0; m < values.size(); ++m) {
      values[m].push_back(wrap_angle(sim.muscle(static_cast<int>(m))));
    }
  }
}

bool changes(const MeasuredVariable& variable, double least) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto& values : variable.values) {
    for (const double value : values) low = std::min(low, value), high = std::max(high, value);
  }
  return high - low > least;
}

}  // namespace

std::vector<MeasuredVariable> wrap_angles(const Evaluator& evaluator,
                                          const std::vector<Dataset>& recordings,
                                          const Experiments& experiments, const Variant& variant,
                                          const Options& options) {
  std::vector<MeasuredVariable> variables;
  for (const MuscleModel& muscle : evaluator.model()->muscles) {
    variables.push_back({muscle.name + "/wrap_angle", "wrap angle", {}, false, "rad"});
  }
  if (variables.empty()) return {};
  try {
    std::vector<std::vector<std::vector<double>>> values(
        experiments.size(), std::vector<std::vector<double>>(variables.size()));
    evaluator.side_by_side(experiments.size(), [&](std::size_t e) {
      follow(evaluator.build(variant, recordings[e].meta.model), recordings[e], *experiments[e],
             options.experiment.postures, values[e]);
    });
    for (std::size_t m = 0; m < variables.size(); ++m) {
      for (auto& own : values) variables[m].values.push_back(std::move(own[m]));
    }
  } catch (const BadInput&) {
    return {};
  } catch (const NumericalFailure&) {
    return {};
  }
  variables.erase(std::remove_if(variables.begin(), variables.end(),
                                 [&](const MeasuredVariable& v) {
                                   return !changes(v, options.diagnosis.dependence.wrap_angle);
                                 }),
                  variables.end());
  return variables;
}

}  // namespace discovery
}  // namespace anthrob
