#include "foreign/foreign_value.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "anthrob_core/errors.h"
#include "foreign/foreign_csv.h"

namespace anthrob {
namespace {

class ForeignValues : public ::testing::Test {
 protected:
  ForeignValues()
      : folder_(std::filesystem::temp_directory_path() /
                ("anthrob_values_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~ForeignValues() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) {
    std::ofstream((folder_ / name).string()) << text;
    return (folder_ / name).string();
  }
  /// What `from` makes of a = 1, 2, 4, (none), 16 and b = 3, 0, 5, 6, -2 in steps of 0.5 s.
  std::vector<double> made(const std::string& from) {
    const std::string map =
        write("map.yaml", "robot: r\nrate: 2\ncolumns: [{from: " + from + ", to: j/position}]\n");
    const std::string csv = write("data.csv", "a,b\n1,3\n2,0\n4,5\n,6\n16,-2\n");
    const Dataset data = read_foreign_csv(csv, ForeignColumns::load(map));
    const Column& column = data.tables.front().columns.front();
    std::vector<double> values;
    for (std::size_t i = 0; i < column.values.size(); ++i) {
      values.push_back(column.present[i] ? column.values[i] : -99.0);
    }
    return values;
  }
  std::string error(const std::string& from) {
    try {
      made(from);
    } catch (const BadInput& bad) {
      return bad.what();
    }
    return "no error";
  }

  std::filesystem::path folder_;
};

using List = std::vector<double>;

TEST_F(ForeignValues, ColumnsAreAddedMultipliedAndScaled) {
  EXPECT_EQ(made("a"), (List{1, 2, 4, -99, 16}));
  EXPECT_EQ(made("{place: 2, scale: 2, offset: 1}"), (List{7, 1, 11, 13, -3}));
  EXPECT_EQ(made("{sum: [a, b, {constant: 10}]}"), (List{14, 12, 19, -99, 24}));
  EXPECT_EQ(made("{difference: [a, {column: b, scale: 2}]}"), (List{-5, 2, -6, -99, 20}));
  EXPECT_EQ(made("{product: [a, b], scale: 0.5}"), (List{1.5, 0, 10, -99, -16}));
  EXPECT_EQ(made("{quotient: [a, b]}"), (List{1.0 / 3, -99, 0.8, -99, -8}));
}

TEST_F(ForeignValues, OperationsOnOneColumn) {
  EXPECT_EQ(made("{integral: b, start: 1}"), (List{1, 1.75, 3, 5.75, 6.75}));
  EXPECT_EQ(made("{clip: b, low: 0, high: 5}"), (List{3, 0, 5, 5, 0}));
  EXPECT_EQ(made("{within: b, low: 0, high: 5}"), (List{3, 0, 5, -99, -99}));
  EXPECT_EQ(made("{unwrap: b, period: 4}"), (List{3, 4, 5, 6, 6}));
  EXPECT_EQ(made("{fresh: a, when: {clip: b, high: 4}}"), (List{1, 2, 4, -99, 16}));
  EXPECT_EQ(made("{fresh: {clip: b, low: 3}}"), (List{3, -99, 5, 6, 3}));
  EXPECT_EQ(made("{derivative: {column: a, scale: 3}}")[1], 9.0);
  const List smooth = made("{smooth: {product: [b, b]}, over: 10}");
  // The parabola of least squares over x = -2..2 has at x = 0 (-3, 12, 17, 12, -3) / 35.
  EXPECT_NEAR(smooth[2], (-3 * 9 + 12 * 0 + 17 * 25 + 12 * 36 - 3 * 4) / 35.0, 1e-12);
}

TEST_F(ForeignValues, WhatIsWrongIsSaidInOneLine) {
  const auto expect = [&](const std::string& from, const std::string& said) {
    EXPECT_NE(error(from).find(said), std::string::npos) << from << ": " << error(from);
    EXPECT_EQ(error(from).find('\n'), std::string::npos);
  };
  expect("{summ: [a, b]}", "map.yaml:3: columns.0.from: expected one of the keys column, place,");
  expect("{sum: [a, b], product: [a, b]}", "product: beside 'sum': expected only one of them");
  expect("{sum: [a]}", "from.sum: expected a list of at least two columns");
  expect("{quotient: [a, b, a]}", "from.quotient: expected a list of two columns");
  expect("{derivative: [a, b]}", "from.derivative: expected one column");
  expect("{product: [a, 0.5]}", "column '0.5' is not in");
  expect("{product: [a, 0.5]}", "; for a number, write {constant: 0.5}");
  expect("{clip: a}", "expected 'low', 'high' or both");
  expect("{clip: a, low: 3, high: 2}", "from.low: 3: expected a number below 'high'");
  expect("{smooth: a, over: 0.5}", "from.over: 0.5: expected a window of at least four samples");
  expect("{smooth: a}", "over");
  expect("{place: 3}", "place 3 is not in");
  expect("{column: a, scle: 2}", "scle");
  expect("{derivative: a, period: 2}", "period");
}

}  // namespace
}  // namespace anthrob
