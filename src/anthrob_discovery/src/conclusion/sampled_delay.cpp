#include "conclusion/sampled_delay.h"

#include <algorithm>
#include <set>
#include <string>

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

}  // namespace

Answer with_sampled_delay(Answer answer, const RobotModel& robot, double longest) {
  const auto is_sampled = [&](const FoundEffect& effect) {
    return effect.id == "mocap_delay" && effect.parameters.front().value <= longest;
  };
  const auto found = std::find_if(answer.effects.begin(), answer.effects.end(), is_sampled);
  if (found == answer.effects.end()) return answer;
  const FoundParameter delay = found->parameters.front();
  for (const std::string& kind : kinds_of_joints(robot)) {
    answer.measurement.push_back(
        {kind, "all", "delay", delay.value, {delay.low, delay.high}, delay.unit, "found"});
  }
  answer.remarks.push_back("all joints are stamped " + significant(1e3 * delay.value, 2) +
                           " ms too late: model.yaml has it as mocap_delay");
  answer.search.alternatives =
      without_effect(static_cast<std::size_t>(found - answer.effects.begin()),
                     std::move(answer.search.alternatives));
  answer.effects.erase(found);
  return answer;
}

}  // namespace discovery
}  // namespace anthrob
