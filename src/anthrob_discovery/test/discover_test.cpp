// The whole search: on a driven axis, made here by its closed equation, and on the arm.
#include "discover.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "arm.h"
#include "axis_recording.h"
#include "config.h"
#include "rendered_page.h"
#include "report/discovery_report.h"
#include "report/discovery_summary.h"
#include "report/model_text.h"
#include "separation/separating_experiment.h"

namespace anthrob {
namespace discovery {
namespace {

const FoundParameter* find_parameter(const FoundEffect& effect, const std::string& name) {
  const auto found = std::find_if(effect.parameters.begin(), effect.parameters.end(),
                                  [&](const FoundParameter& p) { return p.name == name; });
  return found == effect.parameters.end() ? nullptr : &*found;
}

Answer ask(const Question& question, int jobs = 2) {
  const Evaluator evaluator(question.model_file, question.nuisances, question.step, jobs);
  return discover(evaluator, question);
}

TEST(DrivenAxis, DryFrictionIsNamedAndMeasured) {
  const Answer answer = ask(axis_question(20.4, 0.0));
  ASSERT_EQ(answer.verdict, Verdict::kEffectsFound) << summary(answer);
  EXPECT_EQ(answer.effects[0].id, "joint_coulomb") << summary(answer);
  EXPECT_EQ(answer.effects[0].place, "axis");
  const FoundParameter* torque = find_parameter(answer.effects[0], "torque");
  ASSERT_NE(torque, nullptr);
  EXPECT_NEAR(torque->value, 20.4, 0.6);
  EXPECT_LT(torque->low, 20.4);
  EXPECT_GT(torque->high, 20.4);
  EXPECT_LT(torque->high - torque->low, 12.0);
  EXPECT_LT(answer.diagnosis.test.after, 0.3 * answer.diagnosis.test.recalibrated);
  EXPECT_NE(answer.search.end, SearchEnd::kFull);
  EXPECT_TRUE(answer.diagnosis.one_sided.empty());
}

TEST(DrivenAxis, OffsetAndAsymmetricFrictionAreSaidToBeAlike) {
  const Answer answer = ask(axis_question(20.4, -3.2));
  ASSERT_GE(answer.effects.size(), 2u) << summary(answer);
  EXPECT_EQ(answer.effects[0].id, "joint_coulomb") << summary(answer);
  std::set<std::string> second = {answer.effects[1].id};
  for (const Rival& rival : answer.effects[1].rivals) second.insert(rival.id);
  EXPECT_TRUE(second.count("joint_offset_torque")) << summary(answer);
  EXPECT_TRUE(second.count("joint_coulomb_asymmetric")) << summary(answer);
  EXPECT_NE(answer.effects[1].separating_experiment.find("drive off"), std::string::npos);
  // They show in the same, and leave the same of what was there at first.
  EXPECT_EQ(answer.effects[1].shows_in, "axis/effort");
  EXPECT_LT(answer.effects[1].left, 0.05);
  EXPECT_EQ(answer.effects[1].left, answer.effects[0].left);
  // One law says what the two say.
  ASSERT_EQ(answer.search.alternatives.size(), 1u) << summary(answer);
  const Alternative& one = answer.search.alternatives[0];
  EXPECT_EQ(one.id, "joint_coulomb_asymmetric");
  EXPECT_EQ(one.instead_of[0], 0u);
  EXPECT_EQ(one.instead_of[1], 1u);
  EXPECT_GT(one.probability, 0.05);
  EXPECT_LT(one.probability, 0.95);
  EXPECT_NE(separating_experiment(answer.effects[0].id, one.id).find("drive off"),
            std::string::npos);
}

TEST(DrivenAxis, ALawThatSaysMoreIsNamedWhereTheSearchEndsWithASimplerOne) {
  Question question = axis_question(20.4, -3.2);
  question.max_effects = 1;
  const Answer answer = ask(question);
  ASSERT_EQ(answer.effects.size(), 1u) << summary(answer);
  const FoundEffect& effect = answer.effects[0];
  ASSERT_EQ(effect.id, "joint_coulomb_asymmetric") << summary(answer);
  EXPECT_EQ(answer.search.end, SearchEnd::kFull);
  EXPECT_GT(effect.probability, 0.5) << summary(answer);
  const FoundParameter *forward = find_parameter(effect, "forward"),
                       *backward = find_parameter(effect, "backward");
  ASSERT_TRUE(forward && backward);
  EXPECT_NEAR(forward->value, 20.4 - 3.2, 0.8);
  EXPECT_NEAR(backward->value, 20.4 + 3.2, 0.8);
}

TEST(DrivenAxis, FrictionIsNoPayload) {
  Question question = axis_question(20.4, 0.0);
  question.effects = {"payload"};  // friction also resists motion
  const Answer answer = ask(question);
  EXPECT_EQ(answer.verdict, Verdict::kUnexplained) << summary(answer);
  EXPECT_TRUE(answer.effects.empty()) << summary(answer);
  EXPECT_TRUE(answer.extended.effects.empty());
  EXPECT_EQ(answer.diagnosis.test.after, answer.diagnosis.test.recalibrated);
  EXPECT_EQ(answer.extended.nuisances, answer.recalibrated.nuisances);
}

TEST(DrivenAxis, AFitThatDoesNotCarryOverIsSaidNotTo) {
  // The oil was cold when it was learned from, and warm when it was judged.
  Question question = axis_question(0.0, 0.0);
  question.train = {axis_recording(0.0, 0.0, 1, 400.0)};
  const Answer answer = ask(question);
  EXPECT_EQ(answer.verdict, Verdict::kUnexplained);
  ASSERT_EQ(answer.diagnosis.one_sided.size(), 1u) << summary(answer);
  EXPECT_EQ(answer.diagnosis.one_sided[0].channel, "axis/effort");
  EXPECT_LT(answer.diagnosis.one_sided[0].learned, 1.4);
  EXPECT_GT(answer.diagnosis.one_sided[0].held_out, 2.0);
  ASSERT_FALSE(answer.remarks.empty());
  EXPECT_NE(answer.remarks.back().find("does not hold in the others"), std::string::npos);
}

TEST(DrivenAxis, SaysThatNothingOrdinaryIsFitted) {
  Question question = axis_question(0.0, 0.0);
  question.nuisances.clear();
  question.max_effects = 0;
  question.calibration_file = "empty.yaml";
  Answer answer = ask(question);
  ASSERT_EQ(answer.remarks.size(), 1u);
  EXPECT_EQ(answer.remarks[0].find("empty.yaml: lists no parameters"), 0u) << answer.remarks[0];
  question.calibration_file.clear();
  answer = ask(question);
  ASSERT_EQ(answer.remarks.size(), 1u);
  EXPECT_NE(answer.remarks[0].find("no calibration.yaml beside it"), std::string::npos);
}

TEST(DrivenAxis, NothingIsNamedWhereNothingIsMissing) {
  const Answer answer = ask(axis_question(0.0, 0.0));
  EXPECT_EQ(answer.verdict, Verdict::kNoMissingEffect) << summary(answer);
  EXPECT_TRUE(answer.effects.empty()) << summary(answer);
}

/// Dry friction of some form, first.
bool names_friction(const Answer& answer) {
  return !answer.effects.empty() && (answer.effects[0].id == "joint_coulomb" ||
                                     answer.effects[0].id == "joint_coulomb_asymmetric" ||
                                     answer.effects[0].id == "joint_presliding");
}

TEST(DrivenAxis, WhatIsNamedIsLargerThanWhatIsSaidToShow) {
  const Answer nothing = ask(axis_question(0.0, 0.0));
  const auto friction =
      std::find_if(nothing.detectability.visible.begin(), nothing.detectability.visible.end(),
                   [](const Visibility& v) { return v.id == "joint_coulomb"; });
  ASSERT_NE(friction, nothing.detectability.visible.end());
  const double smallest = friction->smallest_visible;
  const Answer less = ask(axis_question(0.6 * smallest, 0.0));
  EXPECT_EQ(less.verdict, Verdict::kNoMissingEffect) << smallest << "\n" << summary(less);
  const Answer more = ask(axis_question(1.5 * smallest, 0.0));
  ASSERT_EQ(more.verdict, Verdict::kEffectsFound) << smallest << "\n" << summary(more);
  EXPECT_TRUE(names_friction(more)) << summary(more);
}

TEST(DrivenAxis, HalfAsMuchMoreThanWhatIsSaidToShowMostlyDoes) {
  int found = 0, told = 0;
  for (std::uint64_t seed = 10; seed < 22; ++seed) {
    const auto with = [&](double coulomb) {
      Question question = axis_question(coulomb, 0.0);
      question.train = {axis_recording(coulomb, 0.0, seed)};
      question.test = {axis_recording(coulomb, 0.0, seed + 100)};
      return ask(question);
    };
    for (const Visibility& shows : with(0.0).detectability.visible) {
      if (shows.id != "joint_coulomb") continue;
      ++told;
      found += names_friction(with(1.5 * shows.smallest_visible));
    }
  }
  EXPECT_EQ(told, 12);
  EXPECT_GE(found, 0.9 * told);
}

TEST(DrivenAxis, WhatACalibrationMayTakeUpIsNotSaidToShow) {
  Question question = axis_question(0.0, 0.0);
  ASSERT_EQ(question.nuisances.size(), 1u);
  const ModelParameter& viscous = question.nuisances.front();
  const double room = viscous.upper - viscous.initial;
  for (const std::uint64_t seed : {1u, 3u, 5u}) {
    question.train = {axis_recording(0.0, 0.0, seed)};
    const Answer answer = ask(question);
    const auto found =
        std::find_if(answer.detectability.visible.begin(), answer.detectability.visible.end(),
                     [](const Visibility& v) { return v.id == "joint_viscous"; });
    ASSERT_NE(found, answer.detectability.visible.end()) << seed;
    EXPECT_GT(found->smallest_visible, room) << seed;
    EXPECT_LT(found->smallest_visible, 1.1 * room) << seed;
  }
}

TEST(DrivenAxis, SameBitsOnAnyNumberOfThreads) {
  const Question question = axis_question(20.4, 0.0);
  const std::string one = report_json(ask(question, 1), question, 0.0);
  EXPECT_EQ(one, report_json(ask(question, 2), question, 0.0));
}

TEST(Arm, FrictionOfTheElbowIsNamedAmongOtherEffects) {
  const Arm arm;
  const std::vector<EffectInstance> hidden = {
      {"joint_coulomb", "elbow", {{"torque", 0.06}, {"static_ratio", 1.2}}}};
  Question question;
  question.model_file = kConfig + "/anthrob/model_I.yaml";
  question.train = {arm.record(hidden, 1, 1)};
  question.test = {arm.record(hidden, 2, 2)};
  question.repeats = {arm.record(hidden, 1, 3)};
  question.effects = {"joint_coulomb", "cable_drag", "payload", "gravity_tilt",
                      "ball_joint_load_friction"};
  question.max_effects = 1;
  const Answer answer = ask(question);
  ASSERT_EQ(answer.verdict, Verdict::kEffectsFound) << summary(answer);
  EXPECT_EQ(answer.effects[0].id, "joint_coulomb") << summary(answer);
  EXPECT_EQ(answer.effects[0].place, "elbow");
  // A fit along stick and slip ends above what little noise there is here: that lowers it.
  EXPECT_GT(answer.effects[0].probability, 0.3) << summary(answer);
  EXPECT_TRUE(answer.effects[0].rivals.empty()) << summary(answer);
  EXPECT_TRUE(answer.diagnosis.per_channel.count(answer.effects[0].shows_in))
      << answer.effects[0].shows_in;
  EXPECT_LT(answer.effects[0].left, 0.1) << summary(answer);
  EXPECT_LT(answer.diagnosis.test.after, 0.2 * answer.diagnosis.test.recalibrated)
      << summary(answer);
  const FoundParameter* torque = find_parameter(answer.effects[0], "torque");
  ASSERT_NE(torque, nullptr);
  EXPECT_NEAR(torque->value, 0.06, 0.006);
  EXPECT_LT(torque->low, torque->value);
  EXPECT_GT(torque->high, torque->value);
  // The model that was written loads and has the effect.
  const Evaluator evaluator(question.model_file, {}, 0.001, 1);
  const std::string text = model_text(answer, evaluator, question, kConfig + "/anthrob");
  EXPECT_NE(text.find("extends: model_I.yaml"), std::string::npos) << text;
  EXPECT_NE(text.find("joint_coulomb"), std::string::npos);
  const std::string page =
      rendered_page("discovery", report_files(answer, question, 1.0), "report.json");
  EXPECT_NE(page.find("<svg"), std::string::npos);
  EXPECT_EQ(page.find("nan"), std::string::npos);
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
