// Friction of an eyelet and resistance of a power stage that are known, forgotten, and found again.
#include <gtest/gtest.h>

#include <cmath>

#include "anthrob_core/errors.h"
#include "campaign.h"
#include "identification/ecu_report.h"
#include "identification/eyelet_report.h"
#include "virtual_rig/eyelet_pull.h"
#include "virtual_rig/load_resistor.h"

namespace anthrob {
namespace identification {
namespace {

const std::string kConfig = ANTHROB_CONFIG_DIR;
constexpr double kPulling = 0.170, kRelaxing = 0.141;

EyeletRecording pull(std::uint64_t seed, int specimen, double load, bool pulling) {
  virtual_rig::PullOptions options;
  options.seed = seed;
  options.specimen = specimen;
  options.load = load;
  options.pulling = pulling;
  options.friction = pulling ? kPulling : kRelaxing;
  return EyeletRecording::read(
      virtual_rig::pull_over_eyelet(kConfig + "/rig_eyelet_pull", options));
}

EyeletResult eyelet(std::uint64_t seed, const std::vector<int>& specimens) {
  std::vector<EyeletRecording> recordings;
  for (const int specimen : specimens) {
    for (const double load : virtual_rig::thesis_loads()) {
      for (const bool pulling : {true, false}) {
        recordings.push_back(pull(seed, specimen, load, pulling));
      }
    }
  }
  return identify_eyelet(std::move(recordings));
}

/// Close to the truth, and with as much doubt as there is reason for.
void expect_recovered(const Recovery& recovery) {
  recovery.print();
  EXPECT_LT(recovery.worst, recovery.allowed) << recovery.name;
  EXPECT_LT(recovery.mean_reach(), recovery.allowed) << recovery.name;
  EXPECT_GT(recovery.score(), 0.33) << recovery.name;
  EXPECT_LT(recovery.score(), 2.0) << recovery.name;
  EXPECT_GE(recovery.covered, 0.7 * recovery.count) << recovery.name;
}

TEST(EyeletIdentification, FindsFrictionOfBothDirections) {
  Recovery pulling{"mu_k pulling", kPulling, 0.014}, relaxing{"mu_k relaxing", kRelaxing, 0.014};
  Recovery both{"mu_k", 0.5 * (kPulling + kRelaxing), 0.014};
  for (int seed = 1; seed <= seed_count(4); ++seed) {
    const EyeletResult result = eyelet(static_cast<std::uint64_t>(seed), {1});
    ASSERT_TRUE(result.fit.pulling && result.fit.relaxing && result.fit.offset);
    EXPECT_EQ(result.fitted.size(), 8u);
    pulling.add(*result.fit.pulling);
    relaxing.add(*result.fit.relaxing);
    both.add(result.fit.both);
  }
  for (const Recovery* recovery : {&both, &pulling, &relaxing}) expect_recovered(*recovery);
}

TEST(EyeletIdentification, ValidatesOnTheSecondSpecimen) {
  const EyeletResult result = eyelet(1, {2, 1});
  EXPECT_EQ(result.specimen, 1);
  ASSERT_TRUE(result.validation_error);
  EXPECT_LT(result.fit_error, 0.5);
  EXPECT_LT(*result.validation_error, 2.0);
}

std::vector<SlidingPoint> exact_points(const std::vector<double>& loads, double offset) {
  std::vector<SlidingPoint> points;
  for (const double load : loads) {
    for (const bool pulling : {true, false}) {
      const double mu = pulling ? kPulling : -kRelaxing;
      SlidingPoint point{"", load, 1.5, pulling, {}};
      point.force.value = load * std::exp(mu * 1.5) + offset;
      points.push_back(point);
    }
  }
  return points;
}

TEST(CapstanFit, ExactPointsGiveExactFriction) {
  const auto points = exact_points({20.0, 40.0, 60.0}, 0.8);
  const CapstanFit fit = fit_capstan(points, 0.0);
  EXPECT_NEAR(fit.pulling->value, kPulling, 1e-9);
  EXPECT_NEAR(fit.relaxing->value, kRelaxing, 1e-9);
  EXPECT_NEAR(fit.offset->value, 0.8, 1e-7);
  EXPECT_NEAR(capstan_error(fit, points), 0.0, 1e-7);
  for (const SlidingPoint& point : points) {
    EXPECT_NEAR(capstan_coefficient(point, 0.8), point.pulling ? kPulling : kRelaxing, 1e-12);
  }
}

TEST(CapstanFit, OneLoadCannotTellTheOffset) {
  auto points = exact_points({40.0}, 0.0);
  EXPECT_THROW(fit_capstan(points, 0.0), BadInput);
  points.push_back(points[0]);
  points.push_back(points[1]);
  const CapstanFit fit = fit_capstan(points, 0.0);
  EXPECT_FALSE(fit.offset);
  EXPECT_NEAR(fit.pulling->value, kPulling, 1e-9);
  points = {points[0], points[2]};
  const CapstanFit one_way = fit_capstan(points, 0.0);
  EXPECT_FALSE(one_way.relaxing);
  EXPECT_NEAR(one_way.both.value, kPulling, 1e-9);
}

TEST(CapstanFit, RefusesFrictionThatPullsAlong) {
  auto points = exact_points({20.0, 40.0, 60.0}, 0.0);
  for (SlidingPoint& point : points) point.pulling = !point.pulling;
  EXPECT_THROW(fit_capstan(points, 0.0), BadInput);
}

TEST(CapstanFit, ErrorOfTheAngleWidensTheInterval) {
  const CapstanFit fit = fit_capstan(exact_points({20.0, 40.0, 60.0}, 0.0), 0.03);
  EXPECT_NEAR(fit.pulling->sigma, kPulling * 0.03 / 1.5, 1e-6);
}

std::vector<LoadRecording> ecu(std::uint64_t seed, const std::vector<int>& specimens) {
  std::vector<LoadRecording> recordings;
  for (const int specimen : specimens) {
    for (const double load : {0.33, 0.66}) {
      virtual_rig::EcuLoadOptions options;
      options.seed = seed;
      options.specimen = specimen;
      options.load_resistance = load;
      recordings.push_back(
          LoadRecording::read(virtual_rig::load_ecu(kConfig + "/rig_ecu_load", options)));
    }
  }
  return recordings;
}

TEST(EcuIdentification, FindsTheSeriesResistance) {
  Recovery resistance{"R_ECU", 0.12, 0.01};
  for (int seed = 1; seed <= seed_count(4); ++seed) {
    const EcuResult result = identify_ecu(ecu(static_cast<std::uint64_t>(seed), {1}));
    ASSERT_TRUE(result.fit.gain);
    EXPECT_EQ(result.fitted[0].points.size(), 17u);
    resistance.add(result.fit.resistance);
  }
  expect_recovered(resistance);
}

TEST(EcuIdentification, ValidatesOnTheSecondSpecimen) {
  const EcuResult result = identify_ecu(ecu(1, {1, 2}));
  ASSERT_TRUE(result.validation_error);
  EXPECT_LT(*result.validation_error, 0.2);
  EXPECT_LT(result.fit_error, 0.1);
}

TEST(SeriesResistanceFit, ExactPointsGiveTheExactResistance) {
  std::vector<LoadRecording> recordings(2);
  for (std::size_t k = 0; k < 2; ++k) {
    recordings[k].load_resistance = k == 0 ? 0.3 : 0.6;
    for (double v = -6.0; v <= 6.0; v += 3.0) {
      const double current = v / (recordings[k].load_resistance + 0.12);
      recordings[k].points.push_back({v, 1.02 * (v - 0.12 * current) + 0.05, current});
    }
  }
  const SeriesResistanceFit fit = fit_series_resistance(recordings);
  EXPECT_NEAR(fit.resistance.value, 0.12, 1e-9);
  EXPECT_NEAR(fit.gain->value, 0.02, 1e-9);
  EXPECT_NEAR(fit.offset.value, 0.05, 1e-9);
  // With one load the gain hides in the resistance, and is not claimed.
  const SeriesResistanceFit single = fit_series_resistance({recordings[0]});
  EXPECT_FALSE(single.gain);
  EXPECT_NEAR(single.resistance.value, 0.12 - 0.02 * 0.3, 1e-9);
}

TEST(SeriesResistanceFit, RefusesAResistanceThatIsNotPositive) {
  LoadRecording recording;
  recording.name = "rec";
  recording.load_resistance = 0.3;
  for (double v = -6.0; v <= 6.0; v += 3.0) {
    recording.points.push_back({v, v + 0.1 * v / 0.42, v / 0.42});  // more than it was asked for
  }
  try {
    fit_series_resistance({recording});
    ADD_FAILURE() << "accepted";
  } catch (const BadInput& error) {
    EXPECT_EQ(std::string(error.what()).find("rec: oscilloscope/current: R_ECU would be -0.1"), 0u)
        << error.what();
  }
}

}  // namespace
}  // namespace identification
}  // namespace anthrob
