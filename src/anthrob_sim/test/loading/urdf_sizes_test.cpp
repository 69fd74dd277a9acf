// Sizes that no robot has: impossible ones are refused, odd ones are remarked on, with the unit in
// which they were probably meant.
#include "loading/urdf_support.h"
#include "skeleton/plausible_body.h"

namespace anthrob {
namespace {

using testing_support::arm_and;
using testing_support::arm_with;
using testing_support::expect_refused;
using testing_support::expect_remark;
using testing_support::expect_silence;
using testing_support::kArmUrdf;
using testing_support::said_about;

const char* const kUpperArm =
    "<inertia ixx=\"2.1e-3\" ixy=\"0\" ixz=\"0\" iyy=\"2.1e-3\" iyz=\"0\" izz=\"8e-5\"/>";

std::string inertia(const std::string& xx, const std::string& yy, const std::string& zz,
                    const std::string& xy = "0") {
  return "<inertia ixx=\"" + xx + "\" ixy=\"" + xy + "\" ixz=\"0\" iyy=\"" + yy +
         "\" iyz=\"0\" izz=\"" + zz + "\"/>";
}

std::string with_tool(const std::string& mass, const std::string& moments) {
  return arm_and(
      "<joint name=\"mount\" type=\"fixed\"><parent link=\"forearm\"/><child "
      "link=\"tool\"/></joint><link name=\"tool\"><inertial><mass value=\"" +
      mass + "\"/>" + moments + "</inertial></link>");
}

const std::string kNoBody =
    ": expected none below 0 and none larger than the other two together [kg m^2]";

TEST(UrdfSizes, InertiasThatNoBodyHas) {
  expect_refused(arm_with(kUpperArm, inertia("2.1e-3", "2.1e-3", "8e-3")),
                 "14: link upper_arm: inertia: principal moments 0.0021, 0.0021, 0.008" + kNoBody);
  expect_refused(arm_with(kUpperArm, inertia("2.1e-3", "2.1e-3", "8e-5", "3e-3")),
                 "14: link upper_arm: inertia: principal moments -0.0009, 8e-05, 0.0051" + kNoBody);
  // On fixed links, too, whose body would have possible moments.
  expect_refused(with_tool("0.3", inertia("-1e-4", "-1e-4", "1e-4")),
                 "35: link tool: inertia: principal moments -0.0001, -0.0001, 0.0001" + kNoBody);
  expect_refused(with_tool("0.3", inertia("1e-5", "1e-5", "1e-4")),
                 "35: link tool: inertia: principal moments 1e-05, 1e-05, 0.0001" + kNoBody);
  // And on the base, which has no use for them.
  expect_refused(
      arm_with("<link name=\"base\"/>", "<link name=\"base\"><inertial><mass value=\"1\"/>" +
                                            inertia("1", "1", "-1") + "</inertial></link>"),
      "2: link base: inertia: principal moments -1, 1, 1" + kNoBody);
  expect_refused(with_tool("-0.3", inertia("1e-4", "1e-4", "1e-4")),
                 "35: link tool: mass: -0.3: expected a number >= 0 [kg]");
}

TEST(UrdfSizes, InertiasAtTheBorderOfThePossible) {
  expect_silence(with_tool("0.3", inertia("1e-4", "1e-4", "2e-4")));  // a disc
  expect_silence(with_tool("0.3", inertia("1e-4", "1e-4", "0")));     // a thin rod
  expect_silence(with_tool("0.3", inertia("0", "0", "0")));           // a point
  expect_silence(with_tool("0", inertia("0", "0", "0")));             // a frame without mass
}

TEST(UrdfSizes, InertiasInOtherUnits) {
  expect_refused(arm_with(kUpperArm, inertia("2100", "2100", "80")),
                 "14: link upper_arm: inertia: 2100 kg m^2 of 0.4 kg (radius of gyration 72.5 m): "
                 "expected at most 10 m: in kg mm^2?");
  expect_refused(arm_with(kUpperArm, inertia("21000", "21000", "800")),
                 "14: link upper_arm: inertia: 21000 kg m^2 of 0.4 kg (radius of gyration 229 m): "
                 "expected at most 10 m: in g cm^2?");
  expect_refused(arm_with(kUpperArm, inertia("2.1e6", "2.1e6", "8e4")),
                 "14: link upper_arm: inertia: 2100000 kg m^2 of 0.4 kg (radius of gyration "
                 "2291 m): expected at most 10 m: in g mm^2?");
  expect_remark(
      arm_with(kUpperArm, inertia("21", "21", "0.8")),
      "14: link upper_arm: inertia: 21 kg m^2 of 0.4 kg (radius of gyration 7.25 m): that "
      "is a large link: in kg cm^2?");
  expect_remark(arm_with(kUpperArm, inertia("0.58", "0.58", "0.02")),
                "14: link upper_arm: inertia: 0.58 kg m^2 of 0.4 kg (radius of gyration 1.2 m): "
                "that is a large link: in kg cm^2?");
}

TEST(UrdfSizes, AnInertiaThatIsLargeForItsLink) {
  const std::string bare = with_tool("0.4", inertia("0.04", "0.04", "0.04"));
  expect_silence(bare);  // a link of which nothing is drawn may be of any size
  const std::string link = "<link name=\"tool\">";
  for (const char* kind : {"visual", "collision"}) {
    std::string drawn = bare;
    drawn.insert(drawn.find(link) + link.size(), std::string("<") + kind +
                                                     "><geometry><sphere radius=\"0.02\"/>"
                                                     "</geometry></" +
                                                     kind + ">");
    expect_remark(drawn,
                  "35: link tool: inertia: 0.04 kg m^2 of 0.4 kg (radius of gyration 0.316 m) of a "
                  "link that reaches 0.02 m: in kg cm^2?");
  }
  std::string meshed = bare;
  meshed.insert(meshed.find(link) + link.size(),
                "<visual><geometry><mesh filename=\"tool.stl\"/></geometry></visual>");
  expect_silence(meshed);
}

TEST(UrdfSizes, MassesInGrams) {
  for (const char* mass : {"100", "200", "400"}) {
    const testing_support::Said said = said_about(
        arm_with("<mass value=\"0.4\"/>", std::string("<mass value=\"") + mass + "\"/>"));
    ASSERT_EQ(said.remarks.size(), 1u) << mass << said.refusal.value_or("");
    EXPECT_NE(said.remarks[0].find("mass in g?"), std::string::npos) << said.remarks[0];
  }
  expect_remark(with_tool("120", inertia("2", "2", "2")), "35: link tool: mass: 120 kg: in g?");
  expect_remark(with_tool("0", inertia("1e-4", "1e-4", "1e-4")),
                "35: link tool: mass: 0 with an inertia: expected both, or none");
}

TEST(UrdfSizes, OriginsInMillimetres) {
  expect_refused(
      arm_with("xyz=\"0 0 -0.12\"", "xyz=\"0 0 -120\""),
      "12: link upper_arm: inertial: origin: centre of mass 120 m away: expected at most "
      "10 m: in mm?");
  expect_refused(arm_with("xyz=\"0 0 -0.25\"", "xyz=\"0 0 -250\""),
                 "24: joint elbow: origin: 250 m away: expected at most 10 m: in mm?");
  expect_refused(arm_with("xyz=\"0 0 -0.125\"", "xyz=\"0 0 -125\""),
                 "17: link upper_arm: visual: origin: 125 m away: expected at most 10 m: in mm?");
  expect_remark(arm_with("xyz=\"0 0 0.6\"", "xyz=\"0 3 4\""),
                "6: joint shoulder: origin: 5 m away: in mm or cm?");
  expect_remark(arm_with("<box size=\"0.025 0.015 0.25\"/>", "<box size=\"25 15 250\"/>"),
                "16: link upper_arm: visual: geometry: reaches 126 m from its centre: in mm?");
}

TEST(UrdfSizes, AnglesInDegrees) {
  for (const char* rpy : {"0 0 180", "-90 0 0", "0 7 0"}) {
    expect_refused(arm_with("xyz=\"0 0 -0.25\"", std::string("rpy=\"") + rpy + "\""),
                   std::string("24: joint elbow: origin: rpy: ") + rpy +
                       ": expected less than a turn [rad]: in degrees?");
  }
  expect_silence(arm_with("xyz=\"0 0 -0.25\"", "xyz=\"0 0 -0.25\" rpy=\"-6.2832 3.1416 0\""));
}

TEST(UrdfSizes, LimitsInDegreesOrMillimetres) {
  const std::string end = " rad: more than a turn, expected radians: in degrees?";
  const auto shoulder = [](const std::string& limits) {
    return arm_with("lower=\"-1\" upper=\"1.5\"", limits);
  };
  expect_remark(shoulder("lower=\"-57.3\" upper=\"85.9\""),
                "8: joint shoulder: limit: -57.3 to 85.9" + end);
  expect_remark(shoulder("lower=\"0\" upper=\"90\""), "8: joint shoulder: limit: 0 to 90" + end);
  expect_remark(shoulder("lower=\"-180\" upper=\"0\""),
                "8: joint shoulder: limit: -180 to 0" + end);
  expect_silence(shoulder("lower=\"-3.1416\" upper=\"6.2832\""));

  std::string slide = shoulder("lower=\"0\" upper=\"400\"");
  slide.replace(slide.find("revolute"), 8, "prismatic");
  expect_remark(slide, "8: joint shoulder: limit: 0 to 400 m: a long way: in mm?");
}

TEST(UrdfSizes, LimitsThatAreNotUsed) {
  const auto shoulder = [](const std::string& type) {
    return arm_with("type=\"revolute\"", "type=\"" + type + "\"");
  };
  expect_remark(shoulder("continuous"),
                "8: joint shoulder: limit: -1 to 1.5: not used, because a joint of type continuous "
                "has no limits in a URDF: revolute?");
  expect_remark(shoulder("floating"),
                "8: joint shoulder: limit: -1 to 1.5: not used, because a joint of type floating "
                "has no limits in a URDF: its stop is in the model file");
}

TEST(UrdfSizes, TheArmItselfIsPlausible) {
  expect_silence(kArmUrdf);
}

TEST(PlausibleBody, AcceptsAllThatRandomPointsCanBe) {
  testing_support::Random random(53);
  for (int i = 0; i < 1000; ++i) {
    const int points = random.integer(3, 12);
    double mass = 0.0;
    Vec3 moment = Vec3::Zero();
    std::vector<std::pair<double, Vec3>> body;
    for (int k = 0; k < points; ++k) {
      body.emplace_back(random.uniform(0.01, 0.3), random.vector(0.2));
      mass += body.back().first;
      moment += body.back().first * body.back().second;
    }
    Mat3 about_centre = Mat3::Zero();
    double farthest = 0.0;
    for (const auto& [m, p] : body) {
      const Vec3 d = p - moment / mass;
      about_centre += m * (d.squaredNorm() * Mat3::Identity() - d * d.transpose());
      farthest = std::max(farthest, p.norm());
    }
    const PlausibleBody plausible(mass, about_centre, farthest);
    EXPECT_EQ(plausible.impossible(), std::nullopt) << *plausible.impossible();
    EXPECT_EQ(plausible.odd(), std::nullopt) << *plausible.odd();
    EXPECT_LE(plausible.radius_of_gyration(), 2.0 * farthest);
  }
}

TEST(PlausibleBody, HasTheRadiusOfGyrationOfARod) {
  const double length = 0.6, mass = 2.0;
  const double moment = mass * length * length / 12.0;
  const Mat3 about_centre = Vec3(moment, moment, 0.0).asDiagonal();
  EXPECT_NEAR(PlausibleBody(mass, about_centre, 0.0).radius_of_gyration(), length / std::sqrt(12.0),
              1e-12);
}

}  // namespace
}  // namespace anthrob
