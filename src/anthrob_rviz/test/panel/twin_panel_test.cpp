#include "panel/twin_panel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "panel/fake_robot.h"
#include "panel/gui.h"

namespace anthrob {
namespace {

GapReading reading_with(double flexor_force) {
  GapReading reading;
  reading.channels = {"flexor/force", "flexor/position", "hinge/position"};
  reading.feeds = {"commands", "postures"};
  reading.windows = {1.0, 10.0, 60.0};
  reading.gaps.assign(18, 0.0);
  // Of 10 s: by channel and feed.
  const double ten[] = {0.9, flexor_force, 1.2, NAN, 1.1, NAN};
  std::copy(std::begin(ten), std::end(ten), reading.gaps.begin() + 6);
  return reading;
}

TEST(TwinReading, OfAnOwnerTheLargestChannelCounts) {
  const auto owners = gaps_by_owner(reading_with(6.0), 1);
  ASSERT_EQ(owners.size(), 2u);
  EXPECT_EQ(owners[0].owner, "flexor");
  EXPECT_EQ(owners[0].gaps[0], 1.2);
  EXPECT_EQ(owners[0].gaps[1], 6.0);  // the other one is not told
  EXPECT_EQ(owners[1].gaps[0], 1.1);
  EXPECT_TRUE(std::isnan(owners[1].gaps[1]));
  EXPECT_EQ(level_of_gap(1.2), Level::kOk);
  EXPECT_EQ(level_of_gap(3.0), Level::kWarning);
  EXPECT_EQ(level_of_gap(6.0), Level::kError);
  EXPECT_EQ(level_of_gap(NAN), Level::kStale);
}

TEST(TwinReading, SaysHowFarAJobIs) {
  EXPECT_EQ(text_of({"calibrate", true, "searching", "fitness 0.02", 0.374, 20.0}),
            "searching, 37 %, about 20 s left, best: fitness 0.02");
  EXPECT_EQ(text_of({"discover", true, "screening", "", 0.1, NAN}), "screening, 10 %");
  EXPECT_EQ(text_of({"discover", false, "", "", 1.0, 0.0, "no_missing_effect", true}),
            "no_missing_effect");
}

class TwinPanelTest : public testing::Test {
 protected:
  TwinPanelTest() {
    begin_application();
    panel_ = std::make_unique<TwinPanel>(std::make_unique<FakeConnection>(robot_), "anthrob");
    panel_->show();
    QTest::qWait(50);
  }
  std::string text(const char* name) const {
    return child<QLabel>(panel_.get(), name)->text().toStdString();
  }
  void tell(const std::string& name, Level level, const std::string& message) {
    robot_->diagnostics.push_back({name, level, message, {}});
  }

  std::shared_ptr<FakeRobot> robot_ = std::make_shared<FakeRobot>();
  std::unique_ptr<TwinPanel> panel_;
};

TEST_F(TwinPanelTest, ShowsGapsInColours) {
  QTest::qWait(150);
  EXPECT_NE(text("twin").find("no twin"), std::string::npos);
  robot_->gap = reading_with(6.0);
  tell("/anthrob: twin", Level::kOk, "in step");
  tell("/anthrob: twin: flexor", Level::kWarning, "flexor: 6 floors since 40 s, spring or tendon");
  tell("/anthrob: twin: hinge", Level::kOk, "1.1 floors");
  tell("/other: twin", Level::kError, "lost");
  QTest::qWait(300);
  EXPECT_EQ(text("twin"), "twin: in step\nflexor: 6 floors since 40 s, spring or tendon");
  auto* table = child<QTableWidget>(panel_.get(), "gaps");
  ASSERT_EQ(table->rowCount(), 2);
  ASSERT_EQ(table->columnCount(), 2);
  EXPECT_EQ(table->verticalHeaderItem(0)->text(), "flexor");
  EXPECT_EQ(table->horizontalHeaderItem(1)->text(), "postures");
  EXPECT_EQ(table->item(0, 0)->text(), "1.2");
  EXPECT_EQ(table->item(0, 1)->text(), "6.0");
  EXPECT_EQ(table->item(1, 1)->text(), "");
  const auto colour = [&](int row, int column) {
    return table->item(row, column)->background().color().rgb();
  };
  EXPECT_EQ(colour(0, 0), colour(1, 0));
  EXPECT_NE(colour(0, 0), colour(0, 1));
  EXPECT_NE(colour(1, 1), colour(1, 0));
}

TEST_F(TwinPanelTest, ShowsJobsAndCancelsThem) {
  auto* cancel = child<QPushButton>(panel_.get(), "calibrate_cancel");
  EXPECT_FALSE(cancel->isEnabled());
  robot_->jobs = {{"calibrate", true, "searching", "", 0.37, 20.0}};
  QTest::qWait(150);
  EXPECT_EQ(text("calibrate_text"), "searching, 37 %, about 20 s left");
  EXPECT_EQ(child<QProgressBar>(panel_.get(), "calibrate_bar")->value(), 37);
  EXPECT_FALSE(child<QPushButton>(panel_.get(), "discover_cancel")->isEnabled());
  QTest::mouseClick(cancel, Qt::LeftButton);
  EXPECT_EQ(robot_->cancelled, std::vector<std::string>{"calibrate"});
  robot_->jobs = {{"calibrate", false, "", "", 1.0, 0.0, "interrupted", false}};
  QTest::qWait(150);
  EXPECT_EQ(text("calibrate_text"), "interrupted");
  EXPECT_FALSE(cancel->isEnabled());
}

TEST_F(TwinPanelTest, ShowsTheHealthOfTheTendons) {
  EXPECT_EQ(text("health"), "");
  robot_->health = HealthReading{"2 tendons: nothing has changed", {}};
  QTest::qWait(150);
  EXPECT_EQ(text("health"), "2 tendons: nothing has changed");
  robot_->health = HealthReading{"2 tendons: 1 has changed, first flexor", {"flexor: it frays"}};
  robot_->jobs = {{"health/test", true, "slow reversal", "", 0.5, 30.0}};
  QTest::qWait(150);
  EXPECT_EQ(text("health"), "2 tendons: 1 has changed, first flexor\nflexor: it frays");
  EXPECT_EQ(text("health/test_text"), "slow reversal, 50 %, about 30 s left");
  QTest::mouseClick(child<QPushButton>(panel_.get(), "health/test_cancel"), Qt::LeftButton);
  EXPECT_EQ(robot_->cancelled, std::vector<std::string>{"health/test"});
}

}  // namespace
}  // namespace anthrob
