// The hand, added to a model by a second file.
#include <gtest/gtest.h>

#include "anthrob_sim/simulation.h"
#include "support.h"

namespace anthrob {
namespace {

using testing_support::config;

TEST(Hand, AddsToTheArmAndChangesNothingElse) {
  const auto arm = load_robot_model(config("anthrob/model_II.yaml"));
  const auto both = load_robot_model(config("anthrob/model_II_hand.yaml"));
  EXPECT_TRUE(arm->touch_pads.empty());
  EXPECT_EQ(both->touch_pads.size(), 4u);
  ASSERT_EQ(both->muscles.size(), arm->muscles.size() + 2);
  Simulation plain(arm), handed(both);
  for (std::size_t m = 0; m < arm->muscles.size(); ++m) {
    EXPECT_EQ(both->muscles[m].name, arm->muscles[m].name);
    EXPECT_NEAR(handed.muscle(static_cast<int>(m)).length(),
                plain.muscle(static_cast<int>(m)).length(), 1e-12);
  }
  EXPECT_EQ(both->muscles.back().name, "hand_antagonist");
  for (std::size_t b = 0; b + 1 < arm->skeleton->bodies.size(); ++b) {
    EXPECT_EQ(both->skeleton->bodies[b].mass, arm->skeleton->bodies[b].mass);
  }
  const int forearm = arm->skeleton->frames[arm->skeleton->find_frame("forearm")].body;
  EXPECT_NEAR(both->skeleton->bodies[forearm].mass, arm->skeleton->bodies[forearm].mass + 0.090,
              1e-12);
}

TEST(Hand, IsTheArmsFileAndMore) {
  const auto content = [](const std::string& file) {
    std::ifstream in(config("anthrob/" + file));
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  const std::string arm = content("robot.urdf"), both = content("robot_hand.urdf");
  const std::size_t shared = arm.rfind("</robot>");
  EXPECT_EQ(both.substr(0, shared), arm.substr(0, shared));
}

TEST(Hand, ClosesPressesAndOpens) {
  const auto model = load_robot_model(config("anthrob/model_III_hand.yaml"));
  Simulation sim(model);
  const int fingers = model->skeleton->find_joint("fingers");
  const auto angle = [&] {
    return sim.configuration()[model->skeleton->joints[fingers].position_offset];
  };
  const auto pull = [&](double agonist, double antagonist) {
    sim.command(model->find_muscle("hand_agonist"), ecu::Mode::kPosition, agonist);
    sim.command(model->find_muscle("hand_antagonist"), ecu::Mode::kPosition, antagonist);
    sim.step(3000);
  };
  const auto pressure = [&](int pad) {
    return pad_force(model->touch_pads[pad], sim.tree(), sim.configuration());
  };
  pull(5.0, -4.0);
  EXPECT_GT(angle(), 1.5);
  // At rest against the stop, what the pads carry is the stop's torque.
  double torque = 0.0;
  for (int pad = 0; pad < 4; ++pad) {
    EXPECT_GT(pressure(pad), 0.0);
    torque += pressure(pad) * model->touch_pads[pad].lever;
  }
  EXPECT_NEAR(torque, model->skeleton->joints[fingers].stop.stiffness * (angle() - 1.5), 1e-4);
  pull(-3.0, 1.0);
  EXPECT_LT(angle(), 0.5);
  for (int pad = 0; pad < 4; ++pad) EXPECT_EQ(pressure(pad), 0.0);
}

}  // namespace
}  // namespace anthrob
