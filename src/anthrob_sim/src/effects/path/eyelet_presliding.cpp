#include <cmath>

#include "anthrob_sim/effects/friction_effect.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "eyelet_presliding";
  i.name = "Presliding in eyelets";
  i.description =
      "After a reversal a tendon bends the fibres it rests on before it slides: friction depends "
      "on the displacement since the reversal instead of the sign of the speed, keeps its value at "
      "rest, and forms a small hysteresis loop at each reversal. Dahl's model on the Stribeck "
      "curve of the friction law at that place.";
  i.equation = "mu = level(|v|) z, dz/dx = (1 - sign(v) z) / distance";
  i.source = "Dahl 1968; thesis (4.70)-(4.74)";
  i.where = "MUSCLE/k | MUSCLE | all";
  i.seam = Seam::kPath;
  i.stage = Stage::kComponents;
  i.channels = {"force", "joint", "current"};
  i.parameters = {{"distance",
                   "m",
                   "tendon travel after which 63 % of friction is back",
                   0.0,
                   3e-4,
                   {0.0, 0.01}}};
  return i;
}

class Dahl final : public FrictionLaw {
 public:
  Dahl(std::shared_ptr<const FrictionLaw> law, double distance, double step)
      : law_(std::move(law)), distance_(distance), step_(step) {}

  std::size_t state_size() const override { return 1; }
  Value evaluate(double v, StateView state) const override {
    const double level = law_->sliding_coefficient(std::abs(v));
    const double side = v < 0.0 ? -1.0 : 1.0;
    const double left = std::exp(-std::abs(v) * step_ / distance_);
    return {level * bristle(v, state[0]),
            level * (1.0 - side * state[0]) * left * step_ / distance_};
  }
  double sliding_coefficient(double speed) const override {
    return law_->sliding_coefficient(speed);
  }
  void commit(double v, StateView state) const override { state[0] = bristle(v, state[0]); }

  const std::shared_ptr<const FrictionLaw>& law() const { return law_; }
  double distance() const { return distance_; }

 private:
  /// z after a step with speed v.
  double bristle(double v, double z) const {
    const double side = v < 0.0 ? -1.0 : 1.0;
    return side + (z - side) * std::exp(-std::abs(v) * step_ / distance_);
  }

  std::shared_ptr<const FrictionLaw> law_;
  double distance_, step_;
};

class EyeletPresliding final : public PathEffect {
 public:
  EyeletPresliding() : PathEffect(describe()) {}

 protected:
  bool fits(const PathObstacle& obstacle, bool inner) const override {
    return inner && !obstacle.surface && obstacle.friction;
  }
  void change(const EffectSetting& setting, const RobotModel& robot,
              PathObstacle& obstacle) const override {
    // Fibres on fibres bend one after the other: one law, and the distances add up.
    const auto there = std::dynamic_pointer_cast<const Dahl>(obstacle.friction);
    obstacle.friction =
        std::make_shared<Dahl>(there ? there->law() : obstacle.friction,
                               setting["distance"] + (there ? there->distance() : 0.0), robot.step);
  }
};

const EffectRegistration kRegistration(std::make_unique<EyeletPresliding>());

}  // namespace
}  // namespace anthrob
