// The program that compares reports of discovery with sealed truths, on answers made up here.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using List = std::vector<Json>;

Json hidden(const std::string& id, const std::string& place, double size) {
  return {{"id", id}, {"place", place}, {"parameters", {{"mu", size}}}, {"sizes", {"mu"}}};
}

Json named(const std::string& id, const std::string& place, double value, double low, double high) {
  return {{"id", id},
          {"place", place},
          {"probability", 0.97},
          {"parameters", {{"mu", {{"value", value}, {"ci95", {low, high}}}}}}};
}

class Score : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_ / "sealed"); }
  void TearDown() override { fs::remove_all(folder_); }

  void truth(const std::string& name, const std::string& kind, const List& effects,
             double floors = 5.0) const {
    std::ofstream(folder_ / "sealed" / (name + ".json"))
        << Json{{"kind", kind}, {"effects", effects}, {"change", {{"floors", floors}}}};
  }
  void report(const std::string& name, const std::string& verdict, const List& effects = {},
              const List& not_visible = {}, const List& visible = {}, const Json& gap = nullptr,
              const List& alternatives = {}) const {
    fs::create_directories(folder_ / "reports" / name);
    std::ofstream(folder_ / "reports" / name / "report.json")
        << Json{{"verdict", verdict}, {"effects", effects}, {"not_visible", not_visible},
                {"visible", visible}, {"gap", gap},         {"alternatives", alternatives}};
  }
  void failed(const std::string& name) const {
    fs::create_directories(folder_ / "reports" / name);
    std::ofstream(folder_ / "reports" / name / "failed") << "";
  }
  Json score() const {
    const std::string at = folder_.string();
    const std::string command = std::string(ANTHROB_SCORE) + " --truths " + at +
                                "/sealed --reports " + at + "/reports --out " + at +
                                "/score.json >" + at + "/log 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << std::ifstream(at + "/log").rdbuf();
    return Json::parse(std::ifstream(at + "/score.json"));
  }
  static double rate(const Json& score, const std::string& label, const std::string& what) {
    for (const Json& row : score["rates"]) {
      if (row["label"] == label) return row[what].get<double>();
    }
    ADD_FAILURE() << "no row " << label;
    return -1.0;
  }

  const fs::path folder_ =
      fs::temp_directory_path() / ("anthrob_score_" + std::to_string(getpid()));
};

TEST_F(Score, OfEffects) {
  const List rubbing = {hidden("eyelet_friction", "biceps_brachii", 0.1)};
  for (const char* name : {"right", "elsewhere", "unsure", "late", "crashed", "unasked", "unseen",
                           "smaller", "overlooked"}) {
    truth(name, "effect", rubbing, std::string(name) == "unseen" ? 2.0 : 5.0);
  }
  const Json good = named("eyelet_friction", "biceps_brachii/2", 0.11, 0.09, 0.13);
  report("right", "effects_found", {good});
  report("elsewhere", "effects_found", {named("eyelet_friction", "brachialis", 0.13, 0.12, 0.14)});
  report("unsure", "unexplained", {good});
  report("late", "effects_found", {named("joint_coulomb", "elbow", 1.0, 0.0, 2.0), good});
  failed("crashed");
  const auto invisible = [](double size) {
    return Json{
        {{"id", "eyelet_friction"}, {"place", "biceps_brachii"}, {"smallest_visible", size}}};
  };
  report("unseen", "no_missing_effect", {}, invisible(0.2));
  report("smaller", "no_missing_effect", {}, {}, invisible(0.2));  // a larger one would have shown
  report("overlooked", "no_missing_effect", {}, {}, invisible(0.05));
  const Json result = score();
  EXPECT_EQ(result["effect"]["cases"], 6);  // "unasked" has no folder, two could not be seen
  EXPECT_EQ(result["effect"]["said_invisible"], 2);
  EXPECT_EQ(result["effect"]["first"], 2);
  EXPECT_EQ(result["effect"]["right_place"], 1);
  EXPECT_EQ(rate(result, "covered by ci95", "hits"), 1);
  EXPECT_NEAR(rate(result, "parameter error [%]", "median"), 10.0, 1e-9);  // there, not elsewhere
  EXPECT_EQ(rate(result, "below 3 floors", "hits"), 1);
}

TEST_F(Score, AClassMayHoldTheRightPlace) {
  truth("same_law", "effect", {hidden("eyelet_friction", "biceps_brachii", 0.1)});
  Json unsure = named("eyelet_friction", "brachialis", 0.13, 0.12, 0.14);
  const auto rival = [](const std::string& id, const std::string& place) {
    return Json{{"id", id}, {"place", place}, {"probability", 0.4}};
  };
  unsure["rivals"] = List{rival("eyelet_friction", "triceps_brachii"),
                          rival("eyelet_friction", "biceps_brachii/2")};
  report("same_law", "effects_found", {unsure});
  Json result = score();
  EXPECT_EQ(result["effect"]["in_class"], 1);
  EXPECT_EQ(result["effect"]["right_place"], 1);
  unsure["rivals"].push_back(rival("joint_coulomb", "elbow"));  // no class any more
  report("same_law", "effects_found", {unsure});
  result = score();
  EXPECT_EQ(result["effect"]["first"], 1);
  EXPECT_EQ(result["effect"]["right_place"], 0);
}

TEST_F(Score, WhatDoesNotShowAtOneSegmentIsNoExcuseForTheMuscle) {
  const auto entry = [](const std::string& place, const Json& smallest) {
    return Json{{"id", "eyelet_friction"}, {"place", place}, {"smallest_visible", smallest}};
  };
  const Json nowhere = entry("biceps_brachii/3", nullptr),
             from_little = entry("biceps_brachii/4", 0.05);
  for (const char* name : {"whole", "segments", "nowhere"}) {
    truth(name, "effect", {hidden("eyelet_friction", "biceps_brachii", 0.1)});
  }
  report("whole", "no_missing_effect", {}, {nowhere}, {from_little, entry("biceps_brachii", 0.05)});
  report("segments", "no_missing_effect", {}, {nowhere}, {from_little});
  report("nowhere", "no_missing_effect", {}, {nowhere, entry("biceps_brachii/4", nullptr)});
  const Json result = score();
  EXPECT_EQ(result["effect"]["cases"], 2);
  EXPECT_EQ(result["effect"]["said_invisible"], 1);
}

TEST_F(Score, SizesOfSeveralUnitsAreEachMeasuredByTheirOwn) {
  const auto sized = [](const Json& values, const Json& sizes) {
    return Json{{"id", "x"}, {"place", "elbow"}, {"parameters", values}, {"sizes", sizes}};
  };
  const auto answer = [](const std::string& first, double a, const std::string& second, double b) {
    const auto number = [](double value) {
      return Json{{"value", value}, {"ci95", List{value - 1.0, value + 1.0}}};
    };
    return Json{
        {"id", "x"}, {"place", "elbow"}, {"parameters", {{first, number(a)}, {second, number(b)}}}};
  };
  truth("offset", "effect", {sized({{"offset", 2.0}, {"drift", 0.02}}, {"offset", "drift"})});
  report("offset", "effects_found", {answer("offset", 2.0, "drift", 0.03)});
  EXPECT_NEAR(rate(score(), "parameter error [%]", "median"), 25.0, 1e-9);  // of 0 and 50
  truth("offset", "effect",
        {sized({{"sine", 0.03}, {"cosine", 0.04}}, {"sine", "cosine"})});  // one vector of 0.05
  report("offset", "effects_found", {answer("sine", 0.03, "cosine", 0.05)});
  EXPECT_NEAR(rate(score(), "parameter error [%]", "median"), 10.0, 1e-9);  // of 0 and 20
}

TEST_F(Score, WhatWouldShowIsComparedWithTheSizeOfItsUnit) {
  const auto drift = [](double rate, double missed) {
    return List{{{"id", "encoder_drift"},
                 {"place", "brachialis"},
                 {"parameters", {{"rate", rate}, {"missed", missed}}},
                 {"sizes", {"rate", "missed"}}}};
  };
  const List shows = {{{"id", "encoder_drift"},
                       {"place", "brachialis"},
                       {"smallest_visible", 0.004},
                       {"unit", "1"}}};
  truth("little_missed", "effect", drift(0.0, 0.003));
  truth("much_missed", "effect", drift(0.0, 0.005));
  truth("of_the_other", "effect", drift(0.003, 0.0));  // [rad/s]
  for (const char* name : {"little_missed", "much_missed", "of_the_other"}) {
    report(name, "no_missing_effect", {}, {}, shows);
  }
  const Json result = score();
  EXPECT_EQ(result["effect"]["said_invisible"], 1);
  EXPECT_EQ(rate(result, "correct", "count"), 2.0);
  EXPECT_EQ(rate(result, "of all, invisible too", "count"), 3.0);
}

TEST_F(Score, ReportsThatAreNowhereAreNoAnswers) {
  truth("nothing", "null", {}, 0.0);
  const std::string at = folder_.string();
  const std::string command = std::string(ANTHROB_SCORE) + " --truths " + at +
                              "/sealed --reports " + at + "/misspelt >" + at + "/log 2>&1";
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 2);
  std::ifstream log(at + "/log");
  const std::string said{std::istreambuf_iterator<char>(log), {}};
  EXPECT_EQ(said, "anthrob_score: " + at +
                      "/misspelt: no such folder; expected one that holds NAME/report.json\n");
}

TEST_F(Score, AMedianHasAnInterval) {
  for (int i = 0; i < 20; ++i) {
    const std::string name = "case_" + std::to_string(i);
    truth(name, "effect", {hidden("eyelet_friction", "brachialis", 0.1)});
    report(name, "effects_found",
           {named("eyelet_friction", "brachialis", 0.1 + 0.001 * (i + 1), 0.0, 1.0)});
  }
  const Json result = score();
  for (const Json& row : result["rates"]) {
    if (row["label"] != "parameter error [%]") continue;
    // Errors of 1, 2 ... 20 %: the 6th and the 15th, as tables of the sign test have them.
    EXPECT_NEAR(row["interval"][0].get<double>(), 6.0, 1e-9);
    EXPECT_NEAR(row["interval"][1].get<double>(), 15.0, 1e-9);
    return;
  }
  FAIL() << "no row";
}

TEST_F(Score, ASizeThatIsNotToldIsMissed) {
  truth("silent", "effect", {hidden("eyelet_friction", "brachialis", 0.1)});
  report("silent", "effects_found",
         {Json{{"id", "eyelet_friction"}, {"place", "brachialis"}, {"parameters", nullptr}}});
  const Json result = score();
  EXPECT_EQ(rate(result, "covered by ci95", "hits"), 0.0);
  EXPECT_EQ(rate(result, "covered by ci95", "count"), 1.0);
  EXPECT_NEAR(rate(result, "parameter error [%]", "median"), 100.0, 1e-9);
}

TEST_F(Score, OneLawInsteadOfTwoIsInTheClassOfBoth) {
  const auto alone = [](double probability, const std::string& place) {
    return List{{{"id", "joint_coulomb_asymmetric"},
                 {"place", place},
                 {"probability", probability},
                 {"instead_of", List{{{"id", "joint_coulomb"}, {"place", place}},
                                     {{"id", "joint_offset_torque"}, {"place", place}}}}}};
  };
  const List two = {named("joint_coulomb", "elbow", 1.0, 0.0, 2.0),
                    named("joint_offset_torque", "elbow", 1.0, 0.0, 2.0)};
  for (const char* name : {"even", "unlikely", "of_others"}) {
    truth(name, "effect", {hidden("joint_coulomb_asymmetric", "elbow", 1.0)});
  }
  report("even", "effects_found", two, {}, {}, nullptr, alone(0.5, "elbow"));
  report("unlikely", "effects_found", two, {}, {}, nullptr, alone(0.03, "elbow"));
  report("of_others", "effects_found", two, {}, {}, nullptr, alone(0.5, "wrist"));
  const Json result = score();
  EXPECT_EQ(result["effect"]["cases"], 3);
  EXPECT_EQ(result["effect"]["first"], 0);
  EXPECT_EQ(result["effect"]["in_class"], 1);
}

TEST_F(Score, OfPairsEachByAnAnswerOfItsOwn) {
  const List two = {hidden("eyelet_friction", "biceps_brachii", 0.1),
                    hidden("supply_sag", "unit_a", 0.1)};
  const Json first = named("eyelet_friction", "biceps_brachii", 0.1, 0.0, 1.0);
  const Json second = named("supply_sag", "unit_a", 0.1, 0.0, 1.0);
  Json either = first;
  either["rivals"] = List{{{"id", "supply_sag"}, {"place", "unit_a"}, {"probability", 0.3}}};
  truth("both", "pair", two);
  truth("one_as_two", "pair", two);
  truth("misplaced", "pair", two);
  report("both", "effects_found", {second, first});
  report("one_as_two", "effects_found", {either});
  report("misplaced", "effects_found", {first, named("supply_sag", "unit_b", 0.1, 0.0, 1.0)});
  truth("one_unseen", "pair", two);
  truth("one_overlooked", "pair", two);
  const auto seen_from = [](double size) {
    return List{{{"id", "supply_sag"}, {"place", "unit_a"}, {"smallest_visible", size}}};
  };
  report("one_unseen", "effects_found", {first}, {}, seen_from(0.2));
  report("one_overlooked", "effects_found", {first}, {}, seen_from(0.05));
  // Who names a third one instead is not excused.
  truth("another", "pair", two);
  report("another", "effects_found", {first, named("payload", "forearm", 0.1, 0.0, 1.0)}, {},
         seen_from(0.2));
  // The first name could stand for either of them, the second for one only.
  truth("class_first", "pair", two);
  report("class_first", "effects_found", {either, first});
  truth("and_more", "pair", two);
  report("and_more", "effects_found", {first, second, named("payload", "forearm", 0.1, 0.0, 1.0)});
  const Json result = score();
  EXPECT_EQ(result["pair"]["both"], 3);
  EXPECT_EQ(result["pair"]["alone"], 2);
  EXPECT_EQ(result["pair"]["cases"], 7);
  EXPECT_EQ(result["pair"]["said_invisible"], 1);
  EXPECT_EQ(rate(result, "one inside a class", "hits"), 1.0);
  EXPECT_EQ(rate(result, "a false one certainly", "hits"), 3.0);  // the misplaced one, too
}

TEST_F(Score, OfWrappedMusclesNullsAndOutsiders) {
  const auto surface = [](const std::string& place) {
    return Json{{"id", "wrapping_surface"},
                {"place", place},
                {"parameters", {{"radius", 0.02}}},
                {"sizes", Json::array()}};
  };
  truth("wrapped", "wrapped", {surface("teres_major"), surface("brachialis")});
  report("wrapped", "effects_found",
         {Json{{"id", "wrapping_surface"},
               {"place", "teres_major/3"},
               {"parameters", {{"radius", {{"value", 0.018}, {"ci95", {0.01, 0.02}}}}}}}});
  truth("quiet", "null", {});
  report("quiet", "no_missing_effect");
  truth("noisy", "null", {});
  report("noisy", "unexplained");
  truth("gusts", "outside", {hidden("gusts", "shoulder", 1.0)});
  Json unlikely = named("payload", "forearm", 0.1, 0.0, 1.0);
  unlikely["probability"] = 0.3;
  // However likely the first name is: none may be wrong with confidence.
  report("gusts", "effects_found", {unlikely, named("joint_coulomb", "elbow", 1.0, 0.0, 2.0)});
  truth("crash", "outside", {hidden("gusts", "shoulder", 1.0)});
  failed("crash");
  const Json result = score();
  EXPECT_EQ(result["missing"], Json::array({"crash"}));
  EXPECT_EQ(result["outside"]["cases"], 1);  // what gave no report was not wrong, nor was it right
  EXPECT_EQ(result["wrapped"]["right"], 1);
  EXPECT_NEAR(rate(result, "its radius [%]", "median"), 10.0, 1e-9);
  EXPECT_EQ(result["null"]["false"], 1);
  EXPECT_EQ(result["outside"]["confidently_wrong"], 1);
}

TEST_F(Score, OfChannelsThatGetWorseAndOfNamesTooMany) {
  const auto force = [](double recalibrated, double after) {
    return Json{{"per_channel",
                 {{"brachialis/force", {{"recalibrated", recalibrated}, {"after", after}}},
                  {"brachialis/position", {{"recalibrated", 1.2}, {"after", 1.2}}}}}};
  };
  const List rubbing = {hidden("eyelet_friction", "brachialis", 0.1)};
  const Json good = named("eyelet_friction", "brachialis", 0.1, 0.09, 0.13);
  const List verbose = {good, named("payload", "forearm", 0.1, 0.0, 1.0)};
  for (const char* name : {"better", "worse", "worse_in_the_noise"}) truth(name, "effect", rubbing);
  report("better", "effects_found", {good}, {}, {}, force(2.0, 1.1));
  Json certainly = force(1.1, 1.3), maybe = force(1.1, 1.3);
  certainly["per_channel"]["brachialis/force"]["growth"] = 4.0;
  maybe["per_channel"]["brachialis/force"]["growth"] = 1.0;
  report("worse", "effects_found", verbose, {}, {}, certainly);
  report("worse_in_the_noise", "effects_found", {good}, {}, {}, force(0.6, 0.9));
  truth("quiet", "null", {});
  report("quiet", "effects_found", {good}, {}, {}, maybe);
  truth("of_an_older_program", "null", {});
  report("of_an_older_program", "effects_found", {good}, {}, {}, force(1.1, 1.3));
  truth("unnamed", "effect", rubbing);
  report("unnamed", "unexplained", {}, {}, {}, force(1.1, 1.1));
  const Json result = score();
  // Also of what is named where nothing is hidden.
  EXPECT_EQ(rate(result, "a channel worse", "hits"), 4.0);
  EXPECT_EQ(rate(result, "a channel worse", "count"), 5.0);
  EXPECT_EQ(rate(result, "and above its floor", "hits"), 3.0);
  EXPECT_EQ(rate(result, "and not by chance", "hits"), 1.0);
  EXPECT_EQ(rate(result, "and not by chance", "count"), 4.0);  // the others tell
  EXPECT_EQ(rate(result, "more named than hidden", "hits"), 1.0);
  EXPECT_EQ(rate(result, "more named than hidden", "count"), 4.0);
  EXPECT_EQ(rate(result, "a false one certainly", "hits"), 1.0);
}

TEST_F(Score, OfTheGapThatIsLeftWhateverWasAnswered) {
  const auto gap = [](double after) {
    return Json{{"test", {{"recalibrated", 3.0}, {"after", after}, {"floor", 1.0}}}};
  };
  const List good = {named("eyelet_friction", "brachialis", 0.1, 0.0, 1.0)};
  const List rubbing = {hidden("eyelet_friction", "brachialis", 0.1)};
  for (const char* name : {"found", "half", "unexplained"}) truth(name, "effect", rubbing);
  report("found", "effects_found", good, {}, {}, gap(1.2));
  report("half", "effects_found", good, {}, {}, gap(2.0));
  report("unexplained", "unexplained", {}, {}, {}, gap(3.0));
  truth("gusts", "outside", rubbing);  // has no answer
  report("gusts", "effects_found", good, {}, {}, gap(1.0));
  EXPECT_NEAR(rate(score(), "gap left held out", "median"), 0.5, 1e-9);
  EXPECT_EQ(rate(score(), "gap left held out", "count"), 3.0);
}

}  // namespace
