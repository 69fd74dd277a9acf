// What holds for every effect of the catalogue: neutral is nothing, a dose shows, snapshots
// continue, no memory is allocated, bad entries are refused.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>
#include <thread>

#include "allocations.h"
#include "anthrob_core/errors.h"
#include "effects_support.h"

namespace anthrob {
namespace {

using namespace testing_support;

const std::set<std::string> kIds = {"eyelet_friction",
                                    "eyelet_presliding",
                                    "joint_coulomb",
                                    "ball_joint_load_friction",
                                    "wrap_friction",
                                    "wrapping_surface",
                                    "spindle_growth",
                                    "tendon_elasticity",
                                    "tendon_creep",
                                    "second_maxwell_arm",
                                    "see_mullins",
                                    "see_hysteresis",
                                    "see_toe",
                                    "see_stiffening",
                                    "gear_backlash",
                                    "gear_efficiency",
                                    "cogging",
                                    "series_resistance",
                                    "pwm_dead_zone",
                                    "supply_sag",
                                    "winding_heating",
                                    "encoder_drift",
                                    "force_sensor_offset",
                                    "force_sensor_gain",
                                    "command_latency",
                                    "sensing_latency",
                                    "payload",
                                    "cable_drag",
                                    "gravity_tilt",
                                    "via_point_shift",
                                    "mocap_misalignment",
                                    "mocap_delay",
                                    "force_crosstalk",
                                    "joint_offset_torque",
                                    "joint_coulomb_asymmetric",
                                    "joint_viscous",
                                    "joint_quadratic_drag",
                                    "joint_presliding",
                                    "joint_lugre",
                                    "joint_load_friction",
                                    "joint_effort_friction",
                                    "joint_ripple",
                                    "effort_gain",
                                    "torque_constant",
                                    "motor_friction",
                                    "transmission_elasticity",
                                    "transmission_ratio"};

const char* const kServo = "../src/anthrob_sim/templates/robot/servo/model_I.yaml";
const char* const kRobots[] = {"two_muscle_rig/model_I.yaml",
                               "two_muscle_rig/model_II.yaml",
                               "two_muscle_rig/model_hill.yaml",
                               "anthrob/model_I.yaml",
                               "anthrob/model_II.yaml",
                               "driven_axis/model_I.yaml",
                               kServo};

std::vector<double> outcome(const std::shared_ptr<const RobotModel>& robot, int steps) {
  Simulation sim(robot);
  run(sim, steps);
  return channels(sim);
}

double difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double apart = std::abs(a[i] - b[i]);
    if (apart > largest || std::isnan(apart)) largest = apart;  // NaN stays
  }
  return largest;
}

/// A few places of each kind: the first of each muscle-wide, of each pathwise kind, and "all".
std::vector<std::string> some_places(const Effect& effect, const RobotModel& robot) {
  std::vector<std::string> list;
  std::set<std::size_t> kinds;
  for (const std::string& place : effect.places(robot)) {
    const auto slashes = static_cast<std::size_t>(std::count(place.begin(), place.end(), '/'));
    if (place == "all" || place == "global" || kinds.insert(slashes).second) list.push_back(place);
  }
  return list;
}

TEST(Catalogue, HasTheFixedIdsAndDescribesEachCompletely) {
  std::set<std::string> ids;
  for (const Effect* effect : all_effects()) {
    const EffectInfo& info = effect->info();
    ids.insert(info.id);
    EXPECT_EQ(find_effect(info.id), effect);
    EXPECT_FALSE(info.name.empty() || info.equation.empty() || info.source.empty()) << info.id;
    EXPECT_GT(info.description.size(), 80u) << info.id;
    EXPECT_FALSE(info.where.empty() || info.channels.empty()) << info.id;
    bool any_size = false;
    for (const EffectParameter& p : info.parameters) {
      EXPECT_FALSE(p.unit.empty() || p.meaning.empty()) << info.id;
      EXPECT_TRUE(p.bounds.contains(p.neutral) && p.bounds.contains(p.typical)) << info.id;
      if (p.kind != EffectParameter::kSize) continue;
      any_size = true;
      EXPECT_NE(p.typical, p.neutral) << info.id;
    }
    EXPECT_TRUE(any_size) << info.id;
  }
  EXPECT_EQ(ids, kIds);
  EXPECT_EQ(find_effect("perpetual_motion"), nullptr);
}

TEST(Catalogue, EveryEffectHasAPlaceOnSomeRobotAndADocumentation) {
  std::ifstream in(config("../docs/effects.md"));
  std::stringstream text;
  text << in.rdbuf();
  std::set<std::string> placed;
  for (const char* file : kRobots) {
    const auto robot = load_robot_model(config(file));
    for (const Effect* effect : all_effects()) {
      if (!effect->places(*robot).empty()) placed.insert(effect->info().id);
    }
  }
  EXPECT_EQ(placed, kIds);
  for (const std::string& id : kIds) {
    const std::string row = "| `" + id + "` | " + find_effect(id)->info().name + " | ";
    EXPECT_NE(text.str().find(row), std::string::npos) << row << " in docs/effects.md";
  }
}

TEST(Catalogue, NeutralParametersAreThePlainModelBitForBit) {
  for (const char* file : kRobots) {
    const ConfigNode node = ConfigNode::load(config(file));
    const auto plain = build_robot_model(node);
    const std::vector<double> expected = outcome(plain, 60);
    for (const Effect* effect : all_effects()) {
      for (const std::string& place : some_places(*effect, *plain)) {
        LoadOptions options;
        options.effects = {dose(*effect, *plain, place, 0.0)};
        EXPECT_EQ(outcome(build_robot_model(node, options), 60), expected)
            << effect->info().id << " at " << place << " of " << file;
      }
    }
  }
}

TEST(Catalogue, EveryListedPlaceIsAccepted) {
  for (const char* file : kRobots) {
    const ConfigNode node = ConfigNode::load(config(file));
    const auto plain = build_robot_model(node);
    for (const Effect* effect : all_effects()) {
      LoadOptions options;
      for (const std::string& place : effect->places(*plain)) {
        options.effects = {dose(*effect, *plain, place, 0.3)};
        EXPECT_NO_THROW(build_robot_model(node, options))
            << effect->info().id << " at " << place << " of " << file;
      }
    }
  }
}

/// Runs of every effect at its kinds of places on the arm with wrapped muscles, and of what only
/// other robots have.
template <class Body>
void for_every_effect(const Body& body) {
  std::set<std::string> done;
  for (const char* file : {"anthrob/model_II.yaml", "two_muscle_rig/model_I.yaml",
                           "driven_axis/model_I.yaml", kServo}) {
    const ConfigNode node = ConfigNode::load(config(file));
    const auto plain = build_robot_model(node);
    for (const Effect* effect : all_effects()) {
      const auto places = some_places(*effect, *plain);
      if (places.empty() || !done.insert(effect->info().id).second) continue;
      for (const std::string& place : places) {
        SCOPED_TRACE(effect->info().id + " at " + place + " of " + file);
        body(node, plain, *effect, place);
      }
    }
  }
  EXPECT_EQ(done, kIds);
}

TEST(Catalogue, ADoseShowsAndAThousandthOfItHardly) {
  std::set<std::string> visible;
  for_every_effect([&visible](const ConfigNode& node,
                              const std::shared_ptr<const RobotModel>& plain, const Effect& effect,
                              const std::string& place) {
    constexpr int kSteps = 900;
    const std::vector<double> expected = outcome(plain, kSteps);
    LoadOptions options;
    options.effects = {dose(effect, *plain, place)};
    const std::vector<double> dosed = outcome(build_robot_model(node, options), kSteps);
    options.effects = {dose(effect, *plain, place, 1e-3)};
    const std::vector<double> trace = outcome(build_robot_model(node, options), kSteps);
    const double change = difference(dosed, expected);
    EXPECT_TRUE(std::isfinite(change));
    if (change > 1e-6) visible.insert(effect.info().id);
    // A presliding distance on its way to zero still sticks at rest.
    if (effect.info().id != "eyelet_presliding") {
      EXPECT_LT(difference(trace, expected), 0.1 * change + 1e-9);
    }
  });
  // Model II's surfaces move with the insertions behind them: friction there shows nowhere. And no
  // tendon touches the surface that is put in beside those it has.
  std::set<std::string> expected = kIds;
  expected.erase("wrap_friction");
  expected.erase("wrapping_surface");
  EXPECT_EQ(visible, expected);
}

TEST(Catalogue, SnapshotsContinueWithTheSameBitsAndNothingIsAllocated) {
  for_every_effect([](const ConfigNode& node, const std::shared_ptr<const RobotModel>& plain,
                      const Effect& effect, const std::string& place) {
    LoadOptions options;
    options.effects = {dose(effect, *plain, place)};
    const auto robot = build_robot_model(node, options);
    Simulation original(robot), fresh(robot);
    run(original, 137);
    const Snapshot snapshot = original.snapshot();
    const std::size_t before = testing_support::allocations();
    run(original, 120);
    EXPECT_EQ(testing_support::allocations(), before);
    fresh.restore(snapshot);
    run(fresh, 120);
    EXPECT_EQ(original.snapshot().state, fresh.snapshot().state);
    EXPECT_EQ(channels(original), channels(fresh));
  });
}

TEST(Catalogue, AllEffectsAtOnceInAnyOrder) {
  const ConfigNode node = ConfigNode::load(config("anthrob/model_I.yaml"));
  const auto plain = build_robot_model(node);
  LoadOptions options;
  for (const Effect* effect : all_effects()) {
    const auto places = effect->places(*plain);
    if (!places.empty()) options.effects.push_back(dose(*effect, *plain, places.back(), 0.3));
  }
  const auto forward = build_robot_model(node, options);
  std::reverse(options.effects.begin(), options.effects.end());
  const auto backward = build_robot_model(node, options);
  EXPECT_EQ(outcome(forward, 200), outcome(backward, 200));
  EXPECT_EQ(forward->effects.size(), options.effects.size());
}

TEST(Catalogue, FileAndProgramGiveTheSameModel) {
  const std::vector<EffectInstance> effects = {
      {"gear_backlash", "flexor", {{"width", 0.017}, {"drag", 0.02}}},
      {"see_toe", "all", {{"softness", 0.2}}}};
  const std::string base = config("two_muscle_rig/model_I.yaml");
  const TemporaryRobot robot("", "extends: " + base + "\n" + effects_yaml(effects));
  // The robot's URDF is beside the extended file.
  EXPECT_EQ(outcome(robot.load(), 300),
            outcome(robot_with("two_muscle_rig/model_I.yaml", effects), 300));
}

TEST(Catalogue, AnyNameOfALinkIsAPlaceInAFile) {
  for (const std::string link :
       {"arm #2", "arm, left", "{arm}", "\"arm\"", "'arm", "&arm", "*", "yes", "arm"}) {
    const YAML::Node file = YAML::Load(effects_yaml({{"payload", link, {{"mass", 0.1}}}}));
    EXPECT_EQ(file["effects"][0]["place"].as<std::string>(), link);
    EXPECT_EQ(file["effects"][0]["mass"].as<double>(), 0.1);
  }
}

TEST(Catalogue, AnEmptyPlaceIsRefused) {
  LoadOptions options;
  options.effects = {{"wrapping_surface", "", {{"radius", 0.02}}}};
  const std::string file = config("two_muscle_rig/model_I.yaml");
  EXPECT_THROW(load_robot_model(file, options), BadInput);
}

TEST(Catalogue, ModelsAreBuiltAndRunInThreadsAtOnce) {
  const ConfigNode node = ConfigNode::load(config("anthrob/model_I.yaml"));
  const auto build = [&] {
    LoadOptions options;
    options.effects = {{"gear_backlash", "all", {{"width", 0.02}}}};
    return outcome(build_robot_model(node, options), 100);
  };
  const std::vector<double> expected = build();
  std::vector<std::vector<double>> found(4);
  std::vector<std::thread> threads;
  for (auto& result : found) {
    threads.emplace_back([&] {
      for (int i = 0; i < 5; ++i) result = build();
    });
  }
  for (auto& thread : threads) thread.join();
  for (const auto& result : found) EXPECT_EQ(result, expected);
}

void trust(const std::string& libraries) {
  setenv("ANTHROB_EFFECT_LIBRARIES", libraries.c_str(), 1);
}

TEST(Catalogue, AModelOfAStrangerRunsNoCode) {
  const TemporaryRobot robot("", "extends: " + config("two_muscle_rig/model_I.yaml") +
                                     "\neffect_libraries: [" + ANTHROB_EXAMPLE_LIBRARY + "]\n");
  for (const char* trusted : {"", "example", "/nowhere"}) {
    trust(trusted);
    try {
      robot.load();
      FAIL() << "loaded, trusting '" << trusted << "'";
    } catch (const BadInput& error) {
      EXPECT_NE(std::string(error.what())
                    .find("effect_libraries.0: " ANTHROB_EXAMPLE_LIBRARY
                          ": this model asks for code of another origin; if you trust it, allow it "
                          "in the environment: ANTHROB_EFFECT_LIBRARIES=" ANTHROB_EXAMPLE_LIBRARY),
                std::string::npos)
          << error.what();
    }
  }
}

TEST(Catalogue, AnEffectOfOnesOwnComesFromALibrary) {
  trust(ANTHROB_EXAMPLE_LIBRARY);
  const std::string base = config("two_muscle_rig/model_I.yaml");
  const TemporaryRobot robot("", "extends: " + base + "\neffect_libraries: [" +
                                     ANTHROB_EXAMPLE_LIBRARY +
                                     "]\neffects:\n  - {id: spindle_eccentricity, place: flexor, "
                                     "offset: 0.001}\n");
  const auto model = robot.load();
  ASSERT_NE(find_effect("spindle_eccentricity"), nullptr);
  const Actuator& actuator = *model->muscles[0].actuator;
  Memory state(actuator.state_size());
  // l_T = l_T0 - r_S position - e (1 - cos position)
  for (const double position : {0.0, 0.7, 3.0}) {
    actuator.place(position, state);
    EXPECT_NEAR(actuator.tendon_length(state),
                0.3652 - 0.0065 * position - 0.001 * (1.0 - std::cos(position)), 1e-12);
    EXPECT_NEAR(actuator.position_for(actuator.tendon_length(state)), position, 1e-9);
  }
  // A tension holds by its lever, -dl/dposition.
  const auto plain = load_robot_model(base);
  const double lever = 0.0065 + 0.001 * std::sin(0.7);
  EXPECT_NEAR(actuator.holding_input(0.7, 40.0),
              plain->muscles[0].actuator->holding_input(0.7, 40.0 * lever / 0.0065), 1e-12);
}

TEST(Catalogue, ALibraryIsLookedForFromTheModelFile) {
  const TemporaryRobot robot("", "extends: " + config("two_muscle_rig/model_I.yaml") +
                                     "\neffect_libraries: [lib/own.so]\neffects:\n  - {id: "
                                     "spindle_eccentricity, place: flexor, offset: 0.001}\n");
  const auto folder = std::filesystem::path(robot.file()).parent_path() / "lib";
  trust(std::string(ANTHROB_EXAMPLE_LIBRARY));
  EXPECT_THROW(robot.load(), BadInput);
  std::filesystem::create_directories(folder);
  std::filesystem::create_symlink(ANTHROB_EXAMPLE_LIBRARY, folder / "own.so");
  EXPECT_EQ(robot.load()->effects.size(), 1u);
}

/// Loads the rig with an `effects:` section; returns the message.
std::string refusal(const std::string& effects) {
  const std::string base = config("two_muscle_rig/model_I.yaml");
  const TemporaryRobot robot("", "extends: " + base + "\n" + effects);
  try {
    robot.load();
  } catch (const BadInput& error) {
    const std::string text = error.what();
    EXPECT_EQ(text.find('\n'), std::string::npos);
    const auto name = text.find("model.yaml:");
    return name == std::string::npos ? text : text.substr(name);
  }
  return "(accepted)";
}

TEST(Catalogue, BadEntriesAreRefusedWithOneLine) {
  EXPECT_EQ(refusal("effects:\n  - {id: warp, place: flexor, x: 1}\n"),
            "model.yaml:3: effects.0.id: warp: expected the id of an effect; anthrob_effects lists "
            "them");
  EXPECT_EQ(refusal("effects:\n  - {id: gear_backlash, place: flexor, width: -1}\n"),
            "model.yaml:3: effects.0.width: -1: expected a number in [0, 0.5] [rad]");
  EXPECT_EQ(refusal("effects:\n  - {id: gear_backlash, place: flexor, width: wide}\n"),
            "model.yaml:3: effects.0.width: wide: expected a finite number [rad]");
  EXPECT_EQ(refusal("effects:\n  - {id: gear_backlash, place: flexor, depth: 1}\n"),
            "model.yaml:3: effects.0.depth: unknown key: no parameter of gear_backlash");
  const TemporaryRobot slide(
      "", "extends: " + config("driven_axis/model_I.yaml") +
              "\neffects:\n  - {id: joint_coulomb, place: axis, torque: high}\n");
  try {
    slide.load();
    ADD_FAILURE() << "accepted";
  } catch (const BadInput& error) {
    EXPECT_NE(std::string(error.what()).find("torque: high: expected a finite number [N]"),
              std::string::npos)
        << error.what();
  }
  // A ball joint's cable is at rest where the joint is.
  try {
    robot_with(kArm, {{"cable_drag", "shoulder", {{"stiffness", 0.1}, {"rest", 0.2}}}});
    ADD_FAILURE() << "accepted";
  } catch (const BadInput& error) {
    EXPECT_NE(std::string(error.what())
                  .find("rest: 0.2: expected one of the effect's parameters there: stiffness"),
              std::string::npos)
        << error.what();
  }
  EXPECT_EQ(refusal("effects:\n  - {id: gear_backlash, place: biceps, width: 0.01}\n"),
            "model.yaml:3: effects.0.place: biceps: expected a place of this effect on this robot "
            "(MUSCLE | all): flexor extensor all");
  EXPECT_EQ(refusal("effects:\n  - {id: gear_backlash, width: 0.01}\n"),
            "model.yaml:3: effects.0: key 'place' is missing");
  EXPECT_EQ(
      refusal("effects:\n  - {id: gear_backlash, place: flexor}\n"),
      "model.yaml:3: effects.0.place: flexor: expected at least one size of the effect in the "
      "same entry; sizes: width");
  EXPECT_EQ(refusal("effects:\n  - {id: payload, place: arm, mass: 0.1}\n"
                    "  - {id: payload, place: arm, mass: 0.2}\n"),
            "model.yaml:4: effects.1.place: arm: expected an effect only once per place; another "
            "entry has the same id and place");
  EXPECT_EQ(refusal("effects:\n  - {id: gear_backlash, place: flexor, width: 0.1}\n"
                    "  - {id: gear_backlash, place: all, width: 0.1}\n"),
            "model.yaml:3: effects.0.place: flexor: expected this effect only once per muscle; the "
            "entry at 'all' already includes this muscle");
  EXPECT_EQ(refusal("effects:\n  - {id: payload, place: arm, mass: -3}\n"),
            "model.yaml:3: effects.0.mass: -3: expected a number for which the body keeps a "
            "mass > 0 [kg]");
  EXPECT_EQ(refusal("effects:\n  - {id: gear_efficiency, place: all, loss: -0.9}\n"),
            "model.yaml:3: effects.0.loss: -0.9: expected a number for which the efficiency "
            "is at most 1");
  EXPECT_NE(refusal("effects:\n  - {id: wrapping_surface, place: flexor, radius: 0.09}\n")
                .find("inside the surface at rest"),
            std::string::npos);
  EXPECT_EQ(refusal("effects: {id: payload}\n"), "model.yaml:2: effects: {...}: expected a list");
  trust("no_such_library");
  EXPECT_NE(refusal("effect_libraries: [no_such_library]\n").find("no_such_library: expected a"),
            std::string::npos);
}

TEST(Catalogue, BadInstancesFromAProgramAreRefusedToo) {
  const auto message = [](const EffectInstance& instance) -> std::string {
    try {
      robot_with("two_muscle_rig/model_I.yaml", {instance});
    } catch (const BadInput& error) {
      return error.what();
    }
    return "(accepted)";
  };
  EXPECT_NE(message({"warp", "all", {}}).find("effect 'warp': expected"), std::string::npos);
  EXPECT_NE(message({"see_toe", "all", {{"softness", 2.0}}})
                .find("effect see_toe at all: softness: 2: expected a number in [0, 0.95] [1]"),
            std::string::npos);
  EXPECT_NE(message({"see_toe", "nobody", {{"softness", 0.2}}}).find("effect see_toe at nobody"),
            std::string::npos);
  EXPECT_NE(message({"see_toe", "all", {{"hardness", 0.2}}}).find("hardness"), std::string::npos);
}

}  // namespace
}  // namespace anthrob
