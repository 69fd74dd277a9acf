#include "laws/laws.h"

namespace anthrob::virtual_robot {
namespace {

/// Of "biceps_brachii/3/x".
double& coordinate(reference::ArmParameters* arm, const std::string& place) {
  const std::vector<std::string> parts = words(place);
  for (reference::MuscleParameters& muscle : arm->muscles) {
    if (muscle.name != parts[0]) continue;
    return muscle.path.at(std::stoul(parts[1])).position(parts[2][0] - 'x');
  }
  throw std::invalid_argument(parts[0] + ": no such muscle");
}

}  // namespace

HiddenLaw via_point_shift() {
  HiddenLaw law;
  law.id = "via_point_shift";
  law.law = "as in the catalogue";
  law.sizes = {"shift"};
  law.places = landing_points;
  law.draw = [](const auto&, const auto&, Random* random) -> Parameters {
    return {{"shift", 0.003 * random->sign()}};
  };
  law.same_as = ModelNumber{[](const std::string& place) {
                              const std::vector<std::string> parts = words(place);
                              return "muscles." + parts[0] + ".path." + parts[1] + ".point." +
                                     std::to_string(parts[2][0] - 'x');
                            },
                            coordinate};
  law.build = [](const Hidden& h, Draft* draft) { coordinate(&draft->arm, h.place) += h["shift"]; };
  return law;
}

}  // namespace anthrob::virtual_robot
