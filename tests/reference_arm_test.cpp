// The simulator against an independent model of the arm, over the motion of the demo: same
// commands, no shared code.
#include <gtest/gtest.h>

#include <cmath>

#include "anthrob_control/posture_sequence.h"
#include "anthrob_reference/arm.h"

namespace anthrob {
namespace {

constexpr double kDegrees = 180.0 / M_PI;
constexpr double kSample = 0.01;  // [s]

/// The demo's commands, and what the reference arm does under them.
struct Demo {
  std::string file;
  double friction;
  std::vector<std::pair<double, std::vector<double>>> commands;  ///< hold [s], references
  std::vector<std::vector<double>> truth;  ///< w, x, y, z, elbow, forces; every sample

  Demo(const std::string& model, double friction_scale) : friction(friction_scale) {
    const std::string folder = std::string(ANTHROB_CONFIG_DIR) + "/anthrob/";
    file = folder + "model_" + model + ".yaml";
    const auto nominal = load_robot_model(file);
    const auto sequence = PostureSequence::load(folder + "demo_postures.yaml", *nominal);
    const auto references = sequence.references(nominal);
    for (std::size_t i = 0; i < references.size(); ++i) {
      commands.emplace_back(sequence.steps[i].hold, references[i]);
    }
    run_reference();
  }

  void run_reference() {
    reference::Arm arm(reference::Arm::load(file));
    arm.scale_eyelet_friction(friction);
    for (const auto& [hold, references] : commands) {
      for (std::size_t m = 0; m < references.size(); ++m) arm.command_position(m, references[m]);
      for (int i = 0; i < std::lround(hold / kSample); ++i) {
        arm.advance(kSample);
        const auto q = arm.shoulder();
        std::vector<double> row{q.w(), q.x(), q.y(), q.z(), arm.elbow()};
        for (std::size_t m = 0; m < arm.muscle_count(); ++m) row.push_back(arm.muscle(m).force);
        truth.push_back(row);
      }
    }
  }
};

struct Difference {
  double shoulder = 0.0, elbow = 0.0;  ///< rms [deg]
  double force = 0.0;                  ///< rms [N]
};

Difference compare(const Demo& demo, double step) {
  const auto model =
      load_robot_model(demo.file, {step,
                                   {{"eyelet_friction.static", 0.195 * demo.friction},
                                    {"eyelet_friction.kinetic", 0.156 * demo.friction}}});
  Simulation sim(model);
  Difference sum;
  std::size_t row = 0;
  for (const auto& [hold, references] : demo.commands) {
    for (std::size_t m = 0; m < references.size(); ++m) {
      sim.command(static_cast<int>(m), ecu::Mode::kPosition, references[m]);
    }
    for (int i = 0; i < std::lround(hold / kSample); ++i, ++row) {
      sim.step(static_cast<int>(std::lround(kSample / step)));
      const auto& q = sim.configuration();
      const auto& r = demo.truth[row];
      const double turned =
          kDegrees * angular_distance(Quat(q[0], q[1], q[2], q[3]), Quat(r[0], r[1], r[2], r[3]));
      sum.shoulder += turned * turned;
      sum.elbow += std::pow(kDegrees * (q[4] - r[4]), 2);
      for (std::size_t m = 0; m < sim.muscle_count(); ++m) {
        sum.force += std::pow(sim.muscle(static_cast<int>(m)).force() - r[5 + m], 2) /
                     static_cast<double>(sim.muscle_count());
      }
    }
  }
  const double n = static_cast<double>(row);
  return {std::sqrt(sum.shoulder / n), std::sqrt(sum.elbow / n), std::sqrt(sum.force / n)};
}

void expect_agreement(const std::string& model, double friction, double degrees, double newtons) {
  const Demo demo(model, friction);
  const Difference coarse = compare(demo, 1e-3), fine = compare(demo, 1e-4);
  for (const auto& [name, d] :
       {std::pair<const char*, Difference>{"1ms", coarse}, {"0.1ms", fine}}) {
    ::testing::Test::RecordProperty(std::string("shoulder_deg_") + name,
                                    std::to_string(d.shoulder));
    ::testing::Test::RecordProperty(std::string("elbow_deg_") + name, std::to_string(d.elbow));
    ::testing::Test::RecordProperty(std::string("force_N_") + name, std::to_string(d.force));
    std::printf("model %s, friction x%g, %s: shoulder %.4f deg, elbow %.4f deg, force %.4f N rms\n",
                model.c_str(), friction, name, d.shoulder, d.elbow, d.force);
  }
  EXPECT_LE(coarse.shoulder, degrees);
  EXPECT_LE(coarse.elbow, degrees);
  EXPECT_LE(coarse.force, newtons);
  EXPECT_LT(fine.shoulder, 0.5 * coarse.shoulder);
  EXPECT_LT(fine.elbow, 0.5 * coarse.elbow);
  EXPECT_LT(fine.force, 0.5 * coarse.force);
}

TEST(ReferenceArm, ModelIFollowsTheDemo) {
  expect_agreement("I", 1.0, 0.05, 0.1);
}
TEST(ReferenceArm, ModelIIFollowsTheDemo) {
  expect_agreement("II", 1.0, 0.05, 0.1);
}
TEST(ReferenceArm, ModelIFollowsTheDemoWithFrictionTripled) {
  expect_agreement("I", 3.0, 0.1, 0.3);
}
TEST(ReferenceArm, ModelIIFollowsTheDemoWithFrictionTripled) {
  expect_agreement("II", 3.0, 0.1, 0.3);
}

}  // namespace
}  // namespace anthrob
