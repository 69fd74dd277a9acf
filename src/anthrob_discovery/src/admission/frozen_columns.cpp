#include "admission/frozen_columns.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "admission/movement.h"
#include "anthrob_ecu/control_law.h"
#include "anthrob_ecu/state_machine.h"
#include "anthrob_recording/resolution.h"

namespace anthrob {
namespace discovery {

namespace {

/// One recording, and what moves in it.
class Witness {
 public:
  Witness(const RobotModel& robot, const Dataset& recording, const AdmissionOptions& options)
      : robot_(robot), data_(recording), options_(options) {
    for (const MuscleModel& muscle : robot.muscles) {
      widest_turn_ = std::max(widest_turn_, range_of(series(muscle, "position")));
      if (!holds_position(muscle)) continue;
      widest_reference_ = std::max(widest_reference_, range_of(series(muscle, "reference")));
    }
    joint_moves_ = any_joint_moves();
  }

  /// Whether a column has one value only, and should not.
  bool is_frozen(const MuscleModel& muscle, const std::string& quantity) const {
    const Series own = series(muscle, quantity);
    return own.values.size() >= options_.frozen.fewest_values && range_of(own) == 0.0 &&
           must_move(muscle, quantity) && others_move(muscle, quantity);
  }
  bool is_zero(const MuscleModel& muscle, const std::string& quantity) const {
    return series(muscle, quantity).values.front() == 0.0;
  }

 private:
  Series series(const MuscleModel& muscle, const std::string& quantity) const {
    return data_.series(muscle.name + "/" + quantity);
  }

  /// Whether its motor is enabled and under position control, as far as the recording says.
  bool holds_position(const MuscleModel& muscle) const {
    const auto is = [](double value) { return [value](double word) { return word == value; }; };
    const Series mode = series(muscle, "mode"), state = series(muscle, "ecu_state");
    const bool position = mode.empty() ? muscle.has_controller
                                       : std::all_of(mode.values.begin(), mode.values.end(),
                                                     is(static_cast<double>(ecu::Mode::kPosition)));
    return position &&
           (state.empty() || std::any_of(state.values.begin(), state.values.end(),
                                         is(static_cast<double>(ecu::State::kEnabled))));
  }

  bool must_move(const MuscleModel& muscle, const std::string& quantity) const {
    const auto is_wide = [this](double range, double widest) {
      return range >=
             std::max(options_.frozen.least_turn, options_.frozen.share_of_widest * widest);
    };
    const Series reference = series(muscle, "reference");
    if (!reference.empty()) {
      return holds_position(muscle) && is_wide(range_of(reference), widest_reference_);
    }
    return quantity == "force" && is_wide(range_of(series(muscle, "position")), widest_turn_);
  }

  bool others_move(const MuscleModel& muscle, const std::string& quantity) const {
    return joint_moves_ ||
           std::any_of(robot_.muscles.begin(), robot_.muscles.end(), [&](const auto& other) {
             if (other.name == muscle.name) return false;
             const Series own = series(other, quantity);
             return !own.empty() &&
                    moves(own, options_.frozen.fewest_counts * resolution_of(own.values),
                          options_.movement);
           });
  }

  bool any_joint_moves() const {
    for (const JointModel& joint : robot_.skeleton->joints) {
      for (const char* quantity : {"/position", "/x", "/y", "/z"}) {
        if (moves(data_.series(joint.name + quantity), options_.frozen.least_joint,
                  options_.movement))
          return true;
      }
    }
    return false;
  }

  const RobotModel& robot_;
  const Dataset& data_;
  const AdmissionOptions& options_;
  double widest_reference_ = 0.0, widest_turn_ = 0.0;  ///< [rad]
  bool joint_moves_ = false;
};

/// Whether a joint swings ever less, or comes to rest, as one does that was let go: ranges of its
/// position by quarters of the recording, down to what is no motion.
bool comes_to_rest(const Series& position, const FrozenColumnOptions& options) {
  const auto quarter = static_cast<std::ptrdiff_t>(position.values.size() / 4);
  if (quarter == 0) return false;
  double before = HUGE_VAL;
  for (std::ptrdiff_t q = 0; q < 4; ++q) {
    const auto begin = position.values.begin() + q * quarter;
    const auto [low, high] = std::minmax_element(begin, begin + quarter);
    const double range = *high - *low;
    if (range >= before && range > options.least_joint) return false;
    before = range;
  }
  return true;
}

std::set<std::string> frozen_columns(const RobotModel& robot, const Dataset& recording,
                                     const AdmissionOptions& options,
                                     std::vector<std::string>& remarks) {
  const Witness witness(robot, recording, options);
  std::set<std::string> frozen;
  for (const MuscleModel& muscle : robot.muscles) {
    for (const char* quantity : {"position", "current", "voltage", "force"}) {
      if (!witness.is_frozen(muscle, quantity)) continue;
      const std::string column = muscle.name + "/" + quantity;
      if (quantity == std::string("force") && witness.is_zero(muscle, quantity)) {
        remarks.push_back(recording.folder + ": " + column +
                          " is always 0: if the tendon was not slack all the time, the sensor is "
                          "dead, and its column should be removed");
        continue;
      }
      frozen.insert(column);
      remarks.push_back(recording.folder + ": " + column +
                        " never changes, though the muscle was moved: left out");
    }
  }
  for (const JointModel& joint : robot.skeleton->joints) {
    const std::string column = joint.name + "/effort";
    const Series effort = recording.series(column);
    if (!joint.driven || effort.values.size() < options.frozen.fewest_values ||
        range_of(effort) > 0.0)
      continue;
    if (!moves(recording.series(joint.name + "/position"), options.frozen.least_joint,
               options.movement))
      continue;
    if (effort.values.front() == 0.0 &&
        comes_to_rest(recording.series(joint.name + "/position"), options.frozen)) {
      remarks.push_back(
          recording.folder + ": " + column +
          " is always 0, and the joint comes to rest: taken as one that was let go; if it "
          "was driven, the sensor is dead");
      continue;
    }
    frozen.insert(column);
    remarks.push_back(recording.folder + ": " + column +
                      " never changes, though the joint was moved: left out");
  }
  return frozen;
}

void empty(const std::set<std::string>& columns, Dataset& recording) {
  for (Table& table : recording.tables) {
    for (Column& column : table.columns) {
      if (columns.count(column.name)) column.present.assign(table.t.size(), 0);
    }
  }
}

}  // namespace

std::vector<std::string> leave_out_frozen(const RobotModel& robot, Question& question) {
  std::vector<std::string> remarks;
  std::set<std::string> of_repeats;
  for (auto* group : {&question.train, &question.test, &question.repeats}) {
    for (Dataset& recording : *group) {
      const std::set<std::string> frozen =
          frozen_columns(robot, recording, question.options.admission, remarks);
      empty(frozen, recording);
      const bool is_first = group == &question.train && &recording == &group->front();
      if (is_first || group == &question.repeats) of_repeats.insert(frozen.begin(), frozen.end());
    }
  }
  if (question.repeats.empty() || of_repeats.empty()) return remarks;
  empty(of_repeats, question.train.front());
  for (Dataset& repeat : question.repeats) empty(of_repeats, repeat);
  return remarks;
}

}  // namespace discovery
}  // namespace anthrob
