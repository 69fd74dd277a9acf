#include "anthrob_ecu/firmware/channel.h"

#include <limits>

#include "anthrob_ecu/protocol.h"

namespace anthrob {
namespace ecu {

namespace {

constexpr double kPositionMargin = 0.5;  // [rad] for overshoot beyond the clipped reference
// A spindle that was pushed no further stands; the counts of a torn encoder may flicker.
constexpr double kStandstill = 0.001;  // [rad]
constexpr int kFlicker = 2;            // [counts]

double magnitude(double value) {
  return value < 0.0 ? -value : value;
}

}  // namespace

Fault Channel::measure(const MuscleReadings& readings) {
  const double scale = parameters.get(Parameter::kEncoderScale);
  if (!started_) {
    for (std::int32_t& old : history_) old = readings.encoder;
    last_encoder_ = readings.encoder;
    started_ = true;
  }
  measured_.position = zero_position_ + scale * (readings.encoder - zero_);
  measured_.velocity = scale * (readings.encoder - history_[next_]) / (0.001 * kSpeedWindow);
  history_[next_] = readings.encoder;
  next_ = next_ + 1 == kSpeedWindow ? 0 : next_ + 1;
  measured_.current = parameters.get(Parameter::kCurrentGain) *
                      (readings.current - parameters.get(Parameter::kCurrentOffset));
  const double force = parameters.get(Parameter::kForceGain) *
                       (readings.force - parameters.get(Parameter::kForceOffset));
  measured_.force = force_filter_.step(force);
  // A tendon does not push: below zero there is only noise.
  if (measured_.force < 0.0) measured_.force = 0.0;
  const Fault fault = judge(readings);
  last_encoder_ = readings.encoder;
  return fault;
}

Fault Channel::judge(const MuscleReadings& readings) {
  const auto limit = [this](Parameter p) { return parameters.get(p); };
  const bool force_at_stop = parameters.has_force_sensor() &&
                             (readings.force < kLowestCount || readings.force > kHighestCount);
  const bool too_much_current =
      current_.lasted(magnitude(measured_.current) > limit(Parameter::kCurrentLimit), 20);
  const bool too_much_force = force_.lasted(
      parameters.has_force_sensor() && measured_.force > limit(Parameter::kForceLimit), 5);
  const bool too_fast =
      speed_.lasted(magnitude(measured_.velocity) > limit(Parameter::kSpeedLimit), 5);
  const bool no_force_sensor = force_sensor_.lasted(force_at_stop, 20);
  const bool no_encoder = encoder_.lasted(stands_though_pushed(readings.encoder), 300);
  if (!limits_set_) return Fault::kNone;
  // Those that lose the zero come first: they must not hide behind another one.
  if (too_fast) return Fault::kOverSpeed;
  if (no_encoder) return Fault::kEncoder;
  if (measured_.position < limit(Parameter::kPositionLow) - kPositionMargin ||
      measured_.position > limit(Parameter::kPositionHigh) + kPositionMargin) {
    return Fault::kPositionLimit;
  }
  if (no_force_sensor) return Fault::kForceSensor;
  if (too_much_current) return Fault::kOverCurrent;
  if (too_much_force) return Fault::kOverForce;
  if (readings.temperature > limit(Parameter::kTemperatureLimit)) return Fault::kOverTemperature;
  return Fault::kNone;
}

bool Channel::stands_though_pushed(std::int32_t encoder) {
  const int travel = encoder < pushed_from_ ? pushed_from_ - encoder : encoder - pushed_from_;
  const bool pushes = magnitude(voltage_) > 0.5 * parameters.get(Parameter::kVoltageLimit);
  const bool stands =
      travel <= kFlicker || parameters.get(Parameter::kEncoderScale) * travel <= kStandstill;
  if (!pushes || !stands) pushed_from_ = encoder;
  return pushes && stands;
}

bool Channel::refer(Mode mode, double reference) {
  if (mode == Mode::kForce && !parameters.has_force_sensor()) return false;
  if (mode == Mode::kPosition) {
    const double low = parameters.get(Parameter::kPositionLow);
    const double high = parameters.get(Parameter::kPositionHigh);
    reference = reference < low ? low : reference > high ? high : reference;
  }
  if (mode != mode_) {
    // A rate-limited reference starts from where the muscle is.
    reference_ = mode == Mode::kPosition ? measured_.position : measured_.force;
    memory_ = {};
    mode_ = mode;
  }
  target_ = reference;
  return true;
}

double Channel::towards(double target, double rate) const {
  const double step = rate * settings_.period, change = target - reference_;
  return change > step ? reference_ + step : change < -step ? reference_ - step : target;
}

double Channel::follow() {
  reference_ = mode_ == Mode::kPosition ? towards(target_, parameters.get(Parameter::kPositionRate))
               : mode_ == Mode::kForce  ? towards(target_, parameters.get(Parameter::kForceRate))
                                        : target_;
  settings_ = parameters.controller();
  voltage_ = control(mode_, reference_, measured_, settings_, memory_);
  return voltage_;
}

void Channel::release() {
  mode_ = Mode::kVoltage;
  target_ = reference_ = voltage_ = 0.0;
  memory_ = {};
}

void Channel::set_position(double position) {
  zero_ = last_encoder_;
  zero_position_ = position;
  measured_.position = position;
  zero_known_ = true;
}

void Channel::reconfigure() {
  force_filter_ =
      FirFilter<kMaxFilterOrder>(static_cast<std::size_t>(parameters.get(Parameter::kFilterOrder)));
  limits_set_ = parameters.get(Parameter::kCurrentLimit) > 0.0 &&
                parameters.get(Parameter::kSpeedLimit) > 0.0 &&
                parameters.get(Parameter::kTemperatureLimit) > 0.0;
}

double Channel::force_or_nan() const {
  return parameters.has_force_sensor() ? measured_.force : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace ecu
}  // namespace anthrob
