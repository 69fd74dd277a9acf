#include "laws/laws.h"

namespace anthrob::virtual_robot {
namespace {

/// Slightly curved: the gain grows by a tenth of its error over 100 N.
class CurvedGain final : public ReadingLaw {
 public:
  CurvedGain(std::size_t muscle, double gain) : muscle_(muscle), gain_(gain) {}
  void apply(Readings* readings) override {
    double& f = readings->muscles[muscle_].force;
    f *= 1.0 + (gain_ - 1.0) * (0.97 + f / kCurve);
  }

 private:
  static constexpr double kCurve = 1000.0;  // [N]
  std::size_t muscle_;
  double gain_;
};

}  // namespace

HiddenLaw force_sensor_gain() {
  HiddenLaw law;
  law.id = "force_sensor_gain";
  law.law = "a gain whose error grows a little with force";
  law.sizes = {"gain"};
  law.neutral = 1.0;
  law.places = muscle_places_and_all;
  law.draw = [](const auto&, const auto&, Random* random) -> Parameters {
    return {{"gain", 1.0 + 0.06 * random->sign()}};
  };
  law.build = [](const Hidden& h, Draft* draft) {
    for (const std::size_t i : draft->muscles(h.place)) {
      draft->reading_laws.push_back(std::make_shared<CurvedGain>(i, h["gain"]));
    }
  };
  return law;
}

}  // namespace anthrob::virtual_robot
