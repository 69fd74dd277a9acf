#pragma once

#include <memory>
#include <vector>

#include "anthrob_sim/path/wrapping_surface.h"

namespace anthrob {
namespace testing_support {

/// A surface with its memory.
class Tendon {
 public:
  explicit Tendon(std::shared_ptr<const WrappingSurface> surface)
      : surface_(std::move(surface)), memory_(surface_->state_size(), 0.0) {}

  const WrapContact& start(const Vec3& p1, const Vec3& p2) {
    surface_->initialise(p1, p2, state());
    return move(p1, p2);
  }
  const WrapContact& move(const Vec3& p1, const Vec3& p2) {
    surface_->wrap(p1, p2, state(), contact_);
    return contact_;
  }
  double length() const { return contact_.length_in + contact_.length_on + contact_.length_out; }
  const WrapContact& contact() const { return contact_; }
  StateView state() { return StateView(memory_.data()); }

 private:
  std::shared_ptr<const WrappingSurface> surface_;
  std::vector<double> memory_;
  WrapContact contact_;
};

}  // namespace testing_support
}  // namespace anthrob
