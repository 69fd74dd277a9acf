#include <nlohmann/json.hpp>

#include "blind_case.h"
#include "channels.h"
#include "places.h"

namespace anthrob::virtual_robot {

std::string truth_text(const BlindCase& blind) {
  nlohmann::ordered_json truth;
  truth["kind"] = word(blind.kind);
  truth["seed"] = blind.seed;
  truth["effects"] = nlohmann::ordered_json::array();
  for (const Hidden& hidden : blind.hidden) {
    const HiddenLaw& law = hidden_law(hidden.id);
    truth["effects"].push_back({{"id", hidden.id},
                                {"place", hidden.place},
                                {"parameters", hidden.parameters},
                                {"sizes", law.sizes},
                                {"law", law.law}});
  }
  if (!blind.change.empty()) {
    const auto [channel, floors] = worst(blind.change);
    truth["change"] = {{"channel", channel}, {"floors", floors}};
  }
  truth["slow"] = blind.slow;
  truth["stated_noise"] = blind.stated_noise;
  truth["noise_memory"] = blind.sensors.force.memory;
  auto& nuisances = truth["nuisances"];
  for (std::size_t i = 0; i < blind.built.muscles.size(); ++i) {
    const auto &is = blind.built.muscles[i], &believed = blind.believed.muscles[i];
    const std::size_t last = leaving_segment(is);
    const Eigen::Vector3d moved = is.path[last].position - believed.path[last].position;
    nuisances[is.name] = {
        {"rest_tendon_length", is.rest_tendon_length - believed.rest_tendon_length},
        {"spindle_radius", is.spindle_radius - believed.spindle_radius},
        {"path_point", {{"index", last}, {"moved", {moved.x(), moved.y(), moved.z()}}}}};
  }
  nuisances["shoulder"]["viscous"] = blind.built.skeleton.shoulder_friction.viscous;
  nuisances["elbow"]["viscous"] = blind.built.skeleton.elbow_friction.viscous;
  return truth.dump(2) + "\n";
}

}  // namespace anthrob::virtual_robot
