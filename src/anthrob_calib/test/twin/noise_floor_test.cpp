#include "twin/noise_floor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "anthrob_core/random.h"

namespace anthrob {
namespace twin {
namespace {

/// Noise of this size on a slow sine of another.
double found(double noise, double sine, int bins) {
  const CounterRandom random(3);
  NoiseFloor floor((TwinOptions()));
  for (int i = 0; i < bins; ++i) {
    floor.add(sine * std::sin(0.05 * i) + noise * random.normal(static_cast<std::uint64_t>(i)));
  }
  floor.update();
  return floor.sigma();
}

TEST(NoiseFloor, IsTheNoiseAlone) {
  EXPECT_NEAR(found(0.1, 0.0, 3000), 0.1, 0.005);
  EXPECT_NEAR(found(0.1, 5.0, 3000), 0.1, 0.005);
  EXPECT_LT(found(0.0, 5.0, 3000), 0.001);
}

TEST(NoiseFloor, NeedsEnough) {
  EXPECT_TRUE(std::isnan(found(0.1, 0.0, TwinOptions{}.least_noise + 2)));
  EXPECT_TRUE(std::isfinite(found(0.1, 0.0, TwinOptions{}.least_noise + 3)));
}

TEST(NoiseFloor, NotAcrossWhatIsMissing) {
  NoiseFloor floor((TwinOptions()));
  for (int i = 0; i < 4000; ++i) floor.add(i % 4 == 3 ? std::nan("") : 100.0 * (i % 3));
  floor.update();
  EXPECT_TRUE(std::isnan(floor.sigma()));  // never four in a row
}

}  // namespace
}  // namespace twin
}  // namespace anthrob
