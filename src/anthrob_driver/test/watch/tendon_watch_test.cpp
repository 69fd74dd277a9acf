#include "watch/tendon_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>

#include "rig.h"
#include "watch/period.h"

namespace anthrob {
namespace driver {
namespace {

struct Strain {
  double position, force;
  bool pulled;
};

/// What the watch says to `course` of time, until it says something or 3 s are over.
std::optional<std::string> watch(const std::function<Strain(double)>& course,
                                 double* when = nullptr) {
  TendonWatch tendon({20.0, 2.5, 6.0});
  for (double t = 0.0; t < 3.0; t += kPeriod) {
    const Strain m = course(t);
    const auto wrong = tendon.step(m.position, m.force, m.pulled, t);
    if (!wrong) continue;
    if (when != nullptr) *when = t;
    return wrong;
  }
  return std::nullopt;
}

/// From `from` to 0 in `duration`, a second after the start.
double fall(double t, double from, double duration) {
  return from * std::min(1.0, std::max(0.0, 1.0 - (t - 1.0) / duration));
}

TEST(TendonWatch, ALoadThatIsGoneAtOnceIsABrokenTendon) {
  double when = 0.0;
  EXPECT_EQ(watch(
                [](double t) {
                  return Strain{1.0, fall(t, 40.0, 0.06), false};
                },
                &when),
            "held 40.0 N, 0.15 s later 0.0 N: the tendon broke or slips");
  EXPECT_NEAR(when, 1.16, 2.0 * kPeriod);
}

TEST(TendonWatch, ATendonThatTheJointsLetGoIsNone) {
  // An arm that moves by 1 rad/s lets a tendon of 4 kN/m at 30 mm go by 120 N/s.
  EXPECT_EQ(watch([](double t) { return Strain{1.0, fall(t, 40.0, 0.33), false}; }), std::nullopt);
}

TEST(TendonWatch, ATendonThatItsSpindleLetsGoIsNone) {
  EXPECT_EQ(watch([](double t) {
              return Strain{1.0 - 4.0 * std::max(0.0, t - 1.0), fall(t, 40.0, 0.06), false};
            }),
            std::nullopt);
}

TEST(TendonWatch, ABlowOnTheArmIsNone) {
  EXPECT_EQ(watch([](double t) {
              return Strain{1.0, t < 1.07 ? fall(t, 40.0, 0.06) : 30.0, false};
            }),
            std::nullopt);
}

TEST(TendonWatch, AForceThatWasThereForAMomentIsNoLoad) {
  EXPECT_EQ(watch([](double t) {
              return Strain{1.0, t > 0.9 ? fall(t, 40.0, 0.06) : 1.0, false};
            }),
            std::nullopt);
}

TEST(TendonWatch, ASlackTendonThatWindsInIsNone) {
  EXPECT_EQ(watch([](double t) { return Strain{8.0 * t, 0.0, false}; }), std::nullopt);
  EXPECT_EQ(watch([](double t) {
              return Strain{std::min(8.0 * t, 5.9), 0.0, true};
            }),
            std::nullopt);
}

TEST(TendonWatch, AForceThatIsWantedAndNeverComesIsABrokenTendon) {
  double when = 0.0;
  EXPECT_EQ(watch(
                [](double t) {
                  return Strain{8.0 * t, 0.0, true};
                },
                &when),
            "wound in by 6.00 rad, but only 0.0 N: the tendon is broken or off its pulley");
  EXPECT_NEAR(when, 0.755, 2.0 * kPeriod);
  // Force in between: it is there.
  EXPECT_EQ(watch([](double t) {
              return Strain{4.0 * t, std::fmod(t, 1.0) < 0.1 ? 3.0 : 0.0, true};
            }),
            std::nullopt);
}

TEST(TendonWatch, NothingIsLookedForWhereTheFileSaysZero) {
  TendonWatch tendon({0.0, 2.5, 0.0});
  for (double t = 0.0; t < 3.0; t += kPeriod) {
    EXPECT_EQ(tendon.step(t < 1.0 ? 1.0 : 10.0 * t, fall(t, 40.0, 0.06), true, t), std::nullopt);
  }
}

TEST(TendonWatch, AnUnloadedTendonThatBreaksUnderForceControlStopsAll) {
  Rig rig;
  ASSERT_TRUE(rig.start());
  constexpr std::size_t kMuscle = 3;
  rig.modes[kMuscle] = static_cast<std::uint8_t>(ecu::Mode::kForce);
  rig.volts[kMuscle] = 8.0;
  rig.run(3000);
  ASSERT_EQ(rig.driver().phase(), RobotDriver::Phase::kEnabled);
  rig.plant.cut(kMuscle);
  const auto cut = rig.ms;
  while (rig.ms < cut + 10000 && rig.moving() > 0) rig.step();
  RecordProperty("stopped_after_ms", static_cast<int>(rig.ms - cut));
  std::printf("stopped after %d ms\n", static_cast<int>(rig.ms - cut));
  EXPECT_EQ(rig.driver().phase(), RobotDriver::Phase::kDisabled);
  EXPECT_EQ(rig.driver().findings().count(Finding::kTendonSlack), 1u);
  EXPECT_NE(rig.driver().stops().last().value_or("").find("(supraspinatus: wound in by 12.0"),
            std::string::npos)
      << rig.driver().stops().last().value_or("");
  // Its unit is to be cleared, as after any fault.
  EXPECT_FALSE(rig.driver().start_enable(rig.now()).accepted);
  rig.driver().clear_faults(rig.now());
  rig.run(200);
  EXPECT_TRUE(rig.enable());
}

}  // namespace
}  // namespace driver
}  // namespace anthrob
