#include "outside/outside.h"

namespace anthrob::virtual_robot {
namespace {

/// A tooth that rubs in one place of each turn of the output.
class BadTooth final : public reference::MuscleLaw {
 public:
  BadTooth(double torque, double place) : torque_(torque), place_(place) {}
  double output_torque(double position, double speed) const override {
    const double near = std::exp(8.0 * (std::cos(position - place_) - 1.0));
    return -torque_ * near * std::tanh(speed / kSmooth);
  }

 private:
  static constexpr double kSmooth = 0.05;  // [rad/s]
  double torque_, place_;
};

}  // namespace

HiddenLaw one_bad_tooth() {
  HiddenLaw law;
  law.id = "one_bad_tooth";
  law.law = "friction of the gear at one angle of its output";
  law.sizes = {"torque"};
  law.most = 10.0;
  law.places = muscle_places;
  law.draw = [](const auto&, const auto&, Random* random) -> Parameters {
    return {{"torque", 0.1}, {"at", random->uniform(0.0, 3.0)}};
  };
  law.build = [](const Hidden& h, Draft* draft) {
    add_to_muscles(h, draft,
                   [&](const auto&) { return std::make_shared<BadTooth>(h["torque"], h["at"]); });
  };
  return law;
}

}  // namespace anthrob::virtual_robot
