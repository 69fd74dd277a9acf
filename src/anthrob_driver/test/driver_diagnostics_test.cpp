#include "driver_diagnostics.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace driver
}  // namespace anthrob
