#include "anthrob_control/approach.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace anthrob {
namespace {

class ApproachTest : public ::testing::Test {
 protected:
  /// The rig's muscles, flexor and extensor, turned so far [rad].
  static RobotMeasurement at(double flexor, double extensor) {
    RobotMeasurement measured;
    measured.muscles.resize(2);
    measured.muscles[0].position = flexor;
    measured.muscles[1].position = extensor;
    return measured;
  }

  std::shared_ptr<const RobotModel> model =
      load_robot_model(std::string(ANTHROB_CONFIG_DIR) + "/two_muscle_rig/model_I.yaml");
  Approach approach{model, 2.0};
  const std::vector<double> wanted{1.0, -0.5};
};

TEST_F(ApproachTest, LeadsStraightFromWhereTheMotorsAre) {
  const RobotMeasurement there = at(0.2, 0.3);  // 0.8 rad to go each, at 0.02 rad a step
  EXPECT_EQ(approach.step(wanted, there, 0.0), (std::vector<double>{0.2, 0.3}));
  EXPECT_FALSE(approach.arrived());
  for (int i = 1; i < 40; ++i) {
    // What is measured on the way does not matter.
    const std::vector<double> reference = approach.step(wanted, at(0.0, 9.0), 0.01);
    EXPECT_NEAR(reference[0], 0.2 + 0.02 * i, 1e-12);
    EXPECT_NEAR(reference[1], 0.3 - 0.02 * i, 1e-12);
    EXPECT_FALSE(approach.arrived());
  }
  for (int i = 0; i < 2 && !approach.arrived(); ++i) approach.step(wanted, there, 0.01);
  EXPECT_TRUE(approach.arrived());
  EXPECT_EQ(approach.step(wanted, there, 0.01), wanted);
}

TEST_F(ApproachTest, HasTheSpeedOfTheLongestWayAndAllArriveTogether) {
  approach.step(wanted, at(0.9, 0.5), 0.0);
  const std::vector<double> reference = approach.step(wanted, at(0.9, 0.5), 0.025);
  EXPECT_NEAR(reference[1], 0.45, 1e-12);
  EXPECT_NEAR(reference[0], 0.905, 1e-12);
}

TEST_F(ApproachTest, TakesReferencesAsTheyAreOnceThere) {
  approach.step(wanted, at(1.0, -0.5), 0.0);
  ASSERT_TRUE(approach.arrived());
  const std::vector<double> next{-3.0, 3.0};
  EXPECT_EQ(approach.step(next, at(1.0, -0.5), 0.01), next);
  approach.begin();
  EXPECT_FALSE(approach.arrived());
  EXPECT_EQ(approach.step(next, at(0.7, 0.1), 0.0), (std::vector<double>{0.7, 0.1}));
}

TEST_F(ApproachTest, DoesNotMakeUpForAnInterruption) {
  approach.step(wanted, at(0.0, 0.0), 0.0);
  EXPECT_NEAR(approach.step(wanted, at(0.0, 0.0), 60.0)[0], 0.2, 1e-12);
}

TEST_F(ApproachTest, StaysWithinLimitsWhereTheMotorsAreBeyond) {
  const double limit = model->muscles[0].limits.position;
  EXPECT_EQ(approach.step(wanted, at(limit + 1.0, 0.0), 0.0)[0], limit);
}

TEST(Approach, PassesOverMusclesWithoutController) {
  const auto model =
      load_robot_model(std::string(ANTHROB_CONFIG_DIR) + "/two_muscle_rig/model_hill.yaml");
  Approach approach(model, 1.0);
  RobotMeasurement measured;
  measured.muscles.resize(model->muscles.size());
  for (ecu::Measurement& m : measured.muscles) m.position = NAN;
  approach.step(std::vector<double>(model->muscles.size(), 0.5), measured, 0.0);
  EXPECT_TRUE(approach.arrived());
}

TEST(Approach, WantsASpeed) {
  const auto model =
      load_robot_model(std::string(ANTHROB_CONFIG_DIR) + "/two_muscle_rig/model_I.yaml");
  EXPECT_THROW(Approach(model, 0.0), std::invalid_argument);
  EXPECT_THROW(Approach(model, NAN), std::invalid_argument);
}

}  // namespace
}  // namespace anthrob
