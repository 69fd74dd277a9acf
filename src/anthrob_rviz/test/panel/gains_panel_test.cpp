#include "panel/gains_panel.h"

#include <gtest/gtest.h>

#include <QLineEdit>

#include "panel/fake_robot.h"
#include "panel/gui.h"

namespace anthrob {
namespace {

class GainsPanelTest : public testing::Test {
 protected:
  GainsPanelTest() {
    begin_application();
    panel_ = std::make_unique<GainsPanel>(std::make_unique<FakeConnection>(robot_), "anthrob");
    panel_->resize(300, 500);
    panel_->show();
    QTest::qWait(100);
    answer(held(4.0, 5.0));
  }

  static std::vector<Gain> held(double flexor, double extensor) {
    return {{"flexor", "position_proportional", flexor},
            {"flexor", "force_integral", 0.5},
            {"extensor", "position_proportional", extensor},
            {"extensor", "force_integral", 0.5}};
  }
  void answer(const std::vector<Gain>& gains, bool success = true, const std::string& why = "") {
    CallResult result{"gains", success, why};
    result.gains = gains;
    robot_->answers.push_back(result);
    QTest::qWait(150);
  }
  /// What was asked to be changed since the last look; reading changes nothing.
  std::vector<Gain> changes() {
    QTest::qWait(100);
    std::vector<Gain> result;
    for (const ServiceRequest& call : std::exchange(robot_->calls, {})) {
      if (call.service == "gains" && !call.gains.empty()) result = call.gains;
    }
    return result;
  }
  QDoubleSpinBox* number(const char* name) { return child<QDoubleSpinBox>(panel_.get(), name); }
  void enter(const char* name, const char* value) {
    number(name)->setFocus();
    number(name)->selectAll();
    QTest::keyClicks(number(name), value);
    QTest::keyClick(number(name), Qt::Key_Return);
  }
  void choose(const char* muscle) {
    auto* box = child<QComboBox>(panel_.get(), "muscle");
    box->setCurrentIndex(box->findText(muscle));
    QTest::qWait(150);
  }
  std::string text(const char* label) {
    return child<QLabel>(panel_.get(), label)->text().toStdString();
  }

  std::shared_ptr<FakeRobot> robot_ = std::make_shared<FakeRobot>();
  std::unique_ptr<GainsPanel> panel_;
};

TEST_F(GainsPanelTest, ShowsWhatIsHeld) {
  EXPECT_EQ(number("position_proportional")->value(), 4.0);
  EXPECT_EQ(text("position_proportional_remark"), "differs");
  EXPECT_EQ(text("force_integral_remark"), "");
  choose("extensor");
  EXPECT_EQ(number("position_proportional")->value(), 5.0);
  EXPECT_EQ(text("position_proportional_remark"), "");
}

TEST_F(GainsPanelTest, ANumberIsSentOnceItIsWholeAndUndone) {
  choose("extensor");
  changes();
  number("position_proportional")->selectAll();
  QTest::keyClicks(number("position_proportional"), "12");
  EXPECT_TRUE(changes().empty());
  QTest::keyClick(number("position_proportional"), Qt::Key_Return);
  const auto changed = changes();
  ASSERT_EQ(changed.size(), 1U);
  EXPECT_EQ(changed[0].muscle, "extensor");
  EXPECT_EQ(changed[0].name, "position_proportional");
  EXPECT_EQ(changed[0].value, 12.0);
  answer(held(4.0, 12.0));
  EXPECT_EQ(text("answer"), "done");
  EXPECT_EQ(number("position_proportional")->value(), 12.0);
  QTest::mouseClick(child<QPushButton>(panel_.get(), "undo"), Qt::LeftButton);
  const auto undone = changes();
  ASSERT_EQ(undone.size(), 1U);
  EXPECT_EQ(undone[0].value, 5.0);
  answer(held(4.0, 5.0));
  EXPECT_FALSE(child<QPushButton>(panel_.get(), "undo")->isEnabled());
}

TEST_F(GainsPanelTest, AllMusclesAtOnce) {
  changes();
  enter("force_integral", "0.25");
  const auto changed = changes();
  ASSERT_EQ(changed.size(), 1U);
  EXPECT_EQ(changed[0].muscle, "");
  EXPECT_EQ(changed[0].value, 0.25);
}

TEST_F(GainsPanelTest, WhatTheRobotRefusesGoesBackToWhatIsHeld) {
  choose("flexor");
  changes();
  enter("position_proportional", "9");
  EXPECT_EQ(changes().size(), 1U);
  answer(held(4.0, 5.0), false, "home runs");
  EXPECT_EQ(text("answer"), "failed: home runs");
  EXPECT_EQ(number("position_proportional")->value(), 4.0);
}

TEST_F(GainsPanelTest, IsSavedByTheTool) {
  changes();
  panel_->save_as("/tmp/tuned.yaml");
  ASSERT_FALSE(robot_->calls.empty());
  EXPECT_EQ(robot_->calls.back().service, "save_gains");
  EXPECT_EQ(robot_->calls.back().name, "/tmp/tuned.yaml");
  robot_->answers = {{"save_gains", false, "--save /tmp/tuned.yaml: expected another file"}};
  QTest::qWait(100);
  EXPECT_EQ(text("answer"), "failed: --save /tmp/tuned.yaml: expected another file");
}

TEST_F(GainsPanelTest, AsksNobodyWhileThereIsNoRobot) {
  robot_->talks = false;
  rviz::Config config;
  config.mapSetValue("Robot", QString("nobody"));
  panel_->load(config);
  QTest::qWait(100);
  changes();
  QTest::qWait(200);
  EXPECT_TRUE(robot_->calls.empty());
  EXPECT_EQ(text("state"), "no robot at /nobody: nothing is commanded");
}

}  // namespace
}  // namespace anthrob
