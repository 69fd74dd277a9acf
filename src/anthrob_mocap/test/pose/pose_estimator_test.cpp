// Poses of targets and the joint between them, from exact and from noisy centroids.
#include "pose/pose_estimator.h"

#include <gtest/gtest.h>

#include <random>

#include "joint/joint_estimator.h"
#include "support.h"

namespace anthrob {
namespace mocap {
namespace {

using test::kDegree;
using test::make_rig;
using test::make_targets;

TEST(RigidFit, RecoversRandomPosesAndNeverMirrors) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 200; ++i) {
    const Pose X{exp_rotation(Vec3(normal(random), normal(random), normal(random))),
                 {normal(random), normal(random), normal(random)}};
    PointPairs pairs, mirrored;
    for (int k = 0; k < 3 + i % 5; ++k) {
      const Vec3 p(normal(random), normal(random), normal(random));
      pairs.add(p, X * p);
      mirrored.add(p, X * Vec3(-p.x(), p.y(), p.z()));
    }
    const RigidFit fit = fit_rigid(pairs);
    EXPECT_LT(angular_distance(fit.X.R, X.R), 1e-6);
    EXPECT_LT((fit.X.p - X.p).norm(), 1e-8);
    EXPECT_NEAR(fit_rigid(mirrored).X.R.determinant(), 1.0, 1e-9);
  }
}

/// What the stages before would hand on for a target at X, with noise on the centroids.
class OneTarget : public ::testing::Test {
 protected:
  Labelling see(const Pose& X, std::vector<int> markers, double noise) {
    points_.clear();
    Labelling labelling;
    labelling.point.assign(5, -1);
    PointPairs pairs;
    std::normal_distribution<double> pixel(0.0, noise * rig_.zoom());
    for (const int i : markers) {
      const Vec3 p = X * target_.markers[static_cast<std::size_t>(i)];
      MarkerPoint point;
      for (const Side side : {kLeft, kRight}) {
        point.image[side] = rig_.project_rectified(side, p) + Vec2(pixel(random_), pixel(random_));
      }
      point.p = rig_.triangulate(point.image[kLeft], point.image[kRight]);
      labelling.point[static_cast<std::size_t>(i)] = static_cast<int>(points_.size());
      pairs.add(target_.markers[static_cast<std::size_t>(i)], point.p);
      points_.push_back(point);
    }
    labelling.count = static_cast<int>(markers.size());
    if (labelling.count >= 3) labelling.fit = fit_rigid(pairs);
    return labelling;
  }

  StereoRig rig_ = make_rig();
  MarkerTarget target_ = make_targets().targets[0];
  PoseOptions options_;
  std::mt19937_64 random_{4};
  std::vector<MarkerPoint> points_;
};

TEST_F(OneTarget, IsExactWithoutNoise) {
  const PoseEstimator estimator(rig_, {target_}, options_);
  const Pose X = test::rest_poses()[0];
  const TargetPose pose = estimator.estimate(0, see(X, {0, 1, 2, 3, 4}, 0.0), points_);
  EXPECT_TRUE(pose.valid);
  EXPECT_LT(angular_distance(pose.X.R, X.R), 1e-7);
  EXPECT_LT((pose.X.p - X.p).norm(), 1e-9);
}

TEST_F(OneTarget, BeatsTheClosedFormAndKnowsItsCovariance) {
  options_.pixel_noise = 0.03;
  const PoseEstimator estimator(rig_, {target_}, options_);
  const Pose X = test::rest_poses()[0];
  double refined = 0.0, closed = 0.0, normalized = 0.0;
  const int trials = 500;
  for (int i = 0; i < trials; ++i) {
    const Labelling labelling = see(X, {0, 1, 2, 3, 4}, 0.03);
    const TargetPose pose = estimator.estimate(0, labelling, points_);
    Eigen::Matrix<double, 6, 1> error;
    error << pose.X.p - X.p, log_rotation(pose.X.R * X.R.transpose());
    refined += error.tail<3>().squaredNorm() / trials;
    closed += std::pow(angular_distance(labelling.fit.X.R, X.R), 2) / trials;
    normalized += error.dot(pose.covariance.inverse() * error) / trials;
  }
  EXPECT_LT(refined, closed);
  // Six for a covariance that is right.
  EXPECT_NEAR(normalized, 6.0, 0.9);
}

TEST_F(OneTarget, LeavesOutAMarkerThatDoesNotFit) {
  const PoseEstimator estimator(rig_, {target_}, options_);
  const Pose X = test::rest_poses()[0];
  const Labelling labelling = see(X, {0, 1, 2, 3, 4}, 0.01);
  points_[2].image[kLeft].x() += 0.8;
  points_[2].p = rig_.triangulate(points_[2].image[kLeft], points_[2].image[kRight]);
  const TargetPose pose = estimator.estimate(0, labelling, points_);
  EXPECT_EQ(pose.markers, 4);
  EXPECT_LT(angular_distance(pose.X.R, X.R), 0.05 * kDegree);
}

TEST_F(OneTarget, NeedsThreeMarkersOffOneLine) {
  const PoseEstimator estimator(rig_, {target_}, options_);
  const Pose X = test::rest_poses()[0];
  EXPECT_TRUE(estimator.estimate(0, see(X, {0, 1, 2}, 0.01), points_).valid);
  EXPECT_FALSE(estimator.estimate(0, see(X, {0, 1}, 0.01), points_).valid);
  EXPECT_FALSE(estimator.estimate(0, see(X, {}, 0.01), points_).valid);
  target_.markers = {{0, 0, 0}, {0.05, 0.0003, 0}, {0.12, 0, 0}, {1, 1, 1}, {2, 2, 2}};
  const PoseEstimator line(rig_, {target_}, options_);
  EXPECT_FALSE(line.estimate(0, see(X, {0, 1, 2}, 0.03), points_).valid);
}

TEST_F(OneTarget, MarkersExactlyOnALineMakeNoPose) {
  std::normal_distribution<double> normal;
  for (int i = 0; i < 500; ++i) {
    const Vec3 along(normal(random_), normal(random_), normal(random_));
    for (const int k : {0, 1, 2})
      target_.markers[static_cast<std::size_t>(k)] = 0.03 * (k + 1) * along;
    target_.markers[2] += 0.03 * along;
    const PoseEstimator line(rig_, {target_}, options_);
    const Labelling seen = see(test::rest_poses()[0], {0, 1, 2}, i % 2 == 0 ? 0.0 : 0.03);
    EXPECT_FALSE(line.estimate(0, seen, points_).valid) << i;
  }
}

TEST_F(OneTarget, IsAsSureOfTheTurnAboutAnyAxisAsItMustBe) {
  // All but on a line, whose direction differs; the turn about it is the one that is not known.
  std::normal_distribution<double> normal;
  for (int i = 0; i < 200; ++i) {
    const Vec3 along = Vec3(normal(random_), normal(random_), normal(random_)).normalized();
    const Vec3 across = along.unitOrthogonal();
    target_.markers[0] = Vec3::Zero();
    target_.markers[1] = 0.04 * along + 0.001 * across;
    target_.markers[2] = 0.10 * along;
    const TargetPose pose = PoseEstimator(rig_, {target_}, options_)
                                .estimate(0, see(test::rest_poses()[0], {0, 1, 2}, 0.03), points_);
    const Mat3 turn = pose.covariance.bottomRightCorner<3, 3>();
    const Vec3 axis = pose.X.R * along;
    const double sigma = std::sqrt(axis.dot(turn * axis));
    EXPECT_EQ(pose.valid, sigma <= options_.max_turn_sigma * 1.01) << sigma;
  }
}

TargetPose valid_pose(const Mat3& R) {
  TargetPose pose;
  pose.valid = true;
  pose.X.R = R;
  pose.covariance.diagonal().setConstant(1e-6);
  return pose;
}

TEST(JointEstimator, UndoesRestAndMount) {
  // The convention: R_parent^-1 R_child = rest R(q) child_mount.
  BallJoint joint{"shoulder", 0, 1, Quat(0.298236838, 0.298236838, 0.641135546, 0.641135546),
                  Quat(0.8, 0.0, 0.6, 0.0)};
  joint.rest.normalize();
  JointEstimator estimator(joint);
  const Mat3 R_q = exp_rotation({0.3, -0.2, 0.5}), R_parent = exp_rotation({1, 2, 3});
  const Mat3 R_child =
      R_parent * joint.rest.toRotationMatrix() * R_q * joint.child_mount.toRotationMatrix();
  const JointEstimate estimate = estimator.estimate(0.0, valid_pose(R_parent), valid_pose(R_child));
  EXPECT_TRUE(estimate.valid);
  EXPECT_FALSE(estimate.velocity_valid);
  EXPECT_GE(estimate.q.w(), 0.0);
  EXPECT_LT(angular_distance(estimate.q.toRotationMatrix(), R_q), 1e-7);
  EXPECT_NEAR(estimate.covariance.trace(), 6e-6, 1e-9);
}

/// Uncertain by 0.01 rad about an axis, by a tenth of that about others [rad^2].
Mat3 spread_along(const Vec3& axis) {
  return 1e-6 * Mat3::Identity() + 1e-4 * axis.normalized() * axis.normalized().transpose();
}

TEST(JointEstimator, KnowsItsCovarianceInTheChildsAxes) {
  // Both targets are uncertain about other axes of the camera; so is the joint, as draws are.
  BallJoint joint{"j", 0, 1, Quat(exp_rotation({0.2, 0.9, -0.4})),
                  Quat(exp_rotation({-0.7, 0.1, 1.1}))};
  TargetPose parent = valid_pose(exp_rotation({1, 2, 3})),
             child = valid_pose(exp_rotation({-0.4, 0.8, 0.3}));
  parent.covariance.bottomRightCorner<3, 3>() = spread_along({1, 0.2, 0});
  child.covariance.bottomRightCorner<3, 3>() = spread_along({0, -0.3, 1});
  const JointEstimate mean = JointEstimator(joint).estimate(0.0, parent, child);
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  const auto draw = [&](const TargetPose& pose) {
    const Mat3 root = pose.covariance.bottomRightCorner<3, 3>().llt().matrixL();
    TargetPose drawn = pose;
    drawn.X.R =
        exp_rotation(root * Vec3(normal(random), normal(random), normal(random))) * pose.X.R;
    return drawn;
  };
  Mat3 seen = Mat3::Zero();
  const int draws = 20000;
  for (int i = 0; i < draws; ++i) {
    const JointEstimate one = JointEstimator(joint).estimate(0.0, draw(parent), draw(child));
    const Vec3 error = log_rotation((mean.q.conjugate() * one.q).toRotationMatrix());
    seen += error * error.transpose() / draws;
  }
  EXPECT_LT((seen - mean.covariance).norm(), 0.05 * mean.covariance.norm());
  // Which its isotropic likeness would miss by far.
  const Mat3 likeness = mean.covariance.trace() / 3.0 * Mat3::Identity();
  EXPECT_GT((seen - likeness).norm(), 0.3 * mean.covariance.norm());
}

TEST(JointEstimator, KnowsTheCovarianceOfItsVelocity) {
  // At rest, seen with noise about one axis: velocities scatter as they are said to.
  const JointEstimator fresh(BallJoint{"j", 0, 1, Quat::Identity(), Quat::Identity()});
  const TargetPose still = valid_pose(Mat3::Identity());
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal(0.0, 0.01);
  for (const int pictures : {2, 6}) {
    Mat3 seen = Mat3::Zero(), said = Mat3::Zero();
    const int draws = 4000;
    for (int i = 0; i < draws; ++i) {
      JointEstimator estimator = fresh;
      JointEstimate estimate;
      for (int k = 0; k < pictures; ++k) {
        TargetPose noisy = valid_pose(exp_rotation(Vec3(0.0, normal(random), 0.0)));
        noisy.covariance.setZero();
        noisy.covariance(4, 4) = 1e-4;
        TargetPose exact = still;
        exact.covariance.setZero();
        estimate = estimator.estimate(k / 60.0, exact, noisy);
      }
      seen += estimate.velocity * estimate.velocity.transpose() / draws;
      said += estimate.velocity_covariance / draws;
    }
    EXPECT_LT((seen - said).norm(), 0.1 * said.norm()) << pictures;
  }
}

TEST(JointEstimator, HasVelocityInTheChildsAxes) {
  const Vec3 w(0.5, -1.0, 2.0), turn(0.3, 0.8, -0.1);
  JointEstimator estimator(BallJoint{"j", 0, 1, Quat::Identity(), Quat::Identity()});
  JointEstimate estimate;
  for (int i = 0; i < 20; ++i) {
    const double t = i / 60.0;
    // Constant acceleration, turning about a fixed axis of the child.
    const Mat3 R = exp_rotation(turn) * exp_rotation(w * (0.5 * t * t));
    estimate = estimator.estimate(t, valid_pose(Mat3::Identity()), valid_pose(R));
    EXPECT_EQ(estimate.velocity_valid, i > 0);
    if (i >= 4) {
      EXPECT_LT((estimate.velocity - w * t).norm(), 1e-4) << i;
    }
  }
}

TEST(JointEstimator, StartsAnewAfterAGapAndWhenTimeStepsBack) {
  JointEstimator estimator(BallJoint{"j", 0, 1, Quat::Identity(), Quat::Identity()});
  const TargetPose still = valid_pose(Mat3::Identity()),
                   turned = valid_pose(exp_rotation({1, 0, 0}));
  estimator.estimate(1.0, still, still);
  EXPECT_TRUE(estimator.estimate(1.016, still, still).velocity_valid);
  EXPECT_FALSE(estimator.estimate(1.5, still, turned).velocity_valid);
  EXPECT_FALSE(estimator.estimate(0.2, still, still).velocity_valid);
  const JointEstimate next = estimator.estimate(0.216, still, still);
  EXPECT_LT(next.velocity.norm(), 1e-9);
  EXPECT_FALSE(estimator.estimate(0.233, TargetPose(), still).valid);
}

}  // namespace
}  // namespace mocap
}  // namespace anthrob
