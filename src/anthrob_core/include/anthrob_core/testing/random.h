#pragma once

#include <random>

#include "anthrob_core/pose.h"

namespace anthrob {
namespace testing_support {

/// Seeded, so that a failure can be seen again.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double lo, double hi) {
    return std::uniform_real_distribution<double>(lo, hi)(engine_);
  }
  int integer(int lo, int hi) { return std::uniform_int_distribution<int>(lo, hi)(engine_); }
  Vec3 vector(double size) {
    return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
  }
  Vec3 direction() {
    for (;;) {
      const Vec3 v = vector(1.0);
      if (v.norm() > 0.1 && v.norm() < 1.0) return v.normalized();
    }
  }
  Quat rotation() { return Quat(Eigen::AngleAxisd(uniform(-3.14, 3.14), direction())); }
  Pose pose(double size) { return {rotation().toRotationMatrix(), vector(size)}; }

 private:
  std::mt19937_64 engine_;
};

}  // namespace testing_support
}  // namespace anthrob
