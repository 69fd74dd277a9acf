// The real panels on a running robot: what a hand on the mouse does, asserted on topics. Started in
// the robot's namespace by tests/node/rviz_panels.test.
#include <anthrob_msgs/Gains.h>
#include <anthrob_msgs/MuscleCommand.h>
#include <anthrob_msgs/MuscleStates.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <ros/service.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/JointState.h>
#include <unistd.h>

#include <QFile>
#include <QPushButton>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>

#include "anthrob_core/monotonic_clock.h"
#include "panel/gains_panel.h"
#include "panel/gui.h"
#include "panel/muscles_panel.h"
#include "panel/record_panel.h"
#include "panel/robot_panel.h"
#include "plot/scope_widget.h"
#include "ros/scope/scope_over_ros.h"

namespace anthrob {
namespace {

const char* const kMuscle = "biceps_brachii";
constexpr double kPatience = 20.0;  // [s] of the robot, also beside other programs

class PanelsOnRobot : public testing::Test {
 protected:
  PanelsOnRobot() {
    subscribers_.push_back(nh_.subscribe("muscle_states", 1, &PanelsOnRobot::see_muscles, this));
    subscribers_.push_back(nh_.subscribe("joint_states", 1, &PanelsOnRobot::see_joints, this));
    subscribers_.push_back(nh_.subscribe("muscle_command", 100, &PanelsOnRobot::count, this));
    muscles_.resize(430, 900);
    muscles_.show();
    robot_.show();
  }

  void see_muscles(const anthrob_msgs::MuscleStates& states) {
    const auto found = std::find(states.name.begin(), states.name.end(), kMuscle);
    if (found == states.name.end()) return;
    const auto i = static_cast<std::size_t>(found - states.name.begin());
    position_ = states.position[i], voltage_ = states.voltage[i], state_ = states.ecu_state[i];
  }
  void see_joints(const sensor_msgs::JointState& joints) { elbow_ = joints.position.at(0); }
  void count(const anthrob_msgs::MuscleCommand&) { ++commands_; }

  template <class Condition>
  bool wait_for(Condition condition) {
    const double end = monotonic_now() + kPatience / ros::param::param("~pace", 1.0);
    while (!condition() && monotonic_now() < end) wait(0.02);
    return condition();
  }
  void wait(double time) {
    QTest::qWait(static_cast<int>(std::lround(1e3 * time)));
    ros::spinOnce();
  }
  int commands_within(double time) {
    ros::spinOnce();
    commands_ = 0;
    wait(time);
    return commands_;
  }

  template <class Widget>
  Widget* of_muscle(const char* name) {
    return child<Widget>(child<QWidget>(&muscles_, kMuscle), name);
  }
  bool connected() {
    return wait_for([&] { return child<QWidget>(&muscles_, kMuscle) && !std::isnan(elbow_); });
  }
  void click(const char* button) {
    QTest::mouseClick(child<QPushButton>(&robot_, button), Qt::LeftButton);
  }
  std::string answer() { return child<QLabel>(&robot_, "answer")->text().toStdString(); }
  bool answered(const std::string& text) {
    return wait_for([&] { return answer().rfind(text, 0) == 0; });
  }
  /// The mouse on the biceps' slider winds its tendon.
  void drag_slider() {
    auto* slider = of_muscle<QSlider>("slider");
    QTest::mousePress(slider, Qt::LeftButton, {}, handle_of(slider));
    wait(0.3);
    drag(slider, 40);
  }
  bool stopped() {
    return wait_for(
        [&] { return state_ != anthrob_msgs::MuscleStates::ENABLED && voltage_ == 0.0; });
  }

  ros::NodeHandle nh_;
  std::vector<ros::Subscriber> subscribers_;
  double position_ = 0.0, voltage_ = 0.0, elbow_ = std::nan("");
  int state_ = 0, commands_ = 0;
  MusclesPanel muscles_;
  RobotPanel robot_;
};

TEST_F(PanelsOnRobot, ASliderMovesTheArmAndStopStopsIt) {
  ASSERT_TRUE(connected());
  EXPECT_EQ(commands_within(0.5), 0);
  click("enable");  // a simulator is enabled from the start
  EXPECT_TRUE(answered("enable: done")) << answer();
  const double begin = position_, angle = elbow_;
  drag_slider();
  EXPECT_TRUE(wait_for([&] { return position_ > begin + 1.0; })) << position_;
  EXPECT_TRUE(wait_for([&] { return std::abs(elbow_ - angle) > 0.05; })) << elbow_ - angle;
  const int count = commands_within(1.0);
  EXPECT_GE(count, 10);
  EXPECT_LE(count, 21);
  click("stop");
  EXPECT_TRUE(answered("STOP (disable): done")) << answer();
  EXPECT_TRUE(stopped());
  // The mouse is still down, and nothing more is sent.
  EXPECT_TRUE(wait_for([&] { return commands_within(0.3) == 0; }));
  QTest::mouseRelease(of_muscle<QSlider>("slider"), Qt::LeftButton);
}

TEST_F(PanelsOnRobot, TheSpaceBarStopsWhatIsHeld) {
  ASSERT_TRUE(connected());
  click("enable");
  EXPECT_TRUE(answered("enable: done")) << answer();
  of_muscle<QCheckBox>("hold")->setChecked(true);
  EXPECT_TRUE(wait_for([&] { return commands_within(0.5) > 4; }));
  QTest::keyClick(&muscles_, Qt::Key_Space);
  EXPECT_TRUE(stopped());
  EXPECT_TRUE(wait_for([&] { return commands_within(0.3) == 0; }));
  EXPECT_TRUE(wait_for([&] { return !of_muscle<QCheckBox>("hold")->isChecked(); }));
  EXPECT_EQ(of_muscle<QLabel>("remark")->text(), "the robot stopped this motor");
}

TEST_F(PanelsOnRobot, AClosedPanelLeavesTheMotorsToTheirTimeOut) {
  ASSERT_TRUE(connected());
  click("enable");
  EXPECT_TRUE(answered("enable: done")) << answer();
  of_muscle<QCheckBox>("hold")->setChecked(true);
  EXPECT_TRUE(wait_for(
      [&] { return commands_within(0.2) > 0 && state_ == anthrob_msgs::MuscleStates::ENABLED; }));
  muscles_.close();
  EXPECT_TRUE(stopped());
  EXPECT_EQ(commands_within(0.3), 0);
}

TEST_F(PanelsOnRobot, APausedSimulatorIsSilentAndEndsAHold) {
  ASSERT_TRUE(connected());
  click("enable");
  EXPECT_TRUE(answered("enable: done")) << answer();
  ASSERT_TRUE(wait_for([&] { return child<QWidget>(&robot_, "simulator")->isVisible(); }));
  of_muscle<QCheckBox>("hold")->setChecked(true);
  EXPECT_TRUE(wait_for([&] { return commands_within(0.2) > 0; }));
  click("pause");
  EXPECT_TRUE(answered("sim/pause: done")) << answer();
  EXPECT_TRUE(wait_for([&] { return !of_muscle<QCheckBox>("hold")->isChecked(); }));
  EXPECT_EQ(commands_within(0.3), 0);
  click("continue");
  EXPECT_TRUE(
      wait_for([&] { return child<QLabel>(&muscles_, "status")->text().contains("11 m"); }));
  EXPECT_EQ(commands_within(0.3), 0);
}

TEST_F(PanelsOnRobot, AntagonistsAreThoseOfTheModel) {
  ASSERT_TRUE(connected());
  auto* group = child<QComboBox>(&muscles_, "group");
  ASSERT_TRUE(wait_for([&] { return group->findText("elbow -") > 0; }));
  const auto shown = [&](const char* muscle) {
    return child<QWidget>(&muscles_, muscle)->isVisible();
  };
  for (const bool flexors : {true, false}) {
    group->setCurrentIndex(group->findText(flexors ? "elbow +" : "elbow -"));
    EXPECT_EQ(shown("biceps_brachii"), flexors);
    EXPECT_EQ(shown("brachialis"), flexors);
    EXPECT_EQ(shown("triceps_brachii"), !flexors);
    EXPECT_FALSE(shown("lateral_deltoid"));
  }
}

TEST_F(PanelsOnRobot, ARecordingIsABagThatIsWhole) {
  ASSERT_TRUE(connected());
  const std::string file = "/tmp/anthrob_record_" + std::to_string(getpid()) + ".bag";
  auto panel = std::make_unique<RecordPanel>();
  panel->show();
  wait(0.3);  // until it is connected
  child<QLineEdit>(panel.get(), "file")->setText(file.c_str());
  auto* button = child<QPushButton>(panel.get(), "record");
  auto* answer = child<QLabel>(panel.get(), "answer");
  QTest::mouseClick(button, Qt::LeftButton);
  ASSERT_TRUE(wait_for([&] { return QFile::exists((file + ".active").c_str()); }))
      << answer->text().toStdString();
  wait(1.5);
  EXPECT_TRUE(answer->text().startsWith("recording " + QString(file.c_str())));
  QTest::mouseClick(button, Qt::LeftButton);
  EXPECT_TRUE(wait_for([&] { return answer->text().startsWith("wrote " + QString(file.c_str())); }))
      << answer->text().toStdString();
  const auto states_in = [](const std::string& bag) {
    return rosbag::View(rosbag::Bag(bag), rosbag::TopicQuery("/anthrob/muscle_states")).size();
  };
  EXPECT_GT(states_in(file), 10U);
  std::remove(file.c_str());
  // And if the panel closes meanwhile.
  child<QLineEdit>(panel.get(), "file")->setText(file.c_str());
  QTest::mouseClick(button, Qt::LeftButton);
  ASSERT_TRUE(wait_for([&] { return QFile::exists((file + ".active").c_str()); }));
  wait(1.5);
  panel.reset();
  EXPECT_GT(states_in(file), 10U);
  std::remove(file.c_str());
}

TEST_F(PanelsOnRobot, GainsAreChangedUndoneAndSaved) {
  ASSERT_TRUE(connected());
  GainsPanel gains;
  gains.show();
  auto* muscle = child<QComboBox>(&gains, "muscle");
  ASSERT_TRUE(wait_for([&] { return muscle->findText(kMuscle) > 0; }));
  muscle->setCurrentIndex(muscle->findText(kMuscle));
  wait(0.3);
  const auto held = [&] {
    anthrob_msgs::Gains call;
    EXPECT_TRUE(ros::service::call(nh_.resolveName("gains"), call));
    for (std::size_t i = 0; i < call.response.held_muscle.size(); ++i) {
      if (call.response.held_muscle[i] == kMuscle &&
          call.response.held_gain[i] == "position_proportional") {
        return call.response.held_value[i];
      }
    }
    return std::nan("");
  };
  const double before = held();
  auto* number = child<QDoubleSpinBox>(&gains, "position_proportional");
  EXPECT_NEAR(number->value(), before, 1e-5);
  number->setValue(before + 0.5);
  EXPECT_TRUE(wait_for([&] { return std::abs(held() - before - 0.5) < 1e-5; })) << held();
  const std::string file = "/tmp/anthrob_gains_" + std::to_string(getpid()) + ".yaml";
  gains.save_as(file);
  auto* answer = child<QLabel>(&gains, "answer");
  EXPECT_TRUE(wait_for([&] { return answer->text().startsWith("done: " + QString(file.c_str())); }))
      << answer->text().toStdString();
  std::ifstream saved(file);
  const std::string text((std::istreambuf_iterator<char>(saved)), {});
  EXPECT_NE(text.find("position_proportional"), std::string::npos) << text;
  std::remove(file.c_str());
  auto* undo = child<QPushButton>(&gains, "undo");
  ASSERT_TRUE(wait_for([&] { return undo->isEnabled(); }));
  QTest::mouseClick(undo, Qt::LeftButton);
  EXPECT_TRUE(wait_for([&] { return std::abs(held() - before) < 1e-6; })) << held();
}

TEST_F(PanelsOnRobot, TheScopePlotsWhatTheRobotSends) {
  ASSERT_TRUE(connected());
  ScopeWidget scope(scope_over_ros());
  scope.show();
  const std::string topic = nh_.resolveName("muscle_states"), path = topic + "/force/" + kMuscle;
  ASSERT_TRUE(wait_for([&] { return scope.model().master().topics.count(topic) > 0; }));
  scope.model().look_into({topic});
  ASSERT_TRUE(wait_for([&] { return scope.model().quantities().count(path) > 0; }));
  EXPECT_EQ(scope.model().quantities().at(path).unit, "N");
  scope.tick({path});
  const auto samples = [&] {
    const auto curves = scope.model().curves();
    return curves.empty() ? SampleSpan() : curves[0].samples;
  };
  ASSERT_TRUE(wait_for([&] { return samples().size() > 500; }));
  // None is lost: the simulator sends one every 2 ms.
  const SampleSpan all = samples();
  for (std::size_t i = 1; i < all.size(); ++i) {
    ASSERT_EQ(all.begin()[i].t - all.begin()[i - 1].t, 2000000) << i;
  }
}

}  // namespace
}  // namespace anthrob

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  anthrob::begin_application();
  ros::init(argc, argv, "rviz_panels");
  return RUN_ALL_TESTS();
}
