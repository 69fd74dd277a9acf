#include "measurement/column_correction.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "anthrob_core/text.h"
#include "anthrob_sim/replay/replay.h"
#include "measurement/column_edits.h"
#include "measurement/column_factor.h"
#include "measurement/expected_current.h"

namespace anthrob {
namespace discovery {

namespace {

const double kDegrees = 180.0 / M_PI, kRpm = 60.0 / (2.0 * M_PI), kKilogram = 1.0 / 9.80665;

/// Two columns at the same moments.
struct Compared {
  std::vector<double> expected, recorded;
};

bool commands_positions(const CommandSeries& commands) {
  return !commands.reference.empty() &&
         std::all_of(commands.mode.values.begin(), commands.mode.values.end(),
                     [](double mode) { return mode == static_cast<double>(ecu::Mode::kPosition); });
}

Compared position_and_reference(const Dataset& recording, const std::string& name) {
  Compared compared;
  const CommandSeries commands = followed_commands(recording, name, ecu::Mode::kPosition);
  if (!commands_positions(commands)) return compared;
  const Series position = recording.series(name + "/position");
  for (std::size_t i = 0; i < position.t.size(); ++i) {
    if (position.t[i] < commands.reference.t.front()) continue;
    compared.expected.push_back(commands.reference.held_at(position.t[i] + 1e-9));
    compared.recorded.push_back(position.values[i]);
  }
  return compared;
}

/// Changes of a position, and the integral of its velocity meanwhile.
Compared velocity_and_position(const Dataset& recording, const std::string& name,
                               std::size_t rows) {
  Compared compared;
  const Series position = recording.series(name + "/position"),
               velocity = recording.series(name + "/velocity");
  if (position.empty()) return compared;
  for (std::size_t first = 0; first + rows < velocity.t.size(); first += rows / 2) {
    double integral = 0.0;
    for (std::size_t i = first; i < first + rows; ++i) {
      integral +=
          0.5 * (velocity.values[i] + velocity.values[i + 1]) * (velocity.t[i + 1] - velocity.t[i]);
    }
    compared.expected.push_back(position.at(velocity.t[first + rows]) -
                                position.at(velocity.t[first]));
    compared.recorded.push_back(integral);
  }
  return compared;
}

Compared current_and_voltage(const MuscleModel& muscle, const Dataset& recording, double beside) {
  Compared compared;
  const Series current = recording.series(muscle.name + "/current"),
               expected = expected_current(muscle, recording, beside);
  if (expected.empty()) return compared;
  for (std::size_t i = 0; i < current.t.size(); ++i) {
    if (current.t[i] < expected.t.front() || current.t[i] > expected.t.back()) continue;
    compared.expected.push_back(expected.at(current.t[i]));
    compared.recorded.push_back(current.values[i]);
  }
  return compared;
}

/// A column as it was measured and as the model has it.
Compared measured_and_simulated(const Dataset& recording, const std::optional<Dataset>& simulated,
                                const std::string& column) {
  Compared compared;
  if (!simulated) return compared;
  const Series measured = recording.series(column), other = simulated->series(column);
  if (other.empty()) return compared;
  for (std::size_t i = 0; i < measured.t.size(); ++i) {
    compared.expected.push_back(other.at(measured.t[i]));
    compared.recorded.push_back(measured.values[i]);
  }
  return compared;
}

/// What all recordings that tell have in common: those that do not are of the same make.
std::optional<ColumnFactor> common_factor(const std::vector<std::optional<ColumnFactor>>& found) {
  std::optional<ColumnFactor> common;
  for (const auto& one : found) {
    if (!one) continue;
    if (common && common->factor != one->factor) return {};
    common = common ? common : one;
  }
  return common;
}

/// Finds, corrects and reports factors of columns.
class ColumnCorrection {
 public:
  explicit ColumnCorrection(Description& description)
      : description_(description),
        options_(description.question.options.measurement.column),
        recordings_(recordings_of(description.question)) {}

  template <typename Comparison>
  void correct(const std::string& column, const std::string& kind, const std::string& against,
               const std::vector<double>& factors, double near, const Comparison& comparison) {
    std::vector<std::optional<ColumnFactor>> found;  // by recording; nothing: it does not tell
    for (std::size_t r = 0; r < recordings_.size(); ++r) {
      const bool has = !recordings_[r]->series(column).empty();
      const Compared compared = has ? comparison(*recordings_[r], r) : Compared{};
      found.push_back(column_factor(compared.expected, compared.recorded, factors, near, options_));
    }
    const auto other = common_factor(found);
    bool is_told = false;
    for (std::size_t r = 0; r < recordings_.size(); ++r) {
      const auto& own = found[r] ? found[r] : other;
      if (!own || own->factor == 1.0 || recordings_[r]->series(column).empty()) continue;
      divide_columns(
          *recordings_[r], [&](const Column& one) { return one.name == column; }, own->factor);
      description_.corrected = true;
      if (!is_told) tell(column, kind, against, *own);
      is_told = true;
    }
  }
  /// A joint's position and velocity.
  void remark_on_rate(const std::string& joint) {
    for (const Dataset* recording : recordings_) {
      const Compared compared = velocity_and_position(*recording, joint, options_.rows);
      const auto found = column_factor(compared.expected, compared.recorded, {kDegrees, 1e3, 1e-3},
                                       options_.exactly.value, options_);
      if (!found || found->factor == 1.0) continue;
      description_.remarks.push_back(
          joint + "/velocity: " + short_number(found->factor) + " times the rate of " + joint +
          "/position: one of the two has another sign or unit; left as they are");
      return;
    }
  }

 private:
  void tell(const std::string& column, const std::string& kind, const std::string& against,
            const ColumnFactor& found) {
    const double half = 1.96 * found.sigma;
    description_.measurement.push_back({kind,
                                        column.substr(0, column.rfind('/')),
                                        found.factor == -1.0 ? "sign" : "unit",
                                        found.factor,
                                        {found.measured - half, found.measured + half},
                                        "1",
                                        "found"});
    description_.remarks.push_back(column + ": " + short_number(found.factor) + " times " +
                                   against + ", by another sign or unit: divided by it");
  }

  Description& description_;
  ColumnOptions options_;
  std::vector<Dataset*> recordings_;
};

}  // namespace

void correct_columns(const RobotModel& robot, Description& description) {
  const ColumnOptions options = description.question.options.measurement.column;
  ColumnCorrection correction(description);
  for (const MuscleModel& muscle : robot.muscles) {
    const std::string& name = muscle.name;
    if (muscle.has_controller) {
      correction.correct(name + "/position", "position", "the reference that it follows",
                         {kDegrees, 1e3, 1e-3}, options.near.value,
                         [&](const Dataset& recording, std::size_t) {
                           return position_and_reference(recording, name);
                         });
    }
    correction.correct(name + "/velocity", "velocity", "the rate of its position",
                       {kDegrees, kRpm, 10.0, 100.0, 1e3, 0.1, 0.01, 1e-3}, options.exactly.value,
                       [&](const Dataset& recording, std::size_t) {
                         return velocity_and_position(recording, name, options.rows);
                       });
    correction.correct(name + "/current", "current",
                       "what voltage and velocity give by the motor's resistance", {1e3, 1e-3},
                       options.near.value, [&](const Dataset& recording, std::size_t) {
                         return current_and_voltage(muscle, recording, options.beside);
                       });
  }
  for (const JointModel& joint : robot.skeleton->joints) {
    if (joint.type != JointType::kBall) correction.remark_on_rate(joint.name);
  }
}

void correct_columns_by_model(const RobotModel& robot,
                              const std::vector<std::optional<Dataset>>& simulated,
                              Description& description) {
  const double near = description.question.options.measurement.column.near.value;
  ColumnCorrection correction(description);
  const auto correct = [&](const std::string& column, const std::string& kind,
                           const std::vector<double>& factors) {
    correction.correct(column, kind, "what the model gives", factors, near,
                       [&](const Dataset& recording, std::size_t r) {
                         return measured_and_simulated(recording, simulated[r], column);
                       });
  };
  for (const MuscleModel& muscle : robot.muscles) {
    correct(muscle.name + "/force", "force", {1e3, 1e-3, kKilogram, 1e3 * kKilogram});
  }
  for (const JointModel& joint : robot.skeleton->joints) {
    if (joint.type == JointType::kBall) continue;
    correct(joint.name + "/position", "joint position", {kDegrees, 1e3, 1e-3});
  }
}

}  // namespace discovery
}  // namespace anthrob
