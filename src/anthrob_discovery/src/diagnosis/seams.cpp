#include "diagnosis/seams.h"

#include <algorithm>
#include <cmath>

#include "anthrob_core/errors.h"
#include "experiment/posture_noise.h"
#include "judgement/judge.h"

namespace anthrob {
namespace discovery {

namespace {

using ChannelGaps =
    std::map<std::string, double>;  ///< by channel; empty: there is nothing to be fed

/// Gaps of one model to recordings that are fed at one seam.
class Fed {
 public:
  Fed(const Evaluator& evaluator, const Scales& scales, const Variant& variant, double bin,
      const Options& options)
      : evaluator_(evaluator), scales_(scales), variant_(variant), bin_(bin), options_(options) {}

  ChannelGaps gaps(const std::vector<Dataset>& recordings, ReplayMode mode) const {
    try {
      const Experiments experiments = make(recordings, mode);
      const Eigen::VectorXf factors = whitener(experiments, scales_, false);
      const Eigen::VectorXf left = residual(experiments, factors);
      if (left.size() == 0) return {};
      return Judge(experiments, factors, {}, options_.judgement).channel_gaps(left);
    } catch (const BadInput&) {
      return {};
    }
  }

  /// With measured postures imposed, without the part that their noise causes.
  ChannelGaps gaps_of_postures(const std::vector<Dataset>& recordings, std::uint64_t seed) const {
    const RobotModel& robot = *evaluator_.model();
    const PostureNoiseOptions& postures = options_.experiment.postures;
    try {
      std::vector<Dataset> smooth, noisier;
      for (const Dataset& recording : recordings) {
        smooth.push_back(with_smooth_postures(robot, recording, postures));
        noisier.push_back(
            with_smooth_postures(robot, with_noisier_postures(robot, recording, seed++), postures));
      }
      const Experiments experiments = make(smooth, ReplayMode::kPosture);
      const Eigen::VectorXf factors = whitener(experiments, scales_, false);
      const Eigen::VectorXf left = residual(experiments, factors),
                            other = residual(make(noisier, ReplayMode::kPosture), factors);
      if (left.size() == 0 || other.size() == 0) return {};
      const Judge judge(experiments, factors, {}, options_.judgement);
      const ChannelGaps noise = judge.channel_gaps(other - left);
      ChannelGaps gaps = judge.channel_gaps(left);
      for (auto& [name, gap] : gaps) {
        gap = std::sqrt(std::max(0.0, gap * gap - noise.at(name) * noise.at(name)));
      }
      return gaps;
    } catch (const BadInput&) {
      return {};
    }
  }

 private:
  Experiments make(const std::vector<Dataset>& recordings, ReplayMode mode) const {
    ReplayScope scope;
    scope.bin = bin_;
    scope.mode = mode;
    Experiments experiments;
    for (const Dataset& recording : recordings) {
      experiments.push_back(
          make_experiment(*evaluator_.model(), recording, options_.experiment, scope));
    }
    return experiments;
  }

  Eigen::VectorXf residual(const Experiments& experiments, const Eigen::VectorXf& factors) const {
    Differences differences = evaluator_.compare({variant_}, experiments).front();
    if (differences.size() > 0) differences.array() *= factors.array();
    return differences;
  }

  const Evaluator& evaluator_;
  const Scales& scales_;
  const Variant& variant_;
  double bin_;
  const Options& options_;
};

/// The part of a gap that is not noise.
double beyond_noise(double gap) {
  return std::sqrt(std::max(0.0, gap * gap - 1.0));
}

std::optional<double> whole_of(const SeamGap& gap) {
  return gap.commands ? gap.commands : gap.voltages;
}

/// Fed with measured values, motors or arm may drift away further than in the whole chain.
std::optional<double> before_postures(const SeamGap& gap) {
  const std::optional<double> whole = whole_of(gap);
  return whole && gap.positions ? std::min(*whole, *gap.positions) : gap.positions;
}

/// Whether a gap's cause is cut off by feeding at a later seam.
bool goes(const std::optional<double>& from, const std::optional<double>& to, double gone) {
  return from && to && beyond_noise(*to) < gone * beyond_noise(*from);
}

}  // namespace

bool postures_mislead(const SeamGap& gap, const SeamOptions& options) {
  return gap.positions && gap.postures &&
         *gap.postures > options.misleading * *before_postures(gap);
}

std::vector<SeamGap> seam_gaps(const Evaluator& evaluator, const Admission& admission,
                               const Scales& scales, const Variant& variant) {
  if (evaluator.model()->muscles.empty()) return {};
  const Question& question = admission.question;
  const Fed fed(evaluator, scales, variant, admission.train.front()->bin(), question.options);
  // Of other controllers, the model's say nothing.
  const ChannelGaps commands = question.feed ? ChannelGaps{}
                                             : fed.gaps(question.train, ReplayMode::kReference),
                    voltages = fed.gaps(question.train, ReplayMode::kVoltage),
                    positions = fed.gaps(question.train, ReplayMode::kPosition),
                    postures = fed.gaps_of_postures(question.train, question.seed);
  std::vector<SeamGap> seams;
  for (const auto& [name, scale] : scales) {
    const std::size_t slash = name.rfind('/');
    SeamGap gap;
    gap.place = name.substr(0, slash);
    gap.channel = name.substr(slash + 1);
    gap.of_joint = evaluator.model()->skeleton->find_joint(gap.place) >= 0;
    const auto value = [key = name](const ChannelGaps& gaps) -> std::optional<double> {
      const auto found = gaps.find(key);
      if (found == gaps.end()) return std::nullopt;
      return found->second;
    };
    gap.commands = value(commands);
    gap.voltages = value(voltages);
    gap.positions = value(positions);
    gap.postures = value(postures);
    seams.push_back(std::move(gap));
  }
  return seams;
}

std::string subsystem_of(const SeamGap& gap, const SeamOptions& options) {
  const bool from_controllers = goes(gap.commands, gap.voltages, options.gone);
  if (gap.channel == "voltage") return "controller, or what it measures";
  if (!gap.of_joint && (gap.channel == "position" || gap.channel == "current")) {
    return from_controllers ? "controller" : "power stage, motor or gear, or their load";
  }
  if (goes(whole_of(gap), gap.positions, options.gone)) {
    return from_controllers ? "controller" : "power stage, motor or gear";
  }
  if (gap.channel != "force") return "path, skeleton, joints or their sensors";
  if (!gap.postures || postures_mislead(gap, options)) {
    return "spindle, tendon, spring, path or force sensor";
  }
  return goes(before_postures(gap), gap.postures, options.gone)
             ? "friction along the path, skeleton, joints or their sensors"
             : "spindle, tendon, spring, length of the path or force sensor";
}

}  // namespace discovery
}  // namespace anthrob
