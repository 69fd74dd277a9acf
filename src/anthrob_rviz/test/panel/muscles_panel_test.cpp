#include "panel/muscles_panel.h"

#include <gtest/gtest.h>

#include <QPushButton>
#include <QThread>

#include "panel/fake_robot.h"
#include "panel/gui.h"
#include "slider_scale.h"

namespace anthrob {
namespace {

class MusclesPanelTest : public testing::Test {
 protected:
  MusclesPanelTest() {
    begin_application();
    panel_ = std::make_unique<MusclesPanel>(std::make_unique<FakeConnection>(robot_), "anthrob");
    panel_->resize(430, 500);
    panel_->show();
    QTest::qWait(300);
  }

  QWidget* row(const char* muscle) { return child<QWidget>(panel_.get(), muscle); }
  QSlider* slider() { return child<QSlider>(row("flexor"), "slider"); }
  QCheckBox* hold() { return child<QCheckBox>(row("flexor"), "hold"); }
  void press_slider() { QTest::mousePress(slider(), Qt::LeftButton, {}, handle_of(slider())); }
  std::string status() {
    QTest::qWait(150);
    return child<QLabel>(panel_.get(), "status")->text().toStdString();
  }
  std::size_t commands_within(int time_ms) {
    robot_->take_commands();
    QTest::qWait(time_ms);
    const auto commands = robot_->take_commands();
    if (!commands.empty()) last_ = commands.back();
    return commands.size();
  }

  std::shared_ptr<FakeRobot> robot_ = std::make_shared<FakeRobot>();
  std::unique_ptr<MusclesPanel> panel_;
  std::vector<Reference> last_;  ///< command
};

// What a busy machine may lose of 20 commands a second.
constexpr std::size_t kFewest = 14, kMost = 21;

TEST_F(MusclesPanelTest, ARowForEachMuscleAndNoCommand) {
  EXPECT_EQ(robot_->connected, "/anthrob");
  ASSERT_NE(row("flexor"), nullptr);
  ASSERT_NE(row("extensor"), nullptr);
  EXPECT_EQ(status(), "/anthrob: 2 muscles, 2 enabled, 0 faulty");
  EXPECT_EQ(commands_within(300), 0U);
}

TEST_F(MusclesPanelTest, APressedSliderCommandsTwentyTimesASecondFromWhereTheMuscleIs) {
  press_slider();
  const std::size_t count = commands_within(1000);
  EXPECT_GE(count, kFewest);
  EXPECT_LE(count, kMost);
  ASSERT_EQ(last_.size(), 1U);
  EXPECT_EQ(last_[0].muscle, "flexor");
  EXPECT_EQ(last_[0].value, 1.0);
  drag(slider(), 20);
  commands_within(150);
  EXPECT_GT(last_[0].value, 1.3);
  QTest::mouseRelease(slider(), Qt::LeftButton);
  QTest::qWait(20);
  EXPECT_EQ(commands_within(300), 0U);
  EXPECT_NEAR(SliderScale({-10.0, 10.0}).value(slider()->value()), 1.0, 0.02);
}

TEST_F(MusclesPanelTest, AHiddenPanelCommandsNothingAndForgetsItsHolds) {
  hold()->setChecked(true);
  EXPECT_GE(commands_within(500), kFewest / 2);
  panel_->hide();
  EXPECT_EQ(commands_within(300), 0U);
  panel_->show();
  EXPECT_EQ(commands_within(300), 0U);
  EXPECT_FALSE(hold()->isChecked());
  EXPECT_EQ(status(), "Commands ended: the panel was hidden");
}

TEST_F(MusclesPanelTest, AGroupHidesTheOthers) {
  auto* group = child<QComboBox>(panel_.get(), "group");
  EXPECT_EQ(group->count(), 1);
  robot_->antagonists = {{"elbow +", {"flexor"}}, {"elbow -", {"extensor"}}};
  QTest::qWait(200);
  ASSERT_EQ(group->count(), 3);
  group->setCurrentIndex(group->findText("elbow -"));
  EXPECT_FALSE(row("flexor")->isVisible());
  EXPECT_TRUE(row("extensor")->isVisible());
  child<QLineEdit>(panel_.get(), "search")->setText("flex");
  EXPECT_FALSE(row("extensor")->isVisible());
  child<QLineEdit>(panel_.get(), "search")->clear();
  robot_->diagnostics = {{"/anthrob: ecu_1", Level::kOk, "", {{"flexor temperature", "25"}}}};
  QTest::qWait(200);
  EXPECT_EQ(group->count(), 4);
  EXPECT_EQ(group->currentText(), "elbow -");
  group->setCurrentIndex(group->findText("ecu_1"));
  EXPECT_TRUE(row("flexor")->isVisible());
  EXPECT_FALSE(row("extensor")->isVisible());
}

TEST_F(MusclesPanelTest, APressedSliderDoesNotOutliveItsPanel) {
  press_slider();
  EXPECT_GE(commands_within(500), kFewest / 2);
  panel_->close();
  EXPECT_EQ(commands_within(300), 0U);
  panel_.reset();
  EXPECT_EQ(commands_within(100), 0U);
}

/// As while RViz draws for long; and if it hangs, commands end.
TEST_F(MusclesPanelTest, CommandsGoOnForAMomentWhileTheGuiIsBusy) {
  hold()->setChecked(true);
  QTest::qWait(200);
  robot_->take_commands();
  QThread::msleep(250);
  EXPECT_GE(robot_->take_commands().size(), 3U);
  QThread::msleep(150);
  robot_->take_commands();
  QThread::msleep(300);
  EXPECT_TRUE(robot_->take_commands().empty());
}

TEST_F(MusclesPanelTest, ASilentRobotIsCommandedForHalfASecondAtMost) {
  hold()->setChecked(true);
  QTest::qWait(300);
  robot_->talks = false;
  EXPECT_LE(commands_within(1000), 12U);
  EXPECT_EQ(commands_within(300), 0U);
  EXPECT_FALSE(hold()->isChecked());
  EXPECT_NE(status().find("/anthrob is silent"), std::string::npos);
  EXPECT_NE(status().find("Commands ended: the robot's states are older than 0.5 s"),
            std::string::npos);
  robot_->talks = true;
  EXPECT_EQ(commands_within(300), 0U);
}

TEST_F(MusclesPanelTest, TheButtonsHoldAllMuscles) {
  QTest::mouseClick(child<QPushButton>(panel_.get(), "hold_here"), Qt::LeftButton);
  commands_within(200);
  ASSERT_EQ(last_.size(), 2U);
  EXPECT_EQ(last_[1].value, -1.0);
  QTest::mouseClick(child<QPushButton>(panel_.get(), "relax_all"), Qt::LeftButton);
  commands_within(200);
  ASSERT_EQ(last_.size(), 2U);
  EXPECT_EQ(last_[1].mode, ControlMode::kVoltage);
  auto* all = child<QCheckBox>(panel_.get(), "hold_all");
  EXPECT_TRUE(all->isChecked());
  all->setChecked(false);
  QTest::qWait(50);
  EXPECT_EQ(commands_within(300), 0U);
}

TEST_F(MusclesPanelTest, ANumberCountsWhileItIsHeld) {
  auto* number = child<QDoubleSpinBox>(row("flexor"), "number");
  EXPECT_TRUE(number->isReadOnly());
  hold()->setChecked(true);
  QTest::qWait(200);
  EXPECT_FALSE(number->isReadOnly());
  number->setValue(2.5);
  commands_within(150);
  ASSERT_EQ(last_.size(), 1U);
  EXPECT_EQ(last_[0].value, 2.5);
}

TEST_F(MusclesPanelTest, TheWheelMovesNoMuscle) {
  hold()->setChecked(true);
  QTest::qWait(150);
  const int before = slider()->value();
  QWheelEvent turn(QPointF(5, 5), slider()->mapToGlobal(QPoint(5, 5)), {}, {0, 120}, Qt::NoButton,
                   Qt::NoModifier, Qt::NoScrollPhase, false);
  QApplication::sendEvent(slider(), &turn);
  EXPECT_EQ(slider()->value(), before);
}

TEST_F(MusclesPanelTest, TheSearchFieldFilters) {
  child<QLineEdit>(panel_.get(), "search")->setText("EXT");
  EXPECT_FALSE(row("flexor")->isVisible());
  EXPECT_TRUE(row("extensor")->isVisible());
}

TEST_F(MusclesPanelTest, AFaultSaysWhatItIs) {
  robot_->muscles[0].state = EcuState::kFault;
  robot_->diagnostics = {{"/anthrob: ecu_1",
                          Level::kError,
                          "FAULT; encoder (flexor)",
                          {{"flexor temperature", "30"}}}};
  QTest::qWait(300);
  EXPECT_EQ(child<QLabel>(row("flexor"), "remark")->text(), "FAULT; encoder (flexor)");
  EXPECT_EQ(child<QLabel>(row("flexor"), "state")->text(), "fault");
  EXPECT_EQ(status(), "/anthrob: 2 muscles, 1 enabled, 1 faulty");
}

TEST_F(MusclesPanelTest, TheRobotIsAPropertyOfTheFile) {
  rviz::Config config;
  config.mapSetValue("Robot", QString("lab/arm"));
  hold()->setChecked(true);
  panel_->load(config);
  QTest::qWait(100);
  EXPECT_EQ(robot_->connected, "/lab/arm");
  EXPECT_EQ(commands_within(300), 0U);
  rviz::Config saved;
  panel_->save(saved);
  QString robot;
  EXPECT_TRUE(saved.mapGetString("Robot", &robot));
  EXPECT_EQ(robot, "lab/arm");
}

}  // namespace
}  // namespace anthrob
