// Numbers that decide: every one is checked, printed, and documented where it is declared.
#include "options/options.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>

#include "report/options_json.h"

namespace anthrob {
namespace discovery {
namespace {

using Json = nlohmann::ordered_json;

void collect_names(const Json& json, std::multiset<std::string>& names) {
  for (const auto& [name, value] : json.items()) {
    names.insert(name);
    if (value.is_object()) collect_names(value, names);
  }
}

/// Every member that the headers declare, of groups and of numbers.
/// @param how_often the group of a member is part of the options, by the name of its type
std::multiset<std::string> declared_names() {
  const std::regex member("^  ([A-Za-z:_]+(?:<double, [0-9]+>)?) ([a-z_]+)(?: = [^;]+)?;.*");
  const std::regex group("^struct ([A-Za-z]+) \\{.*");
  std::map<std::string, std::vector<std::pair<std::string, std::string>>> members;  // by group
  for (const auto& file : std::filesystem::directory_iterator(ANTHROB_OPTIONS_DIR)) {
    if (file.path().extension() != ".h" || file.path().stem() == "share") continue;
    std::ifstream text(file.path());
    std::string line, present;
    for (std::smatch match; std::getline(text, line);) {
      if (std::regex_match(line, match, group)) present = match[1];
      if (std::regex_match(line, match, member)) members[present].push_back({match[1], match[2]});
    }
  }
  std::multiset<std::string> names;
  const std::function<void(const std::string&)> add = [&](const std::string& type) {
    for (const auto& [kind, name] : members.at(type)) {
      names.insert(name);
      if (members.count(kind)) add(kind);
    }
  };
  add("Options");
  return names;
}

TEST(Options, AreAllPrinted) {
  std::multiset<std::string> printed;
  collect_names(options_json({}), printed);
  EXPECT_EQ(printed, declared_names());
  EXPECT_GT(printed.size(), 200u);
}

TEST(Options, ArePrintedAsTheyAre) {
  Options options;
  options.fit.guard.price = 0.25;
  options.judgement.draws = 7;
  const Json json = options_json(options);
  EXPECT_EQ(json["fit"]["guard"]["price"], 0.25);
  EXPECT_EQ(json["judgement"]["draws"], 7);
  EXPECT_EQ(json["hypotheses"]["trials"]["doses"], (std::vector<double>{1.0, 3.0, 10.0}));
}

TEST(Options, AsTheyAreAreValid) {
  EXPECT_EQ(invalid_option({}), std::nullopt);
}

TEST(Options, WhatMakesNoSenseIsNamed) {
  Options share, number, count, list, order, certain;
  share.fit.guard.price = 1.5;
  number.admission.clocks.bin = std::nan("");
  count.search.renewed = 0;
  list.fit.damping.full_steps[1] = -1.0;
  order.judgement.faint_gap = 1.5;
  certain.fit.intervals.confidence = 1.0;
  EXPECT_EQ(invalid_option(share),
            "fit.guard.price: 1.5: expected a number above 0 and not above 1");
  EXPECT_EQ(invalid_option(number)->find("admission.clocks.bin: "), 0u);
  EXPECT_EQ(invalid_option(count), "search.renewed: 0: expected at least 1");
  EXPECT_EQ(invalid_option(list), "fit.damping.full_steps: -1: expected a number above 0");
  EXPECT_EQ(invalid_option(order), "judgement: expected faint_gap <= real_gap <= certain_gap");
  EXPECT_EQ(invalid_option(certain), "fit.intervals.confidence: 1: expected less than 1");
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
