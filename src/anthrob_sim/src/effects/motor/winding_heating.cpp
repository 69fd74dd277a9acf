#include <algorithm>
#include <cmath>

#include "anthrob_sim/effects/motor_effect.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "winding_heating";
  i.name = "Winding heating";
  i.description =
      "Copper losses heat the winding: its resistance rises, and the magnets weaken a little. "
      "Slow; depends on the history of the squared current. One thermal mass, cold at the start "
      "(reset, start of a replay), at most 150 K above its surroundings.";
  i.equation =
      "time_constant d(dT)/dt = thermal_resistance R i^2 - dT, R = R_0 (1 + copper dT), "
      "K = K_0 (1 - magnet dT)";
  i.source = "known: copper 0.0039 1/K; data sheets of small motors";
  i.where = "MUSCLE | all";
  i.once_a_muscle = true;
  i.seam = Seam::kMotor;
  i.stage = Stage::kParts;
  i.dissipates = true;
  i.slow = true;
  i.channels = {"current", "velocity", "position"};
  i.parameters = {
      {"thermal_resistance", "K/W", "winding to surroundings", 0.0, 15.0, {0.0, 200.0}},
      {"time_constant",
       "s",
       "of the temperature",
       100.0,
       100.0,
       {1.0, 5000.0},
       EffectParameter::kShape},
      {"copper",
       "1/K",
       "rise of the winding's resistance",
       0.0039,
       0.0039,
       {0.0, 0.01},
       EffectParameter::kGiven},
      {"magnet",
       "1/K",
       "loss of torque and back-EMF constants",
       0.001,
       0.001,
       {0.0, 0.005},
       EffectParameter::kGiven},
  };
  return i;
}

/// The motor's step is an affine map that depends on temperature; between maps made for steps of
/// 10 K it is blended, which errs by less than 3e-4.
class HeatedMotor final : public MotorWrapper {
 public:
  struct Thermal {
    double resistance, time_constant, copper, magnet;
  };

  HeatedMotor(const DcMotor& cold, const Thermal& thermal, double step)
      : MotorWrapper(std::make_shared<DcMotor>(cold.parameters(), cold.gear(), step)),
        winding_(cold.parameters().winding_resistance),
        thermal_(thermal),
        keep_(std::exp(-step / thermal.time_constant)) {
    for (double warmth = 0.0; warmth <= kHottest; warmth += kSpacing) {
      DcMotor::Parameters p = cold.parameters();
      p.resistance += winding_ * thermal.copper * warmth;
      p.torque_constant *= 1.0 - thermal.magnet * warmth;
      p.back_emf_constant *= 1.0 - thermal.magnet * warmth;
      motors_.emplace_back(p, cold.gear(), step);
    }
  }

  std::size_t state_size() const override { return inner().state_size() + 1; }
  void place(double position, StateView state) const override {
    inner().place(position, state);
    own(state)[0] = 0.0;
  }

  void impose(double position, double velocity, double load, StateView state) const override {
    inner().impose(position, velocity, load, state);
    const double current = inner().read(state).current;
    warm(current, current, state);
  }
  void advance_with(double input, double load, double torque, StateView state) const override {
    const double warmth = own(state)[0];
    const auto cool = std::min(static_cast<std::size_t>(warmth / kSpacing), motors_.size() - 2);
    const double share = warmth / kSpacing - static_cast<double>(cool);
    const double before = inner().read(state).current;
    double warmer[kMotorState];
    for (std::size_t i = 0; i < kMotorState; ++i) warmer[i] = state[i];
    motors_[cool].advance_with(input, load, torque, state);
    motors_[cool + 1].advance_with(input, load, torque, StateView(warmer));
    for (std::size_t i = 0; i < kMotorState; ++i) state[i] += share * (warmer[i] - state[i]);

    warm(before, inner().read(state).current, state);
  }

 private:
  /// @param before, after currents at the ends of the step [A]
  void warm(double before, double after, StateView state) const {
    double& warmth = own(state)[0];
    const double power =
        winding_ * (1.0 + thermal_.copper * warmth) * 0.5 * (before * before + after * after);
    const double target = thermal_.resistance * power;
    warmth = std::min(target + keep_ * (warmth - target), kHottest);
  }

  static constexpr double kSpacing = 10.0, kHottest = 150.0;  // [K]
  static constexpr std::size_t kMotorState = 3;

  double winding_;
  Thermal thermal_;
  double keep_;
  std::vector<DcMotor> motors_;
};

class WindingHeating final : public MotorEffect {
 public:
  WindingHeating() : MotorEffect(describe()) {}

 protected:
  void change_motor(const EffectSetting& setting, const DcMotor& motor, double step,
                    MuscleModel& muscle) const override {
    const HeatedMotor::Thermal thermal{setting["thermal_resistance"], setting["time_constant"],
                                       setting["copper"], setting["magnet"]};
    muscle.actuator = std::make_shared<HeatedMotor>(motor, thermal, step);
  }
};

const EffectRegistration kRegistration(std::make_unique<WindingHeating>());

}  // namespace
}  // namespace anthrob
