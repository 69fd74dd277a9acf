#include <cmath>

#include "laws/laws.h"

namespace anthrob::virtual_robot {
namespace {

/// Slots with a second harmonic. Above a speed that a step cannot follow nothing of it is left.
class Slots final : public reference::MuscleLaw {
 public:
  Slots(double amplitude, double periods, double phase, double ratio)
      : amplitude_(amplitude * ratio), periods_(periods * ratio), phase_(phase) {}
  double output_torque(double position, double speed) const override {
    const double angle = periods_ * position + phase_;
    const double rate = periods_ * speed / kBlur;
    return amplitude_ / (1.0 + rate * rate) * (std::sin(angle) + kSecond * std::sin(2.0 * angle));
  }

 private:
  static constexpr double kSecond = 0.2;
  static constexpr double kBlur = 4000.0;  // [rad/s]
  double amplitude_, periods_, phase_;
};

}  // namespace

HiddenLaw cogging() {
  HiddenLaw law;
  law.id = "cogging";
  law.law = "with a second harmonic of 20 %";
  law.sizes = {"sine", "cosine"};
  law.places = muscle_places_and_all;
  law.most = 20.0;
  law.draw = [](const auto&, const auto&, Random* random) -> Parameters {
    const double phase = random->uniform(-M_PI, M_PI);
    return {
        {"sine", 5e-4 * std::cos(phase)}, {"cosine", 5e-4 * std::sin(phase)}, {"periods", 12.0}};
  };
  law.build = [](const Hidden& h, Draft* draft) {
    add_to_muscles(h, draft, [&](const reference::MuscleParameters& muscle) {
      return std::make_shared<Slots>(std::hypot(h["sine"], h["cosine"]), h["periods"],
                                     std::atan2(h["cosine"], h["sine"]), muscle.motor.gear_ratio);
    });
  };
  return law;
}

}  // namespace anthrob::virtual_robot
