// The drawing of a robot in the report: what is marked, and where it lies.
#include "report/robot_figure.h"

#include <gtest/gtest.h>

#include <regex>

#include "anthrob_sim/model/robot_model.h"

namespace anthrob {
namespace discovery {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

std::string drawn(const std::vector<std::string>& places) {
  static const auto robot = load_robot_model(ANTHROB_CONFIG_DIR "/anthrob/model_I.yaml");
  return robot_figure(*robot, places);
}

TEST(RobotFigure, MarksMusclesEntriesOfPathsJointsAndBodiesInBothViews) {
  const std::string plain = drawn({"global"});
  EXPECT_EQ(count(plain, "class=\"mark\""), 0u);
  EXPECT_EQ(count(plain, "class=\"muscle\""), 2u * 11u);
  for (const std::string place : {"elbow", "forearm", "brachialis", "brachialis/0"}) {
    const std::string svg = drawn({place});
    EXPECT_EQ(count(svg, "class=\"mark\""), 2u) << place;
    EXPECT_EQ(count(svg, ">" + place + "<"), 2u) << place;
  }
  EXPECT_EQ(count(drawn({"brachialis"}), "class=\"muscle marked\""), 2u);
  EXPECT_EQ(count(drawn({"brachialis/biceps_brachii"}), "class=\"muscle marked\""), 4u);
}

TEST(RobotFigure, TheElbowHangsBelowTheShoulder) {
  const std::string svg = drawn({"elbow", "shoulder"});
  std::vector<double> heights;  // in the order of joints: shoulder, elbow; the page's y goes down
  const std::regex circle("cy=\"([0-9.]+)\"");
  for (std::sregex_iterator it(svg.begin(), svg.end(), circle), end; it != end; ++it) {
    heights.push_back(std::stod((*it)[1]));
  }
  ASSERT_EQ(heights.size(), 4u);
  EXPECT_GT(heights[1], heights[0] + 50.0);
  EXPECT_DOUBLE_EQ(heights[0], heights[2]);  // the same height in both views
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
