#include "anthrob_reference/path.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <stdexcept>

#include "support.h"

namespace anthrob::reference {
namespace {

constexpr double kTenthMillimetre = 1e-4;

void expect_rest_lengths(const std::string& model,
                         const std::map<std::string, double>& lengths_mm) {
  const Arm arm(Arm::load(model_file(model)));
  ASSERT_EQ(arm.muscle_count(), lengths_mm.size());
  for (std::size_t i = 0; i < arm.muscle_count(); ++i) {
    const std::string& name = arm.muscle_names()[i];
    EXPECT_NEAR(arm.muscle(i).length, 1e-3 * lengths_mm.at(name), kTenthMillimetre) << name;
  }
}

TEST(Path, RestLengthsOfModelI) {
  expect_rest_lengths("model_I", {{"lateral_deltoid", 344.52},
                                  {"anterior_deltoid", 258.01},
                                  {"posterior_deltoid", 293.03},
                                  {"supraspinatus", 231.15},
                                  {"infraspinatus", 228.19},
                                  {"teres_minor", 219.48},
                                  {"teres_major", 227.46},
                                  {"pectoralis_major", 198.96},
                                  {"biceps_brachii", 485.73},
                                  {"triceps_brachii", 138.40},
                                  {"brachialis", 185.30}});
}

TEST(Path, RestLengthsOfModelII) {
  expect_rest_lengths("model_II", {{"lateral_deltoid", 344.52},
                                   {"anterior_deltoid", 260.24},
                                   {"posterior_deltoid", 295.92},
                                   {"supraspinatus", 235.98},
                                   {"infraspinatus", 229.04},
                                   {"teres_minor", 220.83},
                                   {"teres_major", 229.93},
                                   {"pectoralis_major", 198.96},
                                   {"biceps_brachii", 486.45},
                                   {"triceps_brachii", 138.40},
                                   {"brachialis", 185.32}});
}

TEST(Path, RestMomentArmsOfModelI) {
  const ArmParameters parameters = Arm::load(model_file("model_I"));
  const Arm arm(parameters);
  const Eigen::Matrix3d R_HW = parameters.skeleton.X_WH_rest.linear().transpose();
  const Eigen::Vector3d abduction = R_HW * Eigen::Vector3d(-1.0, -1.0, 0.0).normalized();
  const Eigen::Vector3d flexion = R_HW * Eigen::Vector3d(1.0, -1.0, 0.0).normalized();
  const auto arm_mm = [&](std::size_t i, const Eigen::Vector3d& axis) {
    return 1e3 * axis.dot(arm.moment_arm(i).head<3>());
  };
  EXPECT_NEAR(arm_mm(0, abduction), 29.0, 1.0);   // lateral deltoid
  EXPECT_NEAR(arm_mm(2, abduction), 7.0, 1.0);    // posterior deltoid
  EXPECT_NEAR(arm_mm(1, abduction), -34.0, 1.0);  // anterior deltoid
  EXPECT_NEAR(arm_mm(7, abduction), -63.0, 1.0);  // pectoralis major
  EXPECT_NEAR(arm_mm(1, flexion), 24.0, 1.0);
  EXPECT_NEAR(arm_mm(8, flexion), 26.0, 1.0);  // biceps
  EXPECT_NEAR(arm_mm(2, flexion), -27.0, 1.0);
  EXPECT_NEAR(1e3 * arm.moment_arm(8)(3), 8.0, 1.0);
  EXPECT_NEAR(1e3 * arm.moment_arm(9)(3), -22.0, 1.0);  // triceps
  EXPECT_NEAR(1e3 * arm.moment_arm(10)(3), 14.0, 1.0);  // brachialis
}

// Each span for itself, because eyelet friction gives each its own tension.
void expect_virtual_work(const std::string& model) {
  const ArmParameters parameters = Arm::load(model_file(model));
  const Skeleton skeleton(parameters.skeleton);
  std::mt19937 generator(5);
  for (const MuscleParameters& muscle : parameters.muscles) {
    Path path(muscle.path);
    for (int k = 0; k < 20; ++k) {
      const JointState state = random_state(&generator);
      path.reset_contacts(skeleton.posture(state));
      PathSolution here, up, down;
      path.solve(skeleton.posture(state), &here);
      const double h = 1e-5;
      for (int axis = 0; axis < 4; ++axis) {
        const Vector4 step = h * Vector4::Unit(axis);
        path.solve(skeleton.posture(moved(state, step)), &up);
        path.solve(skeleton.posture(moved(state, -step)), &down);
        for (std::size_t s = 0; s < path.span_count(); ++s) {
          const double slope =
              (up.spans[s].geometry.length - down.spans[s].geometry.length) / (2.0 * h);
          EXPECT_NEAR(here.spans[s].arm(axis), -slope, 1e-8) << muscle.name << " " << s;
        }
      }
    }
  }
}

TEST(Path, VirtualWorkOfModelI) {
  expect_virtual_work("model_I");
}

TEST(Path, VirtualWorkOfModelII) {
  expect_virtual_work("model_II");
}

TEST(Path, DeflectionsAreAnglesBetweenNeighbouringSpans) {
  const Path path({{Body::kBase, {0.0, 0.0, 0.0}, {}},
                   {Body::kBase, {1.0, 0.0, 0.0}, {}},
                   {Body::kBase, {1.0, 2.0, 0.0}, {}},
                   {Body::kHumerus, {0.0, 3.0, 0.0}, {}}});
  PathSolution solution;
  path.solve(Posture{}, &solution);
  ASSERT_EQ(solution.deflections.size(), 2u);
  EXPECT_NEAR(solution.deflections[0], M_PI / 2.0, 1e-12);
  EXPECT_NEAR(solution.deflections[1], M_PI / 4.0, 1e-12);
  EXPECT_NEAR(solution.length, 3.0 + std::sqrt(2.0), 1e-12);
}

TEST(Path, SegmentsCountTheEntries) {
  const CylinderShape bone{Eigen::Vector3d::UnitY(), 0.01};
  const Path path({{Body::kBase, {0.0, 0.0, 0.0}, {}},
                   {Body::kHumerus, {0.0, 0.0, 0.0}, bone},
                   {Body::kHumerus, {1.0, 0.0, 0.0}, {}},
                   {Body::kHumerus, {2.0, 0.0, 0.0}, {}}});
  EXPECT_EQ(path.span_of_segment(0), 0u);
  EXPECT_EQ(path.span_of_segment(1), 0u);
  EXPECT_EQ(path.span_of_segment(2), 1u);
  EXPECT_THROW(path.span_of_segment(3), std::invalid_argument);
}

TEST(Path, RefusesCylindersWithoutEnclosingPoints) {
  const PathEntry point{Body::kBase, {0.0, 0.0, 0.0}, {}};
  const PathEntry bone{Body::kHumerus, {0.0, 0.0, 0.0}, CylinderShape{{0.0, 1.0, 0.0}, 0.01}};
  EXPECT_THROW(Path({point}), std::invalid_argument);
  EXPECT_THROW(Path({point, bone}), std::invalid_argument);
  EXPECT_THROW(Path({point, bone, bone, point}), std::invalid_argument);
}

}  // namespace
}  // namespace anthrob::reference
