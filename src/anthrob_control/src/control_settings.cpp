#include "anthrob_control/control_settings.h"

namespace anthrob {

namespace {

constexpr double kFastestSlide = 0.4;  ///< [m/s] unless the settings say otherwise

ecu::Mode read_mode(const ConfigNode& node) {
  const std::string word = node.as_text();
  if (word == "FORCE") return ecu::Mode::kForce;
  if (word == "POSITION") return ecu::Mode::kPosition;
  if (word == "VOLTAGE") return ecu::Mode::kVoltage;
  node.fail_expected("FORCE, POSITION or VOLTAGE");
}

JointGains read_gains(const ConfigNode& node, const JointModel& joint) {
  const bool slides = joint.type == JointType::kPrismatic;
  JointGains gains;
  if (slides) gains.fastest = kFastestSlide;
  const auto read = [&](const char* key, const char* turning, const char* sliding) {
    return node.number(key, Bounds::nonnegative(), slides ? sliding : turning);
  };
  gains.stiffness = read("stiffness", "Nm/rad", "N/m");
  gains.damping = read("damping", "Nms/rad", "Ns/m");
  gains.integral = read("integral", "Nm/(rad s)", "N/(m s)");
  gains.yield = read("yield", "Nm", "N");
  gains.strength = read("strength", "Nm", "N");
  gains.fastest =
      node.number_or("fastest", gains.fastest, Bounds::positive(), slides ? "m/s" : "rad/s");
  return gains;
}

}  // namespace

ControlSettings ControlSettings::load(const std::string& file, const RobotModel& model) {
  const ConfigNode node = ConfigNode::load(file);
  ControlSettings settings;
  settings.rate = node.number("rate", Bounds::between(10.0, 1000.0), "Hz");
  settings.hold_output = read_mode(node.at("output").at("hold"));
  settings.move_output = read_mode(node.at("output").at("move"));
  const ConfigNode tension = node.at("tension");
  settings.lowest_tension = tension.number("lowest", Bounds::nonnegative(), "N");
  settings.highest_tension =
      tension.number("highest", Bounds::between(settings.lowest_tension, 1e4), "N");
  const ConfigNode filter = node.at("filter");
  settings.position_cutoff = filter.number("position_cutoff", Bounds::positive(), "Hz");
  settings.velocity_cutoff = filter.number("velocity_cutoff", Bounds::positive(), "Hz");
  settings.stale_after = node.number("stale_after", Bounds::positive(), "s");

  const ConfigNode joints = node.at("joints");
  for (const auto& [name, value] : joints.entries()) {
    if (model.skeleton->find_joint(name) < 0)
      value.fail("unknown joint; expected a movable joint of " + model.file);
  }
  for (const JointModel& joint : model.skeleton->joints)
    settings.joints.push_back(read_gains(joints.at(joint.name), joint));
  node.refuse_unknown_keys();
  return settings;
}

}  // namespace anthrob
