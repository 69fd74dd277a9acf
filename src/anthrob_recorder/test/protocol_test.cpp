#include "protocol.h"

#include <gtest/gtest.h>

#include "support.h"

namespace anthrob {
namespace {

using testing_support::anthrob_folder;
using testing_support::content;
using testing_support::Folder;
using testing_support::tier1;

TEST(Protocol, TheThesissSets) {
  const auto one = tier1();
  const auto two = load_robot_model(anthrob_folder() + "model_I.yaml");
  const auto load = [](const std::string& name, const auto& model) {
    return Protocol::load(anthrob_folder() + "record_" + name + ".yaml", model);
  };
  EXPECT_EQ(load("tier1_equilibria", one).targets.size(), 17u);
  EXPECT_EQ(load("tier1_trajectories", one).targets.size(), 16u);
  EXPECT_EQ(load("tier1_zero_gravity", one).targets.size(), 17u);
  EXPECT_EQ(load("tier2_equilibria", two).targets.size(), 6u);
  const Protocol last = load("tier2_trajectories", two);
  ASSERT_EQ(last.targets.size(), 3u);
  EXPECT_EQ(last.targets[2].name, "E5");
  EXPECT_EQ(last.rest.name, "E0");
  EXPECT_NEAR(last.drift_limit, 3.0 * M_PI / 180.0, 1e-4);
}

TEST(Protocol, RefusesWhatItCannotUse) {
  const std::string good = content(anthrob_folder() + "record_tier1_equilibria.yaml");
  const struct {
    const char *replace, *with, *expected;
  } cases[] = {
      {"protocol: equilibria", "protocol: dance", "equilibria, trajectories or zero_gravity"},
      {"equilibria_tier1.yaml", "nothing.yaml", "nothing.yaml"},
      {"rest: E0", "rest: E99", "'E99': expected the name of a posture in "},
      {"rest: E0", "rest: E0\nvisit: [E77]", "'E77': expected the name of a posture in "},
      {"rest: E0", "rest: E0\nvisit: []", "no posture to visit"},
      {"rest: E0", "rest: E0\nvisit: [E1, E3, E1]", "is listed twice"},
      {"repeats: 1", "repeats: 0", "repeats"},
      {"hold: 0.5", "hold: .nan", "hold"},
      {"average: 0.1", "average: 3", "average"},
      {"window: 0.5", "window: 0", "window"},
      {"limit: 0.0524", "limit: -1", "limit"},
      {"hold: 0.5", "hold: 0.5\nhodl: 1", "unknown key"},
      {"hold: 0.5", "hold: 0.5\nby_hand: true", "unknown key"},
  };
  const Folder folder;
  folder.write("equilibria_tier1.yaml", content(anthrob_folder() + "equilibria_tier1.yaml"));
  for (const auto& test : cases) {
    std::string text = good;
    const auto at = text.find(test.replace);
    ASSERT_NE(at, std::string::npos) << test.replace;
    text.replace(at, std::string(test.replace).size(), test.with);
    folder.write("p.yaml", text);
    try {
      Protocol::load(folder.file("p.yaml"), tier1());
      ADD_FAILURE() << test.with;
    } catch (const BadInput& error) {
      const std::string what = error.what();
      EXPECT_NE(what.find(test.expected), std::string::npos) << what;
      EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    }
  }
}

TEST(Protocol, NoTrajectoryLeadsFromRestToRest) {
  const Folder folder;
  folder.write("equilibria_tier1.yaml", content(anthrob_folder() + "equilibria_tier1.yaml"));
  const std::string text = content(anthrob_folder() + "record_tier1_trajectories.yaml");
  folder.write("p.yaml", text + "\nvisit: [E1, E2]\n");
  EXPECT_EQ(Protocol::load(folder.file("p.yaml"), tier1()).targets.size(), 2u);
  folder.write("p.yaml", text + "\nvisit: [E1, E0]\n");
  EXPECT_THROW(Protocol::load(folder.file("p.yaml"), tier1()), BadInput);
}

TEST(Protocol, ASessionKnowsWhatReferencesItHas) {
  const auto load = [](const std::string& model) {
    return Protocol::load(anthrob_folder() + "record_tier1_equilibria.yaml",
                          load_robot_model(anthrob_folder() + model));
  };
  EXPECT_EQ(load("model_I_tier1.yaml").text, load("model_I_tier1.yaml").text);
  EXPECT_NE(load("model_I_tier1.yaml").text, load("model_II_tier1.yaml").text);
}

TEST(Protocol, RefusesTwoPosturesOfOneName) {
  const Folder folder;
  folder.write("p.yaml", content(anthrob_folder() + "record_tier1_equilibria.yaml"));
  folder.write("equilibria_tier1.yaml", "postures: [{name: E0}, {name: E0}]\n");
  EXPECT_THROW(Protocol::load(folder.file("p.yaml"), tier1()), BadInput);
}

TEST(Protocol, ZeroGravityGoesToPosturesThatJointsSay) {
  const Folder folder;
  std::string postures = content(anthrob_folder() + "equilibria_tier1.yaml");
  postures += "  - {name: recorded, references: {";
  const auto model = tier1();
  for (const MuscleModel& muscle : model->muscles) postures += muscle.name + ": 0.5, ";
  folder.write("equilibria_tier1.yaml", postures + "}}\n");
  const std::string protocol = content(anthrob_folder() + "record_tier1_zero_gravity.yaml");
  folder.write("p.yaml", protocol + "visit: [E1]\n");
  Protocol::load(folder.file("p.yaml"), tier1());
  folder.write("p.yaml", protocol + "visit: [E1, recorded]\n");
  EXPECT_THROW(Protocol::load(folder.file("p.yaml"), tier1()), BadInput);
}

}  // namespace
}  // namespace anthrob
