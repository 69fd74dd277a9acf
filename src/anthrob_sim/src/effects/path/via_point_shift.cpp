#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/effects/placed_effects.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "via_point_shift";
  i.name = "Shifted path point";
  i.description =
      "An eyelet, origin or insertion is not where the model has it: length and moment arm of one "
      "muscle are wrong by an amount that depends on posture.";
  i.equation = "p' = p + shift e, e an axis of the point's link";
  i.source = "known; tables C.6, C.7 of the thesis are measured by hand";
  i.where = "MUSCLE/k/x | MUSCLE/k/y | MUSCLE/k/z (k-th entry of the path, origin 0)";
  i.seam = Seam::kPath;
  i.stage = Stage::kNumbers;
  i.channels = {"joint", "force", "position"};
  i.parameters = {{"shift", "m", "along the axis", 0.0, 0.003, {-0.03, 0.03}}};
  return i;
}

class ViaPointShift final : public Effect {
 public:
  ViaPointShift() : Effect(describe()) {}

  std::vector<std::string> places(const RobotModel& robot) const override {
    std::vector<std::string> list;
    for (const MuscleModel& muscle : robot.muscles) {
      for (const PathObstacle& obstacle : muscle.path->obstacles()) {
        if (obstacle.surface || obstacle.entry < 0) continue;
        for (const char* axis : {"/x", "/y", "/z"}) {
          list.push_back(muscle.name + "/" + std::to_string(obstacle.entry) + axis);
        }
      }
    }
    return list;
  }

  void build_in(const EffectSetting& setting, ModelDraft& draft) const override {
    const std::vector<std::string> place = split_place(setting.place());
    MuscleModel& muscle = draft.robot.muscles[draft.robot.find_muscle(place[0])];
    std::vector<PathObstacle> obstacles = muscle.path->obstacles();
    for (PathObstacle& obstacle : obstacles) {
      if (std::to_string(obstacle.entry) != place[1]) continue;
      obstacle.point_B += obstacle.R_BL * (setting["shift"] * Vec3::Unit(place[2][0] - 'x'));
    }
    muscle.path = std::make_shared<PathModel>(draft.skeleton, std::move(obstacles));
  }
};

const EffectRegistration kRegistration(std::make_unique<ViaPointShift>());

}  // namespace
}  // namespace anthrob
