// Parameters and shares that a calibration varies.
#include "anthrob_calib/calibration/parameter_space.h"

#include <gtest/gtest.h>

#include "two_muscle_rig.h"

namespace anthrob {
namespace calibration {
namespace {

TEST(ParameterSpace, SharesFollowWhatTheyAreSharesOf) {
  const ConfigNode model = ConfigNode::load(kModelFile);
  const ParameterSpace space(ConfigNode::parse(R"(
parameters: [{path: joints.hinge.friction.static, unit: Nm, low: 0.0, high: 0.2, step: 0.01}]
shares: [{path: joints.hinge.friction.kinetic, of: joints.hinge.friction.static, low: 0.0, high: 1.0, step: 0.1}]
)",
                                               "c.yaml"),
                             model);
  EXPECT_NEAR(space.initial()[1], 0.8, 1e-12);
  const auto overrides = space.overrides({0.04, 0.5});
  EXPECT_DOUBLE_EQ(overrides.at("joints.hinge.friction.static"), 0.04);
  EXPECT_DOUBLE_EQ(overrides.at("joints.hinge.friction.kinetic"), 0.02);
}

TEST(ParameterSpace, NothingIsAShareOfAShare) {
  const auto error_of = [](const std::string& shares) -> std::string {
    const std::string text = R"(
parameters: [{path: joints.hinge.friction.viscous, unit: Nms, low: 0.0, high: 0.2, step: 0.01}]
shares:
)" + shares;
    try {
      ParameterSpace(ConfigNode::parse(text, "c.yaml"), ConfigNode::load(kModelFile));
    } catch (const BadInput& error) {
      return error.what();
    }
    return "";
  };
  const std::string numbers = ", low: 0.0, high: 100.0, step: 0.1}\n";
  const std::string kinetic =
      "  - {path: joints.hinge.friction.kinetic, of: joints.hinge.friction.viscous" + numbers;
  const std::string of_kinetic =
      "  - {path: joints.hinge.friction.static, of: joints.hinge.friction.kinetic" + numbers;
  const std::string of_itself =
      "  - {path: joints.hinge.friction.static, of: joints.hinge.friction.static" + numbers;
  EXPECT_EQ(error_of(kinetic), "");
  EXPECT_EQ(error_of(of_kinetic + kinetic),
            "c.yaml:4: shares.0.of: joints.hinge.friction.kinetic: expected the path of a number "
            "that is not a share itself");
  EXPECT_NE(error_of(kinetic + of_kinetic).find("shares.1.of: "), std::string::npos);
  EXPECT_NE(error_of(of_itself).find("shares.0.of: "), std::string::npos);
}

TEST(ParameterSpace, AnEntryThatNoListHasIsSaid) {
  const ConfigNode model = ConfigNode::load(kModelFile);
  for (const char* entry : {"99", "99999999999999999999999", "-1", "x", "1x"}) {
    try {
      number_at(model, std::string("muscles.flexor.path.") + entry + ".point.0");
      ADD_FAILURE() << entry;
    } catch (const BadInput& error) {
      EXPECT_NE(std::string(error.what()).find(std::string("has no entry ") + entry),
                std::string::npos)
          << error.what();
    }
  }
}

TEST(ParameterSpace, SharesHaveNoOtherKeys) {
  const ConfigNode config = ConfigNode::parse(R"(
parameters: [{path: joints.hinge.friction.static, unit: Nm, low: 0.0, high: 0.2, step: 0.01}]
shares:
  - {path: joints.hinge.friction.kinetic, of: joints.hinge.friction.static, low: 0.0, high: 1.0,
     step: 0.1, range: 0.1}
)",
                                              "c.yaml");
  config.ignore();  // as a configuration does before
  try {
    ParameterSpace(config, ConfigNode::load(kModelFile));
    ADD_FAILURE() << "accepted";
  } catch (const BadInput& error) {
    EXPECT_STREQ(error.what(), "c.yaml:5: shares.0.range: unknown key");
  }
}

}  // namespace
}  // namespace calibration
}  // namespace anthrob
