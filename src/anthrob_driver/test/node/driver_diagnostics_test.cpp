#include "driver_diagnostics.h"

#include <gtest/gtest.h>

#include <string>

#include "rig.h"

namespace anthrob {
namespace driver {
namespace {

using diagnostic_msgs::DiagnosticStatus;

TEST(DriverDiagnostics, WarnWhileAStopIsLatched) {
  Rig rig;
  ASSERT_TRUE(rig.start());
  rig.commander_runs = false;
  const auto status = [&] { return driver_status(rig.driver(), rig.now(), "/anthrob"); };
  EXPECT_EQ(status().level, DiagnosticStatus::OK);
  rig.driver().emergency_stop();
  rig.run(10000);  // nothing of it is recent
  EXPECT_EQ(status().level, DiagnosticStatus::WARN);
  EXPECT_EQ(status().message, "emergency stop");
  rig.driver().clear_faults(rig.now());
  rig.run(200);
  EXPECT_EQ(status().level, DiagnosticStatus::OK);
  EXPECT_EQ(status().message, "disabled");
}

TEST(DriverDiagnostics, NameTheFaultThatTheDriverHolds) {
  Rig rig;
  rig.run(1000);
  const auto status = [&] { return ecu_status(rig.driver(), 2, rig.now(), "/anthrob"); };
  EXPECT_EQ(status().level, DiagnosticStatus::OK);
  EXPECT_EQ(status().message, "IDLE");
  rig.rack.board(2).set_power(false);
  rig.rack.board(2).set_power(true);
  rig.run(10000);  // nothing of it is recent
  ASSERT_EQ(rig.driver().link(2).state(), ecu::State::kIdle);
  EXPECT_EQ(status().level, DiagnosticStatus::ERROR);
  EXPECT_EQ(
      status().message,
      "FAULT, held by the driver until clear_faults (the ECU itself: IDLE), zero lost: home first");
  rig.driver().clear_faults(rig.now());
  rig.run(200);
  EXPECT_EQ(status().level, DiagnosticStatus::WARN);
  EXPECT_EQ(status().message, "IDLE, zero lost: home first");
}

TEST(DriverDiagnostics, TellOfMotorsThatGetHot) {
  Hardware robot = load_hardware(ANTHROB_CONFIG_DIR "/anthrob/hardware.yaml", false);
  robot.muscles[4].nominal_current = 0.1;
  robot.muscles[4].thermal_time_constant = 2.0;
  Rig rig(robot);
  ASSERT_TRUE(rig.start());
  for (int i = 0; i < 10000 && rig.driver().winding(4).relative_temperature_rise() < 1.0; ++i)
    rig.step();
  const DiagnosticStatus status = ecu_status(rig.driver(), 2, rig.now(), "/anthrob");
  EXPECT_EQ(status.level, DiagnosticStatus::WARN);
  EXPECT_EQ(status.message, "ENABLED; the motor of infraspinatus is hot, judging by its current");
  double told = 0.0;
  for (const auto& value : status.values) {
    if (value.key == "infraspinatus heat") told = std::stod(value.value);
    EXPECT_NE(value.key, "teres_minor heat");  // nobody knows what that one stands
  }
  EXPECT_NEAR(told, 1.0, 0.05);
}

TEST(DriverDiagnostics, GiveNoHealthThatWasNotReportedJustNow) {
  Rig rig;
  const auto supply = [&] {
    for (const auto& value : ecu_status(rig.driver(), 2, rig.now(), "/anthrob").values) {
      if (value.key == "supply") return value.value;
    }
    return std::string("none");
  };
  rig.rack.board(2).set_power(false);
  rig.run(1000);
  EXPECT_EQ(supply(), "unknown");
  rig.rack.board(2).set_power(true);
  rig.run(2000);
  EXPECT_NEAR(std::stod(supply()), 12.0, 0.1);
  rig.rack.board(2).set_power(false);
  rig.run(2000);
  EXPECT_EQ(supply(), "unknown");
}

TEST(DriverDiagnostics, SayThatEnableIsUnderWay) {
  Rig rig;
  rig.run(1000);
  ASSERT_TRUE(rig.driver().start_enable(rig.now()).accepted);
  EXPECT_EQ(driver_status(rig.driver(), rig.now(), "/anthrob").message, "enabling");
}

}  // namespace
}  // namespace driver
}  // namespace anthrob
