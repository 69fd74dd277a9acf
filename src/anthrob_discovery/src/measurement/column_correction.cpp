#include "measurement/column_correction.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "anthrob_core/text.h"
#include "anthrob_sim/actuator/dc_motor.h"
#include "anthrob_sim/replay/replay.h"
#include "measurement/column_factor.h"

namespace anthrob {
namespace discovery {

namespace {

const double kDegrees = 180.0 / M_PI, kRpm = 60.0 / (2.0 * M_PI);

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
  const auto* motor = dynamic_cast<const DcMotor*>(muscle.actuator.get());
  if (motor == nullptr) return compared;
  const auto& p = motor->parameters();
  const Series current = recording.series(muscle.name + "/current"),
               voltage = recording.series(muscle.name + "/voltage"),
               position = recording.series(muscle.name + "/position");
  if (voltage.empty() || position.empty()) return compared;
  for (std::size_t i = 0; i < current.t.size(); ++i) {
    const double t = current.t[i];
    if (t - beside < position.t.front() || t + beside > position.t.back()) continue;
    const double velocity = (position.at(t + beside) - position.at(t - beside)) / (2.0 * beside);
    compared.expected.push_back((voltage.at(t) - p.back_emf_constant * p.ratio * velocity) /
                                p.resistance);
    compared.recorded.push_back(current.values[i]);
  }
  return compared;
}

void divide(Dataset& recording, const std::string& name, double factor) {
  for (Table& table : recording.tables) {
    if (table.name == "commands") continue;
    for (Column& column : table.columns) {
      if (column.name != name) continue;
      for (double& value : column.values) value /= factor;
    }
  }
}

/// Finds, corrects and reports factors of columns.
class ColumnCorrection {
 public:
  explicit ColumnCorrection(Description& description)
      : description_(description), options_(description.question.options.measurement.column) {
    for (auto* group :
         {&description.question.train, &description.question.test, &description.question.repeats}) {
      for (Dataset& recording : *group) recordings_.push_back(&recording);
    }
  }

  template <typename Comparison>
  void correct(const std::string& place, const std::string& kind, const std::string& against,
               const std::vector<double>& factors, double near, const Comparison& comparison) {
    bool is_told = false;
    for (Dataset* recording : recordings_) {
      if (recording->series(place + "/" + kind).empty()) continue;
      const Compared compared = comparison(*recording);
      const auto found =
          column_factor(compared.expected, compared.recorded, factors, near, options_);
      if (!found || found->factor == 1.0) continue;
      divide(*recording, place + "/" + kind, found->factor);
      description_.corrected = true;
      if (!is_told) tell(place, kind, against, *found, "divided by it");
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
  void tell(const std::string& place, const std::string& kind, const std::string& against,
            const ColumnFactor& found, const std::string& done) {
    const double half = 1.96 * found.sigma;
    const char* what = found.factor == -1.0 ? "sign" : "unit";
    description_.measurement.push_back({kind,
                                        place,
                                        what,
                                        found.factor,
                                        {found.measured - half, found.measured + half},
                                        "1",
                                        "found"});
    description_.remarks.push_back(place + "/" + kind + ": " + short_number(found.factor) +
                                   " times " + against + ", by another sign or unit: " + done);
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
      correction.correct(name, "position", "the reference that it follows", {kDegrees, 1e3, 1e-3},
                         options.near.value, [&](const Dataset& recording) {
                           return position_and_reference(recording, name);
                         });
    }
    correction.correct(name, "velocity", "the rate of its position",
                       {kDegrees, kRpm, 10.0, 100.0, 1e3, 0.1, 0.01, 1e-3}, options.exactly.value,
                       [&](const Dataset& recording) {
                         return velocity_and_position(recording, name, options.rows);
                       });
    correction.correct(name, "current", "what voltage and velocity give by the motor's resistance",
                       {1e3, 1e-3}, options.near.value, [&](const Dataset& recording) {
                         return current_and_voltage(muscle, recording, options.beside);
                       });
  }
  for (const JointModel& joint : robot.skeleton->joints) {
    if (joint.type != JointType::kBall) correction.remark_on_rate(joint.name);
  }
}

}  // namespace discovery
}  // namespace anthrob
