#include "anthrob_recording/resolution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "anthrob_core/random.h"

namespace anthrob {
namespace {

TEST(Resolution, IsOneCountOfASensorAndNothingOfContinuousValues) {
  const CounterRandom random(6, 1);
  std::vector<double> counts, printed, fine;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    const double value = 0.5 * std::sin(0.01 * static_cast<double>(i)) + 0.002 * random.normal(i);
    counts.push_back(0.0061 * std::round(value / 0.0061));
    printed.push_back(1e-6 * std::round(1e6 * counts.back() * M_PI));
    fine.push_back(value);
  }
  EXPECT_NEAR(resolution_of(counts), 0.0061, 1e-9);
  EXPECT_NEAR(resolution_of(printed), 0.0061 * M_PI, 2e-6);
  EXPECT_EQ(resolution_of(fine), 0.0);
  EXPECT_EQ(resolution_of(std::vector<double>(100, 1.0)), 0.0);
}

TEST(Resolution, OfSensorsThatHardlyMoved) {
  std::vector<double> two(100, 0.5);
  std::fill_n(two.begin(), 30, 0.4);
  EXPECT_NEAR(resolution_of(two), 0.1, 1e-12);
  EXPECT_EQ(resolution_of(std::vector<double>(100, 0.5)), 0.0);
  EXPECT_EQ(resolution_of({0.5, 0.4}), 0.0);
  two[7] = NAN;  // not measured
  EXPECT_NEAR(resolution_of(two), 0.1, 1e-12);
}

TEST(StepOfDigits, IsWhatPrintingRounds) {
  const CounterRandom random(8, 1);
  std::vector<double> exact;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    exact.push_back(6.0 * std::sin(0.01 * static_cast<double>(i)) + 0.01 * random.normal(i));
  }
  for (const int digits : {3, 4, 6, 7}) {
    std::vector<double> printed;
    double squares = 0.0;
    for (const double value : exact) {
      char text[32];
      std::snprintf(text, sizeof(text), "%.*g", digits, value);
      printed.push_back(std::strtod(text, nullptr));
      squares += std::pow(printed.back() - value, 2);
    }
    const double error = std::sqrt(squares / static_cast<double>(exact.size()));
    EXPECT_NEAR(step_of_digits(printed) / std::sqrt(12.0), error, 0.05 * error) << digits;
    printed[5] = NAN, printed[6] = 0.0;
    EXPECT_GT(step_of_digits(printed), 0.0);
    printed.resize(50);
    EXPECT_EQ(step_of_digits(printed), 0.0);
  }
  EXPECT_EQ(step_of_digits(exact), 0.0);
}

TEST(WhiteNoise, IsThatOnASmoothSeries) {
  const CounterRandom random(7, 1);
  Eigen::VectorXf series(4000);
  for (Eigen::Index i = 0; i < series.size(); ++i) {
    series[i] = static_cast<float>(std::sin(0.01 * static_cast<double>(i)) +
                                   0.02 * random.normal(static_cast<std::uint64_t>(i)));
  }
  EXPECT_NEAR(white_noise(series), 0.02, 0.002);
  EXPECT_EQ(white_noise(Eigen::VectorXf::Zero(3)), 0.0);
}

}  // namespace
}  // namespace anthrob
