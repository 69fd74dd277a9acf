// Malformed robot and model files: each is refused with one line that names file, key, value and
// expectation.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "anthrob_core/errors.h"
#include "anthrob_sim/simulation.h"
#include "support.h"

namespace anthrob {
namespace {

using testing_support::TemporaryRobot;

const char* const kUrdf = R"(<robot name="rig">
  <link name="base"/>
  <joint name="shoulder" type="floating">
    <parent link="base"/><child link="upper"/><origin xyz="0 0 0.3"/>
  </joint>
  <link name="upper"><inertial><mass value="0.7"/>
    <inertia ixx="2e-3" ixy="0" ixz="0" iyy="2e-3" iyz="0" izz="5e-4"/></inertial></link>
  <joint name="elbow" type="revolute">
    <parent link="upper"/><child link="lower"/><axis xyz="0 1 0"/>
    <limit lower="0" upper="2" effort="0" velocity="0"/>
  </joint>
  <link name="lower"><inertial><mass value="0.2"/>
    <inertia ixx="4e-4" ixy="0" ixz="0" iyy="4e-4" iyz="0" izz="2e-5"/></inertial></link>
</robot>)";

const char* const kModel = R"(robot: robot.urdf
gravity: [0, 0, -9.81]
joints:
  shoulder:
    type: ball
    center: [0, 0, 0.1]
    friction: {static: 0.0, kinetic: 0.0, viscous: 0.1, stribeck_velocity: 0.05}
  elbow:
    stop: {stiffness: 500, damping: 1}
springs:
  ring: {type: zener, rest_length: 0.015, section_diameter: 0.005, strands: 2, modulus: 8e5, arm_modulus: 1e5, relaxation_time: 1.3}
actuators:
  motor:
    type: dc_motor
    motor: {resistance: 0.67, inductance: 5.73e-5, torque_constant: 0.0115, back_emf_constant: 0.0115, rotor_inertia: 1.05e-6}
    gear: {law: current_sign, ratio: 128, efficiency: 0.59, inertia: 4.0e-8, steepness: 10, shift: 3, friction_torque: 0.0}
    power_stage: {resistance: 0.12}
    nominal_voltage: 12.0
controllers:
  pd:
    period: 0.001
    voltage_limit: 12
    limits: {position: 30, current: 7, force: 200}
    position: {proportional: 5, derivative: 0.5, force_feedforward: 0.005}
    current: {proportional: 0, integral: 400}
    force: {proportional: 0.5, integral: 1, derivative: 0.5, force_feedforward: 0.005}
eyelet_friction: {law: smooth_stribeck, static: 0.195, kinetic: 0.156, stribeck_velocity: 0.001, steepness: 10}
muscles:
  biceps:
    actuator: motor
    controller: pd
    ecu: ecu_1
    spindle_radius: 0.0065
    rest_tendon_length: 0.35
    spring: {kind: ring, quantity: 2, segment: 0}
    force_sensor_segment: 0
    path:
      - {point: [0.05, 0, 0.6], body: base}
      - {point: [0.05, 0, 0.4], body: base}
      - {cylinder: {origin: [0, 0, 0], axis: [0, 1, 0], radius: 0.02}, body: upper}
      - {point: [0.03, 0, -0.05], body: lower}
)";

struct Case {
  const char* what;
  bool in_urdf;
  const char* from;
  const char* to;
  std::vector<const char*> expected;  ///< all of these words must be in the message
};

const Case kCases[] = {
    {"missing file name",
     false,
     "robot: robot.urdf",
     "robot: nowhere.urdf",
     {"model.yaml:1", "robot", "nowhere.urdf", "URDF"}},
    {"missing gravity",
     false,
     "gravity: [0, 0, -9.81]\n",
     "",
     {"model.yaml", "gravity", "missing"}},
    {"gravity of two numbers", false, "[0, 0, -9.81]", "[0, -9.81]", {"gravity", "three numbers"}},
    {"gravity not a number", false, "-9.81", ".nan", {"gravity", ".nan", "finite"}},
    {"unknown top-level key",
     false,
     "gravity:",
     "gravitation: 1\ngravity:",
     {"gravitation", "unknown key"}},
    {"misspelt muscle key",
     false,
     "spindle_radius:",
     "spindel_radius:",
     {"biceps", "spindle_radius", "missing"}},
    {"extra muscle key",
     false,
     "    ecu: ecu_1",
     "    ecu: ecu_1\n    colour: red",
     {"muscles.biceps.colour", "unknown key"}},
    {"negative spindle radius",
     false,
     "0.0065",
     "-0.0065",
     {"model.yaml:33", "spindle_radius", "-0.0065", "(0, 0.5] [m]"}},
    {"spindle radius in millimetres",
     false,
     "spindle_radius: 0.0065",
     "spindle_radius: 6.5",
     {"model.yaml:33", "biceps.spindle_radius", "6.5", "(0, 0.5] [m]"}},
    {"spindle radius with unit", false, "0.0065", "6.5 mm", {"spindle_radius", "6.5 mm", "[m]"}},
    {"tendon length in millimetres",
     false,
     "rest_tendon_length: 0.35",
     "rest_tendon_length: 361.9",
     {"model.yaml:34", "biceps.rest_tendon_length", "361.9", "(0, 10] [m]"}},
    {"efficiency above one",
     false,
     "efficiency: 0.59",
     "efficiency: 1.2",
     {"gear.efficiency", "1.2", "(0, 1]"}},
    {"zero inductance",
     false,
     "inductance: 5.73e-5",
     "inductance: 0",
     {"motor.inductance", "> 0", "[H]"}},
    {"unknown actuator type",
     false,
     "type: dc_motor",
     "type: steam",
     {"actuators.motor.type", "steam", "dc_motor"}},
    {"misspelt spring in a file that changes one",
     false,
     "actuators:",
     "  rign: {modulus: 2e6}\nactuators:",
     {"springs.rign", "type", "missing"}},
    {"ring in millimetres",
     false,
     "rest_length: 0.015",
     "rest_length: 15",
     {"springs.ring.rest_length", "15"}},
    {"section of a ring in millimetres",
     false,
     "section_diameter: 0.005",
     "section_diameter: 5",
     {"springs.ring.section_diameter", "5"}},
    {"wrong value in a spring that no muscle names",
     false,
     "actuators:",
     "  spare: {type: spring_damper, rest_length: 0.015, stiffness: -1, damping: 5}\nactuators:",
     {"springs.spare.stiffness", "-1"}},
    {"misspelt actuator in a file that changes one",
     false,
     "controllers:",
     "  motr: {motor: {resistance: 4}}\ncontrollers:",
     {"actuators.motr", "type", "missing"}},
    {"misspelt controller in a file that changes one",
     false,
     "eyelet_friction:",
     "  dp: {voltage_limit: 4}\neyelet_friction:",
     {"controllers.dp", "period", "missing"}},
    {"unknown actuator name",
     false,
     "actuator: motor",
     "actuator: engine",
     {"biceps.actuator", "engine", "actuators"}},
    {"unknown gear law",
     false,
     "law: current_sign",
     "law: magic",
     {"gear.law", "magic", "current_sign"}},
    {"unknown friction law",
     false,
     "law: smooth_stribeck",
     "law: grease",
     {"eyelet_friction.law", "grease", "sticking"}},
    {"negative friction",
     false,
     "static: 0.195",
     "static: -0.195",
     {"eyelet_friction.static", "-0.195", ">= 0"}},
    {"no spring at all",
     false,
     "    spring: {kind: ring, quantity: 2, segment: 0}\n",
     "",
     {"biceps", "spring", "section 4.6"}},
    {"unknown spring", false, "kind: ring", "kind: rubber", {"spring.kind", "rubber", "springs"}},
    {"spring in a segment that is not there",
     false,
     "segment: 0}",
     "segment: 7}",
     {"spring.segment", "7", "0 to 2"}},
    {"zero rings", false, "quantity: 2", "quantity: 0", {"spring.quantity", "0", "1 to"}},
    {"zero relaxation time",
     false,
     "relaxation_time: 1.3",
     "relaxation_time: 0",
     {"relaxation_time", "> 0", "[s]"}},
    {"body that is not there",
     false,
     "body: lower",
     "body: hand",
     {"path.3.body", "hand", "link", "robot.urdf"}},
    {"path of one point",
     false,
     "      - {point: [0.05, 0, 0.4], body: base}\n      - {cylinder: {origin: [0, 0, 0], axis: "
     "[0, 1, 0], radius: 0.02}, body: upper}\n      - {point: [0.03, 0, -0.05], body: lower}\n",
     "",
     {"biceps.path", "two points"}},
    {"path that ends on a surface",
     false,
     "      - {point: [0.03, 0, -0.05], body: lower}\n",
     "",
     {"path.2", "ends with a point"}},
    {"two surfaces in a row",
     false,
     "      - {point: [0.03, 0, -0.05]",
     "      - {sphere: {center: [0, 0, 0], radius: 0.01}, body: upper}\n      - {point: [0.03, 0, "
     "-0.05]",
     {"path.3", "two surfaces"}},
    {"unknown surface", false, "cylinder:", "torus:", {"path.2.torus", "cylinder, mesh, sphere"}},
    {"axis without direction", false, "axis: [0, 1, 0]", "axis: [0, 0, 0]", {"axis", "not zero"}},
    {"point inside its cylinder", false, "radius: 0.02", "radius: 0.08", {"path.2", "inside"}},
    {"unknown wrapping start",
     false,
     "radius: 0.02}",
     "radius: 0.02, start: left}",
     {"start", "left", "positive"}},
    {"friction at the end of a path",
     false,
     "- {point: [0.05, 0, 0.6], body: base}",
     "- {point: [0.05, 0, 0.6], body: base, friction: {law: smooth_stribeck, static: 0.2, kinetic: "
     "0.1, stribeck_velocity: 0.001, steepness: 10}}",
     {"path.0.friction", "the tendon is fixed at both ends"}},
    {"same point twice", false, "[0.05, 0, 0.4]", "[0.05, 0, 0.6]", {"path.1", "same place"}},
    {"point of two numbers",
     false,
     "[0.05, 0, 0.4]",
     "[0.05, 0]",
     {"path.1.point", "three numbers"}},
    {"controller period that does not fit the step",
     false,
     "period: 0.001",
     "period: 0.0015",
     {"pd.period", "0.0015", "multiple"}},
    {"joint that is not there",
     false,
     "  elbow:\n    stop",
     "  knee:\n    stop",
     {"joints.knee", "no movable joint"}},
    {"ball joint without entry",
     false,
     "  shoulder:\n    type: ball\n    center: [0, 0, 0.1]\n    friction: {static: 0.0, kinetic: "
     "0.0, viscous: 0.1, stribeck_velocity: 0.05}\n",
     "",
     {"shoulder", "type: ball"}},
    {"limited joint without stop",
     false,
     "    stop: {stiffness: 500, damping: 1}",
     "    friction: {static: 0, kinetic: 0, viscous: 0, stribeck_velocity: 1}",
     {"joints.elbow", "stop", "missing"}},
    {"muscle name in capitals", false, "  biceps:", "  Biceps:", {"Biceps", "lower_snake_case"}},
    {"unit name in capitals",
     false,
     "ecu: ecu_1",
     "ecu: ECU 1",
     {"ecu", "'ECU 1'", "lower_snake_case"}},
    {"joint name in capitals",
     true,
     "<joint name=\"elbow\"",
     "<joint name=\"Elbow\"",
     {"robot.urdf", "joint 'Elbow'", "lower_snake_case"}},
    {"pad name in capitals",
     false,
     "springs:",
     "touch_pads:\n  Thumb: {joint: elbow, lever: 0.01, share: 0.5}\nsprings:",
     {"touch_pads.Thumb", "lower_snake_case"}},
    {"key given twice",
     false,
     "    ecu: ecu_1",
     "    ecu: ecu_1\n    ecu: ecu_2",
     {"ecu", "twice"}},
    {"not YAML", false, "springs:", "springs: [", {"model.yaml:", "not valid YAML"}},
    {"extends nothing",
     false,
     "robot: robot.urdf",
     "extends: other.yaml\nrobot: robot.urdf",
     {"extends", "other.yaml", "no such file"}},
    {"extends itself",
     false,
     "robot: robot.urdf",
     "extends: model.yaml\nrobot: robot.urdf",
     {"model.yaml:1", "extends itself"}},
    {"alias inside what it stands for",
     false,
     "springs:",
     "loop: &loop [*loop]\nsprings:",
     {"model.yaml:10", "nested more than 100 deep", "alias"}},
    {"not XML", true, "<robot name=\"rig\">", "<robot name=", {"robot.urdf", "not a valid URDF"}},
    {"massless link",
     true,
     "<mass value=\"0.2\"/>",
     "<mass value=\"0\"/>",
     {"robot.urdf", "lower", "mass"}},
    {"negative mass",
     true,
     "<mass value=\"0.2\"/>",
     "<mass value=\"-0.2\"/>",
     {"robot.urdf", "lower", "mass", "-0.2"}},
    {"link without inertial",
     true,
     "<link name=\"lower\"><inertial><mass value=\"0.2\"/>\n    <inertia ixx=\"4e-4\" ixy=\"0\" "
     "ixz=\"0\" iyy=\"4e-4\" iyz=\"0\" izz=\"2e-5\"/></inertial></link>",
     "<link name=\"lower\"/>",
     {"robot.urdf", "lower", "inertial"}},
    {"inertia against the triangle inequality",
     true,
     "izz=\"2e-5\"",
     "izz=\"2e-3\"",
     {"robot.urdf", "lower", "principal moments"}},
    {"joint without axis direction",
     true,
     "<axis xyz=\"0 1 0\"/>",
     "<axis xyz=\"0 0 0\"/>",
     {"robot.urdf", "elbow", "axis"}},
    {"mass of a fixed link with a comma",
     true,
     "</robot>",
     "<link name=\"tool\"><inertial><mass value=\"2,0\"/><inertia ixx=\"1e-4\" ixy=\"0\" ixz=\"0\" "
     "iyy=\"1e-4\" iyz=\"0\" izz=\"1e-4\"/></inertial></link><joint name=\"mount\" "
     "type=\"fixed\"><parent link=\"lower\"/><child link=\"tool\"/></joint></robot>",
     {"robot.urdf", "tool", "mass", "2,0"}},
    {"inertia that is no number",
     true,
     "izz=\"2e-5\"",
     "izz=\"2e-5x\"",
     {"robot.urdf", "lower", "izz"}},
    {"sensor without its keys",
     false,
     "gravity:",
     "sensors: {force: 0.3}\ngravity:",
     {"model.yaml:2", "sensors.force", "0.3", "a map"}},
    {"sensors that are a list",
     false,
     "gravity:",
     "sensors: [force, 0.3]\ngravity:",
     {"model.yaml:2", "sensors", "a map"}},
    {"empty key that is unknown",
     false,
     "gravity:",
     "sensor:\ngravity:",
     {"model.yaml:2", "sensor", "unknown key"}},
    {"muscle called all", false, "  biceps:\n", "  all:\n", {"muscles.all", "all muscles"}},
    {"unit called global", false, "ecu: ecu_1", "ecu: global", {"muscles.biceps.ecu", "global"}},
    {"limits swapped",
     true,
     "lower=\"0\" upper=\"2\"",
     "lower=\"2\" upper=\"0\"",
     {"robot.urdf", "elbow", "lower < upper"}},
    {"limits without rest posture",
     true,
     "lower=\"0\" upper=\"2\"",
     "lower=\"0.3\" upper=\"2.3\"",
     {"robot.urdf", "elbow", "lower 0.3", "lower <= 0 <= upper"}},
    {"limits below rest posture",
     true,
     "lower=\"0\" upper=\"2\"",
     "lower=\"-2\" upper=\"-0.1\"",
     {"robot.urdf", "elbow", "upper -0.1", "lower <= 0 <= upper"}},
    {"negative damping",
     true,
     "<limit lower",
     "<dynamics damping=\"-1\" friction=\"0\"/><limit lower",
     {"robot.urdf", "elbow", "damping", "-1", ">= 0"}},
    {"negative joint friction",
     true,
     "<limit lower",
     "<dynamics damping=\"0\" friction=\"-0.1\"/><limit lower",
     {"robot.urdf", "elbow", "friction", "-0.1", ">= 0"}},
    {"joint to a link that is not there",
     true,
     "<child link=\"lower\"/>",
     "<child link=\"hand\"/>",
     {"robot.urdf", "hand"}},
    {"joint that follows another",
     true,
     "<limit lower",
     "<mimic joint=\"shoulder\"/><limit lower",
     {"robot.urdf", "elbow", "mimic"}},
    {"muscle called as a joint",
     false,
     "  biceps:\n",
     "  elbow:\n",
     {"model.yaml", "muscles.elbow", "expected another"}},
    {"sliding without sticking",
     false,
     "{law: smooth_stribeck, static: 0.195, kinetic: 0.156, stribeck_velocity: 0.001, steepness: "
     "10}",
     "{law: sticking, static: 0, kinetic: 0.156, stribeck_velocity: 0.001, presliding: 1e-5}",
     {"model.yaml", "eyelet_friction.static", "a number > 0, because 'kinetic' is"}},
    {"planar joint",
     true,
     "type=\"revolute\"",
     "type=\"planar\"",
     {"robot.urdf", "elbow", "revolute"}},
};

TEST(BadFiles, TheGoodOnesLoad) {
  const TemporaryRobot robot(kUrdf, kModel);
  Simulation sim(robot.load());
  EXPECT_NO_THROW(sim.step(10));
  EXPECT_GT(sim.time(), 0.0);
}

TEST(BadFiles, EachIsRefusedWithOneLine) {
  static_assert(std::size(kCases) >= 30, "at least thirty kinds");
  for (const Case& test : kCases) {
    SCOPED_TRACE(test.what);
    std::string text = test.in_urdf ? kUrdf : kModel;
    const auto at = text.find(test.from);
    ASSERT_NE(at, std::string::npos);
    text.replace(at, std::string(test.from).size(), test.to);
    const TemporaryRobot robot(test.in_urdf ? text : kUrdf, test.in_urdf ? kModel : text);
    try {
      robot.load();
      FAIL() << "was accepted";
    } catch (const BadInput& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      for (const char* word : test.expected) {
        EXPECT_NE(message.find(word), std::string::npos)
            << "'" << word << "' is not in: " << message;
      }
    }
  }
}

TEST(BadFiles, APointInsideASurfaceIsRemarkedOnWhereTheTendonRunsClearOfIt) {
  std::string text = kModel;
  const std::string end = "[0.03, 0, -0.05]";
  text.replace(text.find(end), end.size(), "[0.01, 0, 0.005]");
  const auto model = TemporaryRobot(kUrdf, text).load();
  ASSERT_FALSE(Simulation(model).muscle(0).path().obstacles()[2].touching);
  ASSERT_EQ(model->remarks.size(), 1u);
  for (const char* word : {"model.yaml", "muscles.biceps.path.2", "8.82 mm inside"}) {
    EXPECT_NE(model->remarks[0].find(word), std::string::npos) << model->remarks[0];
  }
  EXPECT_TRUE(TemporaryRobot(kUrdf, kModel).load()->remarks.empty());
}

TEST(BadFiles, OnlyMotorsTakeControllers) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("anthrob_hill_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const std::string rig = std::string(ANTHROB_CONFIG_DIR) + "/two_muscle_rig/";
  std::ofstream(folder / "model.yaml") << "extends: " << rig << "model_hill.yaml\nrobot: " << rig
                                       << "robot.urdf\nmuscles:\n  flexor:\n"
                                       << "    controller: pd\n    ecu: ecu_1\n";
  try {
    load_robot_model((folder / "model.yaml").string());
    ADD_FAILURE() << "accepted";
  } catch (const BadInput& error) {
    EXPECT_NE(std::string(error.what()).find("only a motor can have a controller"),
              std::string::npos)
        << error.what();
  }
  std::filesystem::remove_all(folder);
}

TEST(BadFiles, MissingModelFile) {
  EXPECT_THROW(load_robot_model("/nowhere/model.yaml"), BadInput);
}

TEST(ConfigNode, ExtendsMergesMapsReplacesListsAndRemovesNulls) {
  const TemporaryRobot robot(kUrdf, kModel);
  const_cast<TemporaryRobot&>(robot).write("more.yaml", R"(extends: model.yaml
eyelet_friction: null
muscles:
  biceps:
    spindle_radius: 0.007
    path:
      - {point: [0.05, 0, 0.6], body: base}
      - {point: [0.05, 0, 0.41], body: base}
      - {point: [0.03, 0, -0.05], body: lower}
)");
  const std::string file = robot.file().substr(0, robot.file().rfind('/')) + "/more.yaml";
  const auto model = load_robot_model(file);
  EXPECT_EQ(model->muscles[0].path->obstacles().size(), 3u);
  EXPECT_EQ(model->muscles[0].path->obstacles()[1].friction, nullptr);
  EXPECT_NEAR(model->muscles[0].actuator->position_for(0.343), 1.0, 1e-9);
  EXPECT_TRUE(model->muscles[0].has_controller);
}

TEST(ConfigNode, AKeyThatIsNullIsNotThere) {
  std::string text = kModel;
  const std::string end = "    force_sensor_segment: 0\n";
  text.replace(text.find(end), end.size(), end + "    surface_friction: null\n");
  const std::string unit = "    controller: pd\n    ecu: ecu_1\n";
  text.replace(text.find(unit), unit.size(), "    controller: null\n    ecu:\n");
  const auto model = TemporaryRobot(kUrdf, text + "effects:\nsensors: null\n").load();
  EXPECT_FALSE(model->muscles[0].has_controller);
  EXPECT_EQ(model->muscles[0].ecu, "");
}

TEST(BadFiles, WhatAllMusclesHaveOfTheirOwnMayStandForTheRobotToo) {
  std::string text = kModel;
  const std::string end = "    force_sensor_segment: 0\n";
  text.replace(text.find(end), end.size(),
               end +
                   "    eyelet_friction: {law: smooth_stribeck, static: 0.1, kinetic: 0.1, "
                   "stribeck_velocity: 0.001, steepness: 10}\n");
  const auto model = TemporaryRobot(kUrdf, text).load();
  EXPECT_NE(model->muscles[0].path->obstacles()[1].friction, nullptr);

  // Nor are springs unknown without muscles.
  TemporaryRobot robot(kUrdf, kModel);
  robot.write("bones.yaml", "extends: model.yaml\nmuscles: null\n");
  const std::string folder = robot.file().substr(0, robot.file().rfind('/'));
  EXPECT_TRUE(load_robot_model(folder + "/bones.yaml")->muscles.empty());
}

TEST(ConfigNode, ErrorsInExtendingFilesNameTheRightFile) {
  TemporaryRobot robot(kUrdf, kModel);
  robot.write("more.yaml", "extends: model.yaml\nmuscles: {biceps: {spindle_radius: 0}}\n");
  const std::string file = robot.file().substr(0, robot.file().rfind('/')) + "/more.yaml";
  try {
    load_robot_model(file);
    FAIL() << "was accepted";
  } catch (const BadInput& error) {
    EXPECT_NE(std::string(error.what()).find("more.yaml:2"), std::string::npos) << error.what();
  }
}

TEST(BadFiles, GainsOfOneMuscle) {
  const auto load = [](const std::string& gains, const std::string& controller = "pd") {
    std::string text = kModel;
    const std::string from = "    controller: pd\n";
    text.replace(text.find(from), from.size(),
                 "    controller: " + controller + "\n    gains: " + gains + "\n");
    return TemporaryRobot(kUrdf, text).load();
  };
  const auto model = load("{position_proportional: 7, force_integral: 0.25}");
  EXPECT_EQ(model->muscles[0].controller.position.proportional, 7.0);
  EXPECT_EQ(model->muscles[0].controller.force.integral, 0.25);
  EXPECT_EQ(model->muscles[0].controller.position.derivative, 0.5);  // its kind's
  for (const char* bad : {"{voltage_limit: 7}", "{position_proportional: -1}",
                          "{position_proportional: 1001}", "{K_P: 7}", "7"}) {
    EXPECT_THROW(load(bad), BadInput) << bad;
  }
  EXPECT_THROW(load("{force_integral: 1}", "null"), BadInput);
}

TEST(ConfigNode, ASecondDocumentAndAFolderAreRefused) {
  TemporaryRobot robot(kUrdf, std::string(kModel) + "---\nmuscels: {}\n");
  const std::string folder = robot.file().substr(0, robot.file().rfind('/'));
  robot.write("more.yaml", "extends: .\n");
  const auto refusal = [](const std::string& file) -> std::string {
    try {
      load_robot_model(file);
    } catch (const BadInput& error) {
      return error.what();
    }
    return "(accepted)";
  };
  EXPECT_NE(refusal(robot.file()).find("a second document: expected one"), std::string::npos)
      << refusal(robot.file());
  EXPECT_EQ(refusal(folder), folder + ": expected a YAML file, not a folder");
  EXPECT_NE(refusal(folder + "/more.yaml").find(": expected a YAML file, not a folder"),
            std::string::npos);
}

TEST(ConfigNode, OverridesReachNumbersByPath) {
  const TemporaryRobot robot(kUrdf, kModel);
  const auto model = robot.load(1e-3, {{"muscles.biceps.path.1.point.2", 0.45}});
  EXPECT_NEAR(model->muscles[0].path->obstacles()[1].point_B.z(), 0.45, 1e-12);
  EXPECT_THROW(robot.load(1e-3, {{"muscles.biceps.path.1.point.5", 0.45}}), BadInput);
  EXPECT_THROW(robot.load(1e-3, {{"muscles.biceps.actuator", 1.0}}), BadInput);
}

TEST(BadFiles, CollisionShapesWithoutSize) {
  for (const char* shape : {"<sphere radius=\"-0.05\"/>", "<box size=\"0.1 0 0.1\"/>",
                            "<cylinder radius=\"0\" length=\"0.1\"/>"}) {
    std::string urdf = kUrdf;
    const std::string link = "<link name=\"lower\">";
    urdf.replace(urdf.find(link), link.size(),
                 link + "<collision><geometry>" + shape + "</geometry></collision>");
    const TemporaryRobot robot(urdf, std::string("collisions: true\n") + kModel);
    try {
      robot.load(1e-3);
      ADD_FAILURE() << shape << " was accepted";
    } catch (const BadInput& error) {
      EXPECT_NE(std::string(error.what()).find("lower"), std::string::npos) << error.what();
    }
  }
}

TEST(BadFiles, ImpossibleTimeStep) {
  const TemporaryRobot robot(kUrdf, kModel);
  EXPECT_THROW(robot.load(0.0), BadInput);
  EXPECT_THROW(robot.load(-1e-3), BadInput);
  EXPECT_THROW(robot.load(1e-12), BadInput);  // never comes to an end
  EXPECT_THROW(robot.load(0.002), BadInput);  // longer than a controller's period
  try {
    robot.load(0.10000001);
    FAIL() << "accepted";
  } catch (const BadInput& error) {
    EXPECT_EQ(std::string(error.what()),
              "simulation step 0.10000001 s: expected a number in [1e-07, 0.1]");
  }
}

}  // namespace
}  // namespace anthrob
