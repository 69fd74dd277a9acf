#include "loop/closed_loop.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "experiment/simulated_recording.h"
#include "made_recording.h"
#include "report/discovery_summary.h"
#include "report/separating_files.h"

namespace anthrob {
namespace discovery {
namespace {

constexpr double kBin = 0.02;  // [s]
const std::string kModel = std::string(ANTHROB_CONFIG_DIR) + "/anthrob/model_I.yaml";

std::shared_ptr<const RobotModel> robot_with(const EffectInstance& effect) {
  LoadOptions options;
  options.effects = {effect};
  return build_robot_model(ConfigNode::load(kModel), options);
}

Dataset recording(const std::shared_ptr<const RobotModel>& robot, std::uint64_t seed, double length,
                  double noise = 1.0) {
  MadeRecording made;
  // Not of joints: so much noise on each part of a quaternion makes it none.
  for (double* size :
       {&made.position_noise, &made.current_noise, &made.force_noise, &made.voltage_noise}) {
    *size *= noise;
  }
  made.seed = made.noise = seed;
  made.length = length;
  return made.measure(robot, made.commands(load_robot_model(kModel)));
}

const EffectInstance kFriction{"joint_coulomb", "elbow", {{"torque", 0.06}, {"static_ratio", 1.2}}};
const EffectInstance kMoreDamping{"joint_viscous", "elbow", {{"damping", 0.08}}};

class Separation : public ::testing::Test {
 protected:
  Separation() {
    named.effects = {kFriction};
    rival.effects = {kMoreDamping};
    // Planned once: it takes seconds.
    static const SeparatingRecording kPlan =
        plan_separation(evaluator, named, rival, seen, scales(), kBin, {});
    plan = kPlan;
  }
  Scales scales() const {
    const Experiments train = {make_experiment(*evaluator.model(), seen, {})};
    return measure_scales(evaluator, train, {}, {}, {});
  }

  const Evaluator evaluator{kModel, {}, 0.001, 2};
  const Dataset seen = recording(robot_with(kFriction), 1, 5.0);
  Variant named, rival;
  SeparatingRecording plan;
};

TEST_F(Separation, GoesWhereTheExplanationsDiffer) {
  ASSERT_EQ(plan.targets.size(), 6u);
  EXPECT_GT(plan.distance(), 100.0);
  for (std::size_t i = 0; i < plan.targets.size(); ++i) {
    const auto& target = plan.targets[i];
    ASSERT_EQ(target.references.size(), evaluator.model()->muscles.size());
    if (i > 0) {
      EXPECT_LE(target.distance, plan.targets[i - 1].distance);
    }
  }
  const SeparatingRecording same =
      plan_separation(evaluator, named, named, seen, scales(), kBin, {});
  EXPECT_LT(same.distance(), 1e-3 * plan.distance()) << "nothing tells a model from itself";
}

TEST_F(Separation, IsPlannedForReferencesOfPositionsOnly) {
  Dataset by_force = seen;
  Table& table = by_force.table("commands");
  Column& mode = table.column(evaluator.model()->muscles[2].name + "/mode");
  mode.values.assign(table.t.size(), static_cast<double>(ecu::Mode::kForce));
  mode.present.assign(table.t.size(), 1);
  EXPECT_TRUE(
      plan_separation(evaluator, named, rival, by_force, scales(), kBin, {}).targets.empty());
}

TEST_F(Separation, IsMadeOfEveryTargetOnce) {
  const RobotModel& model = *evaluator.model();
  const Dataset all = separating_commands(model, plan, {});
  const Dataset half = separating_commands(model, plan, {}, 1, 2);
  EXPECT_NEAR(seconds(all.end() - all.begin()), 6 * 5.0, 0.02);
  EXPECT_NEAR(seconds(half.end() - half.begin()), 3 * 5.0, 0.02);
  const std::string muscle = model.muscles[0].name + "/reference";
  EXPECT_EQ(all.series(muscle).at(0.0), plan.rest[0]) << "begins settled at rest";
  EXPECT_EQ(all.series(muscle).held_at(1.0), plan.targets[0].references[0]);
  EXPECT_EQ(half.series(muscle).held_at(1.0), plan.targets[1].references[0]);
}

TEST_F(Separation, IsMeasuredWithTheRobotsSensors) {
  const Dataset commands = separating_commands(*evaluator.model(), plan, {}, 0, 6);
  const auto robot = robot_with(kFriction);
  const Dataset a = simulated_recording(robot, commands, 1, {}),
                b = simulated_recording(robot, commands, 1, {});
  EXPECT_EQ(a.find_table("muscles")->columns[3].values, b.find_table("muscles")->columns[3].values);
  // What was recorded is what the explanation that is true replays.
  const Experiments experiments = {make_experiment(*robot, a, {})};
  const auto results = evaluator.compare({named, rival}, experiments);
  EXPECT_LT(results[0].norm(), 0.05 * results[1].norm());
}

TEST(ClosedLoop, AsksTheRobotNothingWhereNothingIsUndecided) {
  const auto robot = robot_with({"tendon_elasticity", "biceps_brachii", {{"compliance", 2e-4}}});
  Question question;
  question.model_file = kModel;
  question.train = {recording(robot, 1, 4.0, 25.0)};
  question.test = {recording(robot, 2, 4.0, 25.0)};
  question.effects = {"tendon_elasticity"};
  question.max_effects = 1;
  const Evaluator evaluator(kModel, {}, 0.001, 2);
  const Answer answer = discover_in_a_loop(evaluator, question, robot);
  ASSERT_EQ(answer.effects.size(), 1u) << summary(answer);
  EXPECT_EQ(answer.effects[0].place, "biceps_brachii");
  EXPECT_TRUE(answer.asked.empty());
  EXPECT_EQ(question.train.size(), 1u);
}

TEST(ClosedLoop, RefusesAnotherRobotBeforeItSearches) {
  const std::string config = ANTHROB_CONFIG_DIR;
  const std::string rig = config + "/two_muscle_rig/model_I.yaml";
  const std::string axis = config + "/driven_axis/model_I.yaml";
  const struct {
    std::string examined, robot, lacking;
  } cases[] = {
      {rig, kModel, "has no muscle 'flexor'"},
      {axis, kModel, "has no joint 'axis'"},
      {rig, config + "/two_muscle_rig/model_hill.yaml", "has no controller for muscle 'flexor'"},
  };
  for (const auto& test : cases) {
    const Evaluator evaluator(test.examined, {}, 0.001, 1);
    Question question;
    question.model_file = test.examined;
    int stages = 0;
    Observer observer;
    observer.progress = [&stages](const std::string&) { return ++stages > 0; };
    try {
      discover_in_a_loop(evaluator, question, load_robot_model(test.robot), observer);
      ADD_FAILURE() << "not refused: " << test.robot;
    } catch (const BadInput& error) {
      const std::string what = error.what();
      EXPECT_EQ(what.find("--close-the-loop "), 0u) << what;
      EXPECT_NE(what.find(test.lacking + "; expected the muscles and joints of "),
                std::string::npos)
          << what;
      EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    }
    EXPECT_EQ(stages, 0);
  }
}

/// A force sensor that reads too much by a gain, recorded where its muscle's tension hardly
/// changes: an offset explains that as well.
struct OneTension {
  OneTension() {
    LoadOptions options;
    options.effects = {{"force_sensor_gain", "flexor", {{"gain", 1.2}}}};
    robot = build_robot_model(ConfigNode::load(model_file), options);
  }
  Dataset recording(std::uint64_t noise) const {
    constexpr double kShare = 0.01;  // of the made recording's motion
    MadeRecording made;
    made.length = 4.0;
    made.noise = noise;
    made.force_noise = 0.5;
    Dataset commands = made.commands(load_robot_model(model_file));
    for (Column& column : commands.table("commands").columns) {
      const double rest = column.values.front();
      for (double& value : column.values) value = rest + kShare * (value - rest);
    }
    return made.measure(robot, commands);
  }

  const std::string model_file = std::string(ANTHROB_CONFIG_DIR) + "/two_muscle_rig/model_I.yaml";
  std::shared_ptr<const RobotModel> robot;
};

TEST(ClosedLoop, AsksTheRobotWhatTellsRivalsApart) {
  const OneTension made;
  Question question;
  question.model_file = made.model_file;
  question.train = {made.recording(5)};
  question.test = {made.recording(6)};
  question.effects = {"force_sensor_gain", "force_sensor_offset"};
  question.max_effects = 1;
  const Evaluator evaluator(made.model_file, {}, 0.001, 2);
  const Answer answer = discover_in_a_loop(evaluator, question, made.robot);
  ASSERT_GE(answer.asked.size(), 1u) << summary(answer);
  EXPECT_NE(answer.asked[0].find("force_sensor_offset @ flexor"), std::string::npos);
  EXPECT_EQ(question.train.size(), 1 + answer.asked.size());
  EXPECT_EQ(question.test.size(), 1 + answer.asked.size());
  ASSERT_EQ(answer.effects.size(), 1u) << summary(answer);
  const FoundEffect& effect = answer.effects[0];
  EXPECT_EQ(effect.id, "force_sensor_gain");
  EXPECT_EQ(effect.place, "flexor");
  EXPECT_NEAR(effect.parameters.at(0).value, 1.2, 0.02);
  EXPECT_TRUE(effect.rivals.empty() || effect.rivals[0].probability < 0.05) << summary(answer);
}

TEST(SeparatingFiles, AreWrittenForTheRecorder) {
  const auto model = load_robot_model(kModel);
  Answer answer;
  FoundEffect effect;
  effect.id = "joint_coulomb";
  effect.place = "elbow";
  effect.rivals = {{"joint_viscous", "Viscous joint friction", "elbow", 0.3, 10.0}};
  answer.effects = {effect, effect};
  const std::vector<double> references(model->muscles.size(), 0.25);
  answer.effects[1].separating_recording = {references, {{"P1_tight", references, 12.4}}};
  const auto files = separating_files(answer, *model);
  ASSERT_EQ(files.size(), 2u) << "only where a recording is known";
  const std::string& protocol = files.at("separating_2.yaml");
  EXPECT_NE(protocol.find("Tells joint_coulomb @ elbow from joint_viscous @ elbow"),
            std::string::npos);
  EXPECT_NE(protocol.find("record.launch protocol:=separating_2 protocol_file:="),
            std::string::npos);
  EXPECT_NE(protocol.find("sim:=false lock_step:=false enable:=true"), std::string::npos);
  EXPECT_NE(protocol.find("postures: separating_2_postures.yaml"), std::string::npos);
  const std::string& postures = files.at("separating_2_postures.yaml");
  EXPECT_NE(postures.find("- name: P1_tight"), std::string::npos);
  EXPECT_NE(postures.find("# 12 nat"), std::string::npos);
  EXPECT_NE(postures.find("brachialis: 0.25"), std::string::npos);
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
