#include "panel/robot_panel.h"

#include <gtest/gtest.h>

#include <QLineEdit>

#include "panel/fake_robot.h"
#include "panel/gui.h"

namespace anthrob {
namespace {

class RobotPanelTest : public testing::Test {
 protected:
  RobotPanelTest() {
    begin_application();
    panel_ = std::make_unique<RobotPanel>(std::make_unique<FakeConnection>(robot_), "anthrob");
    panel_->resize(300, 600);
    panel_->show();
    QTest::qWait(200);
  }

  void click(const char* button) {
    QTest::mouseClick(child<QPushButton>(panel_.get(), button), Qt::LeftButton);
  }
  std::vector<std::string> called() {
    std::vector<std::string> names;
    for (const ServiceRequest& call : std::exchange(robot_->calls, {})) {
      names.push_back(call.service);
    }
    return names;
  }
  std::string answer() {
    QTest::qWait(50);
    return child<QLabel>(panel_.get(), "answer")->text().toStdString();
  }

  const std::vector<std::string> stopped_ = {"disable"};
  std::shared_ptr<FakeRobot> robot_ = std::make_shared<FakeRobot>();
  std::unique_ptr<RobotPanel> panel_;
};

TEST_F(RobotPanelTest, StopsByClick) {
  click("stop");
  EXPECT_EQ(called(), stopped_);
}

TEST_F(RobotPanelTest, StopsByTheSpaceBarWhateverHasTheFocus) {
  QTest::keyClick(panel_.get(), Qt::Key_Space);
  EXPECT_EQ(called(), stopped_);
  // The button is not pressed as well.
  QTest::keyClick(child<QPushButton>(panel_.get(), "enable"), Qt::Key_Space);
  EXPECT_EQ(called(), stopped_);
  QWidget other;
  QTest::keyClick(&other, Qt::Key_Space);
  EXPECT_EQ(called(), stopped_);
  QTest::keyClick(&other, Qt::Key_A);
  EXPECT_TRUE(called().empty());
}

TEST_F(RobotPanelTest, ASpaceThatIsTypedStopsToo) {
  QLineEdit text;
  QTest::keyClicks(&text, "a b");
  EXPECT_EQ(called(), stopped_);
  EXPECT_EQ(text.text(), "a b");
}

TEST_F(RobotPanelTest, StopsWhileItIsHidden) {
  panel_->hide();
  QWidget other;
  QTest::keyClick(&other, Qt::Key_Space);
  EXPECT_EQ(called(), stopped_);
}

TEST_F(RobotPanelTest, AStopWithoutAnswerIsShouted) {
  click("stop");
  robot_->answers = {{"disable", false, "no answer within 1 s"}};
  EXPECT_EQ(answer(), "STOP NOT CONFIRMED: no answer within 1 s; sent emergency_stop as well");
  EXPECT_EQ(robot_->shouts, 1);
}

TEST_F(RobotPanelTest, ButtonsCallServicesAndShowTheirAnswers) {
  for (const char* button : {"enable", "clear", "home", "zero_gravity"}) click(button);
  EXPECT_EQ(called(), (std::vector<std::string>{"enable", "clear_faults", "home",
                                                "controller/zero_gravity"}));
  robot_->answers = {{"enable", false, "emergency stop: clear faults first"}};
  EXPECT_EQ(answer(), "enable: failed, emergency stop: clear faults first");
  robot_->answers = {{"enable", true, ""}};
  EXPECT_EQ(answer(), "enable: done");
}

TEST_F(RobotPanelTest, TheSimulatorHasButtonsWhereThereIsOne) {
  EXPECT_TRUE(child<QWidget>(panel_.get(), "simulator")->isVisible());
  child<QSpinBox>(panel_.get(), "steps")->setValue(7);
  for (const char* button : {"pause", "continue", "step", "reset"}) click(button);
  ASSERT_EQ(robot_->calls.size(), 4U);
  EXPECT_TRUE(robot_->calls[0].pause);
  EXPECT_FALSE(robot_->calls[1].pause);
  EXPECT_EQ(robot_->calls[2].steps, 7);
  robot_->diagnostics = {
      {"/anthrob: simulator", Level::kOk, "running", {{"real_time_factor", "0.500"}}}};
  QTest::qWait(200);
  EXPECT_EQ(child<QLabel>(panel_.get(), "real_time")->text(), "real time x 0.500");
  robot_->simulated = false;
  QTest::qWait(200);
  EXPECT_FALSE(child<QWidget>(panel_.get(), "simulator")->isVisible());
  EXPECT_TRUE(child<QPushButton>(panel_.get(), "stop")->isVisible());
}

TEST_F(RobotPanelTest, TheSimulatorsRateIsSetAndItsStateSavedAndRestored) {
  child<QDoubleSpinBox>(panel_.get(), "rate")->setValue(0.25);
  child<QLineEdit>(panel_.get(), "snapshot")->setText("lifted");
  for (const char* button : {"set_rate", "save", "restore"}) click(button);
  ASSERT_EQ(robot_->calls.size(), 3U);
  EXPECT_EQ(robot_->calls[0].service, "sim/set_rate");
  EXPECT_EQ(robot_->calls[0].factor, 0.25);
  EXPECT_EQ(robot_->calls[1].service, "sim/save");
  EXPECT_EQ(robot_->calls[2].service, "sim/restore");
  EXPECT_EQ(robot_->calls[2].name, "lifted");
}

TEST_F(RobotPanelTest, SaysThatThereIsNoRobot) {
  robot_->talks = false;
  rviz::Config config;
  config.mapSetValue("Robot", QString("nobody"));
  panel_->load(config);
  QTest::qWait(200);
  EXPECT_EQ(child<QLabel>(panel_.get(), "state")->text(),
            "no robot at /nobody: nothing is commanded");
  EXPECT_TRUE(child<QPushButton>(panel_.get(), "stop")->isEnabled());
}

TEST_F(RobotPanelTest, DiagnosticsAreATree) {
  robot_->diagnostics = {{"/anthrob: ecu_1", Level::kError, "FAULT", {{"fault", "encoder"}}},
                         {"/anthrob: ecu_2", Level::kOk, "IDLE", {}}};
  QTest::qWait(200);
  const auto* tree = child<QTreeWidget>(panel_.get(), "diagnostics");
  ASSERT_EQ(tree->topLevelItemCount(), 1);
  const QTreeWidgetItem* robot = tree->topLevelItem(0);
  EXPECT_EQ(robot->text(0), "/anthrob");
  ASSERT_EQ(robot->childCount(), 2);
  EXPECT_EQ(robot->child(0)->text(1), "FAULT");
  EXPECT_EQ(robot->child(0)->foreground(1).color(), QColor(colour_of(Level::kError)));
  ASSERT_EQ(robot->child(0)->childCount(), 1);
  EXPECT_EQ(robot->child(0)->child(0)->text(1), "encoder");
}

}  // namespace
}  // namespace anthrob
