#include "watch/encoder_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>
#include <random>

#include "watch/period.h"

namespace anthrob {
namespace driver {
namespace {

constexpr double kR = 0.79, kK = 0.0115 * 128.0;    // Anthrob's type_1
constexpr double kAmpere = 0.01, kStep = 9.587e-5;  // what the bus and the encoder resolve

/// A motor by its electrical equation.
struct Moment {
  double voltage, speed;  ///< [V], [rad/s] at the gear output
};

struct Course {
  std::function<Moment(double)> motor;
  std::function<double(double)> counted = [](double position) { return position; };
  double resistance = kR;  ///< the true one
  double noise = 0.0;      ///< [A] of the current's measurement
};

/// What the watch says within 3 s; `when` it did.
std::optional<std::string> watch(const Course& course, double* when = nullptr) {
  EncoderWatch encoder(kR, kK);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  double position = 0.0;
  for (double t = 0.0; t < 3.0; t += kPeriod) {
    const Moment m = course.motor(t);
    position += m.speed * kPeriod;
    const double current = (m.voltage - kK * m.speed) / course.resistance;
    const double read = kAmpere * std::round((current + course.noise * normal(random)) / kAmpere);
    const double seen = kStep * std::floor(course.counted(position) / kStep);
    const auto wrong = encoder.step(seen, m.voltage, read, t);
    if (!wrong) continue;
    if (when != nullptr) *when = t;
    return wrong;
  }
  return std::nullopt;
}

double stuck(double) {
  return 0.3;
}
double flickers(double position) {
  return 0.3 + (std::fmod(position, 0.01) > 0.005 ? kStep : 0.0);
}
Moment runs(double) {
  return {2.0, 1.0};
}

TEST(EncoderWatch, AMotorThatTurnsUncountedIsFoundWithinAFifthOfASecond) {
  double when = 0.0;
  EXPECT_EQ(watch({runs, stuck}, &when),
            "at 2.0 V and 0.67 A its motor must have turned by 0.20 rad, but the encoder counted "
            "0.000 rad");
  EXPECT_NEAR(when, EncoderWatch::kLasts, 2.0 * kPeriod);
  EXPECT_NE(watch({runs, flickers}), std::nullopt);
  EXPECT_NE(watch({[](double) { return Moment{-2.0, -1.0}; }, stuck}), std::nullopt);
}

// POSITION control would run away with it.
TEST(EncoderWatch, AnEncoderThatCountsBackwardsIsFound) {
  const auto backwards = [](double position) { return -position; };
  double when = 0.0;
  EXPECT_EQ(watch({runs, backwards}, &when),
            "at 2.0 V and 0.67 A its motor must have turned by 0.20 rad, but the encoder counted "
            "-0.200 rad");
  EXPECT_NEAR(when, EncoderWatch::kLasts, 2.0 * kPeriod);
  EXPECT_NE(watch({[](double) { return Moment{-2.0, -1.0}; }, backwards}), std::nullopt);
}

TEST(EncoderWatch, AnEncoderThatDiesInMotionIsFound) {
  double when = 0.0;
  EXPECT_NE(watch({runs, [](double position) { return std::min(position, 1.0); }}, &when),
            std::nullopt);
  EXPECT_GT(when, 1.0);
  EXPECT_LT(when, 1.0 + 2.5 * EncoderWatch::kLasts);
}

TEST(EncoderWatch, AMotorThatStandsIsNone) {
  for (const double voltage : {0.5, 2.0, 12.0, -6.0}) {
    const auto held = [voltage](double) { return Moment{voltage, 0.0}; };
    EXPECT_EQ(watch({held, stuck}), std::nullopt) << voltage;
    EXPECT_EQ(watch({held, stuck, 1.4 * kR}), std::nullopt) << "hot, " << voltage;
    EXPECT_EQ(watch({held, stuck, 0.8 * kR}), std::nullopt) << "cold, " << voltage;
    EXPECT_EQ(watch({held, stuck, kR, 0.1}), std::nullopt) << "noise, " << voltage;
  }
}

TEST(EncoderWatch, AMotorThatIsCountedIsNone) {
  EXPECT_EQ(watch({runs}), std::nullopt);
  // Free, hot, with noise; to and fro; driven by its tendon against the voltage.
  EXPECT_EQ(watch({[](double) {
                     return Moment{12.0, 8.0};
                   },
                   Course{}.counted, 1.4 * kR, 0.1}),
            std::nullopt);
  EXPECT_EQ(watch({[](double t) {
              return Moment{12.0 * std::sin(20.0 * t), 7.0 * std::sin(20.0 * t - 0.3)};
            }}),
            std::nullopt);
  EXPECT_EQ(watch({[](double) { return Moment{1.0, -3.0}; }}), std::nullopt);
}

TEST(EncoderWatch, AGapInTheMeasurementsIsNoMotion) {
  EncoderWatch encoder(kR, kK);
  for (double t = 0.0; t < 0.15; t += kPeriod)
    EXPECT_EQ(encoder.step(0.0, 2.0, 0.67, t), std::nullopt);
  EXPECT_EQ(encoder.step(0.0, 2.0, 0.67, 0.3), std::nullopt);
  encoder.restart();
  EXPECT_EQ(encoder.step(0.0, 2.0, 0.67, 0.36), std::nullopt);
}

TEST(EncoderWatch, AMotorThatIsNotKnownIsNotWatched) {
  EncoderWatch encoder(0.0, 0.0);
  for (double t = 0.0; t < 1.0; t += kPeriod)
    EXPECT_EQ(encoder.step(0.0, 12.0, 0.0, t), std::nullopt);
}

}  // namespace
}  // namespace driver
}  // namespace anthrob
