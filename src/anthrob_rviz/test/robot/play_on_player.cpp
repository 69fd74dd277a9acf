// The real panel on a real player: what a hand on the mouse does, asserted on topics. Started by
// tests/node/rviz_play.test.
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <rosbag/bag.h>
#include <sensor_msgs/JointState.h>

#include <QProcess>
#include <QTemporaryDir>

#include "anthrob_core/monotonic_clock.h"
#include "panel/gui.h"
#include "panel/play_panel.h"

namespace anthrob {
namespace {

constexpr double kLong = 100.0;  // [s] no test plays so far

class PlayOnPlayer : public testing::Test {
 protected:
  PlayOnPlayer() {
    file_ = folder_.filePath("run.bag");
    write_bag();
    joints_ = nh_.subscribe("joint_states", 1000, &PlayOnPlayer::see, this);
    player_.start("rosrun", {"anthrob_recorder", "anthrob_player", "_bag:=" + file_});
    panel_.resize(500, 200);
    panel_.show();
  }
  ~PlayOnPlayer() override {
    player_.terminate();
    player_.waitForFinished();
  }

  /// A joint whose angle is the time.
  void write_bag() const {
    rosbag::Bag bag(file_.toStdString(), rosbag::bagmode::Write);
    for (int i = 0; i <= 100 * static_cast<int>(kLong); ++i) {
      sensor_msgs::JointState joint;
      joint.header.stamp = ros::Time(1000.0 + 0.01 * i);
      joint.name = {"elbow"};
      joint.position = {0.01 * i};
      bag.write(nh_.resolveName("joint_states"), joint.header.stamp, joint);
    }
  }
  void see(const sensor_msgs::JointState& joint) { angle_ = joint.position.at(0), ++seen_; }

  template <class Condition>
  bool wait_for(Condition condition) {
    const double end = monotonic_now() + 20.0;
    while (!condition() && monotonic_now() < end) wait(0.02);
    return condition();
  }
  void wait(double time) {
    QTest::qWait(static_cast<int>(1e3 * time));
    ros::spinOnce();
  }
  bool still() {
    const int seen = seen_;
    wait(0.3);
    return seen_ == seen;
  }
  template <class Widget>
  Widget* widget(const char* name) {
    return child<Widget>(&panel_, name);
  }
  void click_pause() { QTest::mouseClick(widget<QPushButton>("pause"), Qt::LeftButton); }

  ros::NodeHandle nh_;
  QTemporaryDir folder_;
  QString file_;
  QProcess player_;
  ros::Subscriber joints_;
  double angle_ = -1.0;
  int seen_ = 0;
  PlayPanel panel_;
};

TEST_F(PlayOnPlayer, TheBarGoesToAnyPlace) {
  ASSERT_TRUE(wait_for([&] { return angle_ > 0.2 && widget<QSlider>("bar")->isEnabled(); }));
  EXPECT_EQ(widget<QLabel>("file")->text(), file_);
  click_pause();
  ASSERT_TRUE(wait_for([&] { return still(); }));
  auto* bar = widget<QSlider>("bar");
  QTest::mousePress(bar, Qt::LeftButton, {}, handle_of(bar));
  drag(bar, bar->width() / 2);
  const double there = kLong * bar->sliderPosition() / bar->maximum();
  ASSERT_GT(there, 0.4 * kLong);
  EXPECT_TRUE(wait_for([&] { return std::abs(angle_ - there) < 0.02; })) << angle_;
  drag(bar, -bar->width() / 4);  // and back, while the clock stands
  const double back = kLong * bar->sliderPosition() / bar->maximum();
  EXPECT_LT(back, there);
  EXPECT_TRUE(wait_for([&] { return std::abs(angle_ - back) < 0.02; })) << angle_;
  QTest::mouseRelease(bar, Qt::LeftButton);
  EXPECT_TRUE(still());
  click_pause();
  EXPECT_TRUE(wait_for([&] { return angle_ > back + 0.5 && angle_ < back + 20.0; })) << angle_;
}

TEST_F(PlayOnPlayer, TheRateIsThatOfThePanel) {
  ASSERT_TRUE(wait_for([&] { return angle_ > 0.2 && widget<QSlider>("bar")->isEnabled(); }));
  widget<QDoubleSpinBox>("rate")->setValue(10.0);
  wait(0.3);
  const double begin = angle_, time = monotonic_now();
  wait(2.0);
  const double rate = (angle_ - begin) / (monotonic_now() - time);
  EXPECT_GT(rate, 5.0);
  EXPECT_LT(rate, 15.0);
}

}  // namespace
}  // namespace anthrob
