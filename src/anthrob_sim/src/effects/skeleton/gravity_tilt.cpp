#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/effects/placed_effects.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "gravity_tilt";
  i.name = "Tilted base";
  i.description =
      "The base is tilted about a horizontal axis of the world, while the model assumes that it is "
      "level: gravity has another direction. One common rotation explains the static errors of all "
      "joints.";
  i.equation = "g = R(axis, -angle) g_model";
  i.source = "known";
  i.where = "x | y | z (axes that turn gravity)";
  i.seam = Seam::kSkeleton;
  i.stage = Stage::kSkeleton;
  i.channels = {"joint", "force"};
  i.parameters = {
      {"angle", "rad", "by which the base is turned about the axis", 0.0, 0.03, {-0.5, 0.5}}};
  return i;
}

class GravityTilt final : public WorldAxisEffect {
 public:
  GravityTilt() : WorldAxisEffect(describe()) {}

  void build_in(const EffectSetting& setting, ModelDraft& draft) const override {
    draft.robot.gravity =
        Eigen::AngleAxisd(-setting["angle"], axis_of(setting.place())) * draft.robot.gravity;
  }

 protected:
  bool fits(const RobotModel& robot, const Vec3& axis) const override {
    return axis.cross(robot.gravity).norm() > 1e-9;
  }
};

const EffectRegistration kRegistration(std::make_unique<GravityTilt>());

}  // namespace
}  // namespace anthrob
