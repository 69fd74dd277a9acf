// A large robot: 20 joints of both kinds, 100 muscles.
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

#include "anthrob_core/testing/content.h"
#include "anthrob_sim/simulation.h"
#include "support.h"

namespace anthrob {
namespace {

TEST(Torso, IsWhatItsGeneratorWrites) {
  const std::filesystem::path config = testing_support::config("");
  const auto out =
      std::filesystem::temp_directory_path() / ("torso_" + std::to_string(getpid())) / "torso_100";
  const std::string command = "/usr/bin/python3 " + (config / "../scripts/make_torso.py").string() +
                              " --out " + out.string();
  std::filesystem::create_directories(out);
  ASSERT_EQ(std::system(command.c_str()), 0);
  for (const char* file : {"robot.urdf", "model_II.yaml", "meshes/knob.obj"}) {
    EXPECT_EQ(content(config / "torso_100" / file), content(out / file)) << file;
  }
  std::filesystem::remove_all(out.parent_path());
}

void note_contacts(const Simulation& sim, std::set<std::string>& touched) {
  for (std::size_t m = 0; m < sim.muscle_count(); ++m) {
    const MusclePath& path = sim.muscle(m).path();
    for (std::size_t i = 0; i < path.obstacles().size(); ++i) {
      const auto& surface = path.model().obstacles()[i].surface;
      if (surface && path.obstacles()[i].touching) touched.insert(surface->type());
    }
  }
}

TEST(Torso, MovesAndStaysTogether) {
  const auto model = load_robot_model(testing_support::config("torso_100/model_II.yaml"));
  std::set<JointType> kinds;
  for (const JointModel& joint : model->skeleton->joints) kinds.insert(joint.type);
  EXPECT_EQ(model->skeleton->joints.size(), 20u);
  EXPECT_EQ(kinds.size(), 2u);
  EXPECT_EQ(model->muscles.size(), 100u);
  std::set<std::string> surfaces;
  for (const MuscleModel& muscle : model->muscles) {
    for (const PathObstacle& obstacle : muscle.path->obstacles()) {
      if (obstacle.surface) surfaces.insert(obstacle.surface->type());
    }
  }
  EXPECT_EQ(surfaces, (std::set<std::string>{"cylinder", "mesh", "sphere"}));
  EXPECT_TRUE(model->remarks.empty()) << model->remarks[0];
  std::set<std::string> touched;
  int sweeps = 0;

  const auto drive = [&](Simulation& sim, int from, int to) {
    for (int i = from; i < to; ++i) {
      if (i % 50 == 0) {
        for (std::size_t m = 0; m < sim.muscle_count(); ++m) {
          const double phase = 0.7 * static_cast<double>(m);
          sim.command(static_cast<int>(m), ecu::Mode::kPosition,
                      0.3 + 0.3 * std::sin(0.001 * i + phase));
        }
      }
      sim.step();
      sweeps += sim.last_step().solver_iterations;
      EXPECT_LT(sim.last_step().solver_iterations, 40) << "friction was not solved in step " << i;
      if (i % 20 == 0) note_contacts(sim, touched);
    }
  };
  Simulation sim(model);
  drive(sim, 0, 400);
  const Snapshot middle = sim.snapshot();
  drive(sim, 400, 1000);
  RecordProperty("sweeps_in_1000_steps", sweeps);
  EXPECT_LT(sweeps, 5000);
  EXPECT_EQ(touched, surfaces) << "muscles run over all kinds of obstacles";
  // Bodies hang together: the constraint solver leaves no gap worth mentioning.
  for (std::size_t j = 0; j < model->skeleton->joints.size(); ++j) {
    const JointModel& joint = model->skeleton->joints[j];
    const auto in_world = [&](int body, const Vec3& point_L) -> Vec3 {
      return sim.bodies()[body].X_WB * model->skeleton->bodies[body].X_LB.to_local(point_L);
    };
    const Vec3 center_P = joint.X_PC_rest * joint.center_C;
    EXPECT_LT((in_world(joint.parent, center_P) - in_world(joint.child, joint.center_C)).norm(),
              1e-4)
        << joint.name;
  }
  const std::vector<double> end = sim.configuration();
  sim.restore(middle);
  drive(sim, 400, 1000);
  EXPECT_EQ(sim.configuration(), end);
}

}  // namespace
}  // namespace anthrob
