#include "laws/laws.h"

namespace anthrob::virtual_robot {
namespace {

/// A bridge that loses its threshold gradually.
class SoftThreshold final : public PowerLaw {
 public:
  SoftThreshold(std::size_t muscle, double width) : muscle_(muscle), width_(width) {}
  void apply(double, const Readings&, std::vector<double>* voltages) override {
    double& v = (*voltages)[muscle_];
    if (width_ > 0.0) v -= width_ * std::tanh(v / width_);
  }

 private:
  std::size_t muscle_;
  double width_;
};

}  // namespace

HiddenLaw pwm_dead_zone() {
  HiddenLaw law;
  law.id = "pwm_dead_zone";
  law.law = "V - width tanh(V / width) instead of a sharp dead zone";
  law.sizes = {"width"};
  law.places = muscle_places_and_all;
  law.draw = [](const auto&, const auto&, Random*) -> Parameters { return {{"width", 0.4}}; };
  law.build = [](const Hidden& h, Draft* draft) {
    for (const std::size_t i : draft->muscles(h.place)) {
      draft->power_laws.push_back(std::make_shared<SoftThreshold>(i, h["width"]));
    }
  };
  return law;
}

}  // namespace anthrob::virtual_robot
