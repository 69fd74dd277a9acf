// Files of one recording that were stamped by different clocks.
#include "dataset/clocks.h"

#include <gtest/gtest.h>

#include "anthrob_core/errors.h"

namespace anthrob {
namespace {

constexpr Nanoseconds kSecond = 1000000000;

Table table(const std::string& name, Nanoseconds begin, Nanoseconds end) {
  Table table;
  table.name = name;
  table.t = {begin, end};
  return table;
}

Dataset recording(std::vector<Table> tables) {
  Dataset dataset;
  dataset.folder = "run";
  dataset.tables = std::move(tables);
  return dataset;
}

std::string refusal_of(Dataset dataset) {
  try {
    check_clocks(dataset);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Clocks, SimulatedTimeBesideTheTimeOfDay) {
  const Nanoseconds today = 1690000000 * kSecond;
  EXPECT_EQ(
      refusal_of(recording({table("muscles", today, today + 2 * kSecond),
                            table("joints", kSecond, 3 * kSecond),
                            table("commands", today, today + kSecond)})),
      "run/joints.csv: not synchronised with the other files: it ends 1689999997.000 s before "
      "they begin; expected all files to use one clock");
}

TEST(Clocks, AnHourFast) {
  const std::string said = refusal_of(recording(
      {table("joints", 3600 * kSecond, 3610 * kSecond), table("commands", 0, 10 * kSecond)}));
  EXPECT_EQ(
      said,
      "run/joints.csv: not synchronised with the other files: it begins 3590.000 s after they "
      "end; expected all files to use one clock");
}

TEST(Clocks, ALatchedCommandIsRemarked) {
  Dataset latched = recording(
      {table("muscles", 600 * kSecond, 610 * kSecond), table("commands", 0, 609 * kSecond)});
  check_clocks(latched);
  ASSERT_EQ(latched.remarks.size(), 1u);
  EXPECT_EQ(
      latched.remarks.front(),
      "run/commands.csv: begins 600.000 s before the other files: a latched message, or a wrong "
      "clock? A replay begins there");
}

TEST(Clocks, WhatIsUsualIsNot) {
  Dataset usual = recording({table("muscles", 2 * kSecond, 300 * kSecond),
                             table("commands", 0, 0),  // one posture, held
                             table("joints", 30 * kSecond, 40 * kSecond), Table()});
  check_clocks(usual);
  EXPECT_TRUE(usual.remarks.empty());
  Dataset alone = recording({table("joints", 1690000000 * kSecond, 1690000001 * kSecond)});
  EXPECT_EQ(refusal_of(alone), "accepted");
}

}  // namespace
}  // namespace anthrob
