#include "anthrob_calib/discovery/seams.h"

#include "anthrob_calib/discovery/judge.h"
#include "anthrob_sim/core/errors.h"

namespace anthrob {
namespace discovery {

namespace {

/// Less than this share of a gap is left when its cause lies before the seam.
constexpr double kGone = 0.5;

/// Gaps of all channels with a seam fed; empty if the recordings lack what is to be fed.
std::map<std::string, double> gaps_fed(const Evaluator& evaluator, const Question& question,
                                       const Laboratory& laboratory, const Scales& scales,
                                       const Variant& variant, ReplayMode mode) {
  ExperimentOptions options;
  options.bin = laboratory.train.front()->bin();
  options.mode = mode;
  try {
    Experiments experiments;
    for (const Dataset& recording : question.train) {
      experiments.push_back(make_experiment(*evaluator.model(), recording, options));
    }
    const Eigen::VectorXf factors = whitener(experiments, scales, false);
    Differences differences = evaluator.compare({variant}, experiments).front();
    if (differences.size() == 0) return {};
    differences.array() *= factors.array();
    return Judge(experiments, factors, {}).channel_gaps(differences);
  } catch (const BadInput&) {
    return {};
  }
}

}  // namespace

std::vector<SeamGap> seam_gaps(const Evaluator& evaluator, const Question& question,
                               const Laboratory& laboratory, const Scales& scales,
                               const Variant& variant) {
  if (evaluator.model()->muscles.empty()) return {};
  const auto commands =
                 gaps_fed(evaluator, question, laboratory, scales, variant, ReplayMode::kReference),
             voltages =
                 gaps_fed(evaluator, question, laboratory, scales, variant, ReplayMode::kVoltage),
             positions =
                 gaps_fed(evaluator, question, laboratory, scales, variant, ReplayMode::kPosition);
  std::vector<SeamGap> seams;
  for (const auto& [name, scale] : scales) {
    const std::size_t slash = name.rfind('/');
    SeamGap gap{name.substr(0, slash), name.substr(slash + 1)};
    gap.of_joint = evaluator.model()->skeleton->find_joint(gap.place) >= 0;
    const auto value = [&](const std::map<std::string, double>& gaps) {
      const auto found = gaps.find(name);
      return found == gaps.end() ? -1.0 : found->second;
    };
    gap.commands = value(commands);
    gap.voltages = value(voltages);
    gap.positions = value(positions);
    seams.push_back(std::move(gap));
  }
  return seams;
}

std::string subsystem_of(const SeamGap& gap) {
  const double whole = gap.commands >= 0.0 ? gap.commands : gap.voltages;
  const bool from_motors = gap.positions >= 0.0 && gap.positions < kGone * whole;
  const bool from_controllers = gap.voltages >= 0.0 && gap.voltages < kGone * gap.commands;
  if (gap.channel == "voltage") return "controller, or what it measures";
  if (!gap.of_joint && (gap.channel == "position" || gap.channel == "current")) {
    return from_controllers ? "controller" : "power stage, motor or gear, or their load";
  }
  if (from_motors) return from_controllers ? "controller" : "power stage, motor or gear";
  if (gap.channel == "force") return "spindle, tendon, spring, path or force sensor";
  return "path, skeleton, joints or their sensors";
}

}  // namespace discovery
}  // namespace anthrob
