#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "fit/model_fit.h"

namespace anthrob {
namespace discovery {

/// Steps along single unknowns, which tell how the residual changes with them.
class SlopeSteps {
 public:
  SlopeSteps(const Fitted& fitted, const SlopeOptions& options)
      : fitted_(fitted), smooth_(options.smooth) {}

  /// A step to one side; to the other one if there is no room on the first.
  /// @param length [scales], shorter at bounds
  void add_one_side(std::size_t unknown, double length);
  void add_both_sides(std::size_t unknown, double length);
  const std::vector<Variant>& variants() const { return variants_; }

  /// Takes slopes, and curvatures of ordinary parameters, from what the steps change. A slope to
  /// one side is freed from the curvature, if that is known; one to both sides shows the curvature.
  /// @param changes of the residual with each of the variants; empty where it cannot be simulated
  void take_slopes(const std::vector<Eigen::VectorXf>& changes, Fitted& fitted) const;

 private:
  /// Where the steps along one unknown are.
  struct Along {
    std::size_t unknown, first, count;
  };
  void add(std::size_t unknown, double length);

  const Fitted& fitted_;
  double smooth_;
  std::vector<Along> unknowns_;
  std::vector<Variant> variants_;
  std::vector<float> lengths_;  ///< [scales], with their signs
};

}  // namespace discovery
}  // namespace anthrob
