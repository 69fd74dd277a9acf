#include "laws.h"

namespace anthrob::virtual_robot {
HiddenLaw via_point_shift() {
  HiddenLaw law;
  law.id = "via_point_shift";
  law.law = "as in the catalogue";
  law.sizes = {"shift"};
  law.places = landing_points;
  law.draw = [](const auto&, const auto&, Random* random) -> Parameters {
    return {{"shift", 0.003 * random->sign()}};
  };
  law.build = [](const Hidden& h, Draft* draft) {
    const std::vector<std::string> place = words(h.place);
    auto& muscle = draft->arm.muscles[draft->muscle(place[0])];
    muscle.path.at(std::stoul(place[1])).position(place[2][0] - 'x') += h["shift"];
  };
  return law;
}

}  // namespace anthrob::virtual_robot
