#include "touch/ball_centers.h"

#include "anthrob_core/config_node.h"

namespace anthrob {

std::map<std::string, Vec3> ball_centers(const std::string& model_file) {
  std::map<std::string, Vec3> centers;
  const ConfigNode model = ConfigNode::load(model_file);
  if (!model.has("joints")) return centers;
  for (const auto& [name, joint] : model.at("joints").entries()) {
    if (joint.has("center")) centers[name] = joint.at("center").as_vector3("m");
  }
  return centers;
}

}  // namespace anthrob
