#include "render/setup.h"

#include "anthrob_core/config_node.h"
#include "core/unit_quaternion.h"

namespace anthrob {
namespace mocap {

namespace {

Pose read_pose(const ConfigNode& node) {
  Pose X;
  if (node.has("position")) X.p = node.at("position").as_vector3("m");
  if (node.has("orientation")) X.R = unit_quaternion(node.at("orientation")).toRotationMatrix();
  return X;
}

void read_virtual(const ConfigNode& node, Setup& setup) {
  setup.rate = node.number_or("rate", setup.rate, Bounds::between(1.0, 1000.0), "Hz");
  setup.exposure = node.number_or("exposure", setup.exposure, Bounds::between(0.0, 0.1), "s");
  if (node.has("instants")) setup.instants = node.at("instants").as_integer(1, 100);
  setup.brightness =
      node.number_or("brightness", setup.brightness, Bounds::between(1.0, 1000.0), "grey levels");
  RenderOptions& r = setup.render;
  r.background =
      node.number_or("background", r.background, Bounds::between(0.0, 255.0), "grey levels");
  r.read_noise =
      node.number_or("read_noise", r.read_noise, Bounds::between(0.0, 100.0), "grey levels");
  r.shot_noise =
      node.number_or("shot_noise", r.shot_noise, Bounds::between(0.0, 100.0), "grey levels");
  r.lens_blur = node.number_or("lens_blur", r.lens_blur, Bounds::between(0.3, 10.0), "pixel");
  if (node.has("seed")) r.seed = static_cast<std::uint64_t>(node.at("seed").as_integer(0, 1 << 30));
  if (!node.has("distractors")) return;
  for (const ConfigNode& item : node.at("distractors").items()) {
    setup.distractors.push_back(
        {item.at("position").as_vector3("m"),
         item.number("radius", Bounds::between(1e-4, 1.0), "m"),
         item.number("brightness", Bounds::between(0.0, 1000.0), "grey levels")});
  }
}

}  // namespace

Pose Setup::JointFrame::at(const Quat& q) const {
  const Mat3 R = X_PC.R * q.toRotationMatrix();
  return {R, X_PC * centre - R * centre};
}

Setup Setup::load(const std::string& path, const TargetSet& set) {
  const ConfigNode file = ConfigNode::load(path);
  Setup setup;
  const ConfigNode camera = file.at("camera");
  setup.camera_parent = camera.text("parent");
  setup.X_PC = read_pose(camera);
  const ConfigNode mounts = file.at("mounts");
  for (const MarkerTarget& target : set.targets) {
    const ConfigNode mount = mounts.at(target.name);
    setup.mounts.push_back({mount.text("link"), read_pose(mount)});
  }
  for (const BallJoint& joint : set.joints) {
    const ConfigNode node = file.at("joints").at(joint.name);
    JointFrame frame;
    frame.parent = node.text("parent"), frame.child = node.text("child");
    frame.X_PC = read_pose(node);
    if (node.has("center")) frame.centre = node.at("center").as_vector3("m");
    setup.joints.push_back(frame);
  }
  if (file.has("virtual")) read_virtual(file.at("virtual"), setup);
  file.refuse_unknown_keys();
  file.refuse_empty_values();
  return setup;
}

}  // namespace mocap
}  // namespace anthrob
