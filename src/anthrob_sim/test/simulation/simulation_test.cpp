// The whole chain: oracle lengths, virtual work, rest, sticking, determinism, snapshots, memory.
#include "anthrob_sim/simulation.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <new>

#include "allocations.h"
#include "simulation/moving_arm.h"
#include "support.h"

namespace anthrob {
namespace {

using testing_support::anthrob_model;
using testing_support::config;
using testing_support::excite;
using testing_support::Random;
using testing_support::random_posture;
using testing_support::swing;

TEST(Anthrob, RestLengthsAreThoseOfTheOracle) {
  // l_M in mm, computed from the thesis's tables; l_T0 + l_0 agree with them within 0.15 mm.
  const std::map<std::string, double> lengths[] = {{{"lateral_deltoid", 344.52},
                                                    {"anterior_deltoid", 258.01},
                                                    {"posterior_deltoid", 293.03},
                                                    {"supraspinatus", 231.15},
                                                    {"infraspinatus", 228.19},
                                                    {"teres_minor", 219.48},
                                                    {"teres_major", 227.46},
                                                    {"pectoralis_major", 198.96},
                                                    {"biceps_brachii", 485.73},
                                                    {"triceps_brachii", 138.40},
                                                    {"brachialis", 185.30}},
                                                   {{"lateral_deltoid", 344.52},
                                                    {"anterior_deltoid", 260.24},
                                                    {"posterior_deltoid", 295.92},
                                                    {"supraspinatus", 235.98},
                                                    {"infraspinatus", 229.04},
                                                    {"teres_minor", 220.83},
                                                    {"teres_major", 229.93},
                                                    {"pectoralis_major", 198.96},
                                                    {"biceps_brachii", 486.45},
                                                    {"triceps_brachii", 138.40},
                                                    {"brachialis", 185.32}}};
  for (int i = 0; i < 2; ++i) {
    const Simulation sim(anthrob_model(i == 0 ? "I" : "II"));
    ASSERT_EQ(sim.muscle_count(), 11u);
    for (std::size_t m = 0; m < sim.muscle_count(); ++m) {
      const Muscle& muscle = sim.muscle(m);
      EXPECT_NEAR(1e3 * muscle.length(), lengths[i].at(muscle.model().name), 0.1)
          << muscle.model().name;
      EXPECT_NEAR(1e3 * muscle.expansion(), 0.0, 0.16) << muscle.model().name;
    }
  }
}

TEST(Anthrob, RestMomentArmsHaveTheSignsAndSizesOfTheOracle) {
  const Simulation sim(anthrob_model("I"));
  const auto& model = sim.model();
  // Child axes to world at rest; abduction about (-1, -1, 0)/sqrt 2, flexion about (1, -1,
  // 0)/sqrt 2.
  const Mat3 R_WC = sim.tree().joint(0).R_WC;
  const auto arm = [&](const std::string& name, const Vec3& axis_W) {
    const auto arms = sim.moment_arms(model.find_muscle(name));
    return 1e3 * axis_W.dot(R_WC * Vec3(arms[0], arms[1], arms[2]));
  };
  const auto elbow = [&](const std::string& name) {
    return 1e3 * sim.moment_arms(model.find_muscle(name))[3];
  };
  const Vec3 abduction = -Vec3(1, 1, 0).normalized(), flexion = Vec3(1, -1, 0).normalized();
  EXPECT_NEAR(arm("lateral_deltoid", abduction), 29, 0.6);
  EXPECT_NEAR(arm("posterior_deltoid", abduction), 7, 0.6);
  EXPECT_NEAR(arm("anterior_deltoid", abduction), -34, 0.6);
  EXPECT_NEAR(arm("pectoralis_major", abduction), -63, 0.6);
  EXPECT_NEAR(arm("anterior_deltoid", flexion), 24, 0.6);
  EXPECT_NEAR(arm("biceps_brachii", flexion), 26, 0.6);
  EXPECT_NEAR(arm("pectoralis_major", flexion), 26, 0.6);
  EXPECT_NEAR(arm("posterior_deltoid", flexion), -27, 0.6);
  EXPECT_NEAR(elbow("biceps_brachii"), 8, 0.6);
  EXPECT_NEAR(elbow("brachialis"), 14, 0.6);
  EXPECT_NEAR(elbow("triceps_brachii"), -22, 0.6);
}

TEST(Anthrob, ElbowMomentArmsOfTheStraightModelReproduceItsKnownFault) {
  Simulation sim(anthrob_model("I"));
  const auto elbow = [&](double angle, const std::string& name) {
    sim.place({1, 0, 0, 0, angle}, std::vector<double>(11, 0.0));
    return 1e3 * sim.moment_arms(sim.model().find_muscle(name))[3];
  };
  EXPECT_NEAR(elbow(M_PI / 2, "biceps_brachii"), 46, 0.6);
  EXPECT_NEAR(elbow(M_PI / 2, "brachialis"), 46, 0.6);
  EXPECT_NEAR(elbow(2.0 * M_PI / 3, "triceps_brachii"), 0, 1.0);
  EXPECT_GT(elbow(2.2, "triceps_brachii"), 0.0);  // the wrong sign
}

TEST(Anthrob, ArmLeftAloneStaysAtRest) {
  for (const char* model : {"I", "II", "III"}) {
    Simulation sim(anthrob_model(model));
    sim.step(10000);
    const auto& q = sim.configuration();
    EXPECT_LT(angular_distance(Quat(q[0], q[1], q[2], q[3]), Quat::Identity()), M_PI / 180);
    EXPECT_NEAR(q[4], 0.0, M_PI / 180);
    for (std::size_t m = 0; m < sim.muscle_count(); ++m) EXPECT_LT(sim.muscle(m).force(), 1.0);
  }
}

/// Virtual work in random postures: moment arms against finite differences of the length.
void expect_virtual_work(const std::shared_ptr<const RobotModel>& model, unsigned seed,
                         int postures) {
  Random random(seed);
  Simulation sim(model);
  const std::vector<double> positions(sim.muscle_count(), 0.0);
  const double h = 1e-5;
  for (int i = 0; i < postures; ++i) {
    const std::vector<double> q = random_posture(random);
    sim.place(q, positions);
    std::vector<std::vector<double>> arms;
    for (std::size_t m = 0; m < sim.muscle_count(); ++m) arms.push_back(sim.moment_arms(m));
    for (int k = 0; k < model->skeleton->velocity_count; ++k) {
      std::vector<double> ends[2];
      for (int side = 0; side < 2; ++side) {
        const double turn = side == 0 ? -h : h;
        std::vector<double> moved = q;
        if (k < 3) {
          const Quat r =
              Quat(q[0], q[1], q[2], q[3]) * Quat(Eigen::AngleAxisd(turn, Vec3::Unit(k)));
          moved[0] = r.w(), moved[1] = r.x(), moved[2] = r.y(), moved[3] = r.z();
        } else {
          moved[4] += turn;
        }
        sim.place(moved, positions);
        for (std::size_t m = 0; m < sim.muscle_count(); ++m)
          ends[side].push_back(sim.muscle(m).length());
      }
      for (std::size_t m = 0; m < sim.muscle_count(); ++m) {
        ASSERT_NEAR(arms[m][k], -(ends[1][m] - ends[0][m]) / (2 * h), 1e-6)
            << model->muscles[m].name << " posture " << i << " axis " << k;
      }
    }
  }
}

TEST(Anthrob, ForceTimesMomentArmIsVirtualWork) {
  expect_virtual_work(anthrob_model("I"), 1, 100);
  expect_virtual_work(anthrob_model("II"), 2, 100);
  expect_virtual_work(anthrob_model("III"), 3, 100);
}

TEST(Simulation, SameInputsSameBits) {
  const auto run = [] {
    Simulation sim(anthrob_model("II"));
    Random random(5);
    std::vector<double> trace;
    for (int i = 0; i < 3000; ++i) {
      if (i % 200 == 0) {
        sim.command(random.integer(0, 10), static_cast<ecu::Mode>(random.integer(0, 3)),
                    random.uniform(0.0, 2.0));
      }
      sim.step();
      if (i % 100 == 0) {
        trace.insert(trace.end(), sim.configuration().begin(), sim.configuration().end());
        for (int m = 0; m < 11; ++m) trace.push_back(sim.muscle(m).force());
      }
    }
    return trace;
  };
  EXPECT_EQ(run(), run());
}

void expect_same_bits(const Simulation& a, const Simulation& b) {
  const Snapshot x = a.snapshot(), y = b.snapshot();
  EXPECT_EQ(x.step_index, y.step_index);
  EXPECT_EQ(x.state, y.state);
  EXPECT_EQ(x.q, y.q);
  for (std::size_t i = 0; i < x.bodies.size(); ++i) {
    EXPECT_EQ(x.bodies[i].X_WB.R, y.bodies[i].X_WB.R);
    EXPECT_EQ(x.bodies[i].X_WB.p, y.bodies[i].X_WB.p);
    EXPECT_EQ(x.bodies[i].v_W, y.bodies[i].v_W);
    EXPECT_EQ(x.bodies[i].w_W, y.bodies[i].w_W);
  }
}

TEST(Simulation, SnapshotInMidFlightContinuesWithTheSameBits) {
  const auto model = anthrob_model("II");
  Simulation original(model);
  excite(original);
  original.step(457);
  const Snapshot snapshot = original.snapshot();
  original.step(800);

  Simulation fresh(model);
  fresh.restore(snapshot);
  fresh.step(800);
  expect_same_bits(original, fresh);

  original.restore(snapshot);
  original.step(800);
  expect_same_bits(original, fresh);
}

TEST(Simulation, RestoringLeavesTheStateThatItWasGiven) {
  for (const char* name : {"II", "III"}) {
    Simulation sim(anthrob_model(name));
    excite(sim);
    sim.step(100);
    const Snapshot snapshot = sim.snapshot();
    sim.restore(snapshot);
    EXPECT_EQ(sim.snapshot().state, snapshot.state) << name;
  }
}

TEST(Simulation, RestoringAndPlacingBringTheLastStepsLossesToo) {
  const auto losses = [](const Simulation& sim) {
    std::vector<double> powers{sim.last_step().joint_dissipation};
    for (std::size_t m = 0; m < sim.muscle_count(); ++m)
      powers.push_back(sim.muscle(m).friction_power());
    return powers;
  };
  Simulation original(anthrob_model("II"));
  excite(original);
  original.step(457);
  const Snapshot snapshot = original.snapshot();
  const std::vector<double> then = losses(original);
  EXPECT_GT(then[0], 0.0);
  EXPECT_NE(then[1], 0.0);
  original.step(200);
  original.restore(snapshot);
  EXPECT_EQ(losses(original), then);
  Simulation fresh(anthrob_model("II"));
  fresh.restore(snapshot);
  EXPECT_EQ(losses(fresh), then);
  fresh.place(fresh.configuration(), std::vector<double>(11, 0.0));
  EXPECT_EQ(losses(fresh), std::vector<double>(12, 0.0));
}

TEST(Simulation, SnapshotOfAnotherModelIsRefused) {
  Simulation one(anthrob_model("I")), two(anthrob_model("II"));
  EXPECT_THROW(one.restore(two.snapshot()), BadInput);
  Snapshot other = one.snapshot();
  other.q.pop_back();
  EXPECT_THROW(one.restore(other), BadInput);
}

TEST(Simulation, WhatIsNotThereIsRefused) {
  Simulation sim(anthrob_model("I"));
  const int nobody = sim.model().find_muscle("nobody");
  EXPECT_THROW(sim.muscle(nobody), BadInput);
  EXPECT_THROW(sim.reading(nobody), BadInput);
  EXPECT_THROW(sim.moment_arms(nobody), BadInput);
  EXPECT_THROW(sim.link_pose(99), BadInput);
  EXPECT_THROW(sim.measured_joint_position(2), BadInput);
  EXPECT_THROW(sim.read_velocity(-1), BadInput);
  EXPECT_THROW(sim.joint_effort(2), BadInput);
  EXPECT_THROW(sim.joint_load(2), BadInput);
}

TEST(Simulation, DoesNotAllocateWhileStepping) {
  for (const char* model : {"I", "II", "III"}) {
    Simulation sim(anthrob_model(model));
    excite(sim);
    sim.step(10);
    const std::size_t before = testing_support::allocations();
    sim.step(500);
    EXPECT_EQ(testing_support::allocations(), before);
    std::vector<double> posture = sim.configuration();
    const std::size_t imposed = testing_support::allocations();
    for (int i = 0; i < 100; ++i) {
      posture.back() += 1e-4;
      sim.imposed_posture().impose(posture);
      sim.step();
    }
    EXPECT_EQ(testing_support::allocations(), imposed);
    std::vector<double>* probe = new std::vector<double>(100);  // the counter works
    EXPECT_GT(testing_support::allocations(), before);
    delete probe;
  }
}

TEST(Simulation, AnImposedPostureIsPartOfASnapshotAndOfNoReset) {
  Simulation original(anthrob_model("II")), fresh(anthrob_model("II"));
  excite(original);
  original.imposed_posture().impose(swing(0.1));
  original.step(50);
  const Snapshot snapshot = original.snapshot();
  original.step(200);
  fresh.restore(snapshot);
  fresh.step(200);
  expect_same_bits(original, fresh);
  EXPECT_EQ(fresh.configuration(), snapshot.q);
  fresh.reset();
  excite(fresh);
  fresh.step(200);
  EXPECT_NE(fresh.configuration(), snapshot.q);
  Snapshot other = snapshot;
  other.posture.pop_back();
  EXPECT_THROW(fresh.restore(other), BadInput);
}

TEST(Simulation, PlaceKeepsWrappingStatesOfAContinuousMotion) {
  // Triceps passes the flip of its normal near 120 degrees: placed directly it would lie on the
  // wrong side.
  Simulation placed(anthrob_model("II"));
  const int triceps = placed.model().find_muscle("triceps_brachii");
  placed.place({1, 0, 0, 0, 2.3}, std::vector<double>(11, 0.0));
  const auto& wrap = placed.muscle(triceps).path().obstacles()[3];
  EXPECT_TRUE(wrap.touching);
  EXPECT_LT(placed.moment_arms(triceps)[3], -0.0149);  // still extends, over the 15 mm cylinder
}

TEST(Simulation, CommandsAreChecked) {
  Simulation sim(anthrob_model("I"));
  EXPECT_THROW(sim.command(11, ecu::Mode::kVoltage, 1.0), BadInput);
  EXPECT_THROW(sim.command(-1, ecu::Mode::kVoltage, 1.0), BadInput);
  EXPECT_THROW(sim.command(0, ecu::Mode::kVoltage, std::nan("")), BadInput);
  EXPECT_THROW(sim.apply_effort(1, 1.0), BadInput);
  EXPECT_THROW(sim.apply_load(0, 1.0), BadInput);
  EXPECT_THROW(sim.apply_effort(-1, 1.0), BadInput);
  EXPECT_THROW(sim.apply_load(99, 1.0), BadInput);
}

TEST(Simulation, ExplodingModelIsReportedNotContinued) {
  // A stiff spring (ten thousand times the ring) at a step far too long for it.
  const auto model = anthrob_model("I", 1e-3, {{"springs.ring_15x5.modulus", 0.8e12}});
  Simulation sim(model);
  sim.command(0, ecu::Mode::kVoltage, 12.0);
  try {
    sim.step(5000);
    FAIL() << "expected a numerical failure";
  } catch (const NumericalFailure& failure) {
    EXPECT_GT(failure.time(), 0.0);
    const std::string text = failure.what();
    EXPECT_TRUE(text.find("body ") != std::string::npos ||
                text.find("muscle ") != std::string::npos)
        << text;
  }
}

TEST(Simulation, NumbersThatAreNotFiniteAreRefused) {
  Simulation sim(anthrob_model("I"));
  const std::vector<double> rest = {1, 0, 0, 0, 0}, zero(11, 0.0);
  const std::vector<double> before = sim.configuration();
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL, 1e9}) {
    for (std::size_t i = 0; i < rest.size(); ++i) {
      std::vector<double> q = rest;
      q[i] = bad;
      EXPECT_THROW(sim.place(q, zero), BadInput);
    }
    std::vector<double> positions = zero;
    positions[3] = bad;
    EXPECT_THROW(sim.place(rest, positions), BadInput);
    EXPECT_THROW(sim.muscle_inputs().impose_position(0, bad, 0.0), BadInput);
    EXPECT_THROW(sim.muscle_inputs().impose_position(0, 0.0, bad), BadInput);
  }
  for (const double bad : {std::nan(""), HUGE_VAL}) EXPECT_THROW(sim.apply_load(1, bad), BadInput);
  EXPECT_THROW(sim.place({0, 0, 0, 0, 0}, zero), BadInput);
  EXPECT_EQ(sim.configuration(), before);
  sim.step(10);
}

/// What is left of a simulation in which one number of its state was broken.
std::string failure_of(const std::function<void(Snapshot&)>& change) {
  Simulation sim(anthrob_model("I"));
  sim.step(5);
  Snapshot snapshot = sim.snapshot();
  change(snapshot);
  sim.restore(snapshot);
  try {
    sim.step();
  } catch (const NumericalFailure& failure) {
    return failure.what();
  }
  return "";
}

TEST(Simulation, EveryKindOfBrokenNumberIsNoticed) {
  const double nan = std::nan("");
  EXPECT_NE(failure_of([&](Snapshot& s) { s.bodies[2].v_W.x() = nan; }), "");
  EXPECT_NE(failure_of([&](Snapshot& s) { s.bodies[2].X_WB.p.x() = nan; }), "");
  EXPECT_NE(failure_of([&](Snapshot& s) { s.bodies[2].X_WB.R(0, 0) = nan; }), "");
  EXPECT_NE(failure_of([&](Snapshot& s) { s.q[4] = nan; }), "");
  // All that an actuator remembers: rubber takes a length that is no number for slack.
  const std::size_t memory = anthrob_model("I")->muscles[0].actuator->state_size();
  for (std::size_t i = 0; i < memory; ++i) {
    EXPECT_NE(failure_of([&](Snapshot& s) { s.state[i] = nan; }), "") << i;
  }
}

TEST(Simulation, ResetBringsBackWhatFailed) {
  const auto model = anthrob_model("I");
  Simulation sim(model), fresh(model);
  Snapshot broken = sim.snapshot();
  broken.bodies[1].w_W.y() = std::nan("");
  sim.restore(broken);
  EXPECT_THROW(sim.step(), NumericalFailure);
  sim.reset();
  fresh.step();  // the same time for both: that of the step that failed
  fresh.reset();
  for (Simulation* s : {&sim, &fresh}) s->command(0, ecu::Mode::kPosition, 3.0);
  sim.step(500);
  fresh.step(500);
  EXPECT_EQ(sim.configuration(), fresh.configuration());
  EXPECT_EQ(sim.snapshot().state, fresh.snapshot().state);
}

TEST(Simulation, PlacingManyTurnsAwayTakesNoLongerThanFifty) {
  const testing_support::TemporaryRobot wheel(
      R"(<robot name="wheel"><link name="base"/>
      <joint name="axle" type="continuous"><parent link="base"/><child link="disc"/><axis xyz="0 1 0"/></joint>
      <link name="disc"><inertial><mass value="1"/>
      <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link></robot>)",
      "robot: robot.urdf\ngravity: [0, 0, -9.81]\njoints:\n  axle: {driven: true}\n");
  Simulation sim(wheel.load());
  const auto start = std::chrono::steady_clock::now();
  sim.place({9e8}, {});
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2));
  EXPECT_EQ(sim.configuration()[0], 9e8);
  sim.step();
  EXPECT_NEAR(sim.configuration()[0], 9e8, 1e-6);
}

TEST(Simulation, SkippedStepsMoveNothingButTime) {
  Simulation sim(anthrob_model("I"));
  sim.place({1, 0, 0, 0, 1.0}, std::vector<double>(11, 0.0));
  sim.step(3);
  const Snapshot before = sim.snapshot();
  sim.skip(20);
  const Snapshot after = sim.snapshot();
  EXPECT_DOUBLE_EQ(sim.time(), 0.023);
  EXPECT_EQ(after.q, before.q);
  EXPECT_EQ(after.state, before.state);
}

TEST(Simulation, RobotWithoutJointsRuns) {
  // A motor pulls a rubber ring at a wall; 3 N at rest, some 20 N a radian.
  Simulation sim(load_robot_model(config("rig_oring_stretcher/model_I.yaml"), {0.002, {}}));
  const double rest = sim.muscle(0).force();
  sim.command(0, ecu::Mode::kPosition, 0.5);
  sim.step(1000);
  EXPECT_NEAR(rest, 3.0, 0.1);
  EXPECT_NEAR(sim.muscle(0).actuator().position, 0.5, 0.02);
  EXPECT_GT(sim.muscle(0).force(), 15.0);
}

TEST(Simulation, ElbowStopHoldsTheArm) {
  Simulation sim(anthrob_model("II"));
  const int triceps = sim.model().find_muscle("triceps_brachii");
  sim.command(triceps, ecu::Mode::kPosition, 1.0);  // extends against the stop
  sim.step(5000);
  EXPECT_GT(sim.muscle(triceps).spring_tension(), 3.0);
  EXPECT_LT(sim.configuration()[4], 0.0);
  EXPECT_GT(sim.configuration()[4], -0.003);
}

}  // namespace
}  // namespace anthrob
