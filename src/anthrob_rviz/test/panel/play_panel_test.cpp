#include "panel/play_panel.h"

#include <gtest/gtest.h>

#include "panel/fake_robot.h"
#include "panel/gui.h"

namespace anthrob {
namespace {

class PlayPanelTest : public testing::Test {
 protected:
  PlayPanelTest() {
    begin_application();
    robot_->player = {"/tmp/run.bag", 20.0, 5.0, 1.0, false};
    panel_ = std::make_unique<PlayPanel>(std::make_unique<FakeConnection>(robot_), "anthrob");
    panel_->resize(400, 200);
    panel_->show();
    QTest::qWait(150);
  }
  template <class Widget>
  Widget* widget(const char* name) {
    return child<Widget>(panel_.get(), name);
  }

  std::shared_ptr<FakeRobot> robot_ = std::make_shared<FakeRobot>();
  std::unique_ptr<PlayPanel> panel_;
};

TEST_F(PlayPanelTest, ShowsWhereThePlayerIs) {
  EXPECT_EQ(widget<QLabel>("file")->text(), "/tmp/run.bag");
  EXPECT_EQ(widget<QLabel>("place")->text(), "5.00 of 20.00 s");
  EXPECT_EQ(widget<QSlider>("bar")->value(), 2500);
  EXPECT_TRUE(robot_->calls.empty());  // showing commands nothing
}

TEST_F(PlayPanelTest, PausesAndGoesOn) {
  QTest::mouseClick(widget<QPushButton>("pause"), Qt::LeftButton);
  ASSERT_EQ(robot_->calls.size(), 1u);
  EXPECT_EQ(robot_->calls[0].service, "player/pause");
  EXPECT_TRUE(robot_->calls[0].pause);
  robot_->player->paused = true;
  QTest::qWait(150);
  EXPECT_EQ(widget<QPushButton>("pause")->text(), "Play");
  QTest::mouseClick(widget<QPushButton>("pause"), Qt::LeftButton);
  EXPECT_FALSE(robot_->calls.at(1).pause);
}

TEST_F(PlayPanelTest, GoesWhereTheBarIsDragged) {
  auto* bar = widget<QSlider>("bar");
  QTest::mousePress(bar, Qt::LeftButton, {}, handle_of(bar));
  drag(bar, 100);
  QTest::qWait(50);
  ASSERT_FALSE(robot_->calls.empty());
  const ServiceRequest& seek = robot_->calls.back();
  EXPECT_EQ(seek.service, "player/seek");
  EXPECT_NEAR(seek.position, 5.0 + 20.0 * 100.0 / bar->width(), 1.0);
  // The player has not gone there yet; the handle stays in the hand.
  QTest::qWait(150);
  EXPECT_NEAR(bar->value(), 1e4 * seek.position / 20.0, 1.0);
  QTest::mouseRelease(bar, Qt::LeftButton);
}

TEST_F(PlayPanelTest, SetsTheRate) {
  widget<QDoubleSpinBox>("rate")->setValue(0.25);
  ASSERT_EQ(robot_->calls.size(), 1u);
  EXPECT_EQ(robot_->calls[0].service, "player/set_rate");
  EXPECT_EQ(robot_->calls[0].factor, 0.25);
}

TEST_F(PlayPanelTest, SaysThatNothingIsPlayed) {
  robot_->player.reset();
  QTest::qWait(1300);
  EXPECT_TRUE(widget<QLabel>("file")->text().startsWith("no recording is played here"));
  EXPECT_FALSE(widget<QSlider>("bar")->isEnabled());
}

TEST_F(PlayPanelTest, TellsWhyACallFailed) {
  robot_->answers.push_back({"player/seek", false, "no answer within 2 s"});
  QTest::qWait(100);
  EXPECT_EQ(widget<QLabel>("answer")->text(), "player/seek: failed, no answer within 2 s");
}

}  // namespace
}  // namespace anthrob
