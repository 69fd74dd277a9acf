#include "laws/laws.h"

namespace anthrob::virtual_robot {
namespace {

/// Layer on layer: each turn winds at one radius, with a soft step to the next.
class Layers final : public reference::MuscleLaw {
 public:
  explicit Layers(double growth) : growth_(growth) {}
  double leverage(double position) const override {
    const double turns = position / (2.0 * M_PI);
    return growth_ * (turns - kStep * std::sin(2.0 * M_PI * turns) / (2.0 * M_PI));
  }
  double wound(double position) const override {
    const double turns = position / (2.0 * M_PI);
    const double ripple = kStep * (std::cos(2.0 * M_PI * turns) - 1.0) / (4.0 * M_PI * M_PI);
    return 2.0 * M_PI * growth_ * (0.5 * turns * turns + ripple);
  }

 private:
  // 0: a steady growth, 1: flat where a turn is full. Many muscles use a part of a turn only.
  static constexpr double kStep = 0.2;
  double growth_;
};

}  // namespace

HiddenLaw spindle_growth() {
  HiddenLaw law;
  law.id = "spindle_growth";
  law.law = "layers with soft steps instead of a radius in proportion to the angle";
  law.sizes = {"growth"};
  law.places = muscle_places_and_all;
  law.draw = [](const auto&, const auto&, Random*) -> Parameters { return {{"growth", 3e-4}}; };
  law.build = [](const Hidden& h, Draft* draft) {
    add_to_muscles(h, draft, [&](const auto&) { return std::make_shared<Layers>(h["growth"]); });
  };
  return law;
}

}  // namespace anthrob::virtual_robot
