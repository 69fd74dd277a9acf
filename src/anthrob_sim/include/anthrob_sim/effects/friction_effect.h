#pragma once

#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/effects/placed_effects.h"
#include "anthrob_sim/friction/friction_law.h"

namespace anthrob {

/// Adds friction to a law: scales its curve so that the kinetic coefficient grows by `mu`. Without
/// friction so far, returns the thesis's law (4.75) with its ratio of coefficients. A law without
/// kinetic friction has nothing to scale: the thesis's law acts beside it.
/// @param law may be null: no friction
/// @param mu added kinetic coefficient [1]
/// @param rest_ratio static over kinetic coefficient of the added friction, relative to the law's
/// [1]
std::shared_ptr<const FrictionLaw> raise_friction(const std::shared_ptr<const FrictionLaw>& law,
                                                  double mu, double rest_ratio);

/// Its parameters. @param typical kinetic coefficient
std::vector<EffectParameter> friction_parameters(double typical);

/// MUSCLE/k | MUSCLE | all: more friction where tendons slide.
class SlidingFrictionEffect : public PathEffect {
 public:
  using PathEffect::PathEffect;

 protected:
  void change(const EffectSetting& setting, const RobotModel&,
              PathObstacle& obstacle) const override {
    obstacle.friction = raise_friction(obstacle.friction, setting["mu"], setting["rest_ratio"]);
  }
};

}  // namespace anthrob
