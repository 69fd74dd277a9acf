#include "anthrob_control/posture_sequence.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <utility>

#include "anthrob_sim/skeleton/skeleton_model.h"

namespace anthrob {

namespace {

constexpr double kLongestHold = 1e6;  ///< [s]
/// With more shortfall than this the posture cannot be held [Nm].
constexpr double kHoldable = 0.02;

/// "shoulder_z 0.024, elbow -0.003": what is missing, largest first, without what hardly is.
std::string by_axis(const SkeletonModel& skeleton, const Eigen::VectorXd& shortfall) {
  std::vector<std::pair<double, std::string>> parts;
  for (const SweepAxis& axis : sweep_axes(skeleton)) {
    const int at = skeleton.joints[static_cast<std::size_t>(axis.joint)].velocity_offset;
    const double missing = shortfall[at + axis.component];
    if (std::abs(missing) < 0.1 * shortfall.norm()) continue;
    char text[40];
    std::snprintf(text, sizeof(text), " %.3g", missing);
    parts.emplace_back(-std::abs(missing), axis.name + text);
  }
  std::sort(parts.begin(), parts.end());
  std::string list;
  for (const auto& [order, part] : parts) list += (list.empty() ? "" : ", ") + part;
  return list;
}

void read_joint(const ConfigNode& node, const JointModel& joint, std::vector<double>& q) {
  double* p = &q[joint.position_offset];
  if (joint.type != JointType::kBall) {
    const Bounds bounds =
        joint.stop.enabled ? Bounds::between(joint.stop.lower, joint.stop.upper) : Bounds::any();
    p[0] = node.as_number(bounds, joint.type == JointType::kPrismatic ? "m" : "rad");
    return;
  }
  if (!node.is_sequence() || node.items().size() != 4)
    node.fail_expected("a unit quaternion [w, x, y, z]");
  double norm = 0.0;
  for (int k = 0; k < 4; ++k) {
    p[k] = node.items()[k].as_number(Bounds::between(-1.001, 1.001), "1");
    norm += p[k] * p[k];
  }
  norm = std::sqrt(norm);
  if (std::abs(norm - 1.0) > 1e-3) node.fail_expected("a unit quaternion [w, x, y, z]");
  for (int k = 0; k < 4; ++k) p[k] /= norm;
  const double angle = angular_distance(Quat(p[0], p[1], p[2], p[3]), Quat::Identity());
  if (joint.stop.enabled && angle > joint.stop.upper + 1e-6) {
    node.fail("turned by " + std::to_string(angle) + " rad: expected at most " +
              std::to_string(joint.stop.upper) + ", the joint's stop");
  }
}

/// Names become file names, table cells and keys.
std::string read_name(const ConfigNode& item) {
  const std::string name = item.text("name");
  const bool good = std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) || c == ' ' || c == '_' || c == '-' || c == '.';
  });
  if (!good || name.empty() || name.front() == '.' || name.front() == ' ' || name.back() == ' ') {
    item.at("name").fail_expected("letters, digits, '_', '-', '.' and spaces between them");
  }
  // As a ROS parameter (~posture) it would be a number.
  if (name.find_first_not_of("0123456789.-") == std::string::npos) {
    item.at("name").fail_expected("a name with a letter in it");
  }
  return name;
}

std::vector<double> read_references(const ConfigNode& node, const RobotModel& model) {
  std::vector<double> references(model.muscles.size(), NAN);
  for (const auto& [name, value] : node.entries()) {
    const int muscle = model.find_muscle(name);
    if (muscle < 0) value.fail("unknown muscle; expected one of " + model.file);
    const double limit = model.muscles[muscle].limits.position;
    references[muscle] = value.as_number(Bounds::between(-limit, limit), "rad");
  }
  for (std::size_t m = 0; m < references.size(); ++m) {
    if (!model.muscles[m].has_controller) {
      references[m] = 0.0;
    } else if (std::isnan(references[m])) {
      node.fail("muscle '" + model.muscles[m].name +
                "' is missing; expected references of all muscles");
    }
  }
  return references;
}

}  // namespace

PostureSequence PostureSequence::load(const std::string& file, const RobotModel& model) {
  const ConfigNode node = ConfigNode::load(file);
  PostureSequence sequence;
  sequence.options.lowest_tension = node.number_or(
      "lowest_tension", 1.0, Bounds::between(0.0, sequence.options.highest_tension), "N");
  for (const ConfigNode& item : node.at("postures").items()) {
    PostureStep step;
    step.name = read_name(item);
    step.hold = item.number_or("hold", step.hold, Bounds{0.0, kLongestHold, true, false}, "s");
    step.q = model.skeleton->rest_configuration();
    if (item.has("joints") && item.has("references")) {
      item.fail("has joints and references; expected one of them");
    }
    if (item.has("joints")) {
      for (const auto& [name, value] : item.at("joints").entries()) {
        const int joint = model.skeleton->find_joint(name);
        if (joint < 0) value.fail("unknown joint; expected a movable joint of " + model.file);
        read_joint(value, model.skeleton->joints[joint], step.q);
      }
    }
    if (item.has("references")) step.reference = read_references(item.at("references"), model);
    sequence.steps.push_back(step);
  }
  if (sequence.steps.empty()) node.at("postures").fail("expected at least one posture");
  node.refuse_unknown_keys();
  return sequence;
}

std::string torque_unit(const SkeletonModel& skeleton) {
  const auto slides = [](const JointModel& joint) { return joint.type == JointType::kPrismatic; };
  const auto& joints = skeleton.joints;
  if (std::none_of(joints.begin(), joints.end(), slides)) return "Nm";
  return std::all_of(joints.begin(), joints.end(), slides) ? "N" : "Nm or N";
}

void refuse_if_not_holdable(const std::string& name, const RobotModel& model,
                            const Equilibrium& equilibrium) {
  const double shortfall = equilibrium.shortfall.norm();
  if (shortfall <= kHoldable) return;
  throw BadInput("posture '" + name + "': the muscles of " + model.file +
                 " cannot hold it: " + std::to_string(shortfall) + " " +
                 torque_unit(*model.skeleton) + " of joint torque are missing (" +
                 by_axis(*model.skeleton, equilibrium.shortfall) + ")");
}

void refuse_beyond_limits(const std::string& posture, const RobotModel& model,
                          const std::vector<double>& reference) {
  for (std::size_t m = 0; m < reference.size(); ++m) {
    const MuscleModel& muscle = model.muscles[m];
    if (!muscle.has_controller || std::abs(reference[m]) <= muscle.limits.position) continue;
    throw BadInput("posture '" + posture + "': muscle '" + muscle.name + "' would need " +
                   std::to_string(reference[m]) + " rad; expected at most " +
                   std::to_string(muscle.limits.position) + " rad, its position limit in " +
                   model.file);
  }
}

void refuse_without_controllers(const RobotModel& model) {
  for (const MuscleModel& muscle : model.muscles) {
    if (muscle.has_controller) return;
  }
  throw BadInput(
      model.file +
      ": no muscle has a controller; expected at least one that takes POSITION commands");
}

std::vector<std::vector<double>> PostureSequence::references(
    const std::shared_ptr<const RobotModel>& model) const {
  refuse_without_controllers(*model);
  Simulation scratch(model);
  std::vector<std::vector<double>> list;
  for (const PostureStep& step : steps) {
    if (!step.reference.empty()) {
      list.push_back(step.reference);
      continue;
    }
    const Equilibrium equilibrium = find_equilibrium(scratch, step.q, options);
    refuse_if_not_holdable(step.name, *model, equilibrium);
    refuse_beyond_limits(step.name, *model, equilibrium.reference);
    list.push_back(equilibrium.reference);
  }
  return list;
}

}  // namespace anthrob
