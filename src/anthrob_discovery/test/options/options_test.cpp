// Numbers that decide: every one is checked, printed, and documented where it is declared.
#include "options/options.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "anthrob_core/errors.h"
#include "report/options_json.h"

namespace anthrob {
namespace discovery {
namespace {

using Json = nlohmann::ordered_json;

struct Member {
  std::string type, name, value;
};

/// The members that the headers declare, by their struct.
std::map<std::string, std::vector<Member>> declared_members() {
  const std::regex member("^  ([A-Za-z:_]+(?:<double, [0-9]+>)?) ([a-z_]+)(?: = ([^;]+))?;.*");
  const std::regex group("^struct ([A-Za-z]+) \\{.*");
  std::map<std::string, std::vector<Member>> members;
  for (const auto& file : std::filesystem::directory_iterator(ANTHROB_OPTIONS_DIR)) {
    if (file.path().extension() != ".h" || file.path().stem() == "share") continue;
    std::ifstream text(file.path());
    std::string line, present;
    for (std::smatch match; std::getline(text, line);) {
      if (std::regex_match(line, match, group)) present = match[1];
      if (std::regex_match(line, match, member)) {
        members[present].push_back({match[1], match[2], match[3]});
      }
    }
  }
  return members;
}

/// "{1.0, 3.0}" without its braces, part by part; nothing of an empty text.
std::vector<std::string> elements(const std::string& list) {
  std::istringstream text(list.empty() ? list : list.substr(1, list.size() - 2));
  std::vector<std::string> parts;
  for (std::string part; std::getline(text, part, ',');) parts.push_back(part);
  return parts;
}

/// A literal, or the ratio of two.
double number_in(const std::string& text) {
  std::istringstream in(text);
  double value = NAN, divisor = 1.0;
  char slash = 0;
  in >> value;
  if (in >> slash) in >> divisor;
  return value / divisor;
}

/// What options_json() should write, read from the text of the headers.
class Declared {
 public:
  /// @param values that replace the struct's own, in order
  Json group(const std::string& type, const std::vector<std::string>& values) const {
    Json json;
    std::size_t k = 0;
    for (const Member& member : members_.at(type)) {
      json[member.name] = value_of(member, k < values.size() ? values[k] : member.value);
      ++k;
    }
    return json;
  }

 private:
  Json value_of(const Member& member, const std::string& text) const {
    if (members_.count(member.type)) return group(member.type, elements(text));
    if (text.empty() || text.front() != '{') return number_in(text);
    Json list;
    for (const std::string& part : elements(text)) list.push_back(number_in(part));
    return list;
  }

  std::map<std::string, std::vector<Member>> members_ = declared_members();
};

TEST(Options, AreAllPrintedAsTheHeadersDeclareThem) {
  const Json printed = options_json({});
  EXPECT_EQ(Json::diff(printed, Declared().group("Options", {})).dump(), "[]");
  EXPECT_GT(printed.flatten().size(), 200u);
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

std::string refused(const std::string& assignment) {
  try {
    with_option({}, assignment);
  } catch (const BadInput& error) {
    return error.what();
  }
  return {};
}

TEST(Options, AreChangedByName) {
  EXPECT_EQ(with_option({}, "judgement.merit.evidence=5").judgement.merit.evidence, 5.0);
  EXPECT_EQ(with_option({}, "fit.guard.price=0.5").fit.guard.price, 0.5);
  EXPECT_EQ(with_option({}, "judgement.draws=7").judgement.draws, 7u);
  EXPECT_EQ(refused("judgement.merit.evidence"), "judgement.merit.evidence: expected NAME=NUMBER");
  EXPECT_EQ(refused("judgement.draws=x"), "judgement.draws=x: expected NAME=NUMBER");
  EXPECT_EQ(refused("judgement.draw=7"),
            "judgement.draw: unknown number of discovery; did you mean 'judgement.draws'?");
  EXPECT_EQ(refused("judgement.draws=7.5"),
            "judgement.draws: 7.5: expected a whole number above 0");
  EXPECT_EQ(refused("fit.guard.price=1.5"),
            "fit.guard.price: 1.5: expected a number above 0 and not above 1");
  EXPECT_NE(refused("fit.damping.full_steps=1"), "");  // a list
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
