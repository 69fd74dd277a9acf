#include <cmath>

#include "anthrob_sim/effects/spring_effect.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "second_maxwell_arm";
  i.name = "Second relaxation of the spring (Maxwell arm)";
  i.description =
      "Rubber relaxes over more than one decade of time: another spring and dashpot in series act "
      "in parallel to the element. After a step of length, two time constants show.";
  i.equation =
      "f = f_model + q, dq/dt + q / relaxation_time = ratio k dl_S/dt, k the stiffness "
      "of the element at rest";
  i.source = "thesis (4.57)-(4.59), Table C.5";
  i.where = "MUSCLE | all";
  i.seam = Seam::kSpring;
  i.dissipates = true;
  i.slow = true;
  i.channels = {"force", "joint"};
  i.parameters = {
      {"ratio", "1", "stiffness of the arm over that of the element", 0.0, 0.12, {0.0, 3.0}},
      {"relaxation_time", "s", "of the arm", 10.0, 10.0, {0.005, 1000.0}, EffectParameter::kShape},
  };
  return i;
}

class MaxwellArmBeside final : public ParallelForce {
 public:
  MaxwellArmBeside(std::shared_ptr<const SeriesElasticElement> inner, double stiffness, double time,
                   double step)
      : ParallelForce(std::move(inner), 1, step),
        stiffness_(stiffness),
        time_(time),
        keep_(std::exp(-step / time)),
        gain_(-stiffness * std::expm1(-step / time) * time / step) {}

 private:
  void settle(double, StateView own) const override { own[0] = 0.0; }
  double force(double from, double to, StateView own) const override {
    return own[0] = keep_ * own[0] + gain_ * (to - from);
  }
  double settled_force(double) const override { return 0.0; }
  double energy(double, StateView own) const override { return 0.5 * own[0] * own[0] / stiffness_; }
  double heat(double, double, StateView own) const override {
    return own[0] * own[0] / (stiffness_ * time_);
  }

  double stiffness_, time_, keep_, gain_;
};

class SecondMaxwellArm final : public SpringEffect {
 public:
  SecondMaxwellArm() : SpringEffect(describe()) {}

 protected:
  std::shared_ptr<const SeriesElasticElement> wrap(const EffectSetting& setting,
                                                   const MuscleModel& muscle,
                                                   double step) const override {
    return std::make_shared<MaxwellArmBeside>(muscle.spring,
                                              setting["ratio"] * working_stiffness(*muscle.spring),
                                              setting["relaxation_time"], step);
  }
};

const EffectRegistration kRegistration(std::make_unique<SecondMaxwellArm>());

}  // namespace
}  // namespace anthrob
