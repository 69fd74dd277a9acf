#include "load.h"

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <map>
#include <stdexcept>

#include "yaml_section.h"

namespace anthrob::reference {
namespace {

// The dry friction of a joint has no steepness in the file; the value of the eyelets (4.75).
constexpr double kJointSteepness = 10.0;

YAML::Node merged(const YAML::Node& base, const YAML::Node& over) {
  if (!base.IsMap() || !over.IsMap()) return YAML::Clone(over);
  YAML::Node result = YAML::Clone(base);
  for (const auto& entry : over) {
    const auto key = entry.first.as<std::string>();
    const YAML::Node old = base[key];
    result[key] = old.IsDefined() ? merged(old, entry.second) : YAML::Clone(entry.second);
  }
  return result;
}

YAML::Node read(const std::filesystem::path& file, int depth = 0) {
  constexpr int kDeepest = 16;
  if (depth > kDeepest) throw std::runtime_error(file.string() + ": extends itself");
  YAML::Node node;
  try {
    node = YAML::LoadFile(file.string());
  } catch (const YAML::Exception& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
  if (!node.IsMap()) throw std::runtime_error(file.string() + ": expected a map");
  // Relative to the file that names it, whoever extends that file.
  if (node["robot"])
    node["robot"] = (file.parent_path() / node["robot"].as<std::string>()).string();
  if (!node["extends"]) return node;
  const YAML::Node base = read(file.parent_path() / node["extends"].as<std::string>(), depth + 1);
  node.remove("extends");
  return merged(base, node);
}

JointFrictionParameters joint_friction(YamlSection section) {
  JointFrictionParameters friction;
  friction.dry.static_level = section.number("static");
  friction.dry.kinetic_level = section.number("kinetic");
  friction.dry.velocity = section.number("stribeck_velocity");
  friction.dry.steepness = kJointSteepness;
  friction.viscous = section.number("viscous");
  section.finish();
  return friction;
}

void read_joints(YamlSection joints, SkeletonParameters* skeleton) {
  YamlSection shoulder = joints.section("shoulder");
  shoulder.expect("type", "ball");
  skeleton->p_HS = shoulder.vector("center");
  skeleton->shoulder_friction = joint_friction(shoulder.section("friction"));
  shoulder.finish();
  YamlSection elbow = joints.section("elbow");
  skeleton->elbow_friction = joint_friction(elbow.section("friction"));
  YamlSection stop = elbow.section("stop");
  skeleton->elbow_stop.stiffness = stop.number("stiffness");
  skeleton->elbow_stop.damping = stop.number("damping");
  stop.finish();
  elbow.finish();
  joints.finish();
}

RingParameters ring(YamlSection section) {
  section.expect("type", "zener");
  RingParameters ring;
  ring.rest_length = section.number("rest_length");
  ring.section_diameter = section.number("section_diameter");
  ring.strands = section.number("strands");
  ring.modulus = section.number("modulus");
  ring.arm_modulus = section.number("arm_modulus");
  ring.relaxation_time = section.number("relaxation_time");
  section.finish();
  return ring;
}

void read_gear(YamlSection section, MotorParameters* motor) {
  section.expect("law", "current_sign");
  motor->gear_ratio = section.number("ratio");
  motor->efficiency = section.number("efficiency");
  motor->gear_inertia = section.number("inertia");
  motor->steepness = section.number("steepness");
  motor->shift = section.number("shift");
  if (section.number("friction_torque") != 0.0)
    section.fail("friction_torque", "not modelled; expected 0");
  section.finish();
}

MotorParameters motor(YamlSection section) {
  section.expect("type", "dc_motor");
  section.ignore("nominal_voltage");
  MotorParameters result;
  YamlSection winding = section.section("motor");
  result.resistance = winding.number("resistance");
  result.inductance = winding.number("inductance");
  result.torque_constant = winding.number("torque_constant");
  result.back_emf_constant = winding.number("back_emf_constant");
  result.rotor_inertia = winding.number("rotor_inertia");
  winding.finish();
  read_gear(section.section("gear"), &result);
  YamlSection stage = section.section("power_stage");
  result.power_stage_resistance = stage.number("resistance");
  stage.finish();
  section.finish();
  return result;
}

ControllerParameters controller(YamlSection section) {
  // What else is here belongs to other modes or decides which commands are accepted.
  ControllerParameters result;
  result.period = section.number("period");
  result.voltage_limit = section.number("voltage_limit");
  YamlSection position = section.section("position");
  result.proportional = position.number("proportional");
  result.derivative = position.number("derivative");
  result.force_feedforward = position.number("force_feedforward");
  position.finish();
  return result;
}

StribeckParameters eyelet_friction(YamlSection section) {
  section.expect("law", "smooth_stribeck");
  StribeckParameters friction;
  friction.static_level = section.number("static");
  friction.kinetic_level = section.number("kinetic");
  friction.velocity = section.number("stribeck_velocity");
  friction.steepness = section.number("steepness");
  section.finish();
  return friction;
}

Body body(YamlSection* entry) {
  const std::string name = entry->text("body");
  if (name == "base") return Body::kBase;
  if (name == "humerus") return Body::kHumerus;
  if (name == "forearm") return Body::kForearm;
  entry->fail("body", name + ": no such body");
}

PathEntry path_entry(YamlSection section) {
  PathEntry entry;
  entry.body = body(&section);
  if (section.has("point")) {
    entry.position = section.vector("point");
  } else {
    YamlSection cylinder = section.section("cylinder");
    entry.position = cylinder.vector("origin");
    entry.cylinder = CylinderShape{cylinder.vector("axis"), cylinder.number("radius")};
    // Both starts are the short side; whether it touches there follows from the posture.
    const std::string start = cylinder.text("start");
    if (start != "positive" && start != "not_wrapping") {
      cylinder.fail("start", start + ": not modelled; expected positive or not_wrapping");
    }
    cylinder.finish();
  }
  section.finish();
  return entry;
}

/// The named parts that muscles refer to.
struct Parts {
  std::map<std::string, RingParameters> rings;
  std::map<std::string, MotorParameters> motors;
  std::map<std::string, ControllerParameters> controllers;
  StribeckParameters eyelet_friction;
};

template <typename T>
std::map<std::string, T> read_all(YamlSection sections, T (*read_one)(YamlSection)) {
  std::map<std::string, T> result;
  for (const auto& entry : sections.node()) {
    const auto name = entry.first.as<std::string>();
    result[name] = read_one(sections.section(name));
  }
  return result;
}

template <typename T>
const T& named(const std::map<std::string, T>& parts, YamlSection* section,
               const std::string& key) {
  const auto found = parts.find(section->text(key));
  if (found == parts.end()) section->fail(key, "no such entry");
  return found->second;
}

MuscleParameters muscle(YamlSection section, const Parts& parts) {
  section.ignore("ecu");
  MuscleParameters result;
  result.motor = named(parts.motors, &section, "actuator");
  result.controller = named(parts.controllers, &section, "controller");
  result.eyelet_friction = parts.eyelet_friction;
  result.spindle_radius = section.number("spindle_radius");
  result.rest_tendon_length = section.number("rest_tendon_length");
  result.sensor_segment = section.integer("force_sensor_segment");
  YamlSection spring = section.section("spring");
  result.ring = named(parts.rings, &spring, "kind");
  result.ring.quantity = spring.number("quantity");
  result.ring_segment = spring.integer("segment");
  spring.finish();
  int index = 0;
  for (const auto& entry : section.list("path")) {
    const std::string where = section.where() + "/path/" + std::to_string(index++);
    result.path.push_back(path_entry(YamlSection(entry, where)));
  }
  section.finish();
  return result;
}

}  // namespace

ArmParameters load_arm(const std::string& model_file) {
  YamlSection model(read(model_file), model_file);
  ArmParameters arm;
  load_robot(model.text("robot"), &arm.skeleton);
  arm.skeleton.gravity_W = model.vector("gravity");
  read_joints(model.section("joints"), &arm.skeleton);
  Parts parts;
  parts.rings = read_all(model.section("springs"), ring);
  parts.motors = read_all(model.section("actuators"), motor);
  parts.controllers = read_all(model.section("controllers"), controller);
  parts.eyelet_friction = eyelet_friction(model.section("eyelet_friction"));
  YamlSection muscles = model.section("muscles");
  for (const auto& entry : muscles.node()) {
    const auto name = entry.first.as<std::string>();
    arm.muscles.push_back(muscle(muscles.section(name), parts));
    arm.muscles.back().name = name;
  }
  model.finish();
  return arm;
}

}  // namespace anthrob::reference
