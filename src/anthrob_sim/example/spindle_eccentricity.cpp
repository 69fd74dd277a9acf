// An effect of one's own: this file, built as a shared library, is all there is to it.
// docs/effects.md explains.
#include <cmath>

#include "anthrob_sim/effects/motor_effect.h"

namespace {

using namespace anthrob;

EffectInfo describe() {
  EffectInfo i;
  i.id = "spindle_eccentricity";
  i.name = "Eccentric spindle";
  i.description =
      "The spindle's centre is not on its axis: the wound length oscillates once per turn around "
      "that of a centred spindle.";
  i.equation = "l_T = l_T0 - r_S position - offset (1 - cos position)";
  i.source = "an example";
  i.where = "MUSCLE | all";
  i.seam = Seam::kSpindle;
  i.channels = {"force", "position"};
  i.parameters = {
      {"offset", "m", "of the spindle's centre from the axis", 0.0, 5e-4, {0.0, 0.005}}};
  return i;
}

/// A spindle whose radius depends on its angle; power stays what it was.
class EccentricSpindle final : public MotorWrapper {
 public:
  EccentricSpindle(std::shared_ptr<const GearedMotor> motor, double offset)
      : MotorWrapper(std::move(motor)), offset_(offset) {}

  void advance_with(double input, double load, double torque, StateView state) const override {
    inner().advance_with(input, load * lever(angle(state)), torque, state);
  }
  void impose(double position, double velocity, double load, StateView state) const override {
    inner().impose(position, velocity, load * lever(angle(state)), state);
  }
  double tendon_length(StateView state) const override {
    return inner().tendon_length(state) - offset_ * (1.0 - std::cos(angle(state)));
  }
  double winding_speed(StateView state) const override {
    return inner().winding_speed(state) * lever(angle(state));
  }
  double position_for(double tendon_length) const override {
    double position = inner().position_for(tendon_length);
    for (int i = 0; i < 50; ++i) {
      position = inner().position_for(tendon_length + offset_ * (1.0 - std::cos(position)));
    }
    return position;
  }
  double holding_input(double position, double load) const override {
    return inner().holding_input(position, load * lever(position));
  }

 private:
  /// Of the spindle: with backlash it lags behind the motor.
  double angle(StateView state) const { return inner().position_for(inner().tendon_length(state)); }
  /// Of the tendon, in units of the radius.
  double lever(double angle) const { return 1.0 + offset_ * std::sin(angle) / spindle_radius(); }

  double offset_;
};

class SpindleEccentricity final : public MotorWrappingEffect {
 public:
  SpindleEccentricity() : MotorWrappingEffect(describe()) {}

 protected:
  std::shared_ptr<const Actuator> wrap(const EffectSetting& setting,
                                       std::shared_ptr<const GearedMotor> motor,
                                       double) const override {
    return std::make_shared<EccentricSpindle>(std::move(motor), setting["offset"]);
  }
};

const EffectRegistration kRegistration(std::make_unique<SpindleEccentricity>());

}  // namespace
