#include "outside/outside.h"

namespace anthrob::virtual_robot {
namespace {

/// A knot that slips a little whenever the tension is beyond what it holds.
class Knot final : public reference::MuscleLaw {
 public:
  Knot(double slip, double holds) : slip_(slip), holds_(holds) {}
  double elongation() const override { return slip_ * slipped_; }
  void settle(double h, const reference::MuscleState&,
              const reference::MuscleSolution& solution) override {
    if (solution.tensions.front() > holds_) slipped_ += h * (1.0 - slipped_) / kPace;
  }

 private:
  static constexpr double kPace = 0.5;  // [s]
  double slip_;                         // [m]
  double holds_;                        // [N]
  double slipped_ = 0.0;
};

}  // namespace

HiddenLaw slipping_knot() {
  HiddenLaw law;
  law.id = "slipping_knot";
  law.law = "tendon that gets longer once, in the moments of high tension";
  law.sizes = {"slip"};
  law.most = 5.0;
  law.places = muscle_places;
  law.draw = [](const auto&, const auto&, Random* random) -> Parameters {
    return {{"slip", 0.003}, {"holds", random->uniform(12.0, 18.0)}};
  };
  law.build = [](const Hidden& h, Draft* draft) {
    add_to_muscles(h, draft,
                   [&](const auto&) { return std::make_shared<Knot>(h["slip"], h["holds"]); });
  };
  return law;
}

}  // namespace anthrob::virtual_robot
