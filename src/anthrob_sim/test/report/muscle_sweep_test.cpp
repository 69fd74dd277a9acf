// Sweeps and solved paths against the definitions of what they report.
#include "report/muscle_sweep.h"

#include <gtest/gtest.h>

#include <cmath>

#include "path/cylinder.h"
#include "report/solved_path.h"
#include "support.h"

namespace anthrob {
namespace {

using testing_support::config;

SweepAxis axis_named(const RobotModel& model, const std::string& name) {
  for (const SweepAxis& axis : sweep_axes(*model.skeleton)) {
    if (axis.name == name) return axis;
  }
  throw std::runtime_error("no axis " + name);
}

TEST(MuscleSweep, MomentArmIsTheSlopeOfTheLength) {
  const auto model = load_robot_model(config("anthrob/model_II.yaml"));
  const std::vector<double> q = model->skeleton->rest_configuration();
  const std::vector<double> actuators(model->muscles.size(), 0.0);
  for (const std::string name : {"elbow", "shoulder_x", "shoulder_y", "shoulder_z"}) {
    const bool elbow = name == "elbow";
    const double from = elbow ? 0.1 : -0.3, to = elbow ? 2.0 : 0.5;
    const int count = 1601;
    const MuscleSweep sweep =
        sweep_muscles(model, q, actuators, axis_named(*model, name), from, to, count);
    ASSERT_EQ(sweep.muscles.size(), 11u);
    const double h = (to - from) / (count - 1);
    for (const MuscleCurve& curve : sweep.muscles) {
      // The mean of two neighbouring arms is the slope between them up to the arm's second
      // derivative, but for the kink at a touch-down: O(h) there.
      for (int i = 0; i + 1 < count; ++i) {
        const double slope = (curve.length[i + 1] - curve.length[i]) / h;
        EXPECT_NEAR(0.5 * (curve.moment_arm[i] + curve.moment_arm[i + 1]), -slope, 1e-4)
            << curve.muscle << " " << name << " " << sweep.position[i];
      }
    }
  }
}

TEST(MuscleSweep, RefusesWhatABallJointCannotTake) {
  const auto model = load_robot_model(config("anthrob/model_I.yaml"));
  const std::vector<double> q = model->skeleton->rest_configuration(), still(11, 0.0);
  const SweepAxis axis = axis_named(*model, "shoulder_x");
  EXPECT_THROW(sweep_muscles(model, q, still, axis, -4.0, 4.0, 3), BadInput);
  auto limited = std::make_shared<RobotModel>(*model);
  auto skeleton = std::make_shared<SkeletonModel>(*model->skeleton);
  JointStopModel& stop = skeleton->joints[static_cast<std::size_t>(axis.joint)].stop;
  stop.enabled = true;
  stop.upper = 0.5;
  limited->skeleton = skeleton;
  EXPECT_THROW(sweep_muscles(limited, q, still, axis, -1.0, 1.0, 3), BadInput);
  EXPECT_EQ(sweep_muscles(limited, q, still, axis, -0.4, 0.4, 3).position.size(), 3u);
}

TEST(MuscleSweep, KeepsTheOtherJointsWhereTheyAre) {
  const auto model = load_robot_model(config("anthrob/model_I.yaml"));
  std::vector<double> q = model->skeleton->rest_configuration();
  const std::vector<double> actuators(model->muscles.size(), 0.0);
  q.back() = 1.0;
  const MuscleSweep sweep =
      sweep_muscles(model, q, actuators, axis_named(*model, "shoulder_z"), -0.2, 0.2, 3);
  Simulation sim(model);
  sim.place(q, actuators);
  for (std::size_t m = 0; m < model->muscles.size(); ++m) {
    EXPECT_NEAR(sweep.muscles[m].length[1], sim.muscle(static_cast<int>(m)).length(), 1e-12);
  }
}

TEST(MuscleSweep, RefusesWhatCannotBeSwept) {
  const auto model = load_robot_model(config("anthrob/model_I.yaml"));
  const std::vector<double> q = model->skeleton->rest_configuration();
  const std::vector<double> actuators(model->muscles.size(), 0.0);
  const SweepAxis elbow = axis_named(*model, "elbow");
  EXPECT_THROW(sweep_muscles(model, q, actuators, elbow, 0.0, 9.0, 10), BadInput);
  EXPECT_THROW(sweep_muscles(model, q, actuators, elbow, 1.0, 0.5, 10), BadInput);
  EXPECT_THROW(sweep_muscles(model, q, actuators, elbow, 0.1, 0.5, 1), BadInput);
  EXPECT_THROW(sweep_muscles(model, q, actuators, elbow, 0.1, NAN, 5), BadInput);
}

TEST(SolvedPath, AgreesWithTheMotion) {
  const auto model = load_robot_model(config("anthrob/model_II.yaml"));
  Simulation sim(model);
  for (std::size_t m = 0; m < sim.muscle_count(); ++m) {
    sim.command(static_cast<int>(m), ecu::Mode::kPosition, 1.5);
  }
  std::size_t touching = 0;
  for (int i = 0; i < 500; ++i) {
    std::vector<double> before;
    for (std::size_t m = 0; m < sim.muscle_count(); ++m) {
      before.push_back(solved_path(sim, static_cast<int>(m)).length);
    }
    sim.step();
    for (std::size_t m = 0; m < sim.muscle_count(); ++m) {
      const SolvedPath path = solved_path(sim, static_cast<int>(m));
      EXPECT_NEAR(path.velocity, (path.length - before[m]) / sim.step_length(), 2e-3);
      EXPECT_EQ(path.slack, sim.muscle(static_cast<int>(m)).spring_tension() <= 0.0);
      for (const SolvedContact& contact : path.contacts) {
        if (!contact.touching) {
          EXPECT_EQ(contact.length, 0.0);
          continue;
        }
        ++touching;
        EXPECT_GE(contact.length + 1e-12, (contact.exit_W - contact.entry_W).norm());
        // Frictionless; within how the tension changed over the step.
        EXPECT_NEAR(contact.tension_in, contact.tension_out, 0.5);
      }
    }
  }
  EXPECT_GT(touching, 500u);
}

/// Flexed by 90 degrees and drawn across the chest, the posterior deltoid's last point on the base
/// comes inside the humerus's cylinder, which has no ends.
TEST(SolvedPath, SaysWhichPathPointIsInsideWhatAndHowDeep) {
  const auto model = load_robot_model(config("anthrob/model_II.yaml"));
  Simulation sim(model);
  EXPECT_LT(deepest_penetration(sim).depth, kRoundingDepth);
  const Mat3 R = sim.tree().joint(0).R_WC;
  const Vec3 flexion = R.transpose() * Vec3(1, -1, 0).normalized();
  const Vec3 up = R.transpose() * Vec3::UnitZ();
  const Quat turn =
      Quat(Eigen::AngleAxisd(34 * M_PI / 180, up)) * Quat(Eigen::AngleAxisd(M_PI / 2, flexion));
  sim.place({turn.w(), turn.x(), turn.y(), turn.z(), 0.0}, std::vector<double>(11, 0.0));

  const int index = model->find_muscle("posterior_deltoid");
  const auto& obstacles = model->muscles[index].path->obstacles();
  const auto& cylinder = dynamic_cast<const Cylinder&>(*obstacles[4].surface);
  const auto place = [&](std::size_t i) -> Vec3 {
    return sim.bodies()[obstacles[i].body].X_WB * obstacles[i].point_B;
  };
  const Vec3 p = cylinder.pose().to_local(sim.bodies()[obstacles[4].body].X_WB.to_local(place(3)));
  const double depth = cylinder.radius() - std::hypot(p.x(), p.z());
  ASSERT_GT(depth, 0.5 * cylinder.radius());

  const Penetration deepest = deepest_penetration(sim);
  EXPECT_EQ(deepest.muscle, "posterior_deltoid");
  EXPECT_EQ(deepest.entry, 4);
  EXPECT_NEAR(deepest.depth, depth, 1e-12);
  char millimetres[16];
  std::snprintf(millimetres, sizeof(millimetres), "%.1f", 1e3 * depth);
  EXPECT_EQ(deepest.text(), std::string("posterior_deltoid: a path point lies ") + millimetres +
                                " mm inside the cylinder on humerus (path.4)");
  EXPECT_NEAR(solved_path(sim, index).contacts[0].penetration, depth, 1e-12);
}

}  // namespace
}  // namespace anthrob
