#include "comparison/comparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace anthrob {
namespace {

using Law = std::function<double(double)>;

/// A column of 101 samples, 10 ms apart, from `begin` on.
Dataset recording(const std::string& column, const Law& law, double begin = 0.0) {
  Dataset data;
  Table& table = data.table("muscles");
  for (int i = 0; i <= 100; ++i) table.t.push_back(std::llround(1e9 * begin) + 10000000LL * i);
  Column& values = table.column(column);
  for (int i = 0; i <= 100; ++i) {
    values.values[i] = law(0.01 * i);
    values.present[i] = 1;
  }
  return data;
}

void add_law(Dataset& data, const std::string& column, const Law& law) {
  Table& table = data.table("muscles");
  Column& values = table.column(column);
  for (std::size_t i = 0; i < table.t.size(); ++i) {
    values.values[i] = law(0.01 * static_cast<double>(i));
    values.present[i] = 1;
  }
}

ChannelDifference only_channel(const Dataset& a, const Dataset& b) {
  const Comparison comparison = compare(a, b);
  EXPECT_EQ(comparison.channels.size(), 1u);
  return comparison.channels.front();
}

TEST(Comparison, OfARecordingWithItselfIsZero) {
  const Dataset data = recording("m/force", [](double t) { return std::sin(7.0 * t); });
  const ChannelDifference same = only_channel(data, data);
  EXPECT_EQ(same.channel, "m/force");
  EXPECT_EQ(same.unit, "N");
  EXPECT_EQ(same.samples, 101);
  EXPECT_EQ(same.rms, 0.0);
  EXPECT_EQ(same.largest, 0.0);
}

TEST(Comparison, HasTheRmsAndTheLargestAndItsTime) {
  const Dataset a = recording("m/force", [](double) { return 1.0; });
  const Dataset b =
      recording("m/force", [](double t) { return 1.0 + (std::abs(t - 0.25) < 1e-6 ? -3.0 : 0.1); });
  const ChannelDifference found = only_channel(a, b);
  EXPECT_NEAR(found.rms, std::sqrt((9.0 + 100 * 0.01) / 101), 1e-12);
  EXPECT_DOUBLE_EQ(found.largest, 3.0);
  EXPECT_DOUBLE_EQ(found.at, 0.25);
}

TEST(Comparison, CountsTimeFromEachBeginning) {
  const Law law = [](double t) { return t * t; };
  EXPECT_LT(only_channel(recording("m/force", law), recording("m/force", law, 1.7e9)).rms, 1e-12);
}

TEST(Comparison, LeavesOutWhereOnlyOneMeasured) {
  Dataset a = recording("m/force", [](double) { return 1.0; });
  Dataset b = a;
  add_law(b, "n/force", [](double) { return 0.0; });
  Column& short_one = b.table("muscles").column("m/force");
  for (int i = 51; i <= 100; ++i) short_one.present[i] = 0;
  const Comparison found = compare(a, b);
  EXPECT_EQ(found.channels.front().samples, 51);
  EXPECT_EQ(found.only_b, std::vector<std::string>{"n/force"});
  EXPECT_TRUE(found.only_a.empty());
  a.table("muscles").column("m/force").values[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(compare(a, b).channels.front().samples, 50);
}

TEST(Comparison, HoldsReferences) {
  const Law steps = [](double t) { return std::floor(2.0 * t + 1e-9); };
  Dataset a = recording("m/reference", steps), sparse = a;
  for (int i = 1; i < 100; ++i) {
    if (i != 50) sparse.table("muscles").column("m/reference").present[i] = 0;
  }
  EXPECT_EQ(only_channel(a, sparse).rms, 0.0);
}

Dataset turning(double angle, double sign) {
  Dataset data = recording("s/w", [&](double) { return sign * std::cos(angle / 2); });
  add_law(data, "s/x", [](double) { return 0.0; });
  add_law(data, "s/y", [&](double) { return sign * std::sin(angle / 2); });
  add_law(data, "s/z", [](double) { return 0.0; });
  return data;
}

TEST(Comparison, OfOrientationsIsTheAngleBetween) {
  // A quaternion and its negative are the same rotation.
  const ChannelDifference found = only_channel(turning(0.3, 1.0), turning(0.8, -1.0));
  EXPECT_EQ(found.channel, "s");
  EXPECT_EQ(found.unit, "rad");
  EXPECT_NEAR(found.rms, 0.5, 1e-12);
}

TEST(Comparison, LeavesOutWords) {
  const Dataset data = recording("m/mode", [](double) { return 1.0; });
  EXPECT_TRUE(compare(data, data).channels.empty());
}

}  // namespace
}  // namespace anthrob
