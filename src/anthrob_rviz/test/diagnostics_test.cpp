#include "diagnostics.h"

#include <gtest/gtest.h>

namespace anthrob {
namespace {

Diagnosis simulator_running() {
  return {"/anthrob: simulator", Level::kOk, "running", {{"real_time_factor", "1.000"}}};
}

TEST(Diagnostics, KeepTheLastOfEachAndAgeIt) {
  Diagnostics diagnostics;
  diagnostics.hear(simulator_running(), 0.0);
  diagnostics.hear({"/anthrob: ecu_1", Level::kError, "FAULT", {}}, 0.0);
  diagnostics.hear({"/anthrob: simulator", Level::kWarning, "slower", {}}, 3.0);
  const auto all = diagnostics.all(5.5);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].message, "slower");
  EXPECT_EQ(all[0].level, Level::kWarning);
  EXPECT_EQ(all[1].level, Level::kStale);
}

TEST(Diagnostics, OfOneRobot) {
  Diagnostics diagnostics;
  diagnostics.hear(simulator_running(), 0.0);
  EXPECT_EQ(diagnostics.of("/anthrob", "simulator", 1.0)->value("real_time_factor").value(),
            "1.000");
  EXPECT_FALSE(diagnostics.of("/anthrob", "simulator", 1.0)->value("nothing").has_value());
  EXPECT_FALSE(diagnostics.of("/other", "simulator", 1.0).has_value());
  EXPECT_FALSE(diagnostics.of("/anthrob", "simulator", 6.0).has_value());
}

TEST(Diagnostics, AUnitIsFoundByItsMuscle) {
  Diagnostics diagnostics;
  diagnostics.hear({"/other: ecu_1", Level::kError, "", {{"triceps temperature", "1"}}}, 0.0);
  diagnostics.hear({"/anthrob: ecu_1", Level::kError, "hot", {{"triceps temperature", "1"}}}, 0.0);
  EXPECT_EQ(diagnostics.unit_of_muscle("/anthrob", "triceps", 0.0)->message, "hot");
  EXPECT_FALSE(diagnostics.unit_of_muscle("/anthrob", "tri", 0.0).has_value());
}

TEST(Diagnostics, NamesHaveAWholeAndAPart) {
  EXPECT_EQ(whole_and_part("/anthrob: ecu_1"),
            std::make_pair(std::string("/anthrob"), std::string("ecu_1")));
  EXPECT_EQ(whole_and_part("disk").second, "disk");
  EXPECT_EQ(whole_and_part("disk").first, "");
}

}  // namespace
}  // namespace anthrob
