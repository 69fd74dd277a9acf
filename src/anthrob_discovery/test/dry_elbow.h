#pragma once

#include "made_problem.h"

namespace anthrob {
namespace discovery {

/// A robot whose elbow may have dry friction, and what that leaves; nothing else is free.
struct DryElbow : MadeProblem {
  explicit DryElbow(const std::function<double(double dry)>& left)
      : DryElbow([left](double, double, double dry) { return left(dry); }, 0) {}

  Fitted with(double torque) const {
    Variant variant;
    variant.effects = {candidates[index("elbow", "joint_coulomb")].neutral()};
    variant.effects[0].parameters["torque"] = torque;
    Unknown u;
    u.effect = 0;
    u.parameter = "torque";
    u.upper = 10.0;
    u.scale = 0.1;
    u.finest = 0.01;
    u.neutral = 0.0;
    return train.start(variant, {u});
  }
  static double torque(const Fitted& fitted) { return fitted.unknowns[0].read(fitted.variant); }

 private:
  static constexpr std::size_t kBins = 100;

  DryElbow(const MadeExperiment::Law& law, int)
      : MadeProblem({}, std::make_shared<MadeExperiment>(law, law, kBins, 1),
                    std::make_shared<MadeExperiment>(law, law, kBins, 2), {"joint_coulomb"}) {}
};

}  // namespace discovery
}  // namespace anthrob
