// What a run of discovery leaves: page, numbers for scripts, extended model.
#include "report/discovery_report.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "anthrob_calib/resume/fingerprint.h"
#include "anthrob_sim/model/robot_model.h"
#include "diagnosis/examples.h"
#include "experiment/evaluator.h"
#include "rendered_page.h"
#include "report/discovery_summary.h"
#include "report/model_text.h"
#include "report/number_text.h"
#include "report/progress.h"

namespace anthrob {
namespace discovery {
namespace {

namespace fs = std::filesystem;

/// The page as users see it: spaces and ends of lines are one space.
std::string report_html(const Answer& answer, const Question& question, double runtime) {
  return rendered_page("discovery", report_files(answer, question, runtime), "report.json");
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

FoundEffect cogging() {
  FoundEffect effect;
  effect.id = "cogging";
  effect.name = "Cogging";
  effect.place = "brachialis";
  effect.probability = 0.9;
  effect.parameters = {{"amplitude", "Nm", 0.005, 0.004, 0.006, false},
                       {"periods", "1", 12.0, 12.0, 12.0, true}};
  return effect;
}

/// Every key of an object, and of objects in it, but for those that are names of data.
void collect(const nlohmann::json& json, std::set<std::string>& keys) {
  if (!json.is_structured()) return;
  for (const auto& [key, value] : json.items()) {
    if (!json.is_array()) keys.insert(key);
    if (key == "options") continue;  // docs/discovery_method.md has them, by a test of its own
    if (key == "parameters" || key == "per_channel") {
      for (const auto& entry : value) collect(entry, keys);
    } else {
      collect(value, keys);
    }
  }
}

TEST(Report, EveryKeyIsDocumented) {
  Answer answer;
  answer.verdict = Verdict::kEffectsFound;
  answer.effects = {cogging()};
  answer.effects[0].parameters[0].undetermined = true;
  answer.effects[0].parameters[0].at_bound = true;
  answer.effects[0].rivals.resize(1);
  answer.effects[0].separating_recording.targets.resize(1);
  answer.diagnosis.where.resize(1);
  answer.search.alternatives.resize(1);
  answer.search.improbable.resize(1);
  answer.search.improbable[0].at_limit = "offset_u";
  answer.search.improbable[0].spoils = "brachialis/position";
  answer.search.refused.emplace();
  answer.search.refused->id = "cogging";
  answer.asked = {"more"};
  answer.remaining.dependences.resize(1);
  answer.remaining.dependences[0].variable = "position",
  answer.remaining.dependences[0].share = 1.0;
  answer.diagnosis.per_channel["brachialis/force"] = {};
  answer.detectability.visible.resize(1);
  answer.detectability.alike = {answer.detectability.visible};
  answer.diagnosis.seams.resize(1);
  SeamGap& seam = answer.diagnosis.seams[0];
  seam.commands = seam.voltages = seam.positions = seam.postures = 1.0;
  answer.diagnosis.regimes.resize(1);
  std::set<std::string> keys;
  collect(nlohmann::json::parse(report_json(answer, {}, 1.0)), keys);
  EXPECT_GT(keys.size(), 60u);
  std::ifstream file(ANTHROB_CONFIG_DIR "/../docs/files.md");
  std::string page(std::istreambuf_iterator<char>(file), {});
  page.erase(0, page.find("## report.json"));
  page.erase(page.find("## result.json"));
  for (const std::string& key : keys) EXPECT_TRUE(holds(page, "`" + key + "`")) << key;
}

TEST(Report, WhatWasNotFittedHasNoInterval) {
  Answer answer;
  answer.verdict = Verdict::kEffectsFound;
  answer.effects = {cogging()};
  const std::string page = report_html(answer, {}, 1.0);
  EXPECT_TRUE(holds(page, "0.004 to 0.006"));
  EXPECT_TRUE(holds(page, "taken as known"));
  EXPECT_FALSE(holds(page, "12 to 12"));
  EXPECT_TRUE(holds(summary(answer), "periods 12, taken as known")) << summary(answer);
  EXPECT_TRUE(holds(summary(answer), "amplitude 0.005 [0.004, 0.006] Nm")) << summary(answer);
  const auto json = nlohmann::json::parse(report_json(answer, {}, 1.0));
  const auto& parameters = json["effects"][0]["parameters"];
  EXPECT_FALSE(parameters["amplitude"].contains("known"));
  EXPECT_EQ(parameters["periods"]["known"], true);
}

TEST(Report, WhatTheRecordingsDoNotDetermineIsSaidInWords) {
  Answer answer;
  answer.verdict = Verdict::kEffectsFound;
  answer.effects = {cogging()};
  FoundParameter& amplitude = answer.effects[0].parameters[0];
  ASSERT_EQ(amplitude.name, "amplitude");
  amplitude.undetermined = true;
  const std::string page = report_html(answer, {}, 1.0);
  EXPECT_TRUE(holds(page, "not determined by these recordings"));
  EXPECT_FALSE(holds(page, "95 % interval not"));
  EXPECT_FALSE(holds(page, "0.004 to 0.006"));
  EXPECT_TRUE(holds(summary(answer), "amplitude 0.005 Nm, not determined by these recordings"))
      << summary(answer);
  const auto json = nlohmann::json::parse(report_json(answer, {}, 1.0));
  EXPECT_EQ(json["effects"][0]["parameters"]["amplitude"]["undetermined"], true);
  EXPECT_FALSE(json["effects"][0]["parameters"]["periods"].contains("undetermined"));
}

TEST(Report, ASizeThatLiesAtTheEndOfItsRangeIsNotUndetermined) {
  Answer answer;
  answer.verdict = Verdict::kEffectsFound;
  answer.effects = {cogging()};
  FoundParameter& amplitude = answer.effects[0].parameters[0];
  amplitude.at_bound = amplitude.low_ends = amplitude.high_ends = true;
  EXPECT_TRUE(holds(report_html(answer, {}, 1.0), "at the end of its range; it may lie beyond"));
  EXPECT_TRUE(holds(summary(answer), "amplitude 0.005 Nm, at the end of its range"))
      << summary(answer);
  const auto json = nlohmann::json::parse(report_json(answer, {}, 1.0));
  EXPECT_EQ(json["effects"][0]["parameters"]["amplitude"]["at_bound"], true);
}

TEST(Report, SizesHaveTheDigitsOfTheirIntervals) {
  FoundParameter gain{"gain", "1", 1.005924, 1.005081, 1.006812};
  EXPECT_EQ(interval_text(gain), "1.0059 [1.0051, 1.0068]");
  gain.value = 0.04212, gain.low = 0.0384, gain.high = 0.0471;
  EXPECT_EQ(interval_text(gain), "0.0421 [0.0384, 0.0471]");
  gain.value = 12345.0, gain.low = 12300.0, gain.high = 12400.0;
  EXPECT_EQ(interval_text(gain), "12345 [12300, 12400]");
  gain.value = gain.low = gain.high = 0.04212;
  EXPECT_EQ(interval_text(gain), "0.0421 [0.0421, 0.0421]");
}

TEST(Report, TheAnswerHasTheSizeThatIsThere) {
  Answer answer;
  answer.verdict = Verdict::kEffectsFound;
  answer.effects = {cogging()};
  answer.effects[0].parameters = {{"forward", "Nm", 0.0, 0.0, 0.008},
                                  {"backward", "Nm", 0.0032, 0.003, 0.0034},
                                  {"width", "rad", 3.0, 2.0, 4.0}};
  EXPECT_TRUE(holds(report_html(answer, {}, 1.0), "(backward 0.0032"));
}

TEST(Report, NumbersAreShortAndHaveNoExponentOfUsualSize) {
  EXPECT_EQ(short_number(0.04212), "0.0421");
  EXPECT_EQ(short_number(999.4), "999");
  EXPECT_EQ(short_number(999.6), "1000");
  EXPECT_EQ(short_number(-26123.4), "-26123");
  EXPECT_EQ(short_number(2.5e8), "2.5e+08");
  EXPECT_EQ(short_number(HUGE_VAL), "unlimited");
  EXPECT_EQ(duration_text(61.4), "61.4 s");
  EXPECT_EQ(duration_text(1040.0), "17 min");
  EXPECT_EQ(duration_text(11520.0), "3.2 h");
}

TEST(Report, CallsNothingCertain) {
  EXPECT_EQ(probability_text(0.934), "probability 0.934");
  EXPECT_EQ(probability_text(1.0), "probability above 0.999");
  EXPECT_EQ(probability_text(0.0), "probability below 0.001");
  Answer answer;
  answer.verdict = Verdict::kEffectsFound;
  answer.effects = {cogging()};
  answer.effects[0].rivals.resize(1);
  EXPECT_TRUE(holds(report_html(answer, {}, 1.0), "These data do not exclude"));
  EXPECT_TRUE(holds(report_html(answer, {}, 1.0), "simulate, control and calibrate with it"));
  // A rival of what is not it either is not something the data leave possible.
  answer.verdict = Verdict::kUnexplained;
  EXPECT_TRUE(holds(report_html(answer, {}, 1.0), "More than that is missing"));
  answer.effects[0].left = 0.4;
  EXPECT_FALSE(holds(report_html(answer, {}, 1.0), "These data do not exclude"));
}

TEST(Report, SaysEitherWhereTwoLawsDoAsWell) {
  Answer answer;
  answer.verdict = Verdict::kEffectsFound;
  answer.effects = {cogging()};
  answer.effects[0].probability = 0.43;
  answer.effects[0].rivals = {{"torque_ripple", "Torque ripple", "brachialis", 0.43}};
  const char* const kEither =
      "one of two effects, which these data cannot tell apart: <b>Cogging</b>";
  EXPECT_TRUE(holds(report_html(answer, {}, 1.0), kEither));
  EXPECT_TRUE(holds(report_html(answer, {}, 1.0), "Or <b>Torque ripple</b> at <b>brachialis</b>"));
  answer.effects[0].rivals[0].probability = 0.1;
  EXPECT_FALSE(holds(report_html(answer, {}, 1.0), kEither));
  answer.effects[0].rivals[0].probability = 0.43;
  answer.effects[0].left = 0.06;  // which has lowered both
  EXPECT_TRUE(holds(report_html(answer, {}, 1.0), kEither));
  answer.effects[0].probability = answer.effects[0].rivals[0].probability = 0.2;
  EXPECT_FALSE(holds(report_html(answer, {}, 1.0), kEither));  // it may well be neither
}

TEST(Report, SaysWhyTheRestHasNoName) {
  Answer answer;
  answer.verdict = Verdict::kUnexplained;
  Question question;
  EXPECT_TRUE(holds(report_html(answer, question, 1.0),
                    "that no law of the catalogue, as fitted here, explains"));
  question.effects = {"payload"};
  std::string page = report_html(answer, question, 1.0);
  EXPECT_TRUE(holds(page, "that no law that --effects lists, as fitted here, explains. "));
  EXPECT_TRUE(holds(page, "Looked for were only the effects that --effects lists: payload."));
  EXPECT_TRUE(holds(page, "Nothing that --effects lists earned its place"));
  EXPECT_TRUE(holds(page, "run again without <code>--effects</code>"));
  EXPECT_FALSE(holds(page, "the law is one that the catalogue lacks"));
  question.max_effects = 1;
  answer.search.end = SearchEnd::kFull;  // by an effect that was improbable at the end
  page = report_html(answer, question, 1.0);
  EXPECT_TRUE(holds(page, "beyond the 1 effect with which --max-effects ended the search"));
  EXPECT_TRUE(holds(page, "run again with a larger <code>--max-effects</code>"));
  EXPECT_TRUE(holds(page, "no further one was looked for"));
  question.max_effects = 0;
  page = report_html(answer, question, 1.0);
  EXPECT_TRUE(holds(page, "no effect was looked for, as --max-effects says"));
  EXPECT_FALSE(holds(page, "earned its place"));
}

TEST(Report, SaysWhereAFitDoesNotCarryOver) {
  Answer answer;
  answer.verdict = Verdict::kUnexplained;
  const char* const kNot = "What was learned does not carry over: axis/effort (0.8 floors";
  EXPECT_FALSE(holds(report_html(answer, {}, 1.0), "carry over"));
  answer.diagnosis.one_sided = {{"axis/effort", 0.8, 27.5}};
  std::string page = report_html(answer, {}, 1.0);
  EXPECT_TRUE(holds(page, kNot));
  EXPECT_TRUE(holds(page, "The recordings that were fitted and the held-out ones differ"));
  answer.remaining.certain = true;
  page = report_html(answer, {}, 1.0);
  EXPECT_TRUE(holds(page, kNot));
  EXPECT_TRUE(holds(page, "Something is missing that no law of the catalogue"));
  answer.verdict = Verdict::kEffectsFound;
  answer.effects = {cogging()};
  EXPECT_TRUE(holds(report_html(answer, {}, 1.0), kNot));
}

TEST(Report, SaysWhereAnIntervalEndsWithItsRange) {
  Answer answer;
  answer.verdict = Verdict::kEffectsFound;
  answer.effects = {cogging()};
  answer.effects[0].parameters[0].high_ends = true;
  EXPECT_TRUE(holds(report_html(answer, {}, 1.0), ", where its range ends"));
  EXPECT_TRUE(holds(summary(answer), ", where its range ends"));
  const auto json = nlohmann::json::parse(report_json(answer, {}, 1.0));
  EXPECT_EQ(json["effects"][0]["parameters"].begin().value().count("high_ends"), 1u);
  EXPECT_EQ(json["effects"][0]["parameters"].begin().value().count("low_ends"), 0u);
}

TEST(Report, TellsWhatTheLoopRecordedAlsoWhereNothingIsNamed) {
  Answer answer;
  answer.verdict = Verdict::kNoMissingEffect;
  answer.asked = {"recorded what tells cogging from ripple"};
  EXPECT_TRUE(holds(report_html(answer, {}, 1.0),
                    "Asked after an earlier search: recorded what tells cogging"));
  answer.effects = {cogging()};
  EXPECT_TRUE(holds(report_html(answer, {}, 1.0),
                    "Asked after an earlier search: recorded what tells cogging"));
}

TEST(Report, ClaimsNoMoreThanWasFound) {
  Answer answer;
  answer.verdict = Verdict::kNoMissingEffect;
  answer.diagnosis.per_channel["elbow/position"] = {2.0, 1.6, 1.6, 1.0};
  answer.diagnosis.per_channel["brachialis/force"] = {1.1, 1.1, 1.1, 1.0};
  std::string page = report_html(answer, {}, 1.0);
  EXPECT_TRUE(holds(page, "no channel with a certain gap"));
  EXPECT_FALSE(holds(page, "no missing effect<"));
  EXPECT_TRUE(holds(page, "but not certain: elbow/position (1.6).")) << page;
  EXPECT_TRUE(holds(page, "held-out recordings</th>"));

  answer.verdict = Verdict::kEffectsFound;
  answer.effects = {cogging()};
  answer.diagnosis.test.recalibrated = 3.0;
  answer.diagnosis.test.after = 1.2;
  page = report_html(answer, {}, 1.0);
  EXPECT_TRUE(holds(page, "The model misses: <b>Cogging</b>"));
  EXPECT_FALSE(holds(page, "improbable"));
  EXPECT_TRUE(holds(page, "With it, the held-out gap falls from 3 to 1.2"));
  answer.effects.push_back(cogging());
  answer.effects[1].probability = 0.3;
  answer.effects[1].name = "Ripple";
  answer.diagnosis.test.after = 3.1;
  page = report_html(answer, {}, 1.0);
  EXPECT_TRUE(holds(page, "The model misses: <b>Cogging</b>"));
  EXPECT_TRUE(holds(page, "The model misses this or something similar: <b>Ripple</b>"));
  EXPECT_TRUE(holds(page, "With them, the held-out gap does not fall: it goes from 3 to 3.1"));
}

TEST(Report, TellsWhatIsTooImprobableToBeAdded) {
  Answer answer;
  answer.verdict = Verdict::kUnexplained;
  answer.search.improbable = {
      {"payload", "Payload", "forearm", 0.03, 200.0, "biceps_brachii/force", 0.4, "", ""}};
  const char* const kImprobableLaw =
      "Tried, but too improbable to be added: Payload at forearm, probability 0.03, "
      "which leaves 40 % of the squared gap of biceps_brachii/force.";
  const std::string page = report_html(answer, {}, 1.0);
  EXPECT_TRUE(holds(page, kImprobableLaw));
  EXPECT_TRUE(holds(page, "Nothing in the catalogue is probable enough"));
  answer.verdict = Verdict::kNoMissingEffect;
  EXPECT_TRUE(holds(report_html(answer, {}, 1.0), kImprobableLaw));
  answer.verdict = Verdict::kEffectsFound;
  answer.effects = {cogging()};
  EXPECT_TRUE(holds(report_html(answer, {}, 1.0), kImprobableLaw));
  EXPECT_TRUE(holds(summary(answer), "too improbable to be added: payload @ forearm"));
  const auto json = nlohmann::json::parse(report_json(answer, {}, 1.0));
  ASSERT_EQ(json["improbable"].size(), 1u);
  EXPECT_EQ(json["improbable"][0]["id"], "payload");
  EXPECT_EQ(json["improbable"][0]["left"], 0.4);
}

TEST(Report, TellsOfAShapeAtTheEndOfItsRange) {
  Answer answer;
  answer.verdict = Verdict::kEffectsFound;
  answer.effects = {cogging()};
  EXPECT_FALSE(holds(report_html(answer, {}, 1.0), "end of its range"));
  EXPECT_FALSE(
      nlohmann::json::parse(report_json(answer, {}, 1.0))["effects"][0].contains("at_limit"));
  answer.effects[0].at_limit = "offset_u";
  answer.search.improbable.resize(1);
  answer.search.improbable[0].at_limit = "offset_v";
  const std::string page = report_html(answer, {}, 1.0);
  EXPECT_TRUE(holds(page, "with offset_u at the end of its range"));
  EXPECT_TRUE(holds(page, "with offset_v at the end of its range"));
  EXPECT_EQ(nlohmann::json::parse(report_json(answer, {}, 1.0))["effects"][0]["at_limit"],
            "offset_u");
}

TEST(Report, TellsOfAChannelThatALawSpoils) {
  Answer answer;
  answer.verdict = Verdict::kEffectsFound;
  answer.effects = {cogging()};
  EXPECT_FALSE(holds(report_html(answer, {}, 1.0), "clearly worse"));
  EXPECT_FALSE(
      nlohmann::json::parse(report_json(answer, {}, 1.0))["effects"][0].contains("spoils"));
  answer.effects[0].spoils = "brachialis/position";
  answer.effects[0].spoilt = 0.01;
  answer.search.improbable.resize(1);
  answer.search.improbable[0].at_limit = "offset_v";
  answer.search.improbable[0].spoils = "triceps_brachii/position";
  const std::string page = report_html(answer, {}, 1.0);
  EXPECT_TRUE(holds(page, "with brachialis/position clearly worse than without it, which"));
  EXPECT_TRUE(holds(page, "with offset_v at the end of its range and triceps_brachii/position "));
  const auto json = nlohmann::json::parse(report_json(answer, {}, 1.0));
  EXPECT_EQ(json["effects"][0]["spoils"], "brachialis/position");
  EXPECT_EQ(json["effects"][0]["spoilt"], 0.01);
  EXPECT_EQ(json["improbable"][0]["spoils"], "triceps_brachii/position");
}

TEST(Report, TellsWhatTheNamedLawLeavesAndWhatItMakesWorse) {
  Answer answer;
  answer.verdict = Verdict::kEffectsFound;
  answer.effects = {cogging()};
  answer.effects[0].shows_in = "biceps_brachii/current";
  answer.effects[0].left = 0.02;
  answer.diagnosis.per_channel["elbow/position"] = {2.0, 1.3, 1.4, 1.0};
  answer.diagnosis.per_channel["brachialis/force"] = {1.1, 0.7, 0.9, 1.0};
  std::string page = report_html(answer, {}, 1.0);
  EXPECT_TRUE(
      holds(page, "shows most in biceps_brachii/current and leaves 2 % of the squared gap"));
  EXPECT_FALSE(holds(page, "another law may be at work"));
  EXPECT_TRUE(holds(page, "worse and above the floor: elbow/position (1.3 to 1.4).")) << page;
  answer.diagnosis.growth["elbow/position"] = 2.0;
  EXPECT_TRUE(holds(report_html(answer, {}, 1.0), "position (1.3 to 1.4, maybe by chance)."));
  answer.diagnosis.growth["elbow/position"] = 4.0;
  EXPECT_TRUE(holds(report_html(answer, {}, 1.0), "position (1.3 to 1.4, not by chance)."));
  EXPECT_EQ(nlohmann::json::parse(
                report_json(answer, {}, 1.0))["gap"]["per_channel"]["elbow/position"]["growth"],
            4.0);
  answer.effects[0].left = 0.2;
  answer.diagnosis.per_channel["elbow/position"].after = 1.2;
  page = report_html(answer, {}, 1.0);
  EXPECT_TRUE(holds(page, "leaves 20 % of the squared gap there: another law may be"));
  EXPECT_FALSE(holds(page, "these channels are more than 5 % worse"));
  const auto effect = nlohmann::json::parse(report_json(answer, {}, 1.0))["effects"][0];
  EXPECT_EQ(effect["shows_in"], "biceps_brachii/current");
  EXPECT_EQ(effect["left"], 0.2);
}

TEST(Report, SaysWhatWasAskedForWouldHaveShown) {
  Question question;
  EXPECT_TRUE(
      holds(report_html({}, question, 1.0), "Everything in the catalogue would have shown"));
  question.effects = {"payload"};
  EXPECT_TRUE(
      holds(report_html({}, question, 1.0), "Everything that --effects asks for would have shown"));
}

TEST(Report, SeamsThatGrowAreNotRed) {
  const std::string grey = "<td style=\"background:#eeeeee\">";
  Answer answer;
  answer.diagnosis.seams = {{"elbow", "position", true, 4.0, 6.0, 3.0, {}}};
  std::string page = report_html(answer, {}, 1.0);
  EXPECT_TRUE(holds(page, grey + "6</td>"));
  EXPECT_FALSE(holds(page, grey + "4</td>"));
  EXPECT_FALSE(holds(page, grey + "3</td>"));
  answer.diagnosis.seams = {{"elbow", "position", true, 4.0, {}, 5.0, {}}};  // no voltages
  page = report_html(answer, {}, 1.0);
  EXPECT_TRUE(holds(page, grey + "5</td>"));
  answer.diagnosis.seams = {{"triceps_brachii", "force", false, 2.0, 1.9, 10.6, 10.2}};
  page = report_html(answer, {}, 1.0);
  EXPECT_TRUE(holds(page, grey + "10.6</td>"));
  EXPECT_TRUE(holds(page, grey + "10.2</td>"));  // still far above what it was
  answer.diagnosis.seams = {{"triceps_brachii", "force", false, 9.5, 5.2, 10.5, 16.1}};
  page = report_html(answer, {}, 1.0);
  EXPECT_TRUE(holds(page, grey + "10.5</td>"));
  EXPECT_FALSE(holds(page, grey + "16.1</td>"));  // natural
  answer.diagnosis.seams[0].postures = 19.5;
  EXPECT_TRUE(holds(report_html(answer, {}, 1.0), grey + "19.5</td>"));
}

TEST(Report, ExplainsItsWords) {
  const std::string page = report_html({}, {}, 1.0);
  for (const char* word : {"floor", "recalibrated", "share", "significance", "nat"}) {
    EXPECT_TRUE(holds(page, "<li>" + std::string(word) + ": ")) << word;
  }
  // Where something was named, less counts.
  EXPECT_TRUE(holds(page, "(1.4 floors)"));
  Answer answer;
  answer.verdict = Verdict::kEffectsFound;
  answer.effects = {cogging()};
  EXPECT_TRUE(holds(report_html(answer, {}, 1.0), "(1.15 floors)"));
}

TEST(Report, HasTheRemarksOnRecordings) {
  Answer answer;
  answer.remarks = {"run_3: has the same commands as run_1"};
  EXPECT_TRUE(holds(report_html(answer, {}, 1.0), answer.remarks[0]));
  EXPECT_EQ(nlohmann::json::parse(report_json(answer, {}, 1.0))["remarks"][0], answer.remarks[0]);
}

/// A ball joint, measured in one bin.
class Turn final : public Experiment {
 public:
  Turn() {
    for (int i = 0; i < 3; ++i) {
      channels_.push_back({"shoulder", "orientation", "rad", i, static_cast<std::size_t>(i), 1});
    }
    present_.assign(3, 1);
    bin_ = duration_ = 0.02;
  }
  void compare(const std::shared_ptr<const RobotModel>&, const Starts&, float*) const override {}
};

TEST(Examples, OfABallJointShowTheComponentThatChangesMost) {
  Eigen::VectorXf recalibrated(3), after(3);
  recalibrated << 0.1f, 0.2f, 0.4f;
  after << 0.1f, 0.0f, 0.3f;
  const std::map<std::string, Gap> gaps = {{"shoulder/orientation", {1.0, 2.0, 1.0, 1.0}}};
  const Eigen::VectorXf ones = Eigen::VectorXf::Ones(3);
  const auto changed = examples_of(Turn(), Dataset{}, ones, recalibrated, after, gaps, 3);
  ASSERT_EQ(changed.size(), 1u);
  EXPECT_EQ(changed[0].channel, "shoulder/orientation/y");
  ASSERT_EQ(changed[0].after.size(), 1u);
  EXPECT_FLOAT_EQ(changed[0].recalibrated[0], 0.2f);
  const auto still = examples_of(Turn(), Dataset{}, ones, recalibrated, recalibrated, gaps, 3);
  EXPECT_EQ(still.at(0).channel, "shoulder/orientation/z");  // the largest gap
}

TEST(ProgressText, TellsWhatIsLeftOnlyOfALongBatch) {
  EXPECT_EQ(progress_text(75.0, 40, {1, 2, 3.0}), "75 s, 40 simulations");
  EXPECT_EQ(progress_text(75.0, 40, {30, 120, 10.0}),
            "75 s, 40 simulations; current batch: 30 of 120, 30 s left");
  EXPECT_EQ(progress_text(75.0, 40, {120, 120, 10.0}), "75 s, 40 simulations");
}

TEST(Report, SaysThatTheSearchEndedAtItsCap) {
  const std::string said = "ended with the 1 effect that --max-effects allows";
  Answer answer;
  answer.verdict = Verdict::kEffectsFound;
  answer.effects = {cogging()};
  Question question;
  EXPECT_FALSE(holds(report_html(answer, question, 1.0), "--max-effects"));
  EXPECT_TRUE(nlohmann::json::parse(report_json(answer, question, 1.0))["remarks"].empty());
  question.max_effects = 1;
  answer.search.end = SearchEnd::kFull;
  EXPECT_TRUE(holds(report_html(answer, question, 1.0), said));
  const auto json = nlohmann::json::parse(report_json(answer, question, 1.0));
  ASSERT_EQ(json["remarks"].size(), 1u);
  EXPECT_TRUE(holds(json["remarks"][0], said)) << json["remarks"];
  question.max_effects = 3;
  answer.search.end = SearchEnd::kNoMore;
  answer.search.end = SearchEnd::kRounds;
  EXPECT_TRUE(holds(report_html(answer, question, 1.0), "the rounds that --max-effects 3 allows"));
}

TEST(Report, ShowsDependencesOfWhatDisagrees) {
  Answer answer;
  answer.verdict = Verdict::kNoMissingEffect;
  Dependence dependence;
  dependence.channel = "elbow/position";
  dependence.variable = "elbow/velocity";
  dependence.word = "sign of velocity";
  dependence.share = 0.5;
  dependence.curve = {{-1.0, 1.0}, {0.1, 0.2}, {0.1, 0.2}};
  answer.diagnosis.dependences = {dependence};
  EXPECT_FALSE(holds(report_html(answer, {}, 1.0), "depends on sign of velocity"));
  Place place;
  place.place = "elbow";
  place.channel = "position";
  answer.diagnosis.where = {place};
  EXPECT_TRUE(holds(report_html(answer, {}, 1.0), "depends on sign of velocity"));
}

Dependence dependence(const std::string& channel, double share) {
  Dependence d;
  d.channel = channel;
  d.unit = "N";
  d.variable = "elbow/position";
  d.variable_unit = "rad";
  d.word = "posture";
  d.share = share;
  d.curve = {{-1.0, 1.0}, {0.1, 0.2}, {0.1, 0.2}};
  return d;
}

TEST(Report, ShowsFirstWhatExplainsMostOfTheGap) {
  Answer answer;
  answer.verdict = Verdict::kNoMissingEffect;
  // The second predicts more of its own channel, which has little of the gap.
  answer.diagnosis.dependences = {dependence("biceps_brachii/force", 0.9),
                                  dependence("brachialis/force", 0.6)};
  Place much, little;
  much.place = "brachialis", little.place = "biceps_brachii";
  much.channel = little.channel = "force";
  much.share = 0.8, little.share = 0.2;
  answer.diagnosis.where = {much, little};
  const std::string page = report_html(answer, {}, 1.0);
  const std::size_t first = page.find("brachialis/force depends on posture"),
                    second = page.find("biceps_brachii/force depends on posture");
  ASSERT_NE(first, std::string::npos);
  ASSERT_NE(second, std::string::npos);
  EXPECT_LT(first, second);
  EXPECT_TRUE(holds(page, "elbow/position [rad] (posture)"));
  EXPECT_TRUE(holds(page, "simulated minus measured [N]"));
}

TEST(Report, ShowsACurveForEachRangeOfASecondQuantity) {
  Dependence d = dependence("brachialis/force", 0.4);
  Dependence::Branch low, high;
  low.at = high.at = {-1.0, 1.0};
  low.mean = low.error = {0.1, 0.2};
  high.mean = high.error = {0.3, 0.6};
  low.second = 12.5, high.second = 37.5;
  d.second = Dependence::Second{"brachialis/force", "N", "load", 0.7, {low, high}};
  Answer answer;
  answer.verdict = Verdict::kUnexplained;
  answer.remaining.dependences = {d};
  const std::string page = report_html(answer, {}, 1.0);
  EXPECT_TRUE(holds(page, "brachialis/force depends on posture and load"));
  EXPECT_TRUE(holds(page, "load 12.5\u00a0N"));
  EXPECT_TRUE(holds(page, "load 37.5\u00a0N"));
  EXPECT_TRUE(holds(page, "70 % of the squared gap"));
  EXPECT_TRUE(holds(page, "one for all would predict 40 %"));
  const auto json = nlohmann::json::parse(report_json(answer, {}, 1.0));
  const auto& second = json["remaining"]["dependences"][0]["second"];
  EXPECT_EQ(second["variable"], "brachialis/force");
  EXPECT_EQ(second["how"], "load");
  EXPECT_EQ(second["share"], 0.7);
  ASSERT_EQ(second["curves"].size(), 2u);
  EXPECT_EQ(second["curves"][1]["second"], 37.5);
  EXPECT_EQ(second["curves"][1]["curve"], (std::vector<double>{0.3, 0.6}));
  answer.remaining.dependences[0].second->word = "posture";
  EXPECT_FALSE(holds(report_html(answer, {}, 1.0), "posture and posture"));
}

TEST(Report, TellsWhatWasAsked) {
  Question question;
  question.model_file = "model_I.yaml";
  question.train.resize(1);
  question.train[0].folder = "run_1";
  question.repeats.resize(1);
  question.repeats[0].folder = "run_1_again";
  const auto json = nlohmann::json::parse(report_json({}, question, 1.0));
  EXPECT_EQ(json["question"]["model"], "model_I.yaml");
  EXPECT_EQ(json["question"]["train"][0], "run_1");
  EXPECT_EQ(json["question"]["repeat"][0], "run_1_again");
  EXPECT_TRUE(json["question"]["calibration"].is_null());
  EXPECT_TRUE(json["question"]["close_the_loop"].is_null());
  EXPECT_TRUE(json["question"]["fingerprints"]["model"].is_null());
}

Dataset ramp(double slope) {
  Dataset recording;
  recording.folder = "run_1";
  Table& table = recording.table("muscles");
  Column& column = table.column("brachialis/position");
  for (int i = 0; i < 5; ++i) {
    table.t.push_back(1000000 * i);
    column.values.push_back(slope * i);
    column.present.push_back(1);
  }
  return recording;
}

Question full_question() {
  Question question;
  question.train = {ramp(1.0)};
  question.test = {ramp(2.0)};
  question.calibration_file = "arm/calibration.yaml";
  question.simulated_robot_file = "arm/robot.yaml";
  question.model_fingerprint = 0xabc;
  return question;
}

TEST(Report, TellsWithWhatItCanBeAskedAgain) {
  Question question = full_question();
  question.nuisances.resize(3);
  const auto asked = [&] {
    return nlohmann::json::parse(report_json({}, question, 1.0))["question"];
  };
  const auto json = asked();
  EXPECT_EQ(json["calibration"], "arm/calibration.yaml");
  EXPECT_EQ(json["close_the_loop"], "arm/robot.yaml");
  EXPECT_EQ(json["ordinary_parameters"], 3);
  const auto& fingerprints = json["fingerprints"];
  EXPECT_EQ(fingerprints["model"], "0000000000000abc");
  ASSERT_EQ(fingerprints["train"].size(), 1u);
  ASSERT_EQ(fingerprints["test"].size(), 1u);
  EXPECT_TRUE(fingerprints["repeat"].empty());
  EXPECT_EQ(fingerprints["train"][0],
            resume::fingerprint_text(resume::content_fingerprint(ramp(1.0))));
  EXPECT_NE(fingerprints["train"][0], fingerprints["test"][0]);
  // They are of the samples, whatever the recording is called.
  question.train[0].folder = "a_copy";
  EXPECT_EQ(asked()["fingerprints"], fingerprints);
  question.train[0].table("muscles").columns[0].values[2] += 1e-9;
  EXPECT_NE(asked()["fingerprints"]["train"], fingerprints["train"]);
}

TEST(ModelText, TellsWhatWasAsked) {
  Question question = full_question();
  question.model_file = ANTHROB_CONFIG_DIR "/driven_axis/model_I.yaml";
  const Evaluator evaluator(question.model_file, {}, 0.001, 1);
  const std::string text = model_text({}, evaluator, question, ".");
  EXPECT_TRUE(holds(
      text, "# Training recordings: run_1 (fingerprint " +
                resume::fingerprint_text(resume::content_fingerprint(question.train[0])) + ")\n"))
      << text;
  EXPECT_TRUE(holds(text, "# Fingerprint of the examined model: 0000000000000abc.\n")) << text;
  EXPECT_TRUE(holds(text, "# Ordinary parameters: 0, listed by arm/calibration.yaml.\n")) << text;
  EXPECT_TRUE(holds(text, " --close-the-loop arm/robot.yaml.\n")) << text;
}

TEST(ModelText, CanBeLoadedWhereTheModelHasEffectsThatMayBeCorrected) {
  const fs::path folder =
      fs::temp_directory_path() / ("anthrob_model_text_" + std::to_string(getpid()));
  fs::create_directories(folder);
  Question question;
  question.model_file = (folder / "model_found.yaml").string();
  std::ofstream(question.model_file)
      << "extends: " << ANTHROB_CONFIG_DIR << "/driven_axis/model_I.yaml\n"
      << "effects:\n  - {id: joint_offset_torque, place: axis, torque: 2.0}\n"
      << "  - {id: joint_coulomb, place: axis, torque: 5.0}\n";
  question.nuisances = read_parameters(
      ConfigNode::parse("- {path: effects.1.torque, unit: N, range: 4, step: 1}", "list"),
      ConfigNode::load(question.model_file));
  const Evaluator evaluator(question.model_file, question.nuisances, 0.001, 1);
  Answer answer;
  answer.extended.nuisances = {7.0};
  const std::string file = (folder / "model.yaml").string();
  std::ofstream(file) << model_text(answer, evaluator, question, folder.string());
  const auto model = load_robot_model(file);
  ASSERT_EQ(model->effects.size(), 2u);
  for (const EffectInstance& effect : model->effects) {
    EXPECT_EQ(effect.parameters.at("torque"), effect.id == "joint_coulomb" ? 7.0 : 2.0);
  }
  fs::remove_all(folder);
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
