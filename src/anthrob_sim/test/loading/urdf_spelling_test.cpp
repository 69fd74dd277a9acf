// What urdfdom would drop without a word is refused, with line and hint; what belongs to other
// programs is left alone.
#include "loading/urdf_support.h"

namespace anthrob {
namespace {

using testing_support::arm_and;
using testing_support::arm_with;
using testing_support::expect_refused;
using testing_support::expect_silence;
using testing_support::kArmUrdf;
using testing_support::said_about;

const char* const kElbowOrigin = "<origin xyz=\"0 0 -0.25\"/>";
const std::string kXacro = ": expected a URDF; run xacro first (xacro FILE > robot.urdf)";

TEST(UrdfSpelling, AttributesThatAreUnknownOrMisspelt) {
  expect_refused(arm_with(kElbowOrigin, "<origin xzy=\"0 0 -0.25\"/>"),
                 "24: joint elbow: origin: xzy: unknown attribute; expected xyz");
  expect_refused(arm_with(kElbowOrigin, "<origin XYZ=\"0 0 -0.25\"/>"),
                 "24: joint elbow: origin: XYZ: unknown attribute; expected xyz");
  expect_refused(arm_with(kElbowOrigin, "<origin pos=\"0 0 -0.25\"/>"),
                 "24: joint elbow: origin: pos: unknown attribute; expected xyz or rpy");
  expect_refused(arm_with(kElbowOrigin, "<origin xyz=\"0 0 -0.25\" quat_xyzw=\"0 0 1 0\"/>"),
                 "24: joint elbow: origin: quat_xyzw: unknown attribute; expected the rotation as "
                 "rpy=\"roll pitch yaw\" [rad]");
  expect_refused(arm_with("<limit lower=\"-1\"", "<limit low=\"-1\""),
                 "8: joint shoulder: limit: low: unknown attribute; expected lower");
  expect_refused(arm_with("<mass value=\"0.4\"/>", "<mass value=\"0.4\" unit=\"kg\"/>"),
                 "13: link upper_arm: inertial: mass: unit: unknown attribute; expected value");
  expect_refused(arm_with("<inertial>", "<inertial mass=\"0.4\">"),
                 "11: link upper_arm: inertial: mass: unknown attribute; expected it as an element "
                 "<mass>");
  expect_refused(arm_with("<geometry>", "<geometry size=\"1\">"),
                 "18: link upper_arm: visual: geometry: size: unknown attribute; expected none in "
                 "<geometry>");
  expect_refused(arm_with("<robot name=\"arm\">", "<robot name=\"arm\" gravity=\"0\">"),
                 "1: robot: gravity: unknown attribute; expected name or version");
}

TEST(UrdfSpelling, ElementsThatAreUnknownOrMisspelt) {
  expect_refused(arm_with("<axis xyz=\"0 -1 0\"/>", "<axes xyz=\"0 -1 0\"/>"),
                 "7: joint shoulder: axes: unknown element; expected axis");
  expect_refused(arm_with("<axis xyz=\"0 -1 0\"/>", "<Axis xyz=\"0 -1 0\"/>"),
                 "7: joint shoulder: Axis: unknown element; expected axis");
  expect_refused(arm_with("<box size=\"0.025 0.015 0.25\"/>", "<capsule radius=\"0.1\"/>"),
                 "18: link upper_arm: visual: geometry: capsule: unknown element; expected box, "
                 "sphere, cylinder or mesh");
  expect_refused(arm_with("<mass value=\"0.4\"/>", "<mass value=\"0.4\"><unit/></mass>"),
                 "13: link upper_arm: inertial: mass: unit: unknown element; expected none in "
                 "<mass>");
  expect_refused(arm_and("<jiont name=\"wrist\"/>"), "35: jiont: unknown element; expected joint");
  expect_refused(arm_and("<Link name=\"hand\"/>"), "35: Link: unknown element; expected link");
}

TEST(UrdfSpelling, ElementsInAnotherPlace) {
  expect_refused(arm_and("<inertial><mass value=\"1\"/></inertial>"),
                 "35: inertial: not an element of <robot>; expected it in <link>");
  expect_refused(arm_with("<mass value=\"0.4\"/>", "<visual/>"),
                 "13: link upper_arm: inertial: visual: not an element of <inertial>; expected it "
                 "in <link>");
  expect_refused(
      arm_with("<link name=\"base\"/>", "<link name=\"base\"><mass value=\"1\"/></link>"),
      "2: link base: mass: not an element of <link>; expected it in <inertial>");
  expect_refused(arm_and("<robot name=\"tool\"/>"),
                 "35: robot: not an element of <robot>; expected it around all");
}

TEST(UrdfSpelling, ElementsThatAppearTwice) {
  expect_refused(arm_with(kElbowOrigin, std::string(kElbowOrigin) + kElbowOrigin),
                 "24: joint elbow: origin: appears twice; expected it once, the first is in line "
                 "24");
  expect_refused(arm_with("<mass value=\"0.4\"/>", "<mass value=\"0.4\"/>\n<mass value=\"0.5\"/>"),
                 "14: link upper_arm: inertial: mass: appears twice; expected it once, the first "
                 "is in line 13");
  expect_refused(
      arm_with("<link name=\"base\"/>", "<link name=\"base\"><inertial/><inertial/></link>"),
      "2: link base: inertial: appears twice; expected it once, the first is in line 2");
  expect_refused(
      arm_with("<child link=\"forearm\"/>", "<child link=\"forearm\"/><child link=\"hand\"/>"),
      "23: joint elbow: child: appears twice; expected it once, the first is in line "
      "23");
  expect_refused(
      arm_with("</geometry>", "<sphere radius=\"0.1\"/></geometry>"),
      "18: link upper_arm: visual: geometry: sphere: a second shape beside box; expected "
      "one, and another <visual> or <collision>");
  expect_refused(arm_with(kElbowOrigin, "<origin xyz=\"0 0 -0.25\" xyz=\"0 0 0\"/>"),
                 "24: not a valid URDF: an attribute that appears twice in its element, or is not "
                 "written name=\"value\"");
}

TEST(UrdfSpelling, TextWhereAttributesBelong) {
  expect_refused(arm_with(kElbowOrigin, "<origin><xyz>0 0 -0.25</xyz></origin>"),
                 "24: joint elbow: origin: xyz: unknown element; expected it as an attribute "
                 "xyz=\"...\"");
  expect_refused(arm_with(kElbowOrigin, "<origin>0 0 -0.25</origin>"),
                 "24: joint elbow: origin: text '0 0 -0.25': expected attributes: xyz=\"...\"");
  expect_refused(arm_with("<mass value=\"0.4\"/>", "<mass>0.4</mass>"),
                 "13: link upper_arm: inertial: mass: text '0.4': expected attributes: "
                 "value=\"...\"");
  expect_refused(arm_with("<parent link=\"base\"/>", "<parent>base</parent>"),
                 "4: joint shoulder: parent: text 'base': expected attributes: link=\"...\"");
  expect_refused(arm_with("<inertial>", "<inertial> the arm's -->"),
                 "11: link upper_arm: inertial: text 'the arm's -->': expected elements only; is a "
                 "comment not closed?");
}

TEST(UrdfSpelling, XacroThatWasNotExpanded) {
  expect_refused(arm_and("<xacro:include filename=\"tool.urdf.xacro\"/>"),
                 "35: xacro:include" + kXacro);
  expect_refused(arm_with("<link name=\"base\"/>",
                          "<link name=\"base\"><xacro:solid_ball mass=\"0.3\"/></link>"),
                 "2: link base: xacro:solid_ball" + kXacro);
  expect_refused(arm_with(kElbowOrigin, "<origin xyz=\"0 0 ${length}\"/>"),
                 "24: joint elbow: origin: xyz: 0 0 ${length}" + kXacro);
  expect_refused(arm_with("<link name=\"base\"/>", "<link name=\"base\" xacro:if=\"1\"/>"),
                 "2: link base: xacro:if" + kXacro);
  expect_refused(arm_and("<macro name=\"tool\"/>"), "35: macro" + kXacro);
  expect_refused(arm_and("<link name=\"$(arg side)_hand\"/>"),
                 "35: link $(arg side)_hand: name: $(arg side)_hand" + kXacro);
  // Its output may still say where the name came from.
  expect_silence(arm_with("<robot name=\"arm\">",
                          "<robot name=\"arm\" xmlns:xacro=\"http://www.ros.org/wiki/xacro\">"));
}

TEST(UrdfSpelling, WhatIsOfOtherProgramsIsLeftAlone) {
  expect_silence(
      arm_and("<gazebo reference=\"forearm\"><material>Gazebo/Grey</material>"
              "<sensor name=\"camera\"><pose>0 0 0</pose></sensor></gazebo>"));
  expect_silence(
      arm_and("<transmission name=\"t\"><type>x/Simple</type><joint name=\"elbow\">"
              "<hardwareInterface>y</hardwareInterface></joint></transmission>"));
  expect_silence(
      arm_and("<ros2_control name=\"a\" type=\"system\"><joint name=\"elbow\"/>"
              "</ros2_control>"));
  expect_silence(arm_and("<drake:loop_constraint a=\"1\">2</drake:loop_constraint>"));
  expect_silence(arm_with("<axis xyz=\"0 -1 0\"/>",
                          "<axis xyz=\"0 -1 0\"/><safety_controller k_position=\"1\" "
                          "k_velocity=\"1\" soft_lower_limit=\"0\" soft_upper_limit=\"1\"/>"
                          "<calibration rising=\"0.0\"/>"));
}

TEST(UrdfSpelling, EverythingThatIsKnownIsAccepted) {
  expect_silence(arm_with(
      "<link name=\"base\"/>",
      "<material name=\"bone\"><color rgba=\"1 1 1 1\"/></material>"
      "<material name=\"wood\"><texture filename=\"package://a/wood.png\"/></material>"
      "<link name=\"base\"><!-- all shapes -->"
      "<visual name=\"a\"><geometry><sphere radius=\"0.1\"/></geometry><material "
      "name=\"bone\"/></visual>"
      "<visual><origin xyz=\"0 0 1\" rpy=\"0 0 3.14\"/><geometry><cylinder radius=\"0.1\" "
      "length=\"1\"/></geometry></visual>"
      "<visual><geometry><mesh filename=\"package://a/b.stl\" scale=\"1 1 1\"/></geometry></visual>"
      "<collision name=\"c\"><geometry><box size=\"1 1 1\"/></geometry></collision></link>"));
  expect_silence(arm_with("<axis xyz=\"0 -1 0\"/>",
                          "<axis xyz=\"0 -1 0\"/><dynamics damping=\"0.1\" friction=\"0\"/>"));
}

TEST(UrdfSpelling, TypesOfJoints) {
  const std::string ball =
      ": expected floating, which stands for a ball joint; then the model file has type: ball and "
      "its center";
  const auto elbow = [](const std::string& type) {
    return arm_with("<joint name=\"elbow\" type=\"revolute\">",
                    "<joint name=\"elbow\" type=\"" + type + "\">");
  };
  expect_refused(elbow("ball"), "21: joint elbow: type: ball" + ball);
  expect_refused(elbow("spherical"), "21: joint elbow: type: spherical" + ball);
  expect_refused(elbow("hinge"), "21: joint elbow: type: hinge: expected revolute");
  expect_refused(elbow("Revolute"), "21: joint elbow: type: Revolute: expected revolute");
  expect_refused(elbow("prizmatic"), "21: joint elbow: type: prizmatic: expected prismatic");
  expect_refused(elbow("screw"),
                 "21: joint elbow: type: screw: expected revolute, continuous, prismatic, fixed, "
                 "floating or planar");
}

TEST(UrdfSpelling, LineEndsAndTabsInAttributes) {
  const std::string line_end = "a line end in the attribute: expected all of it on one line";
  expect_refused(arm_with(kElbowOrigin, "<origin xyz=\"0 0\n -0.25\"/>"),
                 "24: joint elbow: origin: xyz: " + line_end);
  expect_refused(arm_with(kElbowOrigin, "<origin xyz=\"0 0\r\n -0.25\"/>"),
                 "24: joint elbow: origin: xyz: " + line_end);
  expect_refused(arm_with(kElbowOrigin, "<origin xyz=\"0 0\r-0.25\"/>"),
                 "24: joint elbow: origin: xyz: " + line_end);
  expect_refused(arm_with("<mass value=\"0.4\"/>", "<mass value=\"0.4\n\"/>"),
                 "13: link upper_arm: inertial: mass: value: " + line_end);
  expect_refused(arm_with(kElbowOrigin, "<origin xyz=\"0\t0\t-0.25\"/>"),
                 "24: joint elbow: origin: xyz: a tab in the attribute: expected blanks");
  expect_refused(arm_with("<link name=\"base\"/>", "<link name=\"ba\nse\"/>"),
                 "2: link ba se: name: " + line_end);
  // Between attributes they are as good as blanks.
  expect_silence(arm_with(kElbowOrigin, "<origin\n\txyz=\"0 0 -0.25\"\r\n rpy=\"0 0 0\"/>"));
}

std::string with_line_ends(const std::string& end) {
  std::string text;
  for (const char c : kArmUrdf) text += c == '\n' ? end : std::string(1, c);
  return text;
}

TEST(UrdfFile, LineEndsOfOtherSystems) {
  expect_silence(with_line_ends("\r\n"));
  expect_silence(with_line_ends("\r"));
  std::string text = with_line_ends("\r");
  text.replace(text.find("xyz=\"0 0 -0.25\""), 3, "xzy");
  expect_refused(text, "24: joint elbow: origin: xzy: unknown attribute; expected xyz");
}

/// Each byte followed, or preceded, by others that are 0.
std::string wide(const std::string& mark, std::size_t before, std::size_t after) {
  std::string text = mark;
  for (const char c : kArmUrdf) text += std::string(before, '\0') + c + std::string(after, '\0');
  return text;
}

TEST(UrdfFile, OtherEncodings) {
  const std::string utf16 =
      "1: the text is UTF-16: expected UTF-8: iconv -f UTF-16 -t UTF-8 converts it";
  expect_refused(wide("\xFF\xFE", 0, 1), utf16);
  expect_refused(wide("\xFE\xFF", 1, 0), utf16);
  expect_refused(wide("", 0, 1), utf16);
  expect_refused(wide("", 1, 0), utf16);
  expect_refused(wide(std::string("\xFF\xFE\0\0", 4), 0, 3),
                 "1: the text is UTF-32: expected UTF-8: iconv -f UTF-32 -t UTF-8 converts it");
  expect_refused(arm_with("\n  <link name=\"upper_arm\">",
                          std::string("\n\0", 2) + "<link name=\"upper_arm\">"),
                 "10: a byte 0 in the text: expected UTF-8 without it");
  expect_silence("\xEF\xBB\xBF" + kArmUrdf);
}

TEST(UrdfFile, DoctypeAndEntities) {
  const std::string message =
      ": DOCTYPE and entities are not read: expected <robot> first: delete it, and write what each "
      "&entity; stands for";
  expect_refused("<!DOCTYPE robot [<!ENTITY m \"0.4\">]>\n" + kArmUrdf, "1" + message);
  expect_refused(
      "<?xml version=\"1.0\"?>\n<!-- a -->\n<!DOCTYPE robot SYSTEM \"urdf.dtd\">\n" + kArmUrdf,
      "3" + message);
  expect_refused("\n<!doctype robot>" + kArmUrdf, "2" + message);
}

TEST(UrdfFile, WhatIsNotOneRobot) {
  expect_refused(kArmUrdf + "<robot name=\"second\"/>",
                 "36: <robot> after </robot>: expected one <robot> with all in it");
  expect_refused("<sdf version=\"1.6\"/>",
                 "1: not a valid URDF: it begins with <sdf>: expected <robot>");
  expect_refused("", "1: not a valid URDF: the file is empty");
  const auto said_of_xml = [](const std::string& text) {
    const std::string refusal = said_about(text).refusal.value_or("accepted");
    return refusal.substr(refusal.find("not a valid URDF"));  // the line is the parser's
  };
  EXPECT_EQ(said_of_xml(arm_with("</inertial>", "</inertia>")),
            "not a valid URDF: an element that is closed by another name, or not at all");
  EXPECT_EQ(said_of_xml(kArmUrdf.substr(0, kArmUrdf.find("</robot>"))),
            "not a valid URDF: an element that is not closed before the file ends");
  EXPECT_EQ(said_of_xml(arm_with("<mass value=\"0.4\"/>", "<mass value=0.4/>")),
            "not a valid URDF: an attribute that appears twice in its element, or is not written "
            "name=\"value\"");
}

}  // namespace
}  // namespace anthrob
