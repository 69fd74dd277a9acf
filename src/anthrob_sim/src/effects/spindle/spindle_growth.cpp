#include <algorithm>
#include <cmath>

#include "anthrob_sim/effects/motor_effect.h"

namespace anthrob {
namespace {

constexpr double kTwoPi = 2.0 * M_PI;

EffectInfo describe() {
  EffectInfo i;
  i.id = "spindle_growth";
  i.name = "Spindle radius growth";
  i.description =
      "The tendon winds up in layers, which makes the spindle thicker turn by turn: tendon length "
      "over position is curved, and the ratio of force to current changes with winding. Unwound "
      "below position 0 the spindle gets thinner, at most by nine tenths.";
  i.equation = "r = r_S + growth position / (2 pi), dl_T/dposition = -r";
  i.source = "known: + tendon diameter per layer";
  i.where = "MUSCLE | all";
  i.once_a_muscle = true;
  i.seam = Seam::kSpindle;
  i.channels = {"force", "current", "position"};
  i.parameters = {{"growth", "m", "of the radius, per turn", 0.0, 3e-4, {0.0, 0.003}}};
  return i;
}

class GrowingSpindle final : public MotorWrapper {
 public:
  GrowingSpindle(std::shared_ptr<const GearedMotor> motor, double growth)
      : MotorWrapper(std::move(motor)), rate_(growth / (kTwoPi * inner().spindle_radius())) {}

  void advance_with(double input, double load, double torque, StateView state) const override {
    inner().advance_with(input, load * thickness(spindle_angle(state)), torque, state);
  }
  void impose(double position, double velocity, double load, StateView state) const override {
    inner().impose(position, velocity, load * thickness(spindle_angle(state)), state);
  }
  double tendon_length(StateView state) const override {
    const double angle = spindle_angle(state);
    return inner().tendon_length(state) - spindle_radius() * (wound(angle) - angle);
  }
  double winding_speed(StateView state) const override {
    return inner().winding_speed(state) * thickness(spindle_angle(state));
  }
  double position_for(double tendon_length) const override {
    const double turns = inner().position_for(tendon_length);
    const double square = 1.0 + 2.0 * rate_ * turns;  // of the thickness
    if (square < kThinnest * kThinnest) {
      return (kThinnest - 1.0 + 0.5 * (square / kThinnest - kThinnest)) / rate_;
    }
    return 2.0 * turns / (1.0 + std::sqrt(square));
  }
  double holding_input(double position, double load) const override {
    return inner().holding_input(position, load * thickness(position));
  }

 private:
  static constexpr double kThinnest = 0.1;

  /// What is wound round may lag behind the motor.
  double spindle_angle(StateView state) const {
    return inner().position_for(inner().tendon_length(state));
  }
  /// Radius in units of r_S, and its integral over the angle [rad].
  double thickness(double angle) const { return std::max(kThinnest, 1.0 + rate_ * angle); }
  double wound(double angle) const {
    const double thinnest = (kThinnest - 1.0) / rate_;
    const double grown = std::max(angle, thinnest);
    return grown + 0.5 * rate_ * grown * grown + kThinnest * (angle - grown);
  }

  double rate_;  ///< growth of the radius in units of r_S [1/rad]
};

class SpindleGrowth final : public MotorWrappingEffect {
 public:
  SpindleGrowth() : MotorWrappingEffect(describe()) {}

 protected:
  std::shared_ptr<const Actuator> wrap(const EffectSetting& setting,
                                       std::shared_ptr<const GearedMotor> motor,
                                       double) const override {
    return std::make_shared<GrowingSpindle>(std::move(motor), setting["growth"]);
  }
};

const EffectRegistration kRegistration(std::make_unique<SpindleGrowth>());

}  // namespace
}  // namespace anthrob
