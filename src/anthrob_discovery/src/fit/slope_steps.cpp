#include "fit/slope_steps.h"

#include <cmath>
#include <memory>
#include <utility>

namespace anthrob {
namespace discovery {

namespace {

/// Curvature of the residual between two sides; null if that is not smooth, or if the sides are not
/// equally long because of a bound.
std::shared_ptr<const Eigen::VectorXf> smooth_curvature(const Eigen::VectorXf& one, float length,
                                                        const Eigen::VectorXf& other,
                                                        float other_length, float smooth) {
  if (std::abs(length + other_length) > 1e-3f * std::abs(length)) return nullptr;
  const Eigen::VectorXf sum = one + other;
  if (!(sum.norm() < smooth * (one.norm() + other.norm()))) return nullptr;
  return std::make_shared<const Eigen::VectorXf>(sum / (2.0f * length * length));
}

}  // namespace

void SlopeSteps::add(std::size_t unknown, double length) {
  const Unknown& u = fitted_.unknowns[unknown];
  Variant variant = fitted_.variant;
  const double value = u.read(variant);
  u.write(value + length * u.scale, variant);
  lengths_.push_back(static_cast<float>((u.read(variant) - value) / u.scale));
  variants_.push_back(std::move(variant));
}

void SlopeSteps::add_one_side(std::size_t unknown, double length) {
  const Unknown& u = fitted_.unknowns[unknown];
  const bool room = u.read(fitted_.variant) + length * u.scale <= u.upper;
  unknowns_.push_back({unknown, variants_.size(), 1});
  add(unknown, room ? length : -length);
}

void SlopeSteps::add_both_sides(std::size_t unknown, double length) {
  unknowns_.push_back({unknown, variants_.size(), 2});
  add(unknown, length);
  add(unknown, -length);
}

void SlopeSteps::take_slopes(const std::vector<Eigen::VectorXf>& changes, Fitted& fitted) const {
  fitted.curvatures.resize(fitted.unknowns.size());
  for (const auto& [unknown, first, count] : unknowns_) {
    auto column = fitted.sensitivity.col(static_cast<Eigen::Index>(unknown));
    column.setZero();
    float length = 0.0f;
    std::size_t simulated = 0;
    for (std::size_t k = first; k < first + count; ++k) {
      if (lengths_[k] == 0.0f || changes[k].size() == 0) continue;
      column += lengths_[k] > 0.0f ? changes[k] : -changes[k];
      length += std::abs(lengths_[k]);
      ++simulated;
    }
    if (simulated == 0) continue;
    column /= length;
    auto& curvature = fitted.curvatures[unknown];
    if (count == 1) {
      if (curvature) column -= lengths_[first] * *curvature;
    } else if (simulated == 2 && fitted.unknowns[unknown].effect < 0) {
      curvature = smooth_curvature(changes[first], lengths_[first], changes[first + 1],
                                   lengths_[first + 1], static_cast<float>(smooth_));
    }
  }
}

}  // namespace discovery
}  // namespace anthrob
