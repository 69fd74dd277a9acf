// Nothing of a hidden thing is nothing, bit for bit; a typical one is something.
#include <gtest/gtest.h>

#include "support.h"

namespace anthrob::virtual_robot {
namespace {

Readings after_motion(const Hidden* hidden) {
  Draft draft;
  draft.arm = model_I();
  if (hidden) build_in(*hidden, &draft);
  Robot robot(std::move(draft), nullptr, 0);
  return moved(&robot, 0.25);
}

const Readings& plain() {
  static const Readings readings = after_motion(nullptr);
  return readings;
}

Hidden typical(const HiddenLaw& law) {
  Random random(3);
  const std::string place = law.places(model_I()).front();
  return {law.id, place, law.draw(model_I(), place, &random)};
}

TEST(Neutral, NothingOfALawLeavesTheArmBitForBit) {
  for (const auto* laws : {&catalogue_laws(), &outside_laws()}) {
    for (const HiddenLaw& law : *laws) {
      Hidden hidden = scaled(typical(law), 0.0);
      if (law.id == "wrapping_surface") hidden.parameters["radius"] = 0.0;
      EXPECT_TRUE(same(after_motion(&hidden), plain())) << law.id;
    }
  }
}

TEST(Neutral, ATypicalOneChangesReadings) {
  for (const auto* laws : {&catalogue_laws(), &outside_laws()}) {
    for (const HiddenLaw& law : *laws) {
      // Some want a posture, a turn or a force that this motion lacks: see their closed forms in
      // laws_test.cpp, and the surface in robot_test.cpp.
      if (law.id == "shoulder_hardening" || law.id == "weak_above_angle" ||
          law.id == "slipping_knot" || law.id == "force_compression" ||
          law.id == "wrapping_surface" || law.id == "gear_backlash") {
        continue;
      }
      const Hidden hidden = typical(law);
      EXPECT_FALSE(same(after_motion(&hidden), plain())) << law.id;
    }
  }
}

TEST(Neutral, EveryIdIsThereOnce) {
  std::map<std::string, int> seen;
  for (const auto* laws : {&catalogue_laws(), &outside_laws()}) {
    for (const HiddenLaw& law : *laws) {
      EXPECT_EQ(++seen[law.id], 1) << law.id;
      EXPECT_FALSE(law.places(model_I()).empty()) << law.id;
    }
  }
  EXPECT_GE(catalogue_laws().size(), 36u);
  EXPECT_GE(outside_laws().size(), 12u);
}

}  // namespace
}  // namespace anthrob::virtual_robot
