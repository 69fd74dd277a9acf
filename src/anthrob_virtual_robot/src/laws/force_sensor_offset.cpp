#include "laws/laws.h"

namespace anthrob::virtual_robot {
namespace {

class Shifted final : public ReadingLaw {
 public:
  Shifted(std::size_t muscle, double offset, double drift)
      : muscle_(muscle), offset_(offset), drift_(drift) {}
  void apply(Readings* readings) override {
    readings->muscles[muscle_].force += offset_ + drift_ * readings->t;
  }

 private:
  std::size_t muscle_;
  double offset_, drift_;
};

}  // namespace

HiddenLaw force_sensor_offset() {
  HiddenLaw law;
  law.id = "force_sensor_offset";
  law.law = "as in the catalogue";
  law.sizes = {"offset", "drift"};
  law.places = muscle_places_and_all;
  law.draw = [](const auto&, const auto&, Random* random) -> Parameters {
    const double sign = random->sign();
    return {{"offset", 2.0 * sign}, {"drift", random->uniform() < 0.5 ? 0.0 : 0.02 * sign}};
  };
  law.build = [](const Hidden& h, Draft* draft) {
    for (const std::size_t i : draft->muscles(h.place)) {
      draft->reading_laws.push_back(std::make_shared<Shifted>(i, h["offset"], h["drift"]));
    }
  };
  return law;
}

}  // namespace anthrob::virtual_robot
