// What a unit that lets no force fall below zero makes of noise.
#include "experiment/cut_off_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace anthrob {
namespace discovery {
namespace {

/// A force that pulls for a second and lets go for one, and again, as it is measured.
/// @param noise, memory [N], [s]   @param quantum [N]
Series readings(double noise, double memory, double quantum, double pull, bool cut_off) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const double step = 0.002, keep = memory > 0.0 ? std::exp(-step / memory) : 0.0;
  double drift = 0.0;
  Series series;
  for (int i = 0; i < 10000; ++i) {
    drift = keep * drift + std::sqrt(1.0 - keep * keep) * noise * normal(random);
    const double truth = i / 500 % 2 ? pull : 0.0;
    const double value = quantum * std::round((truth + drift) / quantum);
    series.t.push_back(step * i);
    series.values.push_back(cut_off ? std::max(value, 0.0) : value);
  }
  return series;
}

TEST(CutOffNoise, MeanIsThatOfNoiseThatIsCutOff) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  for (const double value : {-0.5, 0.0, 0.2, 1.0, 3.0}) {
    double sum = 0.0;
    constexpr int kDraws = 200000;
    for (int i = 0; i < kDraws; ++i) sum += std::max(value + 0.3 * normal(random), 0.0) / kDraws;
    EXPECT_NEAR(mean_above_zero(value, 0.3), sum, 0.003) << value;
  }
  EXPECT_NEAR(mean_above_zero(0.0, 0.3), 0.3 / std::sqrt(2.0 * M_PI), 1e-12);
  EXPECT_NEAR(mean_above_zero(50.0, 0.3), 50.0, 1e-12);
  EXPECT_EQ(mean_above_zero(-1.0, 0.0), 0.0);
}

TEST(CutOffNoise, IsFoundWhereTendonsAreSlack) {
  EXPECT_NEAR(cut_off_noise(readings(0.3, 0.0, 0.001, 20.0, true), 0.001, {}), 0.3, 0.02);
  EXPECT_NEAR(cut_off_noise(readings(0.3, 0.0, 0.06, 20.0, true), 0.06, {}), 0.3, 0.03);
  EXPECT_NEAR(cut_off_noise(readings(0.3, 0.01, 0.06, 20.0, true), 0.06, {}), 0.3, 0.06);
}

TEST(CutOffNoise, IsNoneWhereNothingIsCutOff) {
  EXPECT_EQ(cut_off_noise(readings(0.3, 0.0, 0.001, 20.0, false), 0.001, {}), 0.0);
  EXPECT_EQ(cut_off_noise(readings(0.0, 0.0, 0.001, 20.0, true), 0.001, {}), 0.0);  // no noise
  Series pulled = readings(0.3, 0.0, 0.001, 20.0, true);
  for (double& value : pulled.values) value += 10.0;
  EXPECT_EQ(cut_off_noise(pulled, 0.001, {}), 0.0);
  // A force that comes and goes within the windows is no noise.
  for (std::size_t i = 0; i < pulled.t.size(); ++i) pulled.values[i] = i / 50 % 2 ? 5.0 : 0.0;
  EXPECT_EQ(cut_off_noise(pulled, 0.001, {}), 0.0);
  EXPECT_EQ(cut_off_noise({}, 0.0, {}), 0.0);
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
