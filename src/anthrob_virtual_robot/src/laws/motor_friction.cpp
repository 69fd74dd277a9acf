#include "anthrob_reference/muscle.h"
#include "laws/laws.h"

namespace anthrob::virtual_robot {
namespace {

/// Brushes and bearings that bend before they slide, as Dahl (1968) has it.
class Brushes final : public reference::MuscleLaw {
 public:
  Brushes(double torque, double ratio) : torque_(torque * ratio), bend_(kBend / ratio) {}
  double output_torque(double, double) const override { return -torque_ * bent_; }
  void settle(double h, const reference::MuscleState& state,
              const reference::MuscleSolution&) override {
    const double side = state.speed < 0.0 ? -1.0 : 1.0;
    bent_ = side - (side - bent_) * std::exp(-h * std::abs(state.speed) / bend_);
  }

 private:
  static constexpr double kBend = 0.3;  // of the rotor until friction is there [rad]
  double torque_;                       // at the gear's output [Nm]
  double bend_;                         // there [rad]
  double bent_ = 0.0;                   // share of friction that is there
};

}  // namespace

HiddenLaw motor_friction() {
  HiddenLaw law;
  law.id = "motor_friction";
  law.law = "bends before it slides (Dahl)";
  law.sizes = {"torque"};
  law.places = muscle_places_and_all;
  law.most = 4.0;
  law.draw = [](const auto&, const auto&, Random*) -> Parameters { return {{"torque", 5e-4}}; };
  law.build = [](const Hidden& h, Draft* draft) {
    add_to_muscles(h, draft, [&](const reference::MuscleParameters& muscle) {
      return std::make_shared<Brushes>(h["torque"], muscle.motor.gear_ratio);
    });
  };
  return law;
}

}  // namespace anthrob::virtual_robot
