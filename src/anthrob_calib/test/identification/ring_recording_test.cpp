// Tests of a ring as others take them: one alone, or a staircase without recoveries.
#include "identification/ring_recording.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "anthrob_core/errors.h"
#include "identification/ring_identification.h"
#include "identification/ring_remarks.h"
#include "identification/ring_report.h"

namespace anthrob {
namespace identification {
namespace {

/// A Zener ring that is wound to strains and held there. Its equation is integrated in small
/// steps: E_0 e + s, ds/dt = E_1 de/dt - s / tau.
struct Staircase {
  double e0 = 0.7e6, e1 = 0.2e6, tau = 1.3;  // [Pa, Pa, s]
  double rest = 0.010, section = 0.005, radius = 0.0129;
  double start = 0.0111;       // [m] inner length at position zero
  double said_start = 0.0111;  // [m] what meta.yaml states
  double offset = 0.4;         // [N] of the force sensor
  std::function<double(double)> softer = [](double) { return 1.0; };  // factor of E_0 by strain

  Dataset wind(const std::vector<double>& strains, double hold = 8.0) const {
    Dataset data;
    Table& table = data.table("muscles");
    table.column("ring/position");
    table.column("ring/force");
    constexpr double kStep = 1e-4;
    const double area = 2.0 * 0.25 * M_PI * section * section;
    double strain = start / rest - 1.0, relaxing = 0.0;
    const double released = strain;
    std::vector<double> goals = {released};
    goals.insert(goals.end(), strains.begin(), strains.end());
    long step = 0;
    for (const double goal : goals) {
      for (long end = step + std::lround(hold / kStep); step < end; ++step) {
        if (step % 100 == 0) {
          table.t.push_back(step * 100000);
          table.columns[0].values.push_back((rest * (1.0 + strain) - start) / radius);
          // What pulls at the released ring belongs to the offset, as on the rig.
          const double stress = e0 * softer(strain) * (strain - released) + relaxing;
          table.columns[1].values.push_back(area * stress + offset);
        }
        const double change = std::max(-6.0 * kStep, std::min(6.0 * kStep, goal - strain));
        relaxing += e1 * change - relaxing * kStep / tau;
        strain += change;
      }
    }
    for (Column& column : table.columns) column.present.assign(table.t.size(), 1);
    char keys[200];
    data.meta.other["specimen"] =
        "{ring: 10x5, number: 1, rest_length: 0.010, section_diameter: 0.005, strands: 2}";
    std::snprintf(keys, sizeof(keys), "{effective_radius: %.4f, start_length: %.4f}", radius,
                  said_start);
    data.meta.other["rig"] = keys;
    data.meta.other["run"] = "1";
    return data;
  }

  RingResult identified(const std::vector<double>& strains) const {
    return identify_rings({RingRecording::read(wind(strains))}).front();
  }
};

TEST(RingRecording, StaircaseWithoutRecoveryTellsTheRing) {
  Staircase ring;
  ring.start = ring.said_start = ring.rest;
  const RingResult result = ring.identified({0.3, 0.8, 1.2, 1.7, 1.0});
  const RingRecording& recording = result.recordings.front();
  ASSERT_EQ(recording.tests.size(), 5u);
  EXPECT_FALSE(recording.tests[0].used);
  EXPECT_NEAR(recording.tests[3].strain, 1.7, 1e-6);
  EXPECT_NEAR(recording.force_offset, ring.offset, 1e-9);
  const RingModelResult* zener = result.better();
  ASSERT_NE(zener, nullptr);
  EXPECT_EQ(zener->arms, 1u);
  // Rows are 0.01 s apart, and strain is linear between them only nearly.
  EXPECT_NEAR(zener->fit->parameters[0].value, ring.e0, 2e-3 * ring.e0);
  EXPECT_NEAR(zener->fit->parameters[1].value, ring.e1, 1e-2 * ring.e1);
  EXPECT_NEAR(zener->fit->parameters[2].value, ring.tau, 1e-2 * ring.tau);
  EXPECT_NEAR(zener->fit->zero->value, 0.0, 2e-5);
  EXPECT_TRUE(remarks_on(result).empty()) << remarks_on(result).front();
  EXPECT_NE(summary_of_rings({result}).find("10x5: take zener"), std::string::npos);
}

TEST(RingRecording, OneTestTellsTheRingButNotTheZero) {
  Staircase ring;
  ring.start = ring.said_start = ring.rest;
  const RingResult result = ring.identified({1.4});
  ASSERT_TRUE(result.better());
  EXPECT_NEAR(result.better()->fit->parameters[0].value, ring.e0, 2e-3 * ring.e0);
  EXPECT_FALSE(result.better()->fit->zero);
}

TEST(RingRecording, OddZerosAndModuliAreTold) {
  Staircase ring;
  ring.start = ring.rest;
  ring.said_start = ring.rest + 0.004;  // measured somewhere else
  const auto zero = remarks_on(ring.identified({0.8, 1.2, 1.7}));
  ASSERT_EQ(zero.size(), 1u);
  EXPECT_NE(zero[0].find("zero of the expansion 4"), std::string::npos) << zero[0];

  Staircase saturated;  // the sensor shows no more
  saturated.start = saturated.said_start = saturated.rest;
  saturated.softer = [](double strain) { return std::min(1.0, 1.0 / strain); };
  const auto modulus = remarks_on(saturated.identified({0.7, 1.2, 1.7, 2.0}));
  ASSERT_FALSE(modulus.empty());
  EXPECT_NE(modulus[0].find("zero of the expansion -"), std::string::npos) << modulus[0];

  Staircase soft;  // what a zero cannot explain
  soft.start = soft.said_start = soft.rest;
  soft.softer = [](double strain) { return 1.25 - 0.25 * strain; };
  const RingResult result = soft.identified({0.7, 0.9, 1.8, 2.0});
  const auto falls = remarks_on(result);
  ASSERT_FALSE(falls.empty()) << result.models.front().failure;
  EXPECT_NE(falls.back().find("E_0 falls from"), std::string::npos) << falls.back();
}

TEST(RingRecording, RefusesWhatIsNoTest) {
  Staircase ring;
  EXPECT_THROW(RingRecording::read(ring.wind({})), BadInput);
  Dataset cut = ring.wind({1.5});
  Table& table = cut.tables.front();
  const std::size_t rows = 810;  // while it is wound
  table.t.resize(rows);
  for (Column& column : table.columns) column.values.resize(rows), column.present.resize(rows);
  try {
    RingRecording::read(cut);
    FAIL();
  } catch (const BadInput& error) {
    EXPECT_NE(std::string(error.what()).find("cut off?"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace identification
}  // namespace anthrob
