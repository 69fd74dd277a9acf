// Parameters and shares that a calibration varies.
#include "problem/parameter_space.h"

#include <gtest/gtest.h>

#include <sstream>

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

TEST(ParameterSpace, AShareAtItsBoundIsTakenUpAgain) {
  const std::string before =
                        "parameters: [{path: a, unit: Nm, low: 0.0, high: 2.0, step: 0.1}]\n"
                        "shares: [{path: b, of: a, low: 0.0, high: ",
                    after = ", step: 0.1}]\n";
  int beyond = 0;
  for (const double bound : {0.3, 0.8, 0.9, 1.2}) {
    for (int i = 1; i < 100; ++i) {
      const double a = 0.017 * i;
      std::ostringstream model;
      model.precision(17);
      model << "{a: " << a << ", b: " << bound * a << "}";
      beyond += bound * a / a > bound;
      const ParameterSpace space(
          ConfigNode::parse(before + std::to_string(bound) + after, "c.yaml"),
          ConfigNode::parse(model.str(), "m.yaml"));
      EXPECT_LE(space.initial()[1], bound);
    }
  }
  EXPECT_GT(beyond, 0);  // the bit in question occurs
  try {
    ParameterSpace(ConfigNode::parse(before + "0.8" + after, "c.yaml"),
                   ConfigNode::parse("{a: 1.0, b: 0.9}", "m.yaml"));
    ADD_FAILURE();
  } catch (const BadInput& error) {
    EXPECT_STREQ(error.what(),
                 "c.yaml:2: shares.0.path: in the model, its share of a is 0.9: expected 0 to 0.8, "
                 "its low and high");
  }
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
