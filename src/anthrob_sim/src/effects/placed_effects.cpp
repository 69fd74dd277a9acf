#include "anthrob_sim/effects/placed_effects.h"

#include <sstream>

namespace anthrob {

namespace {

const char* const kAll = "all";

/// What a joint torque of a hinge corresponds to where the joint slides: 100 N for 1 Nm, 10 m for
/// 100 rad.
constexpr double kForcePerTorque = 100.0;
constexpr double kMetresPerRadian = 0.1;
/// Periods a metre for one period a turn: racks, magnets and balls of guides repeat in centimetres.
constexpr double kPerMetre = 10.0;

bool is_inner(const PathObstacle& obstacle, const std::vector<PathObstacle>& path) {
  return &obstacle != &path.front() && &obstacle != &path.back();
}

struct UnitOfSlides {
  const char* hinge;
  const char* slide;
  double scale;
};
const UnitOfSlides kUnitsOfSlides[] = {
    {"Nm", "N", kForcePerTorque},
    {"Nms/rad", "Ns/m", kForcePerTorque / kMetresPerRadian},
    {"Nms2/rad2", "Ns2/m2", kForcePerTorque / kMetresPerRadian / kMetresPerRadian},
    {"1/turn", "1/m", kPerMetre},
    {"Nm/rad", "N/m", kForcePerTorque / kMetresPerRadian},
    {"rad", "m", kMetresPerRadian},
    {"rad/s", "m/s", kMetresPerRadian},
};

}  // namespace

std::vector<std::string> split_place(const std::string& place) {
  std::vector<std::string> parts;
  std::istringstream in(place);
  std::string part;
  while (std::getline(in, part, '/')) parts.push_back(part);
  if (parts.empty()) parts.emplace_back();
  return parts;
}

bool acts_on(const EffectInfo& effect, const MuscleModel& muscle) {
  if (!muscle.is_drive()) return true;
  switch (effect.seam) {
    case Seam::kSpindle:
    case Seam::kTendon:
    case Seam::kSpring:
    case Seam::kPath:
      return false;
    default:
      return true;
  }
}

std::vector<std::string> MuscleEffect::places(const RobotModel& robot) const {
  std::vector<std::string> list;
  for (const MuscleModel& muscle : robot.muscles) {
    if (acts_on(info(), muscle) && fits(muscle)) list.push_back(muscle.name);
  }
  if (!list.empty()) list.push_back(kAll);
  return list;
}

void MuscleEffect::build_in(const EffectSetting& setting, ModelDraft& draft) const {
  for (std::size_t i = 0; i < draft.robot.muscles.size(); ++i) {
    const MuscleModel& muscle = draft.robot.muscles[i];
    const bool meant = setting.place() == kAll || setting.place() == muscle.name;
    if (meant && acts_on(info(), muscle) && fits(muscle)) {
      change(setting, draft, i);
    }
  }
}

std::vector<std::string> PathEffect::places(const RobotModel& robot) const {
  std::vector<std::string> list;
  for (const MuscleModel& muscle : robot.muscles) {
    if (muscle.is_drive()) continue;
    bool any = false;
    const auto& obstacles = muscle.path->obstacles();
    for (const PathObstacle& obstacle : obstacles) {
      if (!fits(obstacle, is_inner(obstacle, obstacles))) continue;
      any = true;
      if (obstacle.entry >= 0) list.push_back(muscle.name + "/" + std::to_string(obstacle.entry));
    }
    if (any) list.push_back(muscle.name);
  }
  if (!list.empty()) list.push_back(kAll);
  return list;
}

void PathEffect::build_in(const EffectSetting& setting, ModelDraft& draft) const {
  const std::vector<std::string> place = split_place(setting.place());
  for (MuscleModel& muscle : draft.robot.muscles) {
    if (muscle.is_drive() || (place[0] != kAll && place[0] != muscle.name)) continue;
    std::vector<PathObstacle> obstacles = muscle.path->obstacles();
    for (PathObstacle& obstacle : obstacles) {
      const bool meant = place.size() == 1 || std::to_string(obstacle.entry) == place[1];
      if (meant && fits(obstacle, is_inner(obstacle, obstacles)))
        change(setting, draft.robot, obstacle);
    }
    muscle.path = std::make_shared<PathModel>(draft.skeleton, std::move(obstacles));
  }
}

std::vector<std::string> JointEffect::places(const RobotModel& robot) const {
  std::vector<std::string> list;
  for (const JointModel& joint : robot.skeleton->joints) {
    if (fits(joint)) list.push_back(joint.name);
  }
  return list;
}

std::vector<EffectParameter> JointEffect::parameters_at(const RobotModel& robot,
                                                        const std::string& place) const {
  std::vector<EffectParameter> list = info().parameters;
  const int joint = robot.skeleton->find_joint(place);
  if (joint < 0 || robot.skeleton->joints[joint].type != JointType::kPrismatic) return list;
  for (EffectParameter& p : list) {
    for (const UnitOfSlides& unit : kUnitsOfSlides) {
      if (p.unit != unit.hinge) continue;
      p.unit = unit.slide;
      p.neutral *= unit.scale;
      p.typical *= unit.scale;
      p.bounds.lo *= unit.scale;
      p.bounds.hi *= unit.scale;
      break;
    }
  }
  return list;
}

void JointEffect::build_in(const EffectSetting& setting, ModelDraft& draft) const {
  change(setting, draft, draft.skeleton.joints[draft.skeleton.find_joint(setting.place())]);
}

std::vector<std::string> GlobalEffect::places(const RobotModel&) const {
  return {"global"};
}

std::vector<std::string> WorldAxisEffect::places(const RobotModel& robot) const {
  std::vector<std::string> list;
  for (const char* axis : {"x", "y", "z"}) {
    if (fits(robot, axis_of(axis))) list.push_back(axis);
  }
  return list;
}

Vec3 WorldAxisEffect::axis_of(const std::string& place) {
  return Vec3::Unit(place[0] - 'x');
}

}  // namespace anthrob
