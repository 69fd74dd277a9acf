// Scalars of a simulation by path: against closed forms and the accessors they stand for.
#include "report/quantities.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "simulation/moving_arm.h"

namespace anthrob {
namespace {

using testing_support::TemporaryRobot;

double read(const Simulation& sim, const std::string& path) {
  return select_quantities(quantities_of(sim.model()), {path}).front().read(sim);
}

/// A rod on a hinge that leans, and a block that slides along x, pushed over dry friction.
TemporaryRobot rod_and_block() {
  return {R"(<robot name="r"><link name="world"/>
    <joint name="hinge" type="continuous"><parent link="world"/><child link="rod"/>
      <origin xyz="0 0 1" rpy="0.5 0 0"/><axis xyz="1 0 0"/></joint>
    <link name="rod"><inertial><origin xyz="0 0 -0.3"/><mass value="2"/>
      <inertia ixx="1e-2" ixy="0" ixz="0" iyy="1e-2" iyz="0" izz="1e-2"/></inertial></link>
    <joint name="slide" type="prismatic"><parent link="world"/><child link="block"/>
      <origin xyz="0 1 0" rpy="0 0 1"/><axis xyz="1 0 0"/>
      <limit lower="-9" upper="9" effort="1" velocity="1"/></joint>
    <link name="block"><inertial><mass value="3"/>
      <inertia ixx="1e-2" ixy="0" ixz="0" iyy="1e-2" iyz="0" izz="1e-2"/></inertial></link>
    </robot>)",
          "robot: robot.urdf\ngravity: [0, 0, -10]\njoints:\n"
          "  hinge: {friction: {static: 0, kinetic: 0, viscous: 0.5, stribeck_velocity: 0.05}}\n"
          "  slide: {friction: {static: 4, kinetic: 4, viscous: 0, stribeck_velocity: 0.05}, stop: "
          "{stiffness: 2000, "
          "damping: 2}}\n"};
}

TEST(Quantities, OfAPendulumAtRestAreItsWeight) {
  Simulation sim(rod_and_block().load());
  sim.observe_reactions();
  sim.place({-0.5, 0.0}, {});  // hangs straight down
  sim.step(10);
  EXPECT_NEAR(read(sim, "hinge/reaction/x"), 0.0, 1e-9);
  EXPECT_NEAR(read(sim, "hinge/reaction/y"), 0.0, 1e-9);
  EXPECT_NEAR(read(sim, "hinge/reaction/z"), 20.0, 1e-9);
  EXPECT_NEAR(read(sim, "energy/potential"), 2.0 * 10.0 * 0.7, 1e-9);
  EXPECT_NEAR(read(sim, "energy/kinetic"), 0.0, 1e-15);
}

TEST(Quantities, OfAPendulumThatSwingsHoldItOnItsCircle) {
  Simulation sim(rod_and_block().load(1e-5));
  sim.observe_reactions();
  sim.step(40000);
  const double angle = 0.5 + read(sim, "hinge/position"), speed = read(sim, "hinge/velocity");
  EXPECT_GT(std::abs(speed), 0.5);
  EXPECT_NEAR(read(sim, "hinge/friction_torque"), -0.5 * speed, 1e-4 * std::abs(speed));
  // Along the rod: what the circle takes and the part of the weight.
  const double along = -std::sin(angle) * read(sim, "hinge/reaction/y") +
                       std::cos(angle) * read(sim, "hinge/reaction/z");
  EXPECT_NEAR(along, 2.0 * (0.3 * speed * speed + 10.0 * std::cos(angle)), 5e-3);
  EXPECT_NEAR(read(sim, "power/joints"), 0.5 * speed * speed, 1e-3);
}

TEST(Quantities, OfASlidingBlockAreItsFrictionInTheDirectionOfItsAxis) {
  Simulation sim(rod_and_block().load());
  sim.observe_reactions();
  sim.apply_load(1, 10.0);
  sim.step(500);
  EXPECT_NEAR(read(sim, "slide/velocity"), 0.5 * (10.0 - 4.0) / 3.0, 1e-9);
  EXPECT_NEAR(read(sim, "slide/friction_force"), -4.0, 1e-9);
  EXPECT_EQ(read(sim, "slide/load"), 10.0);
  EXPECT_NEAR(read(sim, "slide/reaction/z"), 30.0, 1e-9);
}

TEST(Quantities, AreThoseOfTheMuscles) {
  Simulation sim(testing_support::anthrob_model("II"));
  testing_support::excite(sim);
  sim.observe_reactions();
  sim.step(200);
  const auto all = quantities_of(sim.model());
  std::set<std::string> paths;
  double elastic = 0.0;
  for (const Quantity& quantity : all) {
    EXPECT_TRUE(paths.insert(quantity.path).second) << quantity.path;
    EXPECT_TRUE(std::isfinite(quantity.read(sim))) << quantity.path;
    if (quantity.path.find("/spring/energy") != std::string::npos) elastic += quantity.read(sim);
  }
  EXPECT_GT(elastic, 1e-4);
  EXPECT_NEAR(read(sim, "energy/elastic"), elastic, 1e-12);
  const int biceps = sim.model().find_muscle("biceps_brachii");
  EXPECT_EQ(read(sim, "biceps_brachii/tension/2"), sim.muscle(biceps).tension(2));
  EXPECT_EQ(read(sim, "biceps_brachii/actuator/current"), sim.muscle(biceps).actuator().current);
  EXPECT_EQ(read(sim, "shoulder/position/w"), sim.configuration()[0]);
}

TEST(Quantities, ThatAreNoneAreRefusedWithTheNearest) {
  Simulation sim(testing_support::anthrob_model("II"));
  const auto why = [&](const std::string& path) -> std::string {
    try {
      read(sim, path);
    } catch (const BadInput& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(why("elbow/friction_torqe"),
            "quantity 'elbow/friction_torqe': unknown; did you mean 'elbow/friction_torque'?");
  EXPECT_NE(why("").find("lists all"), std::string::npos);
  EXPECT_THROW(sim.joint_reaction(0), BadInput);  // nobody asked for them
}

}  // namespace
}  // namespace anthrob
