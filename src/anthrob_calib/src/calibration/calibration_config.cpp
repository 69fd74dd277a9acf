#include "calibration/calibration_config.h"

#include <filesystem>

#include "anthrob_core/errors.h"

namespace anthrob {
namespace calibration {

namespace {

Weights read_weights(const ConfigNode& node) {
  Weights weights;
  const auto read = [&](const char* key, double& value) {
    value = node.number_or(key, value, Bounds::nonnegative(), "1");
  };
  read("posture", weights.posture);
  read("force", weights.force);
  read("before", weights.before);
  read("path", weights.path);
  read("after", weights.after);
  if (!(weights.posture + weights.force > 0.0))
    node.fail("posture and force: both are 0; expected one above 0");
  if (!(weights.before + weights.path + weights.after > 0.0)) {
    node.fail("before, path and after: all are 0; expected one above 0");
  }
  return weights;
}

}  // namespace

CalibrationConfig CalibrationConfig::load(const std::string& file) {
  const ConfigNode node = ConfigNode::load(file);
  CalibrationConfig config{file, "", false, {}, {}, {}, node};
  const ConfigNode model = node.at("model");
  config.model_file =
      (std::filesystem::path(model.file()).parent_path() / model.as_text()).string();
  const std::string kind = node.text("recordings");
  if (kind != "equilibria" && kind != "trajectories") {
    node.at("recordings").fail_expected("equilibria or trajectories");
  }
  config.wants_trajectories = kind == "trajectories";
  if (node.has("weights")) config.weights = read_weights(node.at("weights"));
  const ConfigNode simulate = node.at("simulate");
  config.simulation.settle = simulate.number("settle", Bounds::positive(), "s");
  config.simulation.motion = simulate.number("motion", Bounds::positive(), "s");
  config.optimiser = OptimiserSettings::read(node.at("optimiser"));
  node.at("parameters").ignore();
  if (node.has("shares")) node.at("shares").ignore();
  node.refuse_unknown_keys();
  return config;
}

void CalibrationConfig::require_model() const {
  if (std::filesystem::is_regular_file(model_file)) return;
  node.at("model").fail_expected("a model file, by its path from this file");
}

void CalibrationConfig::check(const std::vector<MeasuredRun>& runs,
                              const std::string& folder) const {
  for (const MeasuredRun& run : runs) {
    if (run.is_trajectory == wants_trajectories) continue;
    throw BadInput(folder + ": " + run.name + " is " +
                   (run.is_trajectory ? "a trajectory" : "an equilibrium") + "; expected " +
                   (wants_trajectories ? "trajectories" : "equilibria") + ", as " + file + " says");
  }
}

}  // namespace calibration
}  // namespace anthrob
