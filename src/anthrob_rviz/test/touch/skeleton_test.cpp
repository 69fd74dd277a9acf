#include "touch/skeleton.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "anthrob_core/errors.h"
#include "touch/ball_centers.h"

namespace anthrob {
namespace {

const std::string kFolder = ANTHROB_CONFIG_DIR "/anthrob/";

std::string text_of_file(const std::string& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

Skeleton anthrob_arm() {
  return {text_of_file(kFolder + "robot.urdf"), ball_centers(kFolder + "model_II.yaml")};
}

TEST(Skeleton, HasLinksAfterTheirParents) {
  const Skeleton arm = anthrob_arm();
  ASSERT_EQ(arm.links().size(), 4u);
  const auto forearm = arm.find("forearm");
  ASSERT_TRUE(forearm.has_value());
  EXPECT_EQ(arm.links()[*arm.links()[*forearm].parent].name, "humerus");
  EXPECT_EQ(arm.child_of("elbow"), forearm);
  EXPECT_FALSE(arm.find("tibia").has_value());
  EXPECT_FALSE(arm.links()[0].parent.has_value());
  EXPECT_TRUE(arm.has(JointKind::kBall));
  EXPECT_FALSE(arm.has(JointKind::kSlide));
}

TEST(Skeleton, KnowsWhatMoves) {
  const Skeleton arm = anthrob_arm();
  for (const auto& link : arm.links()) {
    EXPECT_EQ(link.moves, link.name == "humerus" || link.name == "forearm") << link.name;
  }
  const SkeletonLink& forearm = arm.links()[*arm.find("forearm")];
  EXPECT_NEAR(forearm.middle.y(), -0.0778, 1e-12);
  ASSERT_EQ(forearm.shapes.size(), 4u);
  EXPECT_NEAR(forearm.shapes[1].size.x(), 0.015, 1e-12);
  EXPECT_NEAR(*forearm.joint.hi, 2.356194490192345, 1e-12);
}

TEST(Skeleton, ABallJointTurnsAboutItsCenter) {
  const Skeleton arm = anthrob_arm();
  const std::size_t humerus = *arm.find("humerus");
  const Vec3 center(0.0, 0.22, 0.0);
  Posture posture = arm.rest();
  const Vec3 before = arm.pose(humerus, posture) * center;
  posture[humerus].rotation = Quat(Eigen::AngleAxisd(0.7, Vec3(0.6, 0.0, 0.8)));
  const Pose turned = arm.pose(humerus, posture);
  EXPECT_NEAR((turned * center - before).norm(), 0.0, 1e-12);
  EXPECT_GT((turned.p - arm.pose(humerus, arm.rest()).p).norm(), 0.1);
}

TEST(Skeleton, AHingeTurnsAboutItsAxis) {
  const Skeleton arm = anthrob_arm();
  Posture posture = arm.rest();
  posture[*arm.find("forearm")].q = M_PI / 2.0;
  const std::vector<Pose> X_WL = arm.poses(posture);
  const Pose& upper = X_WL[*arm.find("humerus")];
  // The wrist, 0.2 m below the elbow, is 0.2 m in front of it, on the flexor's side.
  const Vec3 wrist = upper.to_local(X_WL[*arm.find("forearm")] * Vec3(0.0, -0.2, 0.0));
  EXPECT_NEAR((wrist - Vec3(0.0, 0.0, 0.2)).norm(), 0.0, 1e-12);
  for (std::size_t i = 0; i < X_WL.size(); ++i) {
    EXPECT_NEAR((arm.pose(i, posture).p - X_WL[i].p).norm(), 0.0, 1e-12);
  }
}

TEST(Skeleton, ASlideMovesAlongItsAxis) {
  const Skeleton press(R"(<robot name="press"><link name="frame"/><link name="ram"/>
    <joint name="drive" type="prismatic"><parent link="frame"/><child link="ram"/>
    <origin xyz="0 0 1"/><axis xyz="0 2 0"/>
    <limit lower="0" upper="0.1" effort="0" velocity="0"/></joint></robot>)",
                       {});
  Posture posture = press.rest();
  posture[1].q = 0.05;
  EXPECT_NEAR((press.pose(1, posture).p - Vec3(0.0, 0.05, 1.0)).norm(), 0.0, 1e-12);
}

TEST(Skeleton, RefusesWhatIsNoRobotOfThisSuite) {
  EXPECT_THROW(Skeleton("no XML", {}), BadInput);
  const std::string planar = R"(<robot name="cart"><link name="floor"/><link name="cart"/>
    <joint name="wheels" type="planar"><parent link="floor"/><child link="cart"/></joint></robot>)";
  try {
    Skeleton cart(planar, {});
    FAIL();
  } catch (const BadInput& error) {
    EXPECT_NE(std::string(error.what()).find("joint wheels: expected revolute"), std::string::npos)
        << error.what();
  }
}

TEST(Skeleton, ReadsEveryRobotOfTheSuite) {
  for (const std::string robot :
       {"anthrob/robot_hand", "anthrob/robot_tier1", "torso_100/robot", "driven_axis/robot",
        "two_muscle_rig/robot", "rig_ecu_load/robot", "rig_eyelet_pull/robot"}) {
    const Skeleton skeleton(text_of_file(ANTHROB_CONFIG_DIR "/" + robot + ".urdf"), {});
    EXPECT_GT(skeleton.links().size(), 1u) << robot;
    for (const auto& link : skeleton.links()) {
      const JointKind kind = link.joint.kind;
      const bool has_axis = kind == JointKind::kHinge || kind == JointKind::kSlide;
      EXPECT_NEAR(link.joint.axis.norm(), has_axis || !link.parent ? 1.0 : 0.0, 1e-9)
          << robot << link.name;
    }
  }
}

TEST(BallCenters, ComeFromTheModelAndWhatItExtends) {
  const auto centers = ball_centers(kFolder + "model_II.yaml");
  ASSERT_EQ(centers.size(), 1u);
  EXPECT_EQ(centers.at("shoulder"), Vec3(0.0, 0.22, 0.0));
  EXPECT_THROW(ball_centers(kFolder + "model_IV.yaml"), BadInput);
}

}  // namespace
}  // namespace anthrob
