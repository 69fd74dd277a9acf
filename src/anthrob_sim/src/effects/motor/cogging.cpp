#include <cmath>
#include <sstream>

#include "anthrob_sim/effects/motor_effect.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "cogging";
  i.name = "Motor cogging";
  i.description =
      "The rotor's slots are attracted by the magnets: a conservative torque that is periodic in "
      "the rotor angle and shows as ripple of current or speed at fixed rotor angles. Two sizes "
      "give its amplitude (root of the sum of their squares) and its phase. In each step acts the "
      "mean of the torque over the angle that the rotor is about to turn, so fast turning averages "
      "it out. Refused if all cogging of the muscle together could move the rotor by a large part "
      "of a period in one step.";
  i.equation = "tau_shaft = sine sin(periods phi) + cosine cos(periods phi), phi = N position";
  i.source = "known";
  i.where = "MUSCLE | all";
  i.seam = Seam::kMotor;
  i.channels = {"current", "velocity", "position"};
  i.parameters = {
      {"sine", "Nm", "at the motor shaft; 1-5 % of stall", 0.0, 4e-4, {-0.05, 0.05}},
      {"cosine", "Nm", "the torque at position 0", 0.0, 3e-4, {-0.05, 0.05}},
      {"periods", "1", "per turn of the rotor", 12.0, 12.0, {1.0, 200.0}, EffectParameter::kGiven},
  };
  return i;
}

/// Largest stiffness against the rotor, in units of inertia over the square of the step. Small
/// swings grow from step to step beyond 4, where the map of a step has determinant 1 and trace
/// 2 - stiffness. Long before that, a rotor that turns may keep in step with the periods and never
/// stop: of 960 starts in motion none at 1.2, one in seven at 1.3. From rest, large swings go on
/// for ever from 1.55 on.
constexpr double kSteepest = 1.2;

class CoggingMotor final : public MotorWrapper {
 public:
  /// @param stiffness of all cogging of the motor, this one included, in units as kSteepest
  CoggingMotor(std::shared_ptr<const GearedMotor> motor, double sine, double cosine, double periods,
               double step, double stiffness)
      : MotorWrapper(std::move(motor)),
        amplitude_(std::hypot(sine, cosine) * inner().ratio()),
        periods_(periods * inner().ratio()),
        phase_(std::atan2(cosine, sine)),
        step_(step),
        stiffness_(stiffness) {}

  void advance_with(double input, double load, double torque, StateView state) const override {
    const Readout motor = inner().read(state);
    const double angle = periods_ * motor.position + phase_;
    const double turn = periods_ * motor.velocity * step_;
    const double mean =
        std::abs(turn) < 1e-6 ? std::sin(angle) : (std::cos(angle) - std::cos(angle + turn)) / turn;
    inner().advance_with(input, load, torque + amplitude_ * mean, state);
  }

  /// Of all cogging of a motor. Entries at `all` and at the muscle are wrapped one round the other.
  static double stiffness_of(const GearedMotor& motor) {
    const auto* cogging = dynamic_cast<const CoggingMotor*>(&motor);
    return cogging ? cogging->stiffness_ : 0.0;
  }

 private:
  double amplitude_;  ///< at the gear output [Nm]
  double periods_;    ///< a turn of the gear output
  double phase_, step_;
  double stiffness_;
};

class Cogging final : public MotorWrappingEffect {
 public:
  Cogging() : MotorWrappingEffect(describe()) {}

 protected:
  std::shared_ptr<const Actuator> wrap(const EffectSetting& setting,
                                       std::shared_ptr<const GearedMotor> motor,
                                       double step) const override {
    const double sine = setting["sine"], cosine = setting["cosine"], periods = setting["periods"];
    const double steepness = step * step * periods / motor->inertia();  // of 1 Nm
    const double others = CoggingMotor::stiffness_of(*motor);
    const double stiffness = others + std::hypot(sine, cosine) * steepness;
    if (stiffness >= kSteepest) {
      std::ostringstream limit;
      limit << "an amplitude below " << (kSteepest - others) / steepness
            << " Nm, for this number of periods and this simulation step"
            << (others > 0.0 ? ", beside the other cogging of this muscle" : "");
      setting.fail(std::abs(sine) >= std::abs(cosine) ? "sine" : "cosine", limit.str());
    }
    return std::make_shared<CoggingMotor>(std::move(motor), sine, cosine, periods, step, stiffness);
  }
};

const EffectRegistration kRegistration(std::make_unique<Cogging>());

}  // namespace
}  // namespace anthrob
