#include "problem/problem.h"

#include <limits>

#include "anthrob_sim/core/errors.h"

namespace anthrob {
namespace calibration {

Problem::Problem(const ConfigNode& model, ParameterSpace space, std::vector<MeasuredRun> runs,
                 Weights weights, SimulationOptions options)
    : model_(model),
      space_(std::move(space)),
      runs_(std::move(runs)),
      weights_(weights),
      options_(options) {}

std::shared_ptr<const RobotModel> Problem::build(const std::vector<double>& values) const {
  LoadOptions load;
  load.overrides = space_.overrides(values);
  return model_.build(load);
}

template <class Function>
bool Problem::try_simulate(const std::vector<double>& values, Function use) const {
  try {
    use(simulate_runs(build(values), runs_, options_));
    return true;
  } catch (const BadInput&) {  // no such robot can be built
    return false;
  } catch (const NumericalFailure&) {
    return false;
  }
}

double Problem::fitness(const std::vector<double>& values) const {
  double sum = 0.0;
  const bool valid = try_simulate(values, [&](const std::vector<RunDifferences>& all) {
    for (const RunDifferences& run : all) sum += run.fitness(weights_);
  });
  return valid ? sum / static_cast<double>(runs_.size()) : std::numeric_limits<double>::infinity();
}

std::vector<double> Problem::residuals(const std::vector<double>& values) const {
  std::vector<double> residuals;
  try_simulate(values, [&](const std::vector<RunDifferences>& all) {
    for (const RunDifferences& run : all) {
      run.append_residuals(weights_, 1.0 / static_cast<double>(runs_.size()), residuals);
    }
  });
  return residuals;
}

}  // namespace calibration
}  // namespace anthrob
