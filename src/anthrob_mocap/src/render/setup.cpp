#include "anthrob_mocap/render/setup.h"

#include "anthrob_mocap/file/settings.h"

namespace anthrob {
namespace mocap {

namespace {

Pose read_pose(const Settings& node) {
  Pose X;
  if (node.has("position")) X.p = node.at("position").vector3();
  if (node.has("orientation")) X.R = node.at("orientation").unit_quaternion().toRotationMatrix();
  return X;
}

void read_virtual(const Settings& node, Setup& setup) {
  setup.rate = node.number_or("rate", setup.rate, 1.0, 1000.0);
  setup.exposure = node.number_or("exposure", setup.exposure, 0.0, 0.1);
  if (node.has("instants")) setup.instants = node.at("instants").integer(1, 100);
  setup.brightness = node.number_or("brightness", setup.brightness, 1.0, 1000.0);
  RenderOptions& r = setup.render;
  r.background = node.number_or("background", r.background, 0.0, 255.0);
  r.read_noise = node.number_or("read_noise", r.read_noise, 0.0, 100.0);
  r.shot_noise = node.number_or("shot_noise", r.shot_noise, 0.0, 100.0);
  r.lens_blur = node.number_or("lens_blur", r.lens_blur, 0.3, 10.0);
  if (node.has("seed")) r.seed = static_cast<std::uint64_t>(node.at("seed").integer(0, 1 << 30));
  if (!node.has("distractors")) return;
  for (const Settings& item : node.at("distractors").items()) {
    setup.distractors.push_back({item.at("position").vector3(),
                                 item.at("radius").number(1e-4, 1.0, "m"),
                                 item.at("brightness").number(0.0, 1000.0)});
  }
}

}  // namespace

Pose Setup::JointFrame::at(const Quat& q) const {
  const Mat3 R = X_PC.R * q.toRotationMatrix();
  return {R, X_PC * center - R * center};
}

Setup Setup::load(const std::string& path, const TargetSet& set) {
  const Settings file = Settings::load(path);
  Setup setup;
  const Settings camera = file.at("camera");
  setup.camera_parent = camera.at("parent").text();
  setup.X_PC = read_pose(camera);
  const Settings mounts = file.at("mounts");
  for (const MarkerTarget& target : set.targets) {
    const Settings mount = mounts.at(target.name);
    setup.mounts.push_back({mount.at("link").text(), read_pose(mount)});
  }
  for (const BallJoint& joint : set.joints) {
    const Settings node = file.at("joints").at(joint.name);
    JointFrame frame;
    frame.parent = node.at("parent").text(), frame.child = node.at("child").text();
    frame.X_PC = read_pose(node);
    if (node.has("center")) frame.center = node.at("center").vector3();
    setup.joints.push_back(frame);
  }
  if (file.has("virtual")) read_virtual(file.at("virtual"), setup);
  file.refuse_unknown_keys();
  return setup;
}

}  // namespace mocap
}  // namespace anthrob
