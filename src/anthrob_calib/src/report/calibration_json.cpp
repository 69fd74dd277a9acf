#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "anthrob_recording/page.h"
#include "report/calibration_report.h"
#include "report/joint_unit.h"

namespace anthrob {
namespace calibration {

namespace {

using nlohmann::ordered_json;

/// JSON has no infinity.
ordered_json number(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

ordered_json errors_json(const MeanErrors& errors, const RobotModel& model) {
  ordered_json out;
  for (std::size_t j = 0; j < errors.joints.size(); ++j) {
    const JointModel& joint = model.skeleton->joints[j];
    const JointUnit unit = unit_of(joint);
    out[std::string("joints_") + unit.name][joint.name] = number(unit.scale * errors.joints[j]);
  }
  out["force_N"] = number(errors.force);
  return out;
}

/// The muscle with the largest mean error of its force in a run.
ordered_json worst_muscle(const RunDifferences& run, const RobotModel& model) {
  const std::vector<double> errors = run.shown().force_errors();
  if (errors.empty()) return nullptr;
  const auto worst = std::max_element(errors.begin(), errors.end());
  return {{"name", model.muscles[static_cast<std::size_t>(worst - errors.begin())].name},
          {"force_N", number(*worst)}};
}

/// A model that could not be simulated has null.
ordered_json runs_json(const BeforeAfter& both, const RobotModel& model) {
  if (both.runs.empty()) return nullptr;
  const auto mean = [&](const std::vector<RunDifferences>& list) {
    return list.empty() ? ordered_json(nullptr) : errors_json(mean_errors(list, model), model);
  };
  const auto of_run = [&](const std::vector<RunDifferences>& list, std::size_t r) {
    return list.empty() ? ordered_json(nullptr) : errors_json(run_errors(list[r], model), model);
  };
  ordered_json out;
  out["mean"] = {{"before", mean(both.before)}, {"after", mean(both.after)}};
  out["runs"] = ordered_json::array();
  for (std::size_t r = 0; r < both.runs.size(); ++r) {
    out["runs"].push_back(
        {{"name", both.runs[r].name},
         {"before", of_run(both.before, r)},
         {"after", of_run(both.after, r)},
         {"worst_muscle",
          both.after.empty() ? ordered_json(nullptr) : worst_muscle(both.after[r], model)}});
  }
  return out;
}

ordered_json parameters_json(const CalibrationOutcome& o) {
  ordered_json list = ordered_json::array();
  const std::vector<std::string> nothing = insensitive_parameters(o);
  for (std::size_t i = 0; i < o.parameters.size(); ++i) {
    const ModelParameter& p = o.parameters[i];
    ordered_json entry = {{"path", p.path},     {"unit", p.unit},   {"initial", p.initial},
                          {"value", o.best[i]}, {"lower", p.lower}, {"upper", p.upper},
                          {"step", p.step}};
    if (!o.identifiability.parameters.empty()) {
      const ParameterKnowledge& k = o.identifiability.parameters[i];
      entry["sigma"] = number(k.sigma);
      const identification::Estimate estimate = interval(o.identifiability, i, o.best[i]);
      entry["ci95"] = {number(estimate.lo), number(estimate.hi)};
      if (is_at_bound(o, i)) entry["ci95"] = {nullptr, nullptr};
      entry["identifiable"] = k.identifiable;
    }
    if (is_at_bound(o, i)) entry["at_bound"] = true;
    entry["name"] = p.name();
    if (std::count(nothing.begin(), nothing.end(), p.name())) entry["insensitive"] = true;
    list.push_back(entry);
  }
  return list;
}

ordered_json identifiability_json(const CalibrationOutcome& o) {
  const Identifiability& id = o.identifiability;
  ordered_json out;
  out["identifiable_share"] = kIdentifiableShare;
  out["posture_noise_deg"] = kDegrees * id.posture_noise;
  out["force_noise_N"] = id.force_noise;
  out["singular_values"] = std::vector<double>(
      id.singular_values.data(), id.singular_values.data() + id.singular_values.size());
  out["flattest_direction_steps"] = id.flattest;
  out["profiles"] = ordered_json::array();
  for (const Profile& profile : id.profiles) {
    ordered_json entry = {{"path", o.parameters[profile.parameter].path},
                          {"value", profile.value},
                          {"fitness", ordered_json::array()}};
    for (const double f : profile.fitness) entry["fitness"].push_back(number(f));
    out["profiles"].push_back(entry);
  }
  return out;
}

ordered_json history_json(const std::vector<Generation>& history) {
  ordered_json list = ordered_json::array();
  for (const Generation& g : history) {
    list.push_back({{"evaluations", g.evaluations},
                    {"valid", g.valid},
                    {"best", number(g.best)},
                    {"mean", number(g.mean)},
                    {"best_ever", number(g.best_ever)}});
  }
  return list;
}

}  // namespace

std::string result_json(const CalibrationOutcome& o, const OutputFiles& figures) {
  ordered_json out;
  out["config"] = std::filesystem::path(o.config_file).filename().string();
  out["model"] = std::filesystem::path(o.model_file).filename().string();
  out["optimiser"] = {{"method", o.optimiser.method},
                      {"parents", o.optimiser.parents},
                      {"offspring", o.optimiser.offspring},
                      {"generations", o.optimiser.generations},
                      {"seed", o.optimiser.seed},
                      {"evaluations", o.evaluations},
                      {"stopped", o.reason}};
  out["simulated_motion_s"] = o.simulation.motion;
  out["fitness"] = {{"before", number(o.fitness_before)}, {"after", number(o.fitness)}};
  if (!o.doubt.empty()) out["doubt"] = o.doubt;
  out["validation"] = runs_json(o.validation, *o.model);
  out["calibration"] = runs_json(o.calibration, *o.model);
  out["parameters"] = parameters_json(o);
  if (!o.identifiability.parameters.empty()) out["identifiability"] = identifiability_json(o);
  if (!o.calibration.runs.empty() && !o.calibration.runs.front().is_trajectory) {
    const int needed = equilibria_needed(static_cast<int>(o.parameters.size()),
                                         static_cast<int>(o.model->muscles.size()),
                                         o.model->skeleton->velocity_count);
    out["equilibria"] = {{"given", o.calibration.runs.size()}, {"needed_by_5.13", needed}};
  }
  for (const DriveErrors& d : o.drives) {
    out["drives"].push_back({{"drive", d.drive},
                             {"posture_rms_deg", number(kDegrees * d.posture)},
                             {"force_rms_N", number(d.force)},
                             {"largest_actuator_difference_deg", number(kDegrees * d.actuator)}});
  }
  out["overrides"] = o.overrides;
  out["given"] = o.given;
  out["history"] = history_json(o.history);
  out["validation_given"] = o.held_out;
  out["figures"] = figures_of(figures);
  return out.dump(2) + "\n";
}

}  // namespace calibration
}  // namespace anthrob
