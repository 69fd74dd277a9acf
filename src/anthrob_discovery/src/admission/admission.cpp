#include "admission/admission.h"

#include <algorithm>
#include <cmath>

#include "admission/frozen_columns.h"
#include "admission/movement.h"
#include "admission/repeats.h"
#include "admission/shared_channels.h"
#include "admission/sound_recordings.h"
#include "anthrob_core/errors.h"
#include "anthrob_core/text.h"
#include "anthrob_recording/table.h"
#include "experiment/axis_plan.h"
#include "experiment/chain_experiment.h"
#include "experiment/poses.h"
#include "judgement/judge.h"

namespace anthrob {
namespace discovery {

namespace {

/// Recordings of one option, by their lengths.
struct Length {
  double seconds = 0.0;
  std::size_t blocks = 0;  ///< of the judge
};

/// @param option that named them
Length refuse_shortness(const std::vector<Dataset>& recordings, const std::string& option,
                        const Options& options) {
  Length length;
  for (const Dataset& recording : recordings) {
    const double own = seconds(recording.end() - recording.begin());
    length.seconds += own;
    length.blocks += Judge::blocks_of(own, options.judgement);
  }
  if (length.seconds < options.admission.shortest) {
    throw BadInput(recordings.front().folder + ": too short: the " + option + " recordings are " +
                   significant(length.seconds, 6) + " s long in all; expected at least " +
                   short_number(options.admission.shortest) + " s");
  }
  return length;
}

/// What is named must gain over blocks of training and held-out recordings together.
void refuse_too_few_blocks(const Question& question, const Length& train, const Length& test) {
  const JudgementOptions& judgement = question.options.judgement;
  if (train.blocks + test.blocks >= judgement.fewest_blocks) return;
  throw BadInput(question.test.front().folder + ": too short: the --train recordings are " +
                 significant(train.seconds, 6) + " s and the --test recordings " +
                 significant(test.seconds, 6) + " s long, together " +
                 std::to_string(train.blocks + test.blocks) + " blocks of " +
                 short_number(judgement.block) + " s; expected at least " +
                 std::to_string(judgement.fewest_blocks) + " blocks (" +
                 short_number(judgement.fewest_blocks * judgement.block) +
                 " s), because nothing can be named by fewer");
}

/// Of one side alone, the other one may make up for it.
void remark_on_few_blocks(const Length& length, const std::string& option,
                          const JudgementOptions& judgement, std::vector<std::string>& remarks) {
  if (length.blocks >= judgement.fewest_blocks) return;
  remarks.push_back("the " + option + " recordings are only " + significant(length.seconds, 6) +
                    " s long in all, which is too short to say how certain a gap is there; " +
                    short_number(judgement.fewest_blocks * judgement.block) +
                    " s or more would do");
}

/// Held-out recordings with the commands of the training recordings test less than they seem to.
std::vector<std::string> remarks_on(const RobotModel& robot, const Question& question) {
  std::vector<std::string> remarks;
  for (const Dataset& test : question.test) {
    for (const Dataset& train : question.train) {
      if (!have_same_commands(robot, train, test, question.options.admission.repeats)) continue;
      remarks.push_back(test.folder + ": has the same commands as " + train.folder +
                        ", which is fitted; another motion would judge better");
    }
  }
  return remarks;
}

/// Numbers of the model that are others in a recording: the answer rests on them.
std::vector<std::string> remarks_on_known_numbers(const Dataset& recording) {
  std::string list;
  for (const auto& [path, value] : recording.meta.model) {
    list += (list.empty() ? "" : ", ") + path + " " + exact_text(value);
  }
  if (list.empty()) return {};
  return {recording.folder + ": simulated with numbers of its own: " + list};
}

/// Poses in an order and at times by which everything else may go.
Question with_ordered_poses(const RobotModel& robot, Question question,
                            std::vector<std::string>& remarks) {
  const PoseOptions& options = question.options.experiment.poses;
  for (auto* group : {&question.train, &question.test, &question.repeats}) {
    for (Dataset& recording : *group) {
      if (!holds_poses(robot, recording)) continue;
      refuse_nonsense(robot, recording, question.options.admission.soundness);
      recording = ordered_poses(robot, recording, options, &remarks);
      remarks.push_back(recording.folder + ": " +
                        std::to_string(recording.tables.front().t.size()) +
                        " poses at rest, in order of direction and position; where a time is "
                        "told, each of them stands for " +
                        short_number(options.seconds) + " s");
    }
  }
  return question;
}

/// Directions are of poses: elsewhere, positions tell them.
std::vector<std::string> remarks_on_directions(const RobotModel& robot, const Dataset& recording) {
  std::vector<std::string> remarks;
  if (holds_poses(robot, recording)) return remarks;
  for (const Table& table : recording.tables) {
    for (const Column& column : table.columns) {
      if (column.quantity() != "direction") continue;
      remarks.push_back(recording.folder + ": " + column.name +
                        ": left out; it is used of poses at rest of driven joints only (`kind: "
                        "equilibrium` in meta.yaml)");
    }
  }
  return remarks;
}

/// A velocity tells positions but for a drift, which only who knows the robot may accept.
void refuse_velocity_alone(const RobotModel& robot, const Dataset& recording) {
  for (const JointModel& joint : robot.skeleton->joints) {
    const std::string position = joint.name + "/position", velocity = joint.name + "/velocity";
    if (!joint.driven || !recording.series(position).empty()) continue;
    if (recording.series(velocity).empty()) continue;
    throw BadInput(recording.folder + ": column '" + position + "' is missing, only " + velocity +
                   " was measured; where nothing depends on the position, as of a hinge without "
                   "gravity and stops, let anthrob_convert integrate it (`from: {integral: ...}`)");
  }
}

/// Recordings in time, of which bins and inertia are planned.
std::vector<Dataset> recordings_in_motion(const RobotModel& robot,
                                          const std::vector<Dataset>& recordings) {
  std::vector<Dataset> motions;
  for (const Dataset& recording : recordings) {
    if (!holds_poses(robot, recording)) motions.push_back(recording);
  }
  return motions;
}

}  // namespace

Admission admit(const Evaluator& evaluator, const Question& given) {
  const RobotModel& robot = *evaluator.model();
  std::vector<std::string> remarks_on_poses;
  const Question asked = with_ordered_poses(robot, given, remarks_on_poses);
  const Options& options = asked.options;
  if (asked.train.empty()) throw BadInput("--train: expected at least one recording");
  if (asked.test.empty()) {
    throw BadInput("--test: expected at least one recording to judge by, which is not fitted");
  }
  for (const auto* group : {&asked.train, &asked.test, &asked.repeats}) {
    for (const Dataset& recording : *group) {
      refuse_nonsense(robot, recording, options.admission.soundness);
      evaluator.require_buildable(recording);
      refuse_velocity_alone(robot, recording);
    }
  }
  const Length length = refuse_shortness(asked.train, "--train", options);
  const Length held_out = refuse_shortness(asked.test, "--test", options);
  refuse_too_few_blocks(asked, length, held_out);
  refuse_stillness(robot, asked.train, options.admission.movement);
  refuse_stillness(robot, asked.test, options.admission.movement);
  refuse_copies(asked);

  Admission admitted;
  admitted.question = asked;
  admitted.remarks = remarks_on(robot, asked);
  append(remarks_on_poses, admitted.remarks);
  remark_on_few_blocks(length, "--train", options.judgement, admitted.remarks);
  remark_on_few_blocks(held_out, "--test", options.judgement, admitted.remarks);
  append(leave_out_frozen(robot, admitted.question), admitted.remarks);
  const Question& question = admitted.question;
  std::vector<double> late;  // [s]
  for (const Dataset& repeat : question.repeats) {
    late.push_back(
        lateness_of_repeat(robot, question.train.front(), repeat, options.admission.repeats));
  }
  for (const auto* group : {&question.train, &question.test, &question.repeats}) {
    for (const Dataset& recording : *group) {
      append(remarks_on_known_numbers(recording), admitted.remarks);
      append(remarks_on_directions(robot, recording), admitted.remarks);
      append(remarks_on_stamps(recording, options.admission.soundness), admitted.remarks);
    }
  }

  ReplayScope scope;
  scope.bin = options.admission.finest_bin;
  scope.mode = question.feed;
  const std::vector<Dataset> motions = recordings_in_motion(robot, question.train);
  if (robot.muscles.empty() && !motions.empty()) {
    const AxisPlan plan = plan_axes(robot, motions, options.experiment.axis);
    scope.bin = plan.bin;
    scope.hidden_inertia = plan.hidden_inertia;
    append(remarks_on_plan(robot, plan), admitted.remarks);
  }
  const double channels = 4.0 * static_cast<double>(robot.muscles.size()) + 4.0;
  scope.bin *= std::max(
      1.0, std::ceil(length.seconds / scope.bin * channels / options.admission.most_differences));
  const auto make = [&](const std::vector<Dataset>& recordings, Experiments& experiments) {
    for (const Dataset& recording : recordings) {
      experiments.push_back(make_experiment(robot, recording, options.experiment, scope));
    }
  };
  make(question.train, admitted.train);
  make(question.test, admitted.test);
  make(question.repeats, admitted.repeats);
  append(remarks_on_channels(admitted.train, admitted.test, options.admission), admitted.remarks);
  // Whole steps of the simulation make a bin a little longer or shorter than was asked for.
  const double bin = admitted.train.front()->bin();
  for (const double seconds : late) admitted.lags.push_back(std::lround(seconds / bin));
  // A driven axis is simulated fast enough for the longer look.
  admitted.quick =
      excerpt(robot, question.train, admitted.train,
              robot.muscles.empty() ? options.admission.slow_look : options.admission.quick_look,
              options.experiment, question.feed);
  admitted.slow = excerpt(robot, question.train, admitted.train, options.admission.slow_look,
                          options.experiment, question.feed);
  return admitted;
}

}  // namespace discovery
}  // namespace anthrob
