#include "health/tendon_figures.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "anthrob_core/errors.h"
#include "anthrob_core/text.h"
#include "anthrob_recording/orientation_series.h"
#include "anthrob_sim/actuator/dc_motor.h"
#include "health/block_fit.h"

namespace anthrob {
namespace health {

namespace {

/// A tendon at one moment.
struct Instant {
  double time = 0.0;  ///< since the beginning of the test [s]
  double winding = 0.0, force = 0.0, current = 0.0;
  double voltage = 0.0;  ///< less the back EMF
  int block = 0;         ///< of its error
  int flank = 0;         ///< +1 tightening, -1 slackening
};

/// Whether anything was measured then.
bool is_fresh(const Series& series, double time, double fresh) {
  const auto next = std::lower_bound(series.t.begin(), series.t.end(), time);
  const double after = next == series.t.end() ? HUGE_VAL : *next - time,
               before = next == series.t.begin() ? HUGE_VAL : time - *std::prev(next);
  return std::min(after, before) <= fresh;
}

/// Mean of the samples within half a width of a moment; between two samples: interpolated.
double mean_around(const Series& series, double time, double width) {
  const auto from = std::lower_bound(series.t.begin(), series.t.end(), time - 0.5 * width);
  double sum = 0.0, count = 0.0;
  for (auto t = from; t != series.t.end() && *t < time + 0.5 * width; ++t) {
    sum += series.values[static_cast<std::size_t>(t - series.t.begin())], count += 1.0;
  }
  return count > 0.0 ? sum / count : series.at(time);
}

Quat turned(const OrientationSeries& ball, double time) {
  double q[4];
  ball.at(time, q);
  return {q[0], q[1], q[2], q[3]};
}

/// Posture of all joints over time, as what their rotations shorten.
class JointMotion {
 public:
  JointMotion(const RobotModel& model, const Dataset& recording) : model_(model) {
    for (const JointModel& joint : model.skeleton->joints) {
      positions_.push_back(
          joint.type == JointType::kBall ? Series{} : recording.series(joint.name + "/position"));
      balls_.push_back(joint.type == JointType::kBall
                           ? OrientationSeries::read(recording, joint.name)
                           : OrientationSeries{});
    }
  }
  /// Path of a muscle that is shorter than in a posture [m].
  double shortened(const std::vector<double>& arms, const std::vector<double>& posture,
                   double now) const {
    double sum = 0.0;
    for (std::size_t j = 0; j < positions_.size(); ++j) {
      const JointModel& joint = model_.skeleton->joints[j];
      const auto at = static_cast<std::size_t>(joint.velocity_offset);
      const double* q = &posture[static_cast<std::size_t>(joint.position_offset)];
      if (joint.type != JointType::kBall) {
        if (!positions_[j].empty()) {
          sum += arms[at] * (positions_[j].at(now) - q[0]);
        }
        continue;
      }
      if (balls_[j].empty()) continue;
      const Quat turn = Quat(q[0], q[1], q[2], q[3]).conjugate() * turned(balls_[j], now);
      const double sign = turn.w() < 0.0 ? -2.0 : 2.0;
      sum += sign * (arms[at] * turn.x() + arms[at + 1] * turn.y() + arms[at + 2] * turn.z());
    }
    return sum;
  }

 private:
  const RobotModel& model_;
  std::vector<Series> positions_;
  std::vector<OrientationSeries> balls_;
};

/// One tendon's test.
class TendonTest {
 public:
  TendonTest(const TestProtocol& protocol, std::size_t tendon, const Dataset& recording,
             const JointMotion& motion, double begin)
      : protocol_(protocol),
        options_(protocol.options()),
        tendon_(tendon),
        muscle_(protocol.model().muscles[static_cast<std::size_t>(protocol.muscles()[tendon])]),
        motion_(motion),
        begin_(begin) {
    figures_.muscle = muscle_.name;
    position_ = recording.series(muscle_.name + "/position");
    force_ = recording.series(muscle_.name + "/force");
    current_ = recording.series(muscle_.name + "/current");
    voltage_ = recording.series(muscle_.name + "/voltage");
  }

  TendonFigures figures() {
    using Kind = Phase::Kind;
    if (position_.empty()) {
      figures_.remarks.push_back("its motor's position was not measured: nothing is known");
      return figures_;
    }
    const bool has_force = !force_.empty();
    if (!has_force) figures_.remarks.push_back("no force was measured: nothing about its tendon");
    const auto slack = instants(Kind::kSlack), flanks = instants(Kind::kFlank);
    if (has_force) {
      offset_ = mean_force(slack);
      add(Quantity::kForceOffset, offset_);
      stretch(flanks);
      creep(instants(Kind::kHold));
    }
    if (current_.empty()) {
      figures_.remarks.push_back("no current was measured: nothing about its motor");
      return figures_;
    }
    if (has_force) pull(flanks);
    if (!voltage_.empty()) resist(instants(Kind::kLevel));
    return figures_;
  }

 private:
  std::vector<Instant> instants(Phase::Kind kind) const {
    std::vector<Instant> all;
    int phase_number = 0, sign = 1;
    for (const Phase& phase : protocol_.phases()) {
      if (phase.kind != kind) continue;
      // Slackening comes first.
      sign = -sign;
      const bool is_hold = kind == Phase::Kind::kHold;
      const bool is_level = kind == Phase::Kind::kLevel;
      const double from = phase.begin + (is_level ? options_.after_step : options_.after_ramp);
      const bool is_still = is_hold || kind == Phase::Kind::kSlack;
      const double to = phase.end - (is_level ? options_.beside : 0.0);
      for (double time = from; time < to; time += 1.0 / options_.rate) {
        const double at = begin_ + time;
        const auto measured = [&](const Series& series) {
          return series.empty() || is_fresh(series, at, options_.fresh);
        };
        if (!measured(position_) || !measured(force_) || !measured(current_) ||
            !measured(voltage_)) {
          continue;
        }
        const auto mean = [&](const Series& series, double when) {
          return series.empty() ? 0.0 : mean_around(series, when, 1.0 / options_.rate);
        };
        Instant now;
        now.time = time;
        now.winding = muscle_.motor()->spindle_radius() * mean(position_, at) -
                      motion_.shortened(protocol_.moment_arms()[tendon_], protocol_.posture(), at);
        now.force = mean(force_, at);
        now.current = mean(current_, at);
        now.voltage = mean(voltage_, at) - back_emf(at);
        // A flank and the one back tell a slope; what is still, only noise.
        now.block = is_still ? static_cast<int>((time - phase.begin) / options_.still_block) %
                                   options_.still_blocks
                    : kind == Phase::Kind::kFlank ? phase_number / 2
                                                  : phase_number;
        now.flank = sign;
        all.push_back(now);
      }
      ++phase_number;
    }
    return all;
  }

  /// [V] of the motor's turning, by the model's constant.
  double back_emf(double time) const {
    const auto* motor = dynamic_cast<const DcMotor*>(muscle_.actuator.get());
    if (motor == nullptr) return 0.0;
    const double beside = options_.beside, width = 1.0 / options_.rate;
    const double velocity = (mean_around(position_, time + beside, width) -
                             mean_around(position_, time - beside, width)) /
                            (2.0 * beside);
    return motor->parameters().back_emf_constant * motor->parameters().ratio * velocity;
  }

  static int blocks_of(const std::vector<Instant>& all) {
    int most = 0;
    for (const Instant& one : all) most = std::max(most, one.block);
    return most + 1;
  }

  void add(Quantity quantity, const std::optional<Measured>& number) {
    if (!number) {
      figures_.remarks.push_back(std::string(name_of(quantity)) + ": the recording does not tell");
      return;
    }
    figures_.figures.push_back(
        {quantity, number->value, number->value - number->half, number->value + number->half});
  }

  static std::optional<Measured> mean_force(const std::vector<Instant>& slack) {
    BlockFit fit(1, blocks_of(slack));
    for (const Instant& one : slack) fit.add(one.block, Eigen::VectorXd::Ones(1), one.force);
    return fit.coefficient(0);
  }
  double without_offset(double force) const { return force - (offset_ ? offset_->value : 0.0); }

  /// Force over winding: F = c0 + c1 u + c2 u^2 + c3 (tightening: 1, slackening: -1).
  void stretch(const std::vector<Instant>& flanks) {
    double centre = 0.0, reach = 0.0;
    for (const Instant& one : flanks) centre += one.winding / static_cast<double>(flanks.size());
    for (const Instant& one : flanks) reach = std::max(reach, std::abs(one.winding - centre));
    if (!(reach > 0.0)) return;
    BlockFit fit(4, blocks_of(flanks));
    for (const Instant& one : flanks) {
      const double u = (one.winding - centre) / reach;
      fit.add(one.block, Eigen::Vector4d(1.0, u, u * u, one.flank), without_offset(one.force));
    }
    const double tension = protocol_.middle_tension()[tendon_];
    const auto where = [tension](const Eigen::VectorXd& c) {
      double u = 0.0;
      for (int i = 0; i < 8; ++i) {
        u -= (c[0] + c[1] * u + c[2] * u * u - tension) / (c[1] + 2.0 * c[2] * u);
        u = std::clamp(u, -2.0, 2.0);
      }
      return std::abs(u) < 2.0 ? u : NAN;
    };
    const auto stiffness = fit.number(
        [&](const Eigen::VectorXd& c) { return (c[1] + 2.0 * c[2] * where(c)) / reach; });
    slope_ = stiffness ? stiffness->value : 0.0;
    add(Quantity::kStiffness, stiffness);
    add(Quantity::kZero, fit.number([&](const Eigen::VectorXd& c) {
      return centre + reach * where(c) - protocol_.middle_winding()[tendon_];
    }));
    add(Quantity::kHysteresis, fit.coefficient(3));
  }

  /// Force after a step, as if the motor stood still: at first and in the end.
  void creep(const std::vector<Instant>& hold) {
    if (hold.empty()) return;
    const double begin = hold.front().time, end = hold.back().time;
    BlockFit fit(2, blocks_of(hold));
    for (const Instant& one : hold) {
      const bool is_first = one.time < begin + options_.creep_begin;
      if (!is_first && one.time < end - options_.creep_end) continue;
      const double still =
          without_offset(one.force) - slope_ * (one.winding - hold.front().winding);
      fit.add(one.block, is_first ? Eigen::Vector2d(1.0, 0.0) : Eigen::Vector2d(0.0, 1.0), still);
    }
    add(Quantity::kCreep, fit.number([](const Eigen::VectorXd& c) { return 1.0 - c[1] / c[0]; }));
  }

  /// Current over force: I = c0 + c1 F + c2 (tightening: 1, slackening: -1).
  void pull(const std::vector<Instant>& flanks) {
    BlockFit fit(3, blocks_of(flanks));
    for (const Instant& one : flanks) {
      fit.add(one.block, Eigen::Vector3d(1.0, without_offset(one.force), one.flank), one.current);
    }
    add(Quantity::kFriction, fit.coefficient(2));
    add(Quantity::kCurrentGain, fit.coefficient(1));
  }

  /// I = c0 + c1 (V - back EMF): voltages have no noise, currents have.
  void resist(const std::vector<Instant>& resting) {
    BlockFit fit(2, blocks_of(resting));
    for (const Instant& one : resting) {
      fit.add(one.block, Eigen::Vector2d(1.0, one.voltage), one.current);
    }
    add(Quantity::kResistance, fit.number([](const Eigen::VectorXd& c) { return 1.0 / c[1]; }));
  }

  const TestProtocol& protocol_;
  const HealthOptions& options_;
  std::size_t tendon_;
  const MuscleModel& muscle_;
  const JointMotion& motion_;
  double begin_;
  Series position_, force_, current_, voltage_;
  std::optional<Measured> offset_;
  double slope_ = 0.0;
  TendonFigures figures_;
};

/// @param begin of the test in the recording [s]
void require_commands(const TestProtocol& protocol, const Dataset& recording, double begin) {
  for (std::size_t i = 0; i < protocol.muscles().size(); ++i) {
    const auto m = static_cast<std::size_t>(protocol.muscles()[i]);
    const std::string& name = protocol.model().muscles[m].name;
    const Series asked = recording.find_table("commands")->find(name + "/reference") == nullptr
                             ? Series{}
                             : recording.series(name + "/reference");
    if (asked.empty()) {
      throw BadInput(recording.folder + ": no references of " + name +
                     "; expected the recording of a test");
    }
    for (std::size_t k = 0; k < asked.t.size(); ++k) {
      const double wanted = protocol.references(asked.t[k] - begin)[i];
      if (std::abs(asked.values[k] - wanted) <= protocol.options().off_reference) continue;
      throw BadInput(recording.folder + ": " + significant(asked.t[k] - begin, 3) +
                     " s after the " + "first command, the reference of " + name + " is " +
                     significant(asked.values[k], 3) + " rad, not " + significant(wanted, 3) +
                     "; expected the recording of a test by this model, from its first command on");
    }
  }
}

}  // namespace

const char* name_of(Quantity quantity) {
  const char* const names[] = {"force_offset", "stiffness",    "zero",       "hysteresis",
                               "friction",     "current_gain", "resistance", "creep"};
  return names[static_cast<int>(quantity)];
}

const char* unit_of(Quantity quantity) {
  const char* const units[] = {"N", "N/m", "m", "N", "A", "A/N", "ohm", "1"};
  return units[static_cast<int>(quantity)];
}

std::vector<TendonFigures> measure(const TestProtocol& protocol, const Dataset& recording) {
  const Table* commands = recording.find_table("commands");
  if (commands == nullptr || commands->t.empty()) {
    throw BadInput(recording.folder + ": no commands; expected the recording of a test");
  }
  const double begin = seconds(commands->t.front() - recording.begin());
  const double length = seconds(recording.end() - recording.begin()) - begin;
  if (length < protocol.duration() - 1.0) {
    throw BadInput(recording.folder + ": " + std::to_string(static_cast<int>(length)) +
                   " s from the first command on; expected a whole test of " +
                   std::to_string(static_cast<int>(protocol.duration())) + " s");
  }
  require_commands(protocol, recording, begin);
  const JointMotion motion(protocol.model(), recording);
  std::vector<TendonFigures> all;
  for (std::size_t i = 0; i < protocol.muscles().size(); ++i) {
    all.push_back(TendonTest(protocol, i, recording, motion, begin).figures());
  }
  return all;
}

}  // namespace health
}  // namespace anthrob
