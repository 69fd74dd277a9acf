#pragma once

#include <cmath>
#include <memory>

#include "experiment/experiment.h"
#include "experiment/measured_variable.h"

namespace anthrob {
namespace discovery {
namespace testing_support {

constexpr std::size_t kBins = 2000;

/// One channel of a joint that swings to and fro, 40 s; after one of a muscle, if that was
/// measured.
class Swing final : public Experiment {
 public:
  explicit Swing(bool with_muscle = false) {
    bin_ = 0.02;
    duration_ = 0.02 * kBins;
    if (with_muscle) channels_ = {{"flexor", "force", "N", 0, 0, kBins, 0.0}};
    channels_.push_back({"hinge", "position", "rad", 0, with_muscle ? kBins : 0, kBins, 0.0});
    present_.assign(kBins * channels_.size(), 1);
  }
  void compare(const std::shared_ptr<const RobotModel>&, const Starts&, float*) const override {}
};

inline double speed_at(std::size_t bin) {
  return std::sin(0.9 * static_cast<double>(bin));
}

inline MeasuredVariable speed() {
  MeasuredVariable variable{"hinge/position", "speed", {{}}, false, "rad/s"};
  for (std::size_t b = 0; b < kBins; ++b) variable.values[0].push_back(speed_at(b));
  return variable;
}

}  // namespace testing_support
}  // namespace discovery
}  // namespace anthrob
