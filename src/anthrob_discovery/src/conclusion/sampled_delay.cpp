#include "conclusion/sampled_delay.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "anthrob_core/text.h"

namespace anthrob {
namespace discovery {

namespace {

/// Without the alternatives to it and another effect.
std::vector<Alternative> without_effect(std::size_t effect, std::vector<Alternative> alternatives) {
  alternatives.erase(std::remove_if(alternatives.begin(), alternatives.end(),
                                    [&](const Alternative& alternative) {
                                      return alternative.instead_of[0] == effect ||
                                             alternative.instead_of[1] == effect;
                                    }),
                     alternatives.end());
  for (Alternative& alternative : alternatives) {
    for (std::size_t& index : alternative.instead_of) index -= index > effect ? 1 : 0;
  }
  return alternatives;
}

/// What is measured of the robot's joints.
std::set<std::string> kinds_of_joints(const RobotModel& robot) {
  std::set<std::string> kinds;
  for (const JointModel& joint : robot.skeleton->joints) {
    kinds.insert(joint.type == JointType::kBall ? "orientation" : "joint position");
  }
  return kinds;
}

/// An effect that sampling makes, too, up to some delay [s].
struct SampledEffect {
  std::string id;
  std::set<std::string> channel_kinds;
  double longest;
};

/// Where the joints' clock was moved, what is left of its offset looks like a delay.
bool has_moved_clock(const Measurement& measurement) {
  return std::any_of(measurement.begin(), measurement.end(), [](const MeasurementProperty& row) {
    return row.what == "clock" && row.unit == "s";
  });
}

std::vector<SampledEffect> sampled_effects(const RobotModel& robot, double longest) {
  double tick = 0.0;
  for (const MuscleModel& muscle : robot.muscles) {
    if (muscle.has_controller) tick = std::max(tick, muscle.controller.period);
  }
  return {{"mocap_delay", kinds_of_joints(robot), longest},
          {"sensing_latency", {"position and force"}, tick},
          {"command_latency", {"reference"}, tick}};
}

/// @param effect index of the one that is told among `measurement`
Answer moved(Answer answer, std::size_t effect, const std::set<std::string>& kinds) {
  const FoundEffect& found = answer.effects[effect];
  const FoundParameter& delay = found.parameters.front();
  const std::string place = found.place == "global" ? "all" : found.place;
  for (const std::string& kind : kinds) {
    answer.measurement.push_back(
        {kind, place, "delay", delay.value, {delay.low, delay.high}, delay.unit, "found"});
  }
  answer.remarks.push_back(
      (place == "all" ? "all of kind " : place + "/") +
      joined({kinds.begin(), kinds.end()}, " and ") + ": " + significant(1e3 * delay.value, 2) +
      " ms late, as sampling makes them: " + "model.yaml has it as " + found.id);
  answer.search.alternatives = without_effect(effect, std::move(answer.search.alternatives));
  answer.effects.erase(answer.effects.begin() + static_cast<std::ptrdiff_t>(effect));
  return answer;
}

}  // namespace

Answer with_sampled_delays(Answer answer, const RobotModel& robot, double longest) {
  const double latest = has_moved_clock(answer.measurement) ? HUGE_VAL : longest;
  for (const SampledEffect& sampled : sampled_effects(robot, latest)) {
    for (std::size_t e = answer.effects.size(); e-- > 0;) {
      const FoundEffect& effect = answer.effects[e];
      if (effect.id != sampled.id || effect.parameters.front().value > sampled.longest) continue;
      answer = moved(std::move(answer), e, sampled.channel_kinds);
    }
  }
  return answer;
}

}  // namespace discovery
}  // namespace anthrob
