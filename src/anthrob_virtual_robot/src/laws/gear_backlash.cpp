#include "laws/laws.h"

namespace anthrob::virtual_robot {
namespace {

/// The spindle sits on an oiled shaft: between the flanks it turns as fast as the tendon pulls it
/// through the oil. While it is free the motor carries nothing of the tendon.
class OiledPlay final : public reference::MuscleLaw {
 public:
  OiledPlay(double width, double drag, double radius)
      : width_(width), drag_(drag), radius_(radius) {}

  double wound(double) const override { return radius_ * lead_; }
  double leverage(double) const override { return lead_ > 0.0 && lead_ < width_ ? -radius_ : 0.0; }
  void settle(double h, const reference::MuscleState& state,
              const reference::MuscleSolution& solution) override {
    if (!placed_) last_ = state.position, placed_ = true;
    const double turned = state.position - last_;
    last_ = state.position;
    const double excess = std::max(0.0, radius_ * solution.tensions.front() - drag_);
    lead_ = std::clamp(lead_ - turned - h * excess / kOil, 0.0, width_);
  }

 private:
  static constexpr double kOil = 1e-3;  // [Nms/rad]
  double width_, drag_, radius_;
  double lead_ = 0.0;  // of the spindle before the flank that winds in [rad]
  double last_ = 0.0;
  bool placed_ = false;
};

}  // namespace

HiddenLaw gear_backlash() {
  HiddenLaw law;
  law.id = "gear_backlash";
  law.law = "free spindle drawn through oil of 1e-3 Nms/rad";
  law.sizes = {"width"};
  law.places = muscle_places_and_all;
  law.most = 10.0;
  law.draw = [](const auto&, const auto&, Random* random) -> Parameters {
    return {{"width", 0.03}, {"drag", random->log_uniform(0.02, 0.06)}};
  };
  law.build = [](const Hidden& h, Draft* draft) {
    add_to_muscles(h, draft, [&](const reference::MuscleParameters& muscle) {
      return std::make_shared<OiledPlay>(h["width"], h["drag"], muscle.spindle_radius);
    });
  };
  return law;
}

}  // namespace anthrob::virtual_robot
