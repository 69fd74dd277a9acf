#include "foreign/time_base.h"

#include <gtest/gtest.h>

#include <cmath>

#include "anthrob_recording/dataset.h"

namespace anthrob {
namespace {

/// A table of one column, sampled at `rate` from `begin` on.
Table sampled(const std::string& table, const std::string& column, double begin, double rate, int n,
              double (*value)(double)) {
  Table made;
  made.name = table;
  for (int i = 0; i < n; ++i) {
    made.t.push_back(std::llround(1e9 * (begin + i / rate)));
  }
  Column& cells = made.column(column);
  for (std::size_t i = 0; i < made.t.size(); ++i) {
    cells.values[i] = value(seconds(made.t[i]));
    cells.present[i] = 1;
  }
  return made;
}

double line(double t) {
  return 3.0 - 2.0 * t;
}

TEST(TimeBase, EachSampleOfASlowSensorIsInOneRowWithoutDelay) {
  Dataset out;
  out.tables = on_time_base({sampled("muscles", "m/force", 0.0, 1000.0, 1001, line),
                             sampled("joints", "j/position", 0.0031, 60.0, 59, line)},
                            200.0);
  const Series slow = out.series("j/position"), fast = out.series("m/force");
  EXPECT_EQ(out.find_table("joints")->t.size(), 201u);
  EXPECT_EQ(fast.t.size(), 201u);
  EXPECT_GE(slow.t.size(), 57u);  // the rows next to the ends may lie outside
  EXPECT_LE(slow.t.size(), 59u);
  for (const Series& s : {slow, fast}) {
    for (std::size_t i = 0; i < s.t.size(); ++i) EXPECT_NEAR(s.values[i], line(s.t[i]), 1e-9);
  }
}

TEST(TimeBase, WhatActsKeepsItsImpulse) {
  const auto steps = [](double t) { return std::floor(13.0 * t) - 3.0; };
  Dataset out, in;
  in.tables = {sampled("joints", "j/effort", 0.0, 1000.0, 1001, steps)};
  out.tables = on_time_base(in.tables, 75.0);
  const Series before = in.series("j/effort"), after = out.series("j/effort");
  ASSERT_EQ(after.t.size(), 76u);
  double given = 0.0, kept = 0.0;  // [Nms]
  for (std::size_t i = 0; i < 1000; ++i) given += before.values[i] / 1000.0;
  for (std::size_t i = 0; i < 75; ++i) kept += after.values[i] / 75.0;
  EXPECT_NEAR(kept, given, 1e-9);
}

TEST(TimeBase, CommandsComeInTheFirstRowThatIsNotBeforeThem) {
  Table commands = sampled("commands", "m/reference", 0.0, 10.0, 3, line);
  commands.t = {0, 105000000, 200000000};
  Dataset out;
  out.tables = on_time_base({commands}, 50.0);
  const Series reference = out.series("m/reference");
  ASSERT_EQ(reference.t.size(), 3u);
  EXPECT_NEAR(reference.t[1], 0.12, 1e-12);
  EXPECT_EQ(reference.t[2], 0.2);
  EXPECT_EQ(reference.values[1], line(0.1));
}

TEST(TimeBase, OrientationsStayOfUnitLengthAndTurnTheShortWay) {
  Table table;
  table.name = "spherical_joints";
  for (int i = 0; i <= 60; ++i) table.t.push_back(std::llround(1e9 * i / 60.0));
  for (const char* part : {"s/w", "s/x", "s/y", "s/z"}) {
    Column& column = table.column(part);
    for (std::size_t i = 0; i < table.t.size(); ++i) {
      const double half = 2.5 * seconds(table.t[i]);  // w changes its sign on the way
      const double sign = std::cos(half) < 0.0 ? -1.0 : 1.0;
      column.present[i] = 1;
      column.values[i] = sign * (part[2] == 'w'   ? std::cos(half)
                                 : part[2] == 'y' ? std::sin(half)
                                                  : 0);
    }
  }
  Dataset out;
  out.tables = on_time_base({table}, 100.0);
  const Series w = out.series("s/w"), y = out.series("s/y");
  ASSERT_GE(w.t.size(), 60u);
  for (std::size_t i = 0; i < w.t.size(); ++i) {
    EXPECT_NEAR(std::hypot(w.values[i], y.values[i]), 1.0, 1e-12);
    EXPECT_NEAR(
        std::abs(std::cos(2.5 * w.t[i]) * w.values[i] + std::sin(2.5 * w.t[i]) * y.values[i]), 1.0,
        1e-5);
  }
}

}  // namespace
}  // namespace anthrob
