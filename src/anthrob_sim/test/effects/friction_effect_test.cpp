// Effects along the path: friction, surfaces and points, each against a closed form, and what they
// dissipate.
#include "anthrob_sim/effects/friction_effect.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "effects_support.h"
#include "friction/sliding_tendon.h"
#include "friction/smooth_stribeck.h"
#include "friction/sticking.h"
#include "report/solved_path.h"

namespace anthrob {
namespace {

using namespace testing_support;

TEST(EyeletFriction, TensionRatioIsTheCapstans) {
  const double mu = 0.1;
  const auto robot = robot_with(kArm, {{"eyelet_friction", "biceps_brachii/1", {{"mu", mu}}}});
  const int biceps = robot->find_muscle("biceps_brachii");
  const auto& obstacles = robot->muscles[biceps].path->obstacles();
  Memory nothing(4);
  EXPECT_NEAR(obstacles[1].friction->evaluate(1.0, nothing).mu, 0.156 + mu, 1e-12);
  EXPECT_NEAR(obstacles[2].friction->evaluate(1.0, nothing).mu, 0.156, 1e-12);
  // In the chain, winding in: what the motor feels over what the spring pulls.
  Simulation sim(robot);
  for (int i = 1; i <= 500; ++i) {
    sim.muscle_inputs().impose_position(biceps, 0.004 * i, 4.0);
    sim.step();
  }
  const Muscle& muscle = sim.muscle(biceps);
  ASSERT_GT(muscle.tension(1), 1.0);
  EXPECT_NEAR(muscle.tension(0) / muscle.tension(1),
              std::exp((0.156 + mu) * muscle.path().obstacles()[1].turning), 1e-6);
}

TEST(EyeletFriction, BringsTheThesisLawWhereThereIsNone) {
  const auto law = muscle_with("two_muscle_rig/model_II.yaml",
                               {"wrap_friction", "flexor", {{"mu", 0.2}}}, "flexor")
                       .path->obstacles()[2]
                       .friction;
  ASSERT_TRUE(law);
  Memory nothing(4);
  EXPECT_NEAR(law->evaluate(1.0, nothing).mu, 0.2, 1e-12);
  EXPECT_NEAR(law->evaluate(-1.0, nothing).mu, -0.2, 1e-12);
  EXPECT_NEAR(law->sliding_coefficient(0.0), 0.25, 1e-12);
}

TEST(EyeletFriction, ExcessAtRestIsFreeAndTheSlopeIsTheCurves) {
  const double mu = 0.1, model = 0.156;
  for (const double rest_ratio : {0.7, 1.0, 1.4}) {
    const auto robot = robot_with(
        kArm, {{"eyelet_friction", "biceps_brachii/1", {{"mu", mu}, {"rest_ratio", rest_ratio}}}});
    const auto& obstacles = robot->muscles[robot->find_muscle("biceps_brachii")].path->obstacles();
    const FrictionLaw &raised = *obstacles[1].friction, &own = *obstacles[2].friction;
    EXPECT_NEAR(raised.sliding_coefficient(1.0), model + mu, 1e-12);
    EXPECT_NEAR(raised.sliding_coefficient(0.0) / own.sliding_coefficient(0.0),
                1.0 + mu / model * rest_ratio, 1e-12);
    Memory nothing(4);
    for (const double v : {-3e-3, -4e-4, 2e-4, 1e-3, 5e-3}) {
      const double h = 1e-9;
      const double slope =
          (raised.evaluate(v + h, nothing).mu - raised.evaluate(v - h, nothing).mu) / (2.0 * h);
      EXPECT_NEAR(raised.evaluate(v, nothing).slope, slope, 1e-4 * std::abs(slope) + 1e-4) << v;
    }
  }
}

TEST(EyeletFriction, IsAddedBesideALawThatHasNoneInMotion) {
  const double mu = 0.15, rest_ratio = 1.2, step = 1e-3, presliding = 1e-4;
  const SmoothStribeck thesis(1.25 * rest_ratio * mu, mu, 1e-3, 10.0);
  // exp(-1 m/s / v_s) is 2e-22 and 0.
  for (const double stribeck_velocity : {0.02, 0.001}) {
    const std::shared_ptr<const FrictionLaw> laws[] = {
        std::make_shared<SmoothStribeck>(0.2, 0.0, stribeck_velocity, 10.0),
        std::make_shared<Sticking>(0.2, 0.0, stribeck_velocity, presliding, step)};
    for (const auto& law : laws) {
      const auto more = raise_friction(law, mu, rest_ratio);
      ASSERT_EQ(more->state_size(), law->state_size());
      Memory plain(law->state_size()), raised(law->state_size()), nothing(0);
      for (const double v : {0.0, 2e-4, -5e-3, 1e-2, 1.0}) {
        const FrictionLaw::Value a = law->evaluate(v, plain), b = thesis.evaluate(v, nothing),
                                 both = more->evaluate(v, raised);
        EXPECT_NEAR(both.mu, a.mu + b.mu, 1e-15) << v;
        EXPECT_NEAR(both.slope, a.slope + b.slope, 1e-12 * std::abs(both.slope)) << v;
        EXPECT_NEAR(more->sliding_coefficient(std::abs(v)),
                    law->sliding_coefficient(std::abs(v)) + thesis.sliding_coefficient(std::abs(v)),
                    1e-15);
        law->commit(v, plain), more->commit(v, raised);
      }
    }
  }
}

TEST(EyeletFriction, SlopeOfABristleIsTheCurvesWhereItGivesBackToo) {
  for (const double rest_ratio : {0.5, 1.4, 2.0}) {
    const auto law =
        muscle_with(kRig,
                    {"eyelet_friction", "flexor/1", {{"mu", 0.1}, {"rest_ratio", rest_ratio}}},
                    "flexor")
            .path->obstacles()[1]
            .friction;
    for (const double bend : {-9e-6, -5e-6, 0.0, 5e-6}) {  // [m]; the model's law slides at 1e-5
      Memory memory(law->state_size());
      memory.at(0) = bend;
      for (const double v : {-2e-2, -2e-3, -5e-4, 1e-4, 5e-4, 3e-3, 2e-2}) {
        const double h = 1e-8;
        const double slope =
            (law->evaluate(v + h, memory).mu - law->evaluate(v - h, memory).mu) / (2.0 * h);
        EXPECT_NEAR(law->evaluate(v, memory).slope, slope, 1e-4 * std::abs(slope) + 1e-3)
            << rest_ratio << " " << bend << " " << v;
      }
    }
  }
}

TEST(WrapFriction, ActsWhereTheTendonSlidesOverTheSurface) {
  // The rig with a surface on the base, over which the flexor slides to its insertion on the arm.
  const TemporaryRobot robot("", "extends: " + config(kRig) + R"(
muscles:
  flexor:
    eyelet_friction: {law: none}
    path:
      - {point: [0.03, 0.0, 0.80], body: base}
      - {point: [0.03, 0.0, 0.62], body: base}
      - {cylinder: {origin: [0.01, 0.0, 0.5], axis: [0, 1, 0], radius: 0.025}, body: base}
      - {point: [0.02, 0.0, -0.08], body: arm}
effects:
  - {id: wrap_friction, place: flexor/2, mu: 0.2}
)");
  Simulation sim(robot.load());
  // The extensor swings the arm back and pulls the flexor over the surface.
  for (int i = 1; i <= 300; ++i) {
    sim.muscle_inputs().impose_position(0, 0.0, 0.0);
    sim.muscle_inputs().impose_position(1, 0.01 * i, 10.0);
    sim.step();
  }
  const Muscle& flexor = sim.muscle(0);
  const double turning = flexor.path().obstacles()[2].turning;
  ASSERT_GT(turning, 0.05);
  ASSERT_GT(flexor.tension(1), 1.0);
  ASSERT_GT(std::abs(flexor.sliding().slide_speed[0]), 0.002);
  EXPECT_NEAR(std::abs(std::log(flexor.tension(1) / flexor.tension(2))), 0.2 * turning,
              0.1 * 0.2 * turning);
  EXPECT_GT(flexor.friction_power(), 0.0);
}

TEST(EyeletPresliding, FrictionFollowsDisplacementAndStaysAtRest) {
  const double distance = 4e-4;
  const auto law =
      muscle_with(kArm, {"eyelet_presliding", "brachialis", {{"distance", distance}}}, "brachialis")
          .path->obstacles()[1]
          .friction;
  Memory state(law->state_size());
  const double v = 0.05, fast = 0.156 + 0.039 * std::exp(-50.0);
  for (int i = 0; i < 200; ++i) law->commit(v, state);
  EXPECT_NEAR(law->evaluate(v, state).mu, fast, 1e-9);
  // At rest it stays, at the static level.
  law->commit(0.0, state);
  EXPECT_NEAR(law->evaluate(0.0, state).mu, 0.195, 1e-9);
  // Back by x: z = -1 + 2 exp(-x / distance).
  for (int i = 1; i <= 30; ++i) {
    const double mu = law->evaluate(-v, state).mu;
    law->commit(-v, state);
    EXPECT_NEAR(mu, fast * (2.0 * std::exp(-v * kStep * i / distance) - 1.0), 1e-9) << i;
  }
  // The slope is the derivative of the displacement part.
  const double h = 1e-7, speed = 0.2;
  const double slope =
      (law->evaluate(speed + h, state).mu - law->evaluate(speed - h, state).mu) / (2.0 * h);
  EXPECT_NEAR(law->evaluate(speed, state).slope, slope, 1e-4 * slope);
}

TEST(EyeletPresliding, DistancesOfSeveralPlacesAddUp) {
  const auto law_of = [](const std::vector<EffectInstance>& effects) {
    const auto robot = robot_with(kArm, effects);
    return robot->muscles[robot->find_muscle("brachialis")].path->obstacles()[1].friction;
  };
  const EffectInstance all = {"eyelet_presliding", "all", {{"distance", 1e-3}}};
  const EffectInstance muscle = {"eyelet_presliding", "brachialis", {{"distance", 1e-4}}};
  const EffectInstance eyelet = {"eyelet_presliding", "brachialis/1", {{"distance", 4e-4}}};
  const std::pair<std::vector<EffectInstance>, double> cases[] = {
      {{all, muscle}, 1.1e-3}, {{muscle, eyelet}, 5e-4}, {{all, muscle, eyelet}, 1.5e-3}};
  for (const auto& [effects, distance] : cases) {
    const auto law = law_of(effects);
    ASSERT_EQ(law->state_size(), 1u);
    Memory state(1);
    const double back = 0.5, level = 0.156;  // fast, at the kinetic level
    for (int i = 0; i < 2000; ++i) law->commit(0.05, state);
    const double mu = law->evaluate(-back, state).mu;
    EXPECT_NEAR(mu, level * (2.0 * std::exp(-back * kStep / distance) - 1.0), 1e-9) << distance;
  }
}

/// Work that a law takes over three periods of a motion, the first of which only bends it, per
/// tension and angle.  @param speed of the phase, 0 to 1 [m/s]
double work_taken(const FrictionLaw& law, const std::function<double(double)>& speed) {
  Memory state(law.state_size());
  double work = 0.0;
  for (int i = 0; i < 3000; ++i) {
    const double v = speed(i % 1000 / 1000.0);
    if (i >= 1000) work += law.evaluate(v, state).mu * v * kStep;
    law.commit(v, state);
  }
  return work;
}

/// The same for strokes between -reach and reach, slow while friction gives back what has bent and
/// fast while it takes: the least work of all motions where friction falls with speed.
double least_work(const FrictionLaw& law, double reach) {
  const double slow = 1e-4, fast = 0.05;
  Memory state(law.state_size());
  double work = 0.0, at = 0.0;
  for (int stroke = 0; stroke < 12; ++stroke) {
    const double side = stroke % 2 == 0 ? 1.0 : -1.0;
    while ((reach - side * at) > 1e-12) {
      const double most = side * law.evaluate(0.0, state).mu < 0.0 ? slow : fast;
      const double v = side * std::min(most, (reach - side * at) / kStep);
      if (stroke >= 2) work += law.evaluate(v, state).mu * v * kStep;
      law.commit(v, state);
      at += v * kStep;
    }
  }
  return work;
}

TEST(SlidingFriction, NeverGivesEnergyOverACycle) {
  const double distance = 5e-4;
  const EffectInstance raised = {"eyelet_friction", "all", {{"mu", 0.2}, {"rest_ratio", 2.0}}};
  const std::vector<EffectInstance> cases[] = {
      {{"eyelet_friction", "all", {{"mu", 0.2}}}},
      {raised},
      {{"eyelet_presliding", "all", {{"distance", distance}}}},
      {{"eyelet_presliding", "all", {{"distance", distance}}}, raised}};
  for (const auto& effects : cases) {
    for (const char* file : {kRig, kArm}) {
      const auto law = robot_with(file, effects)->muscles[0].path->obstacles()[1].friction;
      for (const double reach : {1e-4, 1e-3, 1e-2}) {
        SCOPED_TRACE(effects.back().id + " " + file + " " + std::to_string(reach));
        EXPECT_GT(work_taken(*law,
                             [&](double phase) {
                               return 2.0 * M_PI * reach * std::cos(2.0 * M_PI * phase);
                             }),
                  0.0);
        // There fast and back slowly, and the other way round.
        for (const double there : {0.1, 0.9}) {
          EXPECT_GT(work_taken(*law,
                               [&](double phase) {
                                 return phase < there ? 2.0 * reach / there
                                                      : -2.0 * reach / (1.0 - there);
                               }),
                    0.0);
        }
        // Small reversals on the way.
        EXPECT_GT(work_taken(*law,
                             [&](double phase) {
                               return 2.0 * M_PI * reach *
                                      (std::cos(2.0 * M_PI * phase) +
                                       2.0 * std::cos(14.0 * M_PI * phase + 1.0));
                             }),
                  0.0);
      }
      // Presliding with less of a stroke than half the distance may give some: docs/effects.md.
      for (const double reach : {0.5 * distance, distance, 4.0 * distance}) {
        EXPECT_GT(least_work(*law, reach), 0.0) << effects.back().id << " " << file << " " << reach;
      }
    }
  }
}

TEST(WrappingSurface, TurnsTheStraightRigIntoTheWrappedOne) {
  const auto built = robot_with(kRig, {{"wrapping_surface", "flexor", {{"radius", 0.018}}},
                                       {"wrapping_surface", "extensor/2", {{"radius", 0.018}}}});
  Simulation with(built), wrapped(load_robot_model(config("two_muscle_rig/model_II.yaml"))),
      straight(load_robot_model(config(kRig)));
  double largest = 0.0;
  for (double q = -1.5; q <= 1.5; q += 0.1) {
    for (Simulation* sim : {&with, &wrapped, &straight}) sim->place({q}, {0.0, 0.0});
    for (int m = 0; m < 2; ++m) {
      EXPECT_NEAR(with.muscle(m).length(), wrapped.muscle(m).length(), 1e-12);
      EXPECT_NEAR(with.moment_arms(m)[0], wrapped.moment_arms(m)[0], 1e-12);
      largest = std::max(largest, wrapped.muscle(m).length() - straight.muscle(m).length());
    }
  }
  EXPECT_GT(largest, 0.005);
  const EffectParameter radius =
      find_effect("wrapping_surface")->parameters_at(straight.model(), "flexor")[0];
  EXPECT_NEAR(radius.bounds.hi, std::hypot(0.02, 0.08), 1e-12);  // the insertion's distance
}

TEST(WrappingSurface, MovesSegmentsBehindItUp) {
  const auto robot = robot_with("anthrob/model_I.yaml",
                                {{"wrapping_surface", "lateral_deltoid", {{"radius", 0.0127}}}});
  const auto with = robot->muscles[robot->find_muscle("lateral_deltoid")];
  EXPECT_EQ(with.path->obstacles().size(), 5u);
  EXPECT_EQ(with.spring_segment, 1);
  EXPECT_EQ(with.sensor_segment, 0);
  // Model II of the thesis has it on the same line.
  const auto two = load_robot_model(config(kArm));
  Simulation a(robot), b(two);
  const std::vector<double> q = {std::cos(0.4), 0.0, 0.0, std::sin(0.4), 0.5};
  a.place(q, std::vector<double>(11, 0.0));
  b.place(q, std::vector<double>(11, 0.0));
  EXPECT_NEAR(a.muscle(0).length(), b.muscle(0).length(), 5e-4);
}

TEST(WrappingSurface, LeavesTheOthersTheirPlacesInTheFile) {
  const std::string file = "anthrob/model_II.yaml";
  Simulation plain(load_robot_model(config(file)));
  const auto entries_of = [](const Simulation& sim, const std::string& muscle) {
    std::multiset<int> entries;
    for (const auto& contact : solved_path(sim, sim.model().find_muscle(muscle)).contacts) {
      entries.insert(contact.entry);
    }
    return entries;
  };
  int beside_another = 0;
  for (const std::string& place : find_effect("wrapping_surface")->places(plain.model())) {
    const std::string muscle = place.substr(0, place.find('/'));
    if (muscle == place || entries_of(plain, muscle).empty()) continue;
    ++beside_another;
    Simulation sim(robot_with(file, {{"wrapping_surface", place, {{"radius", 0.001}}}}));
    std::multiset<int> expected = entries_of(plain, muscle);
    expected.insert(-1);
    EXPECT_EQ(entries_of(sim, muscle), expected) << place;
  }
  EXPECT_GT(beside_another, 0);
}

TEST(WrappingSurface, IsNotOfferedWhereThereIsNoLineToBeRound) {
  // The bob's mass: off the ball joint's centre, which makes a line; or in it.
  const std::map<std::string, bool> masses = {{"0 0 -0.3", true}, {"0 0 0", false}};
  for (const auto& [mass, line] : masses) {
    const testing_support::TemporaryRobot robot(
        R"(<robot name="p"><link name="world"/>
        <joint name="ball" type="floating"><parent link="world"/><child link="bob"/></joint>
        <link name="bob"><inertial><origin xyz=")" +
            mass + R"("/><mass value="1"/>
        <inertia ixx="1e-2" ixy="0" ixz="0" iyy="1e-2" iyz="0" izz="1e-2"/></inertial></link>
        </robot>)",
        R"(robot: robot.urdf
gravity: [0, 0, -9.81]
joints:
  ball: {type: ball, center: [0, 0, 0]}
springs:
  band: {type: spring_damper, rest_length: 0.02, stiffness: 100, damping: 1}
actuators:
  ligament: {type: ligament}
muscles:
  band:
    actuator: ligament
    rest_tendon_length: 0.2
    spring: {kind: band, segment: 0}
    force_sensor_segment: 0
    path:
      - {point: [0.05, 0, 0.1], body: world}
      - {point: [0.05, 0, -0.1], body: bob}
)");
    const std::vector<std::string> expected =
        line ? std::vector<std::string>{"band/1", "band"} : std::vector<std::string>{};
    EXPECT_EQ(find_effect("wrapping_surface")->places(*robot.load()), expected) << mass;
  }
}

TEST(ViaPointShift, MovesOnePointAlongItsAxis) {
  const auto plain = load_robot_model(config(kRig));
  const auto robot = robot_with(kRig, {{"via_point_shift", "flexor/2/z", {{"shift", 0.01}}}});
  Simulation before(plain), after(robot);
  const Vec3 moved = after.muscle(0).path().segments().back().to_W -
                     before.muscle(0).path().segments().back().to_W;
  EXPECT_NEAR((moved - Vec3(0, 0, 0.01)).norm(), 0.0, 1e-12);
  EXPECT_EQ(after.muscle(1).length(), before.muscle(1).length());
}

TEST(ViaPointShift, AxesAreThoseOfTheLinkThatTheFileNames) {
  // `base` stands turned by 45 degrees on the body that it is a part of.
  Simulation before(load_robot_model(config(kArm)));
  Simulation after(
      robot_with(kArm, {{"via_point_shift", "biceps_brachii/0/x", {{"shift", 0.01}}}}));
  const int muscle = after.model().find_muscle("biceps_brachii");
  const Vec3 moved = after.muscle(muscle).path().segments().front().from_W -
                     before.muscle(muscle).path().segments().front().from_W;
  const Vec3 x = after.link_pose(after.model().skeleton->find_frame("base")).R.col(0);
  ASSERT_LT(x.x(), 0.9);
  EXPECT_NEAR((moved - 0.01 * x).norm(), 0.0, 1e-12);
}

TEST(WrappingSurface, ThatHidesAPathPointIsNamed) {
  try {
    robot_with(kRig, {{"wrapping_surface", "flexor", {{"radius", 0.09}}}});
    FAIL() << "not refused";
  } catch (const BadInput& error) {
    EXPECT_NE(std::string(error.what()).find("at rest, with wrapping_surface @ flexor; expected"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace anthrob
