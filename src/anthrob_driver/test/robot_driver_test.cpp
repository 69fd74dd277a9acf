#include "anthrob_driver/robot_driver.h"

#include <gtest/gtest.h>

#include <cmath>

#include "rig.h"

namespace anthrob {
namespace driver {
namespace {

using Phase = RobotDriver::Phase;

TEST(RobotDriver, ConfiguresEveryEcuAndReadsItBack) {
  Rig rig;
  rig.run(1000);
  ASSERT_EQ(rig.rack.size(), 7u);
  for (std::size_t e = 0; e < 7; ++e) {
    EXPECT_TRUE(rig.driver().link(e).configured()) << e;
    for (std::size_t c = 0; c < rig.hardware.ecus[e].muscles.size(); ++c) {
      const auto muscle = static_cast<std::size_t>(rig.hardware.ecus[e].muscles[c]);
      const auto& held = rig.rack.board(e).firmware().channel(static_cast<int>(c)).parameters;
      for (int i = 0; i < ecu::kParameterCount; ++i) {
        EXPECT_EQ(held.raw(i), rig.hardware.muscles[muscle].parameters.raw(i));
      }
    }
  }
  EXPECT_EQ(rig.moving(), 0);
}

TEST(RobotDriver, NothingMovesBeforeEnable) {
  Rig rig;
  rig.commander_runs = true;
  for (int i = 0; i < 2000; ++i) {
    rig.step();
    ASSERT_EQ(rig.moving(), 0) << "at " << i << " ms";
  }
}

TEST(RobotDriver, EnablesAndMovesAllMuscles) {
  Rig rig;
  ASSERT_TRUE(rig.start()) << rig.driver().last_outcome().reason;
  rig.run(3000);
  const Sample& sample = rig.samples.back();
  ASSERT_EQ(sample.muscles.size(), 13u);
  for (std::size_t m = 0; m < 13; ++m) {
    const Plant::Muscle truth = rig.plant.muscle(m);
    EXPECT_TRUE(sample.muscles[m].measured);
    EXPECT_EQ(sample.muscles[m].state, ecu::State::kEnabled);
    EXPECT_EQ(sample.muscles[m].voltage, 0.5);
    EXPECT_EQ(sample.muscles[m].reference, 0.5);
    EXPECT_NEAR(sample.muscles[m].position, truth.position, 0.01);
    EXPECT_NEAR(sample.muscles[m].current, truth.current, 0.05);
    if (rig.hardware.muscles[m].parameters.has_force_sensor()) {
      EXPECT_NEAR(sample.muscles[m].force, truth.force, 0.5);
    } else {
      EXPECT_TRUE(std::isnan(sample.muscles[m].force));
    }
  }
}

}  // namespace
}  // namespace driver
}  // namespace anthrob
