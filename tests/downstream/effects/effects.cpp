// Effects as another laboratory would write them: on a spring, and where tendons slide.
#include "anthrob_sim/effects/friction_effect.h"
#include "anthrob_sim/effects/spring_effect.h"

namespace {

using namespace anthrob;

/// A rubber cord beside the spring: f = stiffness stretch.
class Cord final : public ParallelForce {
 public:
  Cord(std::shared_ptr<const SeriesElasticElement> inner, double stiffness, double step)
      : ParallelForce(std::move(inner), 0, step), stiffness_(stiffness) {}

 private:
  void settle(double, StateView) const override {}
  double force(double, double to, StateView) const override { return stiffness_ * to; }
  double settled_force(double stretch) const override { return stiffness_ * stretch; }
  double energy(double stretch, StateView) const override {
    return 0.5 * stiffness_ * stretch * stretch;
  }
  double heat(double, double, StateView) const override { return 0.0; }

  double stiffness_;
};

EffectInfo cord() {
  EffectInfo info;
  info.id = "downstream_cord";
  info.name = "Cord beside the spring";
  info.where = "MUSCLE | all";
  info.seam = Seam::kSpring;
  info.channels = {"force"};
  info.parameters = {{"stiffness", "N/m", "of the cord", 0.0, 200.0, Bounds::nonnegative()}};
  return info;
}

class CordEffect final : public SpringEffect {
 public:
  CordEffect() : SpringEffect(cord()) {}

 private:
  std::shared_ptr<const SeriesElasticElement> wrap(const EffectSetting& setting,
                                                   const MuscleModel& muscle,
                                                   double step) const override {
    return std::make_shared<Cord>(muscle.spring, setting["stiffness"], step);
  }
};

EffectInfo dirt() {
  EffectInfo info;
  info.id = "downstream_dirt";
  info.name = "Dirt in eyelets";
  info.where = "MUSCLE/k | MUSCLE | all";
  info.seam = Seam::kPath;
  info.stage = Stage::kParts;
  info.dissipates = true;
  info.channels = {"force"};
  info.parameters = friction_parameters(0.02);
  return info;
}

class DirtEffect final : public SlidingFrictionEffect {
 public:
  DirtEffect() : SlidingFrictionEffect(dirt()) {}

 private:
  bool fits(const PathObstacle& obstacle, bool inner) const override {
    return inner && !obstacle.surface;
  }
};

const EffectRegistration kCord(std::make_unique<CordEffect>());
const EffectRegistration kDirt(std::make_unique<DirtEffect>());

}  // namespace
