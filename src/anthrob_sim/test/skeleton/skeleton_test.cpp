// Bodies and joints: Bullet's step with the tree solver, and the joint-space view, against closed
// forms, invariants and Bullet's own constraint solver.
#include "skeleton/skeleton.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "support.h"

namespace anthrob {
namespace {

using testing_support::Random;

/// A random tree of bodies with all kinds of joints.
SkeletonModel random_tree(Random& random, int joints) {
  SkeletonModel model;
  model.bodies.resize(joints + 1);
  model.bodies[0].name = "world";
  for (int i = 0; i < joints; ++i) {
    BodyModel& body = model.bodies[i + 1];
    body.name = "body_" + std::to_string(i + 1);
    body.mass = random.uniform(0.1, 1.0);
    body.X_LB = random.pose(0.05);
    const double size = random.uniform(0.03, 0.1);
    body.principal =
        body.mass * size * size *
        Vec3(random.uniform(0.8, 1.0), random.uniform(0.8, 1.0), random.uniform(0.8, 1.0));
    JointModel joint;
    joint.name = "joint_" + std::to_string(i);
    joint.type = static_cast<JointType>(random.integer(0, 2));
    joint.parent = random.integer(0, i);
    joint.child = i + 1;
    joint.X_PC_rest = random.pose(0.1);
    joint.center_C = random.vector(0.1);
    joint.axis_C = random.direction();
    joint.position_offset = model.position_count;
    joint.velocity_offset = model.velocity_count;
    model.position_count += joint.position_size();
    model.velocity_count += joint.dof();
    model.joints.push_back(joint);
  }
  return model;
}

std::vector<double> random_positions(const SkeletonModel& model, Random& random) {
  std::vector<double> q(model.position_count);
  for (const auto& joint : model.joints) {
    if (joint.type == JointType::kBall) {
      const Quat turn = canonical(random.rotation());
      q[joint.position_offset] = turn.w();
      q[joint.position_offset + 1] = turn.x();
      q[joint.position_offset + 2] = turn.y();
      q[joint.position_offset + 3] = turn.z();
    } else {
      q[joint.position_offset] = random.uniform(-0.5, 0.5);
    }
  }
  return q;
}

std::vector<double> random_velocities(const SkeletonModel& model, Random& random, double size) {
  std::vector<double> u(model.velocity_count);
  for (double& x : u) x = random.uniform(-size, size);
  return u;
}

double kinetic_energy(const SkeletonModel& model, const std::vector<BodyState>& bodies) {
  double energy = 0.0;
  for (std::size_t i = 1; i < bodies.size(); ++i) {
    const Vec3 w = bodies[i].X_WB.R.transpose() * bodies[i].w_W;
    energy += 0.5 * model.bodies[i].mass * bodies[i].v_W.squaredNorm() +
              0.5 * w.dot(model.bodies[i].principal.cwiseProduct(w));
  }
  return energy;
}

double total_energy(const SkeletonModel& model, const std::vector<BodyState>& bodies,
                    const Vec3& g) {
  double energy = kinetic_energy(model, bodies);
  for (std::size_t i = 1; i < bodies.size(); ++i) {
    energy -= model.bodies[i].mass * g.dot(bodies[i].X_WB.p);
  }
  return energy;
}

TEST(KinematicTree, PlaceAndUpdateAreInverse) {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const SkeletonModel model = random_tree(random, 6);
    KinematicTree tree(model);
    const std::vector<double> q = random_positions(model, random);
    const std::vector<double> u = random_velocities(model, random, 2.0);
    std::vector<BodyState> bodies;
    tree.place(q, u, bodies);
    std::vector<double> seen(q.size(), 0.0);
    tree.update(bodies, seen);
    for (std::size_t k = 0; k < q.size(); ++k) EXPECT_NEAR(seen[k], q[k], 1e-12);
    for (std::size_t k = 0; k < u.size(); ++k) EXPECT_NEAR(tree.velocities()[k], u[k], 1e-12);
  }
}

TEST(KinematicTree, MassMatrixGivesTheKineticEnergyOfTheBodies) {
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const SkeletonModel model = random_tree(random, 6);
    KinematicTree tree(model);
    const std::vector<double> u = random_velocities(model, random, 3.0);
    std::vector<BodyState> bodies;
    tree.place(random_positions(model, random), u, bodies);
    std::vector<double> q(model.position_count, 0.0);
    tree.update(bodies, q);
    tree.update_dynamics(bodies, Vec3(0, 0, -9.81));
    const Eigen::Map<const Eigen::VectorXd> v(u.data(), u.size());
    const double energy = kinetic_energy(model, bodies);
    EXPECT_NEAR(0.5 * v.dot(tree.mass_matrix() * v), energy, 1e-12 * energy);
  }
}

/// Advances a posture exactly along constant generalised velocities (ball joints: world axes) by a
/// small time.
void nudge(const SkeletonModel& model, const KinematicTree& tree, std::vector<double>& q,
           const std::vector<double>& u, double dt) {
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const JointModel& joint = model.joints[j];
    double* p = &q[joint.position_offset];
    const double* s = &u[joint.velocity_offset];
    if (joint.type != JointType::kBall) {
      p[0] += s[0] * dt;
      continue;
    }
    const Vec3 w_C = tree.joint(j).R_WC.transpose() * Vec3(s[0], s[1], s[2]);
    const double angle = w_C.norm() * dt;
    const Quat turned =
        Quat(p[0], p[1], p[2], p[3]) * Quat(Eigen::AngleAxisd(angle, w_C.normalized()));
    p[0] = turned.w(), p[1] = turned.x(), p[2] = turned.y(), p[3] = turned.z();
  }
}

TEST(KinematicTree, BiasForcesKeepTheEnergy) {
  // With du/dt = -M^-1 bias nothing works on the bodies but gravity: the total energy has no first
  // derivative, along the motion.
  Random random(3);
  const Vec3 g(0.3, -0.5, -9.81);
  for (int i = 0; i < 50; ++i) {
    const SkeletonModel model = random_tree(random, 5);
    KinematicTree tree(model);
    const std::vector<double> q = random_positions(model, random);
    const std::vector<double> u = random_velocities(model, random, 2.0);
    std::vector<BodyState> bodies;
    tree.place(q, u, bodies);
    std::vector<double> seen = q;
    tree.update(bodies, seen);
    tree.update_dynamics(bodies, g);
    const Eigen::VectorXd a = -tree.mass_matrix().llt().solve(tree.bias());
    const double dt = 1e-5;
    double energies[2];
    for (int side = 0; side < 2; ++side) {
      const double h = side == 0 ? -dt : dt;
      std::vector<double> q2 = q, u2 = u;
      std::vector<double> mean = u;
      for (std::size_t k = 0; k < u.size(); ++k) {
        mean[k] += 0.5 * h * a[k];
        u2[k] += h * a[k];
      }
      nudge(model, tree, q2, mean, h);
      std::vector<BodyState> moved;
      tree.place(q2, u2, moved);
      energies[side] = total_energy(model, moved, g);
    }
    const double power = (energies[1] - energies[0]) / (2 * dt);
    const double scale =
        a.cwiseAbs().dot(tree.mass_matrix().cwiseAbs() *
                         Eigen::Map<const Eigen::VectorXd>(u.data(), u.size()).cwiseAbs());
    EXPECT_NEAR(power, 0.0, 1e-6 * scale);
  }
}

TEST(Skeleton, JointsHoldAndTheBiasIsBullets) {
  // One small step in Bullet against the joint-space prediction: an independent formulation.
  Random random(4);
  const double h = 1e-5;
  const Vec3 g(0, 0, -9.81);
  for (int i = 0; i < 50; ++i) {
    const SkeletonModel model = random_tree(random, 6);
    KinematicTree tree(model);
    std::vector<double> q = random_positions(model, random);
    const std::vector<double> u = random_velocities(model, random, 2.0);
    std::vector<BodyState> bodies;
    tree.place(q, u, bodies);
    Skeleton skeleton(model, g, h, false);
    skeleton.set_bodies(bodies);
    // The first step only brings velocities into phase: half a step ahead of positions.
    skeleton.step();
    tree.update(skeleton.bodies(), q);
    tree.update_dynamics(skeleton.bodies(), g);
    const std::vector<double> before = tree.velocities();
    const Eigen::VectorXd expected = -tree.mass_matrix().llt().solve(tree.bias());
    skeleton.step();
    tree.update(skeleton.bodies(), q);
    for (int k = 0; k < model.velocity_count; ++k) {
      const double acceleration = (tree.velocities()[k] - before[k]) / h;
      EXPECT_NEAR(acceleration, expected[k], 2e-3 * (1.0 + std::abs(expected[k]))) << "tree " << i;
    }
  }
}

TEST(Skeleton, TreeSolverAgreesWithBulletsOwnSolver) {
  // The same robots through Bullet's world with its LCP solver (chosen for collisions): a
  // velocity-level scheme of first order, so they agree to the order of the step.
  Random random(5);
  for (int i = 0; i < 10; ++i) {
    const SkeletonModel model = random_tree(random, 8);
    KinematicTree tree(model);
    std::vector<BodyState> bodies;
    tree.place(random_positions(model, random), random_velocities(model, random, 1.0), bodies);
    Skeleton ours(model, Vec3(0, 0, -9.81), 1e-3, false),
        bullets(model, Vec3(0, 0, -9.81), 1e-3, true);
    ours.set_bodies(bodies);
    bullets.set_bodies(bodies);
    for (int step = 0; step < 20; ++step) {
      ours.clear_wrenches();
      bullets.clear_wrenches();
      ours.step();
      bullets.step();
    }
    for (std::size_t b = 1; b < bodies.size(); ++b) {
      EXPECT_LT((ours.bodies()[b].X_WB.p - bullets.bodies()[b].X_WB.p).norm(), 5e-6);
      EXPECT_LT((ours.bodies()[b].w_W - bullets.bodies()[b].w_W).norm(), 2e-3);
    }
  }
}

SkeletonModel anthrob_without_friction() {
  SkeletonModel model = load_urdf(testing_support::config("anthrob/robot.urdf"));
  model.joints[0].center_C = Vec3(0, 0.22, 0);
  return model;
}

double relative_drift(double step, double seconds) {
  const SkeletonModel model = anthrob_without_friction();
  const Vec3 g(0, 0, -9.81);
  KinematicTree tree(model);
  std::vector<BodyState> bodies;
  const Quat raised(Eigen::AngleAxisd(1.0, Vec3(0.6, 0.3, 0.74).normalized()));
  tree.place({raised.w(), raised.x(), raised.y(), raised.z(), 0.8}, {0.5, 0.2, 0.3, 1.0}, bodies);
  Skeleton skeleton(model, g, step, false);
  skeleton.set_bodies(bodies);
  const double start = total_energy(model, bodies, g);
  // Energy that can be turned over: falling from the start to hanging down.
  tree.place(model.rest_configuration(), {}, bodies);
  const double available = start - total_energy(model, bodies, g);
  double worst = 0.0;
  for (int i = 0; i < static_cast<int>(seconds / step); ++i) {
    skeleton.clear_wrenches();
    skeleton.step();
    worst =
        std::max(worst, std::abs(total_energy(model, skeleton.bodies(), g) - start) / available);
  }
  return worst;
}

TEST(Skeleton, LosslessDoublePendulumKeepsItsEnergy) {
  const double coarse = relative_drift(1e-3, 10.0), fine = relative_drift(2.5e-4, 10.0);
  RecordProperty("drift_1ms", std::to_string(coarse));
  EXPECT_LT(coarse, 5e-3);
  EXPECT_LT(fine, 0.5 * coarse);
}

TEST(Skeleton, PendulumPeriodIsThatOfThePhysicalPendulum) {
  // One body on a hinge, small swings: T = 2 pi sqrt(I / (m g l)).
  SkeletonModel model;
  model.bodies.resize(2);
  model.bodies[1].mass = 0.7;
  model.bodies[1].principal = Vec3(2e-3, 2.2e-3, 5e-4);
  JointModel joint;
  joint.type = JointType::kHinge;
  joint.child = 1;
  joint.axis_C = Vec3::UnitX();
  joint.center_C = Vec3(0, 0, 0.13);
  joint.X_PC_rest.p = Vec3(0, 0, -0.13);
  model.joints.push_back(joint);
  model.position_count = model.velocity_count = 1;
  KinematicTree tree(model);
  std::vector<BodyState> bodies;
  const double amplitude = 0.01;
  tree.place({amplitude}, {}, bodies);
  Skeleton skeleton(model, Vec3(0, 0, -9.81), 1e-4, false);
  skeleton.set_bodies(bodies);
  std::vector<double> q{amplitude};
  int crossings = 0;
  double first = 0.0, last = 0.0, before = amplitude;
  for (int i = 1; crossings < 21; ++i) {
    skeleton.clear_wrenches();
    skeleton.step();
    tree.update(skeleton.bodies(), q);
    if (q[0] < 0 && before >= 0) {
      const double t = (i - q[0] / (q[0] - before)) * 1e-4;
      if (crossings++ == 0) first = t;
      last = t;
    }
    before = q[0];
  }
  const double I = 2e-3 + 0.7 * 0.13 * 0.13;
  const double period =
      2 * M_PI * std::sqrt(I / (0.7 * 9.81 * 0.13)) * (1 + amplitude * amplitude / 16);
  EXPECT_NEAR((last - first) / 20, period, 1e-5 * period);
}

TEST(Skeleton, FreeTopPrecessesWithItsAngularMomentum) {
  // A ball joint at the centre of mass, no gravity: angular momentum and energy stay.
  SkeletonModel model;
  model.bodies.resize(2);
  model.bodies[1].mass = 1.0;
  model.bodies[1].principal = Vec3(1e-3, 2e-3, 2.8e-3);
  JointModel joint;
  joint.type = JointType::kBall;
  joint.child = 1;
  model.joints.push_back(joint);
  model.position_count = 4, model.velocity_count = 3;
  KinematicTree tree(model);
  std::vector<BodyState> bodies;
  tree.place({1, 0, 0, 0}, {0.1, 5.0, 0.2}, bodies);
  Skeleton skeleton(model, Vec3::Zero(), 1e-4, false);
  skeleton.set_bodies(bodies);
  const auto momentum = [&](const BodyState& b) -> Vec3 {
    return b.X_WB.R * model.bodies[1].principal.cwiseProduct(b.X_WB.R.transpose() * b.w_W);
  };
  const Vec3 L = momentum(bodies[1]);
  for (int i = 0; i < 20000; ++i) {
    skeleton.clear_wrenches();
    skeleton.step();
  }
  EXPECT_LT((momentum(skeleton.bodies()[1]) - L).norm(), 2e-3 * L.norm());
}

TEST(Skeleton, JointsDoNotDriftApart) {
  const SkeletonModel model = anthrob_without_friction();
  KinematicTree tree(model);
  std::vector<BodyState> bodies;
  const Quat raised(Eigen::AngleAxisd(1.2, Vec3(0.2, 0.9, 0.3).normalized()));
  tree.place({raised.w(), raised.x(), raised.y(), raised.z(), 1.0}, {3, -2, 4, 5}, bodies);
  Skeleton skeleton(model, Vec3(0, 0, -9.81), 1e-3, false);
  skeleton.set_bodies(bodies);
  const Vec3 center_B = model.bodies[1].X_LB.inverse() * Vec3(0, 0.22, 0);
  std::vector<double> q = model.rest_configuration();
  for (int i = 0; i < 10000; ++i) {
    skeleton.clear_wrenches();
    skeleton.step();
    tree.update(skeleton.bodies(), q);
    // At up to 10 rad/s.
    ASSERT_LT((skeleton.bodies()[1].X_WB * center_B - tree.joint(0).center_W).norm(), 1e-6) << i;
  }
}

TEST(Skeleton, LargeRatiosOfMassesHoldAndKeepTheEnergy) {
  for (const double ratio : {1e-3, 1e3}) {
    SkeletonModel model = anthrob_without_friction();
    model.bodies[2].mass *= ratio;  // the forearm
    model.bodies[2].principal *= ratio;
    KinematicTree tree(model);
    std::vector<BodyState> bodies;
    const Quat raised(Eigen::AngleAxisd(1.2, Vec3(0.2, 0.9, 0.3).normalized()));
    tree.place({raised.w(), raised.x(), raised.y(), raised.z(), 1.0}, {1, -1, 1, 2}, bodies);
    const Vec3 gravity(0, 0, -9.81);
    Skeleton skeleton(model, gravity, 1e-4, false);
    skeleton.set_bodies(bodies);
    const Vec3 center_B = model.bodies[1].X_LB.inverse() * Vec3(0, 0.22, 0);
    std::vector<double> q = model.rest_configuration();
    const double begun = total_energy(model, bodies, gravity);
    double turned_over = 0.0;  // between kinetic and potential energy
    for (int i = 0; i < 20000; ++i) {
      skeleton.clear_wrenches();
      skeleton.step();
      tree.update(skeleton.bodies(), q);
      ASSERT_LT((skeleton.bodies()[1].X_WB * center_B - tree.joint(0).center_W).norm(), 1e-6) << i;
      turned_over = std::max(turned_over, kinetic_energy(model, skeleton.bodies()));
    }
    const double lost = total_energy(model, skeleton.bodies(), gravity) - begun;
    EXPECT_LT(std::abs(lost), 5e-3 * turned_over) << ratio;
  }
}

TEST(Skeleton, CollisionShapesStopAFallingBody) {
  // A ball, hinged to a light carriage on a vertical slide, falls onto the ground plate and rests
  // there. (Bodies that share a joint do not collide with each other.)
  SkeletonModel model;
  model.bodies.resize(3);
  CollisionModel plate, ball;
  plate.type = ShapeType::kBox, plate.size = Vec3(1, 1, 0.1), plate.X_LS.p = Vec3(0, 0, -0.05);
  ball.type = ShapeType::kSphere, ball.size = Vec3(0.05, 0, 0);
  model.bodies[0].collisions = {plate};
  model.bodies[2].collisions = {ball};
  for (int i : {1, 2}) {
    model.bodies[i].mass = 0.2;
    model.bodies[i].principal = Vec3::Constant(2e-4);
  }
  JointModel slide, hinge;
  slide.type = JointType::kPrismatic;
  slide.child = 1;
  slide.X_PC_rest.p = Vec3(0, 0, 0.3);
  hinge.parent = 1, hinge.child = 2;
  hinge.position_offset = hinge.velocity_offset = 1;
  model.joints = {slide, hinge};
  model.position_count = model.velocity_count = 2;
  KinematicTree tree(model);
  std::vector<BodyState> bodies;
  tree.place({0.0, 0.0}, {}, bodies);
  Skeleton skeleton(model, Vec3(0, 0, -9.81), 1e-3, true);
  skeleton.set_bodies(bodies);
  for (int i = 0; i < 2000; ++i) {
    skeleton.clear_wrenches();
    skeleton.step();
  }
  EXPECT_NEAR(skeleton.bodies()[2].X_WB.p.z(), 0.05, 1e-3);
  EXPECT_NEAR(skeleton.bodies()[2].v_W.norm(), 0.0, 1e-6);
}

TEST(Skeleton, ContactsOfSeveralShapesContinueWithTheSameBits) {
  // A bar with a ball at each end, hinged to a carriage on a slide, falls aslant onto two plates:
  // the pairs of shapes meet one after the other, and a restored world meets them all at once.
  SkeletonModel model;
  model.bodies.resize(3);
  for (const double side : {-0.6, 0.6}) {
    CollisionModel plate, ball;
    plate.type = ShapeType::kBox, plate.size = Vec3(1, 1, 0.1);
    plate.X_LS.p = Vec3(side, 0, -0.05);
    ball.type = ShapeType::kSphere, ball.size = Vec3(0.05, 0, 0);
    ball.X_LS.p = Vec3(side / 3.0, 0, 0);
    model.bodies[0].collisions.push_back(plate);
    model.bodies[2].collisions.push_back(ball);
  }
  for (int i : {1, 2}) {
    model.bodies[i].mass = 0.2;
    model.bodies[i].principal = Vec3::Constant(2e-4);
  }
  JointModel slide, hinge;
  slide.type = JointType::kPrismatic;
  slide.child = 1;
  slide.X_PC_rest.p = Vec3(0, 0, 0.3);
  hinge.parent = 1, hinge.child = 2;
  hinge.axis_C = Vec3::UnitY();
  hinge.position_offset = hinge.velocity_offset = 1;
  model.joints = {slide, hinge};
  model.position_count = model.velocity_count = 2;
  KinematicTree tree(model);
  std::vector<BodyState> bodies;
  tree.place({0.0, 0.4}, {}, bodies);
  const auto advance = [](Skeleton& skeleton, int steps) {
    for (int i = 0; i < steps; ++i) {
      skeleton.clear_wrenches();
      skeleton.step();
    }
  };
  Skeleton original(model, Vec3(0, 0, -9.81), 1e-3, true);
  original.set_bodies(bodies);
  bool met = false;
  for (int round = 0; round < 20; ++round) {
    advance(original, 37);
    Skeleton fresh(model, Vec3(0, 0, -9.81), 1e-3, true);
    fresh.set_bodies(original.bodies());
    advance(original, 37);
    advance(fresh, 37);
    met = met || original.bodies()[2].X_WB.p.z() < 0.15;
    for (int i : {1, 2}) {
      ASSERT_EQ(original.bodies()[i].X_WB.p, fresh.bodies()[i].X_WB.p) << round;
      ASSERT_EQ(original.bodies()[i].X_WB.R, fresh.bodies()[i].X_WB.R) << round;
      ASSERT_EQ(original.bodies()[i].w_W, fresh.bodies()[i].w_W) << round;
    }
  }
  EXPECT_TRUE(met);
}

}  // namespace
}  // namespace anthrob
