// Measurements that two nodes publish, in recordings that do not say who published what.
#include "dataset/sources.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "anthrob_core/errors.h"

namespace anthrob {
namespace {

constexpr Nanoseconds kMillisecond = 1000000;

double raising(double t) {
  return 0.4 * std::sin(2.0 * t);
}

/// 4 s of a joint at 100 Hz.
Dataset joint(const std::function<double(int)>& position) {
  Dataset dataset;
  dataset.folder = "run";
  Table& joints = dataset.table("joints");
  Column& column = joints.column("elbow/position");
  for (int i = 0; i < 400; ++i) {
    joints.t.push_back(10 * i * kMillisecond);
    column.values.push_back(position(i));
    column.present.push_back(1);
  }
  return dataset;
}

std::string answer_to(const Dataset& dataset) {
  try {
    check_sources(dataset);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Sources, OneThatMovesTremblesOrErrsNowAndThenIsAccepted) {
  EXPECT_EQ(answer_to(joint([](int i) { return raising(0.01 * i); })), "accepted");
  const auto trembles = [](int i) { return raising(0.01 * i) + (i % 2 == 0 ? 0.004 : -0.004); };
  EXPECT_EQ(answer_to(joint(trembles)), "accepted");
  const auto errs = [](int i) { return i % 100 == 7 ? 3.0 : raising(0.01 * i); };
  EXPECT_EQ(answer_to(joint(errs)), "accepted");
  const auto steps = [](int i) { return i / 50 % 2 == 0 ? 0.0 : 1.0; };
  EXPECT_EQ(answer_to(joint(steps)), "accepted");
}

TEST(Sources, TwoThatAlternateAreToldWithBothValues) {
  const auto other = [](int i) { return i % 2 == 1 ? 0.0 : 0.5 + 0.1 * raising(0.01 * i); };
  EXPECT_EQ(answer_to(joint(other)),
            "run/joints.csv: column 'elbow/position': jumps to another value and back in 398 of "
            "400 rows, first from 0.5 to 0 at 0.010 s: do two nodes publish it? Expected one "
            "publisher of each measurement");
}

TEST(Sources, ASlowerSecondOneIsToldToo) {
  const auto other = [](int i) { return i % 10 == 5 ? 0.0 : 0.5; };
  EXPECT_NE(answer_to(joint(other)).find("in 40 of 400 rows"), std::string::npos);
}

TEST(Sources, OneThatIsLateByAFewMillisecondsIsTold) {
  // Both measure the same motion, one in degrees.
  const auto degrees = [](int i) { return raising(0.01 * i) * (i % 2 == 1 ? 57.3 : 1.0); };
  EXPECT_NE(answer_to(joint(degrees)).find("jumps to another value and back"), std::string::npos);
}

TEST(Sources, TwoValuesOfOneTimeAreTold) {
  Dataset dataset = joint([](int i) { return raising(0.01 * (i / 2)); });
  Table& joints = dataset.table("joints");
  for (std::size_t i = 0; i < joints.t.size(); ++i)
    joints.t[i] = static_cast<Nanoseconds>(i / 2) * 20 * kMillisecond;
  EXPECT_EQ(answer_to(dataset), "accepted") << "the same twice";
  joints.column("elbow/position").values[101] = 0.5;
  EXPECT_NE(answer_to(dataset).find("and 0.5 at one time, 1.000 s"), std::string::npos)
      << answer_to(dataset);
}

TEST(Sources, OfCommandsMayBeSeveral) {
  Dataset dataset;
  Table& commands = dataset.table("commands");
  commands.t = {0, 0};
  commands.columns = {{"biceps/reference", {1.0, 2.0}, {1, 1}}};
  EXPECT_EQ(answer_to(dataset), "accepted");
}

}  // namespace
}  // namespace anthrob
