// The file of all tests of a robot.
#include "health/history.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "anthrob_core/errors.h"

namespace anthrob {
namespace health {
namespace {

class HistoryFile : public testing::Test {
 protected:
  ~HistoryFile() override { std::filesystem::remove(file); }
  const std::string file = std::filesystem::temp_directory_path() /
                           ("anthrob_health_" + std::to_string(getpid()) + ".csv");
};

TEST_F(HistoryFile, ComesBackAsItWasWritten) {
  History history = History::load(file);
  EXPECT_TRUE(history.muscles().empty());
  const double day = day_of("2026-12-01T08:30:00Z");
  history.add(day, {{"flexor", {{Quantity::kStiffness, 1234.5, 1200.0, 1300.0}}, {}},
                    {"extensor", {{Quantity::kZero, -1e-4, -2e-4, 0.0}}, {}}});
  history.add(day + 1.0, {{"flexor", {{Quantity::kStiffness, 0.1 + 0.2, 0.0, 1.0}}, {}}});
  history.save(file);
  const History again = History::load(file);
  EXPECT_EQ(again.muscles(), (std::vector<std::string>{"flexor", "extensor"}));
  ASSERT_EQ(again.series("flexor", Quantity::kStiffness).size(), 2u);
  EXPECT_EQ(again.series("flexor", Quantity::kStiffness)[1].figure.value, 0.1 + 0.2);
  EXPECT_EQ(time_of_day(again.last_day()), "2026-12-02T08:30:00Z");
  EXPECT_TRUE(again.series("flexor", Quantity::kZero).empty());
}

TEST_F(HistoryFile, RefusesWhatIsWrong) {
  const std::string head = "time,muscle,quantity,value,low,high,unit";
  const auto error_of = [&](const std::string& text) -> std::string {
    std::ofstream(file) << text;
    try {
      History::load(file);
    } catch (const BadInput& error) {
      return error.what();
    }
    return "";
  };
  const std::string good = "\n2026-12-01T08:30:00Z,flexor,stiffness,1,0,2,N/m";
  EXPECT_EQ(error_of(head + good + "\n"), "");
  EXPECT_NE(error_of("a,b\n").find("line 1"), std::string::npos);
  EXPECT_NE(error_of(head + good + "\n2026-12-01,flexor,stiffness,x,0,2,N/m\n").find("line 3"),
            std::string::npos);
  EXPECT_NE(error_of(head + good + "\n2026-11-01,flexor,stiffness,1,0,2,N/m\n").find("before"),
            std::string::npos);
  EXPECT_NE(error_of(head + "\n2026-12-01,flexor,stiffness,1,0,2,N/mm\n").find("unit N/mm"),
            std::string::npos);
  EXPECT_NE(error_of(head + "\nyesterday,flexor,stiffness,1,0,2,N/m\n").find("expected a time"),
            std::string::npos);
  History history;
  history.add(20000.0, std::vector<TendonFigures>{});
  history.add(20001.0, {{"flexor", {{Quantity::kCreep, 0.1, 0.0, 0.2}}, {}}});
  EXPECT_THROW(history.add(20000.5, std::vector<TendonFigures>{}), BadInput);
}

}  // namespace
}  // namespace health
}  // namespace anthrob
