#include "load.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "support.h"

namespace anthrob::reference {
namespace {

class ModelFile : public testing::Test {
 protected:
  ModelFile()
      : file_(std::filesystem::temp_directory_path() /
              ("anthrob_reference_" + std::to_string(getpid()) + ".yaml")) {}
  ~ModelFile() override { std::filesystem::remove(file_); }

  // Model I with these lines on top of it.
  ArmParameters load_with(const std::string& lines) const {
    const auto base = std::filesystem::canonical(model_file("model_I"));
    std::ofstream(file_) << "extends: " << base.string() << "\n" << lines;
    return load_arm(file_.string());
  }

  void expect_refused(const std::string& lines, const std::string& named) const {
    try {
      load_with(lines);
      ADD_FAILURE() << "accepted: " << lines;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(named), std::string::npos) << error.what();
    }
  }

 private:
  std::filesystem::path file_;
};

TEST_F(ModelFile, FillsAllParts) {
  const ArmParameters arm = load_arm(model_file("model_I"));
  ASSERT_EQ(arm.muscles.size(), 11u);
  const MuscleParameters& triceps = arm.muscles[9];
  EXPECT_EQ(triceps.name, "triceps_brachii");
  EXPECT_EQ(triceps.ring_segment, 2);
  EXPECT_EQ(triceps.spindle_radius, 0.0065);
  EXPECT_EQ(triceps.ring.section_diameter, 0.004);
  EXPECT_EQ(triceps.ring.quantity, 1.0);
  EXPECT_EQ(triceps.motor.resistance, 4.69);
  EXPECT_EQ(triceps.motor.power_stage_resistance, 0.12);
  EXPECT_EQ(triceps.controller.force_feedforward, 0.04021);
  EXPECT_EQ(triceps.eyelet_friction.kinetic_level, 0.156);
  EXPECT_EQ(arm.skeleton.shoulder_friction.viscous, 0.15);
  EXPECT_EQ(arm.skeleton.elbow_stop.stiffness, 2000.0);
  EXPECT_EQ(arm.skeleton.humerus.mass, 0.70339);
  EXPECT_NEAR(arm.skeleton.elbow_stop.upper, 135.0 * M_PI / 180.0, 1e-12);
}

TEST_F(ModelFile, ExtensionMergesMapsAndReplacesLists) {
  const ArmParameters one = load_arm(model_file("model_I"));
  const ArmParameters two = load_arm(model_file("model_II"));
  const MuscleParameters& biceps = two.muscles[8];
  EXPECT_EQ(biceps.name, "biceps_brachii");
  EXPECT_EQ(biceps.rest_tendon_length, 0.4715);
  ASSERT_EQ(biceps.path.size(), 6u);
  ASSERT_TRUE(biceps.path[4].cylinder.has_value());
  EXPECT_EQ(biceps.path[4].cylinder->radius, 0.015);
  EXPECT_EQ(biceps.ring_segment, one.muscles[8].ring_segment);
  EXPECT_EQ(biceps.motor.torque_constant, one.muscles[8].motor.torque_constant);
  const ArmParameters three = load_with("eyelet_friction: {kinetic: 0.2}\n");
  EXPECT_EQ(three.muscles[0].eyelet_friction.kinetic_level, 0.2);
  EXPECT_EQ(three.muscles[0].eyelet_friction.static_level, 0.195);
}

TEST_F(ModelFile, RefusesWhatItDoesNotModel) {
  expect_refused("efects: {}\n", "efects");
  expect_refused("joints: {elbow: {friction: {viscus: 0.1}}}\n", "joints/elbow/friction/viscus");
  expect_refused("joints: {shoulder: {type: hinge}}\n", "joints/shoulder/type");
  expect_refused("gravity: [0, 0]\n", "gravity");
  expect_refused("springs: {ring_15x5: {modulus: soft}}\n", "springs/ring_15x5/modulus");
  expect_refused("actuators: {unit_a: {gear: {friction_torque: 0.1}}}\n", "friction_torque");
  expect_refused("muscles: {brachialis: {actuator: unit_c}}\n", "muscles/brachialis/actuator");
  expect_refused("muscles: {brachialis: {path: [{point: [0, 0, 0], body: hand}]}}\n",
                 "path/0/body");
}

TEST_F(ModelFile, NamesAMissingFile) {
  EXPECT_THROW(load_arm("no_such_model.yaml"), std::runtime_error);
  expect_refused("robot: no_such_robot.urdf\n", "no_such_robot.urdf");
}

}  // namespace
}  // namespace anthrob::reference
