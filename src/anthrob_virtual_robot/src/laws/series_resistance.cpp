#include "laws/laws.h"

namespace anthrob::virtual_robot {
HiddenLaw series_resistance() {
  HiddenLaw law;
  law.id = "series_resistance";
  law.law = "as in the catalogue";
  law.sizes = {"resistance"};
  law.places = muscle_places_and_all;
  law.most = 15.0;
  law.draw = [](const auto&, const auto&, Random*) -> Parameters { return {{"resistance", 0.3}}; };
  law.build = [](const Hidden& h, Draft* draft) {
    for (const std::size_t i : draft->muscles(h.place)) {
      draft->arm.muscles[i].motor.power_stage_resistance += h["resistance"];
    }
  };
  return law;
}

}  // namespace anthrob::virtual_robot
