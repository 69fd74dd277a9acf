#include "laws/laws.h"

namespace anthrob::virtual_robot {
namespace {

/// Two bodies: the winding inside, the case outside.
class TwoBodies final : public reference::MuscleLaw {
 public:
  TwoBodies(const reference::MotorParameters& cold, const Hidden& h)
      : cold_(cold),
        thermal_(h["thermal_resistance"]),
        time_(h["time_constant"]),
        copper_(h["copper"]),
        magnet_(h["magnet"]) {}

  void settle(double h, const reference::MuscleState& state,
              const reference::MuscleSolution&) override {
    const double power =
        cold_.resistance * (1.0 + copper_ * winding_) * state.current * state.current;
    // A fifth of the resistance between winding and case, and a tenth of the heat capacity.
    const double flow = (winding_ - case_) / (0.2 * thermal_);
    winding_ += h * (power - flow) / (0.1 * time_ / thermal_);
    case_ += h * (flow - case_ / (0.8 * thermal_)) / (0.9 * time_ / thermal_);
    since_ += h;
  }
  bool retune(reference::MotorParameters* motor) override {
    if (since_ < kEvery) return false;
    since_ = 0.0;
    motor->resistance = cold_.resistance * (1.0 + copper_ * winding_);
    motor->torque_constant = cold_.torque_constant * (1.0 - magnet_ * winding_);
    motor->back_emf_constant = cold_.back_emf_constant * (1.0 - magnet_ * winding_);
    return true;
  }

 private:
  static constexpr double kEvery = 0.1;  // the motor is told [s]
  reference::MotorParameters cold_;
  double thermal_, time_, copper_, magnet_;
  double winding_ = 0.0, case_ = 0.0;  // above the surroundings [K]
  double since_ = 0.0;
};

}  // namespace

HiddenLaw winding_heating() {
  HiddenLaw law;
  law.id = "winding_heating";
  law.law = "winding and case instead of one thermal body";
  law.sizes = {"thermal_resistance"};
  law.places = muscle_places_and_all;
  law.slow = true;
  law.most = 10.0;
  law.draw = [](const auto&, const auto&, Random* random) -> Parameters {
    return {{"thermal_resistance", 20.0},
            {"time_constant", random->log_uniform(50.0, 120.0)},
            {"copper", 0.0039},
            {"magnet", 0.001}};
  };
  law.build = [](const Hidden& h, Draft* draft) {
    if (h["thermal_resistance"] == 0.0) return;
    add_to_muscles(h, draft, [&](const reference::MuscleParameters& muscle) {
      return std::make_shared<TwoBodies>(muscle.motor, h);
    });
  };
  return law;
}

}  // namespace anthrob::virtual_robot
