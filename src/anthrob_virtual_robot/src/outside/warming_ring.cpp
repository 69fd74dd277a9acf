#include "outside/outside.h"

namespace anthrob::virtual_robot {
namespace {

/// A ring that gets softer as the room gets warmer.
class Warming final : public reference::MuscleLaw {
 public:
  Warming(double softening, double stiffness) : softening_(softening), stiffness_(stiffness) {}
  double spring_force(double stretch) const override {
    return -softening_ * (1.0 - std::exp(-t_ / kRoom)) * stiffness_ * stretch;
  }
  void settle(double h, const reference::MuscleState&, const reference::MuscleSolution&) override {
    t_ += h;
  }

 private:
  static constexpr double kRoom = 15.0;  // [s]
  double softening_, stiffness_;
  double t_ = 0.0;
};

}  // namespace

HiddenLaw warming_ring() {
  HiddenLaw law;
  law.id = "warming_ring";
  law.law = "stiffness of a ring that falls with time whatever it carries";
  law.sizes = {"softening"};
  law.most = 4.0;
  law.places = muscle_places;
  law.draw = [](const auto&, const auto&, Random*) -> Parameters { return {{"softening", 0.2}}; };
  law.build = [](const Hidden& h, Draft* draft) {
    add_to_muscles(h, draft, [&](const reference::MuscleParameters& muscle) {
      return std::make_shared<Warming>(h["softening"], ring_stiffness(muscle.ring));
    });
  };
  return law;
}

}  // namespace anthrob::virtual_robot
