#include "gains/gain_table.h"

#include <gtest/gtest.h>

namespace anthrob {
namespace {

using Why = GainTable::Why;

std::vector<Gain> held(double flexor_p, double extensor_p, double d = 0.1) {
  return {{"flexor", "p", flexor_p},
          {"flexor", "d", d},
          {"extensor", "p", extensor_p},
          {"extensor", "d", d}};
}

TEST(GainTable, TellsWhatIsHeld) {
  GainTable table;
  EXPECT_FALSE(table.entry("", "p"));
  table.hear(held(1.0, 2.0), Why::kRead);
  EXPECT_EQ(table.muscles(), (std::vector<std::string>{"flexor", "extensor"}));
  EXPECT_EQ(table.names(), (std::vector<std::string>{"p", "d"}));
  EXPECT_EQ(table.entry("extensor", "p")->value, 2.0);
  EXPECT_TRUE(table.entry("extensor", "p")->same);
  EXPECT_EQ(table.entry("", "p")->value, 1.0);
  EXPECT_FALSE(table.entry("", "p")->same);
  EXPECT_TRUE(table.entry("", "d")->same);
  EXPECT_FALSE(table.entry("", "i"));
}

TEST(GainTable, UndoesTheUsersChangesOneByOne) {
  GainTable table;
  table.hear(held(1.0, 2.0), Why::kRead);
  EXPECT_FALSE(table.can_undo());
  table.hear(held(3.0, 3.0), Why::kChange);     // of all muscles at once
  table.hear(held(3.0, 3.0, 0.5), Why::kRead);  // somebody else's
  table.hear(held(3.0, 4.0, 0.5), Why::kChange);
  ASSERT_EQ(table.undo().size(), 1U);
  EXPECT_EQ(table.undo()[0].muscle, "extensor");
  EXPECT_EQ(table.undo()[0].value, 3.0);
  table.hear(held(3.0, 3.0, 0.5), Why::kUndo);
  ASSERT_EQ(table.undo().size(), 2U);
  EXPECT_EQ(table.undo()[0].value, 1.0);
  EXPECT_EQ(table.undo()[1].value, 2.0);
  table.hear(held(1.0, 2.0, 0.5), Why::kUndo);
  EXPECT_FALSE(table.can_undo());
}

TEST(GainTable, AnUndoThatIsRefusedCanBeTriedAgain) {
  GainTable table;
  table.hear(held(1.0, 2.0), Why::kRead);
  table.hear(held(3.0, 2.0), Why::kChange);
  table.hear(held(3.0, 2.0), Why::kUndo);
  EXPECT_TRUE(table.can_undo());
  table.hear(held(1.0, 2.0), Why::kUndo);
  EXPECT_FALSE(table.can_undo());
}

TEST(GainTable, WhatIsRefusedIsNoChange) {
  GainTable table;
  table.hear(held(1.0, 2.0), Why::kRead);
  table.hear(held(1.0, 2.0), Why::kChange);
  EXPECT_FALSE(table.can_undo());
}

}  // namespace
}  // namespace anthrob
