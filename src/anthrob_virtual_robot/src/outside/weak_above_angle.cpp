#include "outside/outside.h"

namespace anthrob::virtual_robot {
namespace {

/// A table of gains in the firmware with a wrong entry: less voltage beyond an angle.
class WrongEntry final : public PowerLaw {
 public:
  WrongEntry(std::size_t muscle, double loss, double angle)
      : muscle_(muscle), loss_(loss), angle_(angle) {}
  void apply(double, const Readings& now, std::vector<double>* voltages) override {
    if (now.muscles[muscle_].position > angle_) (*voltages)[muscle_] *= 1.0 - loss_;
  }

 private:
  std::size_t muscle_;
  double loss_, angle_;
};

}  // namespace

HiddenLaw weak_above_angle() {
  HiddenLaw law;
  law.id = "weak_above_angle";
  law.law = "gain schedule with a wrong entry: less voltage beyond an angle";
  law.sizes = {"loss"};
  law.most = 3.0;
  law.places = muscle_places;
  law.draw = [](const auto&, const auto&, Random* random) -> Parameters {
    return {{"loss", 0.3}, {"angle", random->uniform(0.8, 1.6)}};
  };
  law.build = [](const Hidden& h, Draft* draft) {
    draft->power_laws.push_back(
        std::make_shared<WrongEntry>(draft->muscle(h.place), h["loss"], h["angle"]));
  };
  return law;
}

}  // namespace anthrob::virtual_robot
