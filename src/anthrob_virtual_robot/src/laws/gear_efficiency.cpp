#include "laws/laws.h"

namespace anthrob::virtual_robot {
HiddenLaw gear_efficiency() {
  HiddenLaw law;
  law.id = "gear_efficiency";
  law.law = "as in the catalogue";
  law.sizes = {"loss"};
  law.places = muscle_places_and_all;
  law.most = 4.0;
  law.draw = [](const auto&, const auto&, Random*) -> Parameters { return {{"loss", 0.15}}; };
  law.build = [](const Hidden& h, Draft* draft) {
    for (const std::size_t i : draft->muscles(h.place)) {
      draft->arm.muscles[i].motor.efficiency *= 1.0 - h["loss"];
    }
  };
  return law;
}

}  // namespace anthrob::virtual_robot
