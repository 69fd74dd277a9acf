#include "separation/separating_recording.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "anthrob_sim/core/errors.h"
#include "experiment/simulated_recording.h"

namespace anthrob {
namespace discovery {

namespace {

double distance_between(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

bool is_of_positions(const Series& mode) {
  return std::all_of(mode.values.begin(), mode.values.end(), [](double value) {
    return value == static_cast<double>(ecu::Mode::kPosition);
  });
}

/// References at so many moments, spread over the recording. Empty if a muscle has none, or other
/// ones than of its position.
std::vector<std::vector<double>> references_in(const RobotModel& model, const Dataset& recording,
                                               int count) {
  std::vector<std::vector<double>> moments(static_cast<std::size_t>(count));
  const double length = seconds(recording.end() - recording.begin());
  for (const MuscleModel& muscle : model.muscles) {
    const Series series = recording.series(muscle.name + "/reference");
    if (series.empty() && muscle.has_controller) return {};
    if (!is_of_positions(recording.series(muscle.name + "/mode"))) return {};
    for (int i = 0; i < count; ++i) {
      const double time = length * i / count;
      moments[static_cast<std::size_t>(i)].push_back(series.empty() ? 0.0 : series.held_at(time));
    }
  }
  return moments;
}

/// The first one, and then always the one farthest from all that were taken.
std::vector<std::vector<double>> spread_out(const std::vector<std::vector<double>>& all,
                                            std::size_t count) {
  std::vector<std::vector<double>> taken = {all.front()};
  std::vector<double> away(all.size(), std::numeric_limits<double>::infinity());
  while (taken.size() <= count) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      away[i] = std::min(away[i], distance_between(all[i], taken.back()));
    }
    const auto farthest = std::max_element(away.begin(), away.end());
    if (!(*farthest > 0.0)) break;
    taken.push_back(all[static_cast<std::size_t>(farthest - away.begin())]);
  }
  return taken;
}

std::vector<double> within_limits(const RobotModel& model, std::vector<double> references) {
  for (std::size_t m = 0; m < references.size(); ++m) {
    const double limit = model.muscles[m].limits.position;
    references[m] = std::clamp(references[m], -limit, limit);
  }
  return references;
}

void add_variants(const RobotModel& model, const std::vector<double>& posture,
                  const SeparationOptions& options, SeparatingRecording& plan) {
  const std::string number = std::to_string(plan.targets.size() / 3 + 1);
  std::vector<double> tight = posture, little = posture;
  for (std::size_t m = 0; m < posture.size(); ++m) {
    tight[m] += options.tighter;
    little[m] = plan.rest[m] + options.little * (posture[m] - plan.rest[m]);
  }
  plan.targets.push_back({"P" + number, posture});
  plan.targets.push_back({"P" + number + "_tight", within_limits(model, tight)});
  plan.targets.push_back({"P" + number + "_little", little});
}

/// Half the squared difference in units of the floor, leg by leg.
void measure_distances(const Experiment& experiment, const Eigen::VectorXf& whitened,
                       const SeparationOptions& options, SeparatingRecording& plan) {
  for (const Channel& channel : experiment.channels()) {
    for (std::size_t b = 0; b < channel.count; ++b) {
      const auto target = static_cast<std::size_t>(experiment.bin_time(b) / (2.0 * options.leg));
      if (target >= plan.targets.size()) continue;
      const double y = whitened[static_cast<Eigen::Index>(channel.offset + b)];
      plan.targets[target].distance += 0.5 * y * y;
    }
  }
}

}  // namespace

double SeparatingRecording::distance() const {
  double sum = 0.0;
  for (const Target& target : targets) sum += target.distance;
  return sum;
}

SeparatingRecording plan_separation(const Evaluator& evaluator, const Variant& named,
                                    const Variant& rival, const Dataset& recording,
                                    const Scales& scales, double bin, const Options& options) {
  const SeparationOptions& numbers = options.separation;
  SeparatingRecording plan;
  const RobotModel& model = *evaluator.model();
  const auto moments = references_in(model, recording, numbers.moments);
  if (model.muscles.empty() || moments.empty()) return plan;
  const auto postures = spread_out(moments, numbers.postures);
  plan.rest = postures.front();
  for (std::size_t i = 1; i < postures.size(); ++i) add_variants(model, postures[i], numbers, plan);

  Dataset imagined;
  try {
    imagined = simulated_recording(
        evaluator.build(named), separating_commands(model, plan, numbers), 1, options.experiment);
  } catch (const NumericalFailure&) {
    return {};
  }
  ReplayScope scope;
  scope.bin = bin;
  const Experiments experiments = {make_experiment(model, imagined, options.experiment, scope)};
  const auto differences = evaluator.compare({rival}, experiments).front();
  if (differences.size() == 0) return {};
  // Floors as they were measured: the robot is recorded at its own rate, not at that of this plan.
  Scales floors = scales;
  for (auto& [name, scale] : floors) scale.rows = 0.0;
  const Eigen::VectorXf whitened =
      differences.cwiseProduct(whitener(experiments, floors, true)).eval();
  measure_distances(*experiments.front(), whitened, numbers, plan);
  std::stable_sort(plan.targets.begin(), plan.targets.end(),
                   [](const auto& a, const auto& b) { return a.distance > b.distance; });
  if (plan.targets.size() > numbers.targets) plan.targets.resize(numbers.targets);
  return plan;
}

Dataset separating_commands(const RobotModel& model, const SeparatingRecording& plan,
                            const SeparationOptions& options, std::size_t first,
                            std::size_t stride) {
  Dataset data;
  data.folder = "separating";
  data.meta.robot = model.name;
  Table& table = data.table("commands");
  for (const MuscleModel& muscle : model.muscles) table.column(muscle.name + "/reference");
  const auto leg = static_cast<std::size_t>(std::lround(options.leg / options.command_period));
  const auto hold = [&](const std::vector<double>& references, std::size_t rows) {
    for (std::size_t i = 0; i < rows; ++i) {
      table.t.push_back(static_cast<Nanoseconds>(
          std::llround(1e9 * options.command_period * static_cast<double>(table.t.size()))));
      for (std::size_t m = 0; m < references.size(); ++m) {
        table.columns[m].values.push_back(references[m]);
        table.columns[m].present.push_back(1);
      }
    }
  };
  hold(plan.rest, 1);  // where it starts, settled
  for (std::size_t i = first; i < plan.targets.size(); i += stride) {
    hold(plan.targets[i].references, leg);
    hold(plan.rest, leg);
  }
  return data;
}

}  // namespace discovery
}  // namespace anthrob
