#include "tendon.h"

#include <gtest/gtest.h>

#include "tendon_status.h"

namespace anthrob {
namespace {

const Pose kTurned{Mat3(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitZ())), Vec3(1.0, 0.0, 0.0)};

std::optional<Pose> base_and_arm(const std::string& link) {
  if (link == "base") return Pose();
  if (link == "arm") return kTurned;
  return std::nullopt;
}

Tendon tendon(const std::vector<LinkPoint>& points) {
  Tendon result;
  result.name = "biceps";
  result.points = points;
  return result;
}

TEST(PlacedTendons, EachPointMovesWithItsLink) {
  const auto placed = place({tendon({{"base", {0, 0, 1}}, {"arm", {0.5, 0, 0}}})}, base_and_arm);
  ASSERT_EQ(placed.lines.size(), 1u);
  ASSERT_EQ(placed.lines[0].size(), 2u);
  EXPECT_LT((placed.lines[0][0] - Vec3(0, 0, 1)).norm(), 1e-12);
  EXPECT_LT((placed.lines[0][1] - Vec3(1.0, 0.5, 0)).norm(), 1e-12);
  EXPECT_TRUE(placed.lost.empty());
}

TEST(PlacedTendons, ALinkIsAskedForOnce) {
  // Another answer within a frame would tear a tendon apart.
  int asked = 0;
  const auto tendons = std::vector<Tendon>(3, tendon({{"arm", {0, 0, 0}}, {"arm", {1, 0, 0}}}));
  place(tendons, [&](const std::string&) {
    ++asked;
    return Pose();
  });
  EXPECT_EQ(asked, 1);
}

TEST(PlacedTendons, WithoutALinkTheTendonIsNotDrawnAndTheOthersAre) {
  const auto placed = place({tendon({{"base", {0, 0, 1}}, {"hand", {0, 0, 0}}}),
                             tendon({{"base", {0, 0, 1}}, {"arm", {0, 0, 0}}})},
                            base_and_arm);
  EXPECT_TRUE(placed.lines[0].empty());
  EXPECT_EQ(placed.lines[1].size(), 2u);
  EXPECT_EQ(placed.lost, std::set<std::string>{"hand"});
  EXPECT_EQ(placed.links.size(), 3u);
}

TEST(TendonLine, LengthAndMiddle) {
  const std::vector<Vec3> line = {{0, 0, 0}, {3, 0, 0}, {3, 0, 0}, {3, 1, 0}};
  EXPECT_DOUBLE_EQ(line_length(line), 4.0);
  EXPECT_LT((middle_of(line) - Vec3(2, 0, 0)).norm(), 1e-12);
  EXPECT_EQ(middle_of({{1, 2, 3}}), Vec3(1, 2, 3));
  EXPECT_EQ(middle_of({{1, 2, 3}, {1, 2, 3}}), Vec3(1, 2, 3));
}

TEST(TendonThickness, GrowsWithTheRobot) {
  const std::vector<Vec3> line = {{0, 0, 0}, {0.2, 0, 0}};
  const std::vector<Vec3> twice = {{0, 0, 0}, {0.4, 0, 0}};
  const double thickness = fitting_thickness({line, line, {}});
  EXPECT_GT(thickness, 0.0);
  EXPECT_NEAR(fitting_thickness({twice, twice}), 2.0 * thickness, 1e-12);
  EXPECT_GT(fitting_thickness({}), 0.0);
}

TEST(TendonStatus, SaysWhatIsWrong) {
  TendonFeed feed;
  feed.topic = "/anthrob/tendon_paths";
  EXPECT_EQ(feed_status(feed).level, Level::kWarning);
  EXPECT_NE(feed_status(feed).text.find("nobody publishes /anthrob/tendon_paths"),
            std::string::npos);
  feed.publishers = 1;
  EXPECT_EQ(feed_status(feed).text, "no message on /anthrob/tendon_paths yet");
  feed.age = 0.1, feed.tendons = 11;
  EXPECT_EQ(feed_status(feed).level, Level::kOk);
  EXPECT_EQ(feed_status(feed).text, "11 tendons");
  feed.age = 3.2;
  EXPECT_EQ(feed_status(feed).level, Level::kWarning);
  EXPECT_EQ(feed_status(feed).text,
            "no message on /anthrob/tendon_paths for 3 s: forces are not shown");
  feed.wrong = "biceps: 3 links and 4 points, expected as many";
  EXPECT_EQ(feed_status(feed).level, Level::kError);
}

TEST(TendonStatus, NamesLinksThatTfLacks) {
  EXPECT_EQ(link_status({"base", "arm"}, {}).level, Level::kOk);
  const StatusLine line = link_status({"base", "arm", "hand"}, {"arm", "hand"});
  EXPECT_EQ(line.level, Level::kError);
  EXPECT_EQ(line.text.rfind("not in tf: arm, hand", 0), 0u);
}

}  // namespace
}  // namespace anthrob
