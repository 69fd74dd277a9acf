#include "anthrob_sim/effects/catalogue.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "payload";
  i.name = "Unmodelled mass";
  i.description =
      "A point mass fixed to a body. If negative, mass that the model has and the robot does not. "
      "Weight, centre of mass and inertia change together. At rest it shows as sine and cosine "
      "of posture, in motion it grows with acceleration.";
  i.equation = "m' = m + mass, centre of mass and inertia as of both together";
  i.source = "rigid body mechanics";
  i.where = "BODY";
  i.seam = Seam::kSkeleton;
  i.stage = Stage::kSkeleton;
  i.channels = {"joint", "force"};
  i.parameters = {
      {"mass", "kg", "of the payload", 0.0, 0.1, {-1e4, 1e4}},
      {"x",
       "m",
       "from the body's centre of mass, axes of its link",
       0.0,
       0.02,
       {-1.0, 1.0},
       EffectParameter::kShape},
      {"y", "m", "the same", 0.0, 0.02, {-1.0, 1.0}, EffectParameter::kShape},
      {"z", "m", "the same", 0.0, 0.02, {-1.0, 1.0}, EffectParameter::kShape},
  };
  return i;
}

class Payload final : public Effect {
 public:
  Payload() : Effect(describe()) {}

  std::vector<std::string> places(const RobotModel& robot) const override {
    std::vector<std::string> list;
    for (const BodyModel& body : robot.skeleton->bodies) {
      if (body.mass > 0.0) list.push_back(body.name);
    }
    return list;
  }

  void build_in(const EffectSetting& setting, ModelDraft& draft) const override {
    for (BodyModel& body : draft.skeleton.bodies) {
      if (body.mass > 0.0 && body.name == setting.place()) add(setting, body);
    }
  }

 private:
  static void add(const EffectSetting& setting, BodyModel& body) {
    const double mass = setting["mass"];
    const Vec3 d(setting["x"], setting["y"], setting["z"]);
    const double total = body.mass + mass;
    if (!(total > 0.0)) setting.fail("mass", "a number for which the body keeps a mass > 0 [kg]");
    // About the common centre of mass, by the reduced mass (Steiner).
    const double reduced = body.mass * mass / total;
    body.inertia_L += reduced * (d.squaredNorm() * Mat3::Identity() - d * d.transpose());
    body.com_L += mass / total * d;
    body.mass = total;
    if (!body.find_principal_axes()) {
      setting.fail(
          "mass",
          "a number for which the body keeps principal moments of inertia > 0, none larger "
          "than the other two together [kg]");
    }
  }
};

const EffectRegistration kRegistration(std::make_unique<Payload>());

}  // namespace
}  // namespace anthrob
