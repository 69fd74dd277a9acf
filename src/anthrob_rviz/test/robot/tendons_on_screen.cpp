// The display Tendons in RViz's view, while the simulated arm moves: tendons end at their bones in
// every picture. Started in the robot's namespace by tests/node/rviz_tendons.test, on a virtual
// screen. ANTHROB_PICTURES, a number, takes that many pictures instead of the few of a test.
#include <anthrob_msgs/ApplyWrench.h>
#include <anthrob_msgs/TendonPaths.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <map>

#include "robot/screen.h"
#include "ros/tendons_display.h"

namespace anthrob {
namespace {

constexpr double kPatience = 60.0;  // [s] of wall time, also beside other programs
constexpr double kPushTime = 0.4;   // [s]
constexpr int kPixels = 2;          // that a tendon may be away from its bone

Ogre::Vector3 to_ogre_vector(const geometry_msgs::Point& p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

int pictures() {
  const char* asked = std::getenv("ANTHROB_PICTURES");
  return asked != nullptr ? std::atoi(asked) : 12;
}

/// An end of a tendon: the link that holds it, and where.
struct Anchor {
  std::string link;
  Ogre::Vector3 point_L;
};

/// What was seen at one rate of frames.
struct Seen {
  int frames = 0;
  double tendons = 0.0;      ///< [pixels] largest distance of a tendon's end from its bone
  double markers = 0.0;      ///< the same of the markers on muscle_paths
  double motion = 0.0;       ///< of a bone from one frame to the next
  int ends = 0, unseen = 0;  ///< anchors in the picture; without a tendon's pixel beside them
};

constexpr double kThickness = 4.0;  // [mm] a slack tendon, half as thick, is nearly two pixels wide

class TendonsOnScreen : public testing::Test {
 protected:
  TendonsOnScreen() {
    paths_ = nh_.subscribe("tendon_paths", 1, &TendonsOnScreen::see_paths, this);
    markers_ = nh_.subscribe("muscle_paths", 1, &TendonsOnScreen::see_markers, this);
    push_ = nh_.serviceClient<anthrob_msgs::ApplyWrench>("sim/apply_wrench");
    timer_ = nh_.createWallTimer(ros::WallDuration(kPushTime),
                                 [this](const ros::WallTimerEvent&) { push_arm(); });
    show_tendons_only(true);
  }
  ~TendonsOnScreen() override { show_tendons_only(false); }

  /// Nothing else, on black: what is not black is a tendon.
  void show_tendons_only(bool only) {
    for (const char* other : {"Wrapping surfaces", "Markers seen by cameras"}) {
      screen_->display<rviz::Display>(other)->setEnabled(!only);
    }
    screen_->set({"Global Options", "Background Color"},
                 only ? QColor(Qt::black) : QColor(38, 40, 44));
    screen_->set({"Bones", "Visual Enabled"}, !only);
    screen_->set({"Tendons", "Legend"}, !only);
    screen_->set({"Tendons", "Thickness [mm]"}, only ? kThickness : 0.0);
  }

  void see_paths(const anthrob_msgs::TendonPaths& paths) {
    for (const auto& path : paths.muscles) {
      anchors_[path.name] = {Anchor{path.link.front(), to_ogre_vector(path.point.front())},
                             Anchor{path.link.back(), to_ogre_vector(path.point.back())}};
    }
  }
  void see_markers(const visualization_msgs::MarkerArray& markers) { last_markers_ = markers; }

  /// To and fro and sideways.
  void push_arm() {
    static const double kPushes[][2] = {{12.0, 0.0}, {-12.0, 8.0}, {0.0, -12.0}, {0.0, 8.0}};
    const double* force = kPushes[pushes_++ % 4];
    anthrob_msgs::ApplyWrench push;
    push.request.link = "forearm";
    push.request.point.z = -0.15;
    push.request.force.x = force[0], push.request.force.y = force[1];
    push.request.duration = ros::Duration(kPushTime);
    pushed_ = push_.call(push) && push.response.success;
  }

  Seen look(int frame_rate, int frames) {
    Seen seen;
    screen_->set({"Global Options", "Frame Rate"}, frame_rate);
    std::map<std::string, Ogre::Vector2> before;
    screen_->on_frame = [&] {
      if (!tendons_->visuals().empty() && drawn(*tendons_)) measure(before, seen);
    };
    EXPECT_TRUE(screen_->wait_for([&] { return seen.frames >= frames; }, kPatience + frames));
    screen_->on_frame = nullptr;
    return seen;
  }

  static bool drawn(const TendonsDisplay& display) {
    return std::all_of(display.visuals().begin(), display.visuals().end(), [](const auto& visual) {
      return !visual->tube_object().getSections().empty();
    });
  }

  void measure(std::map<std::string, Ogre::Vector2>& before, Seen& seen) {
    const auto picture = screen_->picture();
    for (const auto& visual : tendons_->visuals()) {
      const std::string& name = visual->facts().name;
      for (const int end : {0, 1}) {
        const Anchor& anchor = anchors_.at(name).at(static_cast<std::size_t>(end));
        const Ogre::Vector2 bone = screen_->pixel(on_bone(bones_, anchor.link, anchor.point_L));
        const auto& object = visual->tube_object();
        const Ogre::Vector2 drawn_at =
            screen_->pixel(end == 0 ? first_end(object) : last_end(object));
        seen.tendons = std::max(seen.tendons, static_cast<double>(drawn_at.distance(bone)));
        const std::string key = name + std::to_string(end);
        if (before.count(key) > 0) {
          seen.motion = std::max(seen.motion, static_cast<double>(before[key].distance(bone)));
        }
        before[key] = bone;
        find_pixel(*screen_, picture, bone, seen);
        compare_marker(*screen_, name, end, bone, seen);
      }
    }
    ++seen.frames;
  }

  static void find_pixel(Screen& screen, const std::vector<std::uint32_t>& picture,
                         const Ogre::Vector2& bone, Seen& seen) {
    const int x = static_cast<int>(bone.x), y = static_cast<int>(bone.y);
    if (x < kPixels || y < kPixels || x + kPixels >= screen.width() ||
        y + kPixels >= screen.height()) {
      return;
    }
    ++seen.ends;
    for (int row = y - kPixels; row <= y + kPixels; ++row) {
      const std::size_t begin =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(screen.width());
      for (int column = x - kPixels; column <= x + kPixels; ++column) {
        if (picture[begin + static_cast<std::size_t>(column)] != 0u) return;
      }
    }
    ++seen.unseen;
  }

  void compare_marker(Screen& screen, const std::string& name, int end, const Ogre::Vector2& bone,
                      Seen& seen) {
    for (const auto& marker : last_markers_.markers) {
      if (marker.ns != name || marker.points.empty()) continue;
      const auto& point = end == 0 ? marker.points.front() : marker.points.back();
      const double away = static_cast<double>(screen.pixel(to_ogre_vector(point)).distance(bone));
      seen.markers = std::max(seen.markers, away);
    }
  }

  ros::NodeHandle nh_;
  ros::Subscriber paths_, markers_;
  ros::ServiceClient push_;
  ros::WallTimer timer_;
  std::map<std::string, std::vector<Anchor>> anchors_;
  visualization_msgs::MarkerArray last_markers_;
  std::size_t pushes_ = 0;
  bool pushed_ = false;
  Screen* screen_ = shared_screen().get();
  TendonsDisplay* tendons_ = screen_->display<TendonsDisplay>("Tendons");
  rviz::RobotModelDisplay* bones_ = screen_->display<rviz::RobotModelDisplay>("Bones");
};

TEST_F(TendonsOnScreen, TendonsEndAtTheirBonesInEveryPicture) {
  for (const int frame_rate : {3, 10, 30}) {
    const Seen seen = look(frame_rate, pictures());
    std::cout << frame_rate << " frames/s: " << seen.frames << " pictures, a bone moves up to "
              << seen.motion << " pixels between two; tendons end up to " << seen.tendons
              << " pixels beside it, markers " << seen.markers << "; " << seen.unseen << " of "
              << seen.ends << " ends are not seen within " << kPixels << " pixels" << std::endl;
    EXPECT_GE(seen.frames, pictures());
    EXPECT_LT(seen.tendons, kPixels);
    EXPECT_LE(20 * seen.unseen, seen.ends) << "more than bones can hide";
    EXPECT_GT(seen.ends, 10 * seen.frames);
    EXPECT_TRUE(pushed_);
    EXPECT_GT(seen.motion, kPixels) << "the arm does not move: nothing was tested";
  }
}

}  // namespace
}  // namespace anthrob

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (std::getenv("DISPLAY") == nullptr) {
    std::cout << "[  SKIPPED ] no screen: xvfb is not installed" << std::endl;
    return 0;
  }
  QApplication application(argc, argv);
  ros::init(argc, argv, "rviz_tendons");
  const int result = RUN_ALL_TESTS();
  anthrob::shared_screen().reset();
  return result;
}
