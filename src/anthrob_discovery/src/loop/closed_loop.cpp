#include "loop/closed_loop.h"

#include <algorithm>
#include <exception>

#include "anthrob_core/errors.h"
#include "anthrob_core/text.h"
#include "experiment/simulated_recording.h"

namespace anthrob {
namespace discovery {

namespace {

/// The first effect whose rival a recording can decide; null: none.
const FoundEffect* undecided(const Answer& answer, const LoopOptions& options) {
  const auto it =
      std::find_if(answer.effects.begin(), answer.effects.end(), [&](const FoundEffect& effect) {
        return !effect.rivals.empty() && effect.rivals.front().probability > options.rival &&
               effect.separating_recording.distance() > options.tells;
      });
  return it == answer.effects.end() ? nullptr : &*it;
}

std::string name_of(int number, const std::string& group) {
  return "separating_" + std::to_string(number) + "_" + group;
}

std::string sentence(const FoundEffect& effect, int number) {
  const Rival& rival = effect.rivals.front();
  return effect.id + " @ " + effect.place + " (" + short_number(effect.probability) + ") or " +
         rival.id + " @ " + rival.place + " (" + short_number(rival.probability) +
         "): separating recording " + std::to_string(number) + " of the robot, expected to bring " +
         short_number(effect.separating_recording.distance()) + " nat of evidence";
}

/// Commands and measurements go by the names of muscles and joints: another robot would fail, or
/// stand still, only at the end of a long search.
void require_same_robot(const RobotModel& examined, const RobotModel& robot) {
  const auto refuse = [&](const std::string& what) {
    throw BadInput("--close-the-loop " + robot.file + ": has no " + what +
                   "; expected the muscles and joints of " + examined.file);
  };
  for (const MuscleModel& muscle : examined.muscles) {
    const int same = robot.find_muscle(muscle.name);
    if (same < 0) refuse("muscle '" + muscle.name + "'");
    if (muscle.has_controller && !robot.muscles[static_cast<std::size_t>(same)].has_controller) {
      refuse("controller for muscle '" + muscle.name + "'");
    }
  }
  for (const JointModel& joint : examined.skeleton->joints) {
    const int same = robot.skeleton->find_joint(joint.name);
    if (same < 0) refuse("joint '" + joint.name + "'");
    const bool ball = joint.type == JointType::kBall;
    if (ball != (robot.skeleton->joints[static_cast<std::size_t>(same)].type == JointType::kBall)) {
      refuse((ball ? "ball joint '" : "hinge or slide '") + joint.name + "'");
    }
  }
}

}  // namespace

Answer discover_in_a_loop(const Evaluator& evaluator, Question& question,
                          const std::shared_ptr<const RobotModel>& robot,
                          const Observer& observer) {
  const LoopOptions options = question.options.loop;
  require_same_robot(*evaluator.model(), *robot);
  Answer answer = discover(evaluator, question, observer);
  std::vector<std::string> asked;
  for (int number = 1; number <= options.most_recordings; ++number) {
    const FoundEffect* effect = undecided(answer, options);
    if (effect == nullptr) break;
    asked.push_back(sentence(*effect, number));
    observer.say(asked.back());
    const auto record = [&](std::size_t first, const std::string& name) {
      const Dataset commands = separating_commands(*evaluator.model(), effect->separating_recording,
                                                   question.options.separation, first, 2);
      Dataset recording = simulated_recording(
          robot, commands, question.seed + 2 * static_cast<std::uint64_t>(number) + first,
          question.options.experiment);
      recording.folder = name_of(number, name);
      return recording;
    };
    Question more = question;
    try {
      more.train.push_back(record(0, "train"));
      more.test.push_back(record(1, "test"));
      answer = discover(evaluator, more, observer);
    } catch (const Interrupted&) {
      throw;
    } catch (const std::exception& e) {
      // The answer without that recording stays.
      asked.back() += "; it failed: " + std::string(e.what());
      observer.say(asked.back());
      break;
    }
    question = std::move(more);
  }
  answer.asked = std::move(asked);
  return answer;
}

std::vector<std::string> loop_recordings(const LoopOptions& options) {
  std::vector<std::string> names;
  for (int number = 1; number <= options.most_recordings; ++number) {
    for (const char* group : {"train", "test"}) names.push_back(name_of(number, group));
  }
  return names;
}

}  // namespace discovery
}  // namespace anthrob
