#include "measurement/controller_algebra.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace anthrob {
namespace discovery {

namespace {

/// Squares by block, at shifts of whole ticks.
struct Scan {
  long first;  ///< [ticks]
  std::vector<std::vector<double>> squares;

  /// The index that leaves least without one block; with all blocks: pass their number.
  std::size_t best(std::size_t without) const {
    const auto left = [&](std::size_t at) {
      return sum_of(squares[at]) - (without < squares[at].size() ? squares[at][without] : 0.0);
    };
    std::size_t best = 0;
    for (std::size_t i = 1; i < squares.size(); ++i) {
      if (left(i) < left(best)) best = i;
    }
    return best;
  }
  /// Of the best index, by the jackknife over blocks [ticks].
  double error() const {
    const std::size_t n = squares.front().size();
    const auto whole = static_cast<double>(best(n));
    double square = 0.0;
    for (std::size_t b = 0; b < n; ++b) {
      square += std::pow(static_cast<double>(best(b)) - whole, 2);
    }
    return std::sqrt(square * static_cast<double>(n - 1) / static_cast<double>(n));
  }
};

}  // namespace

ControllerAlgebra::ControllerAlgebra(const RobotModel& robot,
                                     const std::vector<const Dataset*>& recordings,
                                     const ControllerAlgebraOptions& options)
    : data_(robot, recordings, options) {}

ControllerAlgebra::Shifts ControllerAlgebra::shifts(LateStamp what, double late) const {
  const double tick = data_.tick();
  Shifts all{tick, tick, tick};
  // A voltage that is stamped late is due to what was earlier; of what is stamped late itself, the
  // controller knew what the recording has only later.
  switch (what) {
    case LateStamp::kVoltage:
      return {tick + late, tick + late, tick + late};
    case LateStamp::kPosition:
      all.position -= late;
      break;
    case LateStamp::kForce:
      all.force -= late;
      break;
    case LateStamp::kReference:
      all.reference -= late;
      break;
    case LateStamp::kMeasured:
      all.position -= late;
      all.force -= late;
      break;
  }
  return all;
}

Squares ControllerAlgebra::squares(const Shifts& shifts) const {
  Squares squares(data_.blocks(), 0.0);
  for (const ControlledMuscle& muscle : data_.muscles()) {
    const ecu::PositionGains& gains = muscle.gains;
    for (const std::size_t row : muscle.rows) {
      const double t = muscle.voltage.t[row];
      const Interpolated position = interpolated(muscle.position, t - shifts.position),
                         velocity = interpolated(muscle.velocity, t - shifts.position);
      double expected =
          gains.proportional *
              (muscle.reference.held_at(t - shifts.reference + 1e-9) - position.value) -
          gains.derivative * velocity.value;
      double force_variance = 0.0;
      if (!muscle.force.empty()) {
        const Interpolated force = interpolated(muscle.force, t - shifts.force);
        expected += gains.force_feedforward * force.value;
        force_variance = force.variance;
      }
      const double left = muscle.voltage.values[row] - expected;
      squares[muscle.block_of(row, data_.options().block)] +=
          muscle.weight * (left * left - muscle.noise(gains, position.variance, force_variance));
    }
  }
  return squares;
}

Squares ControllerAlgebra::squares_of_free_gains() const {
  Squares squares(data_.blocks(), 0.0);
  for (const ControlledMuscle& muscle : data_.muscles()) {
    const auto n = static_cast<Eigen::Index>(muscle.rows.size());
    Eigen::MatrixX4d terms(n, 4);
    Eigen::VectorXd voltages(n), position_variance(n), force_variance(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const std::size_t row = muscle.rows[static_cast<std::size_t>(i)];
      const double t = muscle.voltage.t[row] - data_.tick();
      const Interpolated position = interpolated(muscle.position, t);
      const Interpolated force =
          muscle.force.empty() ? Interpolated{0.0, 0.0} : interpolated(muscle.force, t);
      terms.row(i) << muscle.reference.held_at(t + 1e-9) - position.value,
          interpolated(muscle.velocity, t).value, force.value, 1.0;
      voltages[i] = muscle.voltage.values[row];
      position_variance[i] = position.variance, force_variance[i] = force.variance;
    }
    Eigen::Matrix4d gram = terms.transpose() * terms;
    gram.diagonal().array() *= 1.0 + 1e-9;
    gram.diagonal().array() += 1e-12;
    // Noise of the measurements makes gains smaller; what it leaves with them is less, too.
    const Eigen::Vector4d gains = gram.ldlt().solve(terms.transpose() * voltages);
    const Eigen::VectorXd left = voltages - terms * gains;
    const ecu::PositionGains fitted{gains[0], -gains[1], gains[2]};
    for (Eigen::Index i = 0; i < n; ++i) {
      squares[muscle.block_of(muscle.rows[static_cast<std::size_t>(i)], data_.options().block)] +=
          muscle.weight *
          (left[i] * left[i] - muscle.noise(fitted, position_variance[i], force_variance[i]));
    }
  }
  return squares;
}

struct ControllerAlgebra::Cause {
  StampShift shift;
  Squares squares;
};

std::optional<ControllerAlgebra::Cause> ControllerAlgebra::best_shift(LateStamp what, long earliest,
                                                                      long latest) const {
  const double tick = data_.tick();
  Scan scan{earliest, {}};
  for (long k = earliest; k <= latest; ++k) {
    scan.squares.push_back(squares(shifts(what, static_cast<double>(k) * tick)));
  }
  const std::size_t at = scan.best(data_.blocks());
  if (at == 0 || at + 1 == scan.squares.size()) return {};
  const auto ticks = static_cast<double>(scan.first + static_cast<long>(at));
  const double error = std::hypot(scan.error(), 1.0 / std::sqrt(12.0));
  return Cause{{what, ticks * tick, error * tick, tick}, scan.squares[at]};
}

std::optional<StampShift> ControllerAlgebra::latency() const {
  if (!is_known()) return {};
  const auto reach = static_cast<long>(data_.options().longest_latency / data_.tick() + 1e-9);
  std::optional<Cause> best;
  for (const LateStamp what :
       {LateStamp::kPosition, LateStamp::kForce, LateStamp::kReference, LateStamp::kMeasured}) {
    auto cause = best_shift(what, -reach, 1);
    if (!cause || cause->shift.late > -0.5 * data_.tick()) continue;
    if (!best || sum_of(cause->squares) < sum_of(best->squares)) best = std::move(cause);
  }
  if (!best) return {};
  return best->shift;
}

std::optional<StampShift> ControllerAlgebra::stamp_shift() const {
  if (!is_known()) return {};
  const ControllerAlgebraOptions& options = data_.options();
  const double tick = data_.tick();
  std::vector<Cause> causes;
  const Squares none = squares(shifts(LateStamp::kVoltage, 0.0));
  const auto reach = static_cast<long>(std::floor(options.longest / tick + 1e-9));
  for (const LateStamp what : {LateStamp::kVoltage, LateStamp::kPosition, LateStamp::kForce,
                               LateStamp::kReference, LateStamp::kMeasured}) {
    // At either end, it is beyond what sampling does.
    if (auto cause = best_shift(what, -reach, reach)) causes.push_back(std::move(*cause));
  }
  if (causes.empty()) return {};
  auto best = std::min_element(causes.begin(), causes.end(), [](const Cause& a, const Cause& b) {
    return sum_of(a.squares) < sum_of(b.squares);
  });
  // Where forces hardly matter to the law, nothing says that they are late, too.
  const auto positions = std::find_if(causes.begin(), causes.end(), [](const Cause& cause) {
    return cause.shift.what == LateStamp::kPosition;
  });
  const bool is_measured = best->shift.what == LateStamp::kMeasured;
  if (is_measured && positions != causes.end() &&
      data_.sureness(positions->squares, best->squares) < options.clearly) {
    best = positions;
  }
  const StampShift& shift = best->shift;
  if (std::abs(shift.late) < 0.5 * tick) return {};
  if (data_.sureness(none, best->squares) < options.sure) return {};
  if (data_.sureness(squares_of_free_gains(), best->squares) < options.clearly) return {};
  for (const Cause& other : causes) {
    const bool is_part =
        best->shift.what == LateStamp::kPosition && other.shift.what == LateStamp::kMeasured;
    if (&other == &*best || is_part) continue;
    if (data_.sureness(other.squares, best->squares) < options.clearly) return {};
  }
  // Stamps that come before their quantity are a controller that hears of it late.
  if (shift.what != LateStamp::kVoltage && shift.late < 0.0) return {};
  return shift;
}

bool ControllerAlgebra::helps(const StampShift& shift, std::size_t recording) const {
  const Squares without = squares(shifts(LateStamp::kVoltage, 0.0)),
                with = squares(shifts(shift.what, shift.late));
  double gain = 0.0;
  for (std::size_t b = data_.first_blocks()[recording]; b < data_.first_blocks()[recording + 1];
       ++b) {
    gain += without[b] - with[b];
  }
  return gain > 0.0;
}

Squares ControllerAlgebra::squares_at(const std::optional<StampShift>& shift) const {
  return squares(shift ? shifts(shift->what, shift->late) : shifts(LateStamp::kVoltage, 0.0));
}

double ControllerAlgebra::left(const std::optional<StampShift>& shift) const {
  return is_known() ? data_.left(squares_at(shift)) : 0.0;
}

}  // namespace discovery
}  // namespace anthrob
