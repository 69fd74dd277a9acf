// What an ECU that did not answer leaves in a recording.
#include "anthrob_recording/unanswered.h"

#include <gtest/gtest.h>

#include <cmath>

#include "anthrob_recording/quantities.h"

namespace anthrob {
namespace {

constexpr std::size_t kRows = 40;
constexpr Nanoseconds kPeriod = 5'000'000;
const char* const kTwoMuscles[] = {"biceps", "triceps"};
const char* const kMeasured[] = {"position", "velocity", "current", "voltage", "force"};
const char* const kWords[] = {"ecu_state", "mode", "reference"};

double state_of(const std::string& word) {
  return number_of("ecu_state", word).value();
}

double mode_of(const std::string& word) {
  return number_of("mode", word).value();
}

/// Two enabled muscles at 200 Hz; cells are numbered.
Dataset recording() {
  Dataset data;
  Table& table = data.table("muscles");
  for (std::size_t i = 0; i < kRows; ++i) table.t.push_back(static_cast<Nanoseconds>(i) * kPeriod);
  const auto fill = [&](const std::string& name, double value) {
    Column& column = table.column(name);
    column.values.assign(kRows, value);
    column.present.assign(kRows, 1);
  };
  double value = 0.5;
  for (const std::string muscle : kTwoMuscles) {
    for (const std::string quantity : kMeasured) fill(muscle + "/" + quantity, value += 1.0);
    fill(muscle + "/ecu_state", state_of("ENABLED"));
    fill(muscle + "/mode", mode_of("POSITION"));
    fill(muscle + "/reference", value);
  }
  return data;
}

/// As the driver publishes a muscle whose ECU did not answer.
void lose(Dataset& data, const std::string& muscle, std::size_t first, std::size_t count) {
  Table& table = data.tables.front();
  const auto fill = [&](const std::string& quantity, double value) {
    std::fill_n(table.column(muscle + "/" + quantity).values.begin() + static_cast<long>(first),
                count, value);
  };
  for (const char* quantity : kMeasured) fill(quantity, NAN);
  fill("ecu_state", state_of("FAULT"));
  fill("mode", mode_of("VOLTAGE"));
  fill("reference", 0.0);
}

std::size_t cells(const Dataset& data, const std::string& column) {
  return data.series(column).t.size();
}

TEST(Unanswered, ShortSilenceIsNotMeasured) {
  Dataset data = recording();
  lose(data, "biceps", 0, 2);
  lose(data, "biceps", 10, 9);  // 50 ms from the row before to the row after
  lose(data, "biceps", kRows - 1, 1);
  leave_out_unanswered(data);
  for (const std::string quantity : kMeasured) {
    EXPECT_EQ(cells(data, "biceps/" + quantity), kRows - 12);
    EXPECT_EQ(cells(data, "triceps/" + quantity), kRows);
  }
  for (const std::string quantity : kWords) {
    EXPECT_EQ(cells(data, "biceps/" + quantity), kRows - 12);
    EXPECT_EQ(cells(data, "triceps/" + quantity), kRows);
  }
  for (const double state : data.series("biceps/ecu_state").values) {
    EXPECT_EQ(state, state_of("ENABLED"));
  }
}

TEST(Unanswered, LongSilenceStays) {
  Dataset data = recording();
  lose(data, "biceps", 10, 10);
  leave_out_unanswered(data);
  EXPECT_EQ(cells(data, "biceps/ecu_state"), kRows);
  EXPECT_TRUE(std::isnan(data.series("biceps/position").values[15]));
}

TEST(Unanswered, AUnitThatTellsOfAFaultStays) {
  Dataset data = recording();
  lose(data, "biceps", 10, 4);
  data.tables.front().column("biceps/current").values[12] = 0.0;
  leave_out_unanswered(data);
  // It failed in the silence before it said so; of the one after that nothing is known.
  EXPECT_EQ(cells(data, "biceps/ecu_state"), kRows - 1);
  for (std::size_t i = 10; i < 13; ++i) {
    EXPECT_EQ(data.series("biceps/ecu_state").values[i], state_of("FAULT"));
  }
}

TEST(Unanswered, AUnitThatWasStoppedMeanwhileStays) {
  Dataset data = recording();
  lose(data, "biceps", 10, 4);
  auto& state = data.tables.front().column("biceps/ecu_state").values;
  for (std::size_t i = 14; i < kRows; ++i) state[i] = state_of("FAULT");
  leave_out_unanswered(data);
  EXPECT_EQ(cells(data, "biceps/position"), kRows - 4);
  EXPECT_EQ(cells(data, "biceps/ecu_state"), kRows);
  EXPECT_EQ(data.series("biceps/ecu_state").values[10], state_of("FAULT"));
}

TEST(Unanswered, AUnitThatNeverAnswersStays) {
  Dataset data = recording();
  lose(data, "biceps", 0, kRows);
  leave_out_unanswered(data);
  EXPECT_EQ(cells(data, "biceps/ecu_state"), kRows);
  EXPECT_EQ(cells(data, "biceps/reference"), kRows);
  EXPECT_EQ(cells(data, "biceps/position"), kRows);
}

TEST(Unanswered, WhatDrivesAReplayIsNotMeasured) {
  Dataset data = recording();
  Column& load = data.tables.front().column("elbow/load");
  load.values.assign(kRows, 0.1);
  load.present.assign(kRows, 1);
  load.values[7] = NAN;
  data.tables.front().column("biceps/reference").values[7] = NAN;
  leave_out_unanswered(data);
  EXPECT_EQ(cells(data, "elbow/load"), kRows);
  EXPECT_EQ(cells(data, "biceps/reference"), kRows);
}

TEST(Unanswered, CellsInBetweenThatWereEmptyAreNoAnswer) {
  Dataset data = recording();
  Table& table = data.tables.front();
  Column& joint = table.column("elbow/position");  // at a quarter of the rate
  for (std::size_t i = 0; i < kRows; i += 4) joint.present[i] = 1;
  joint.values[8] = joint.values[20] = joint.values[24] = NAN;  // 40 ms and 60 ms
  leave_out_unanswered(data);
  EXPECT_EQ(cells(data, "elbow/position"), kRows / 4 - 1);
  EXPECT_TRUE(std::isnan(data.series("elbow/position").at(0.11)));
}

TEST(Unanswered, WhatWasNeverMeasuredIsEmpty) {
  Dataset data = recording();
  auto& force = data.tables.front().column("triceps/force").values;
  std::fill(force.begin(), force.end(), NAN);
  auto& reference = data.tables.front().column("triceps/reference").values;
  std::fill(reference.begin(), reference.end(), NAN);
  leave_out_unanswered(data);
  EXPECT_EQ(cells(data, "triceps/force"), 0u);
  EXPECT_EQ(cells(data, "triceps/position"), kRows);
  EXPECT_EQ(cells(data, "triceps/reference"), kRows);  // to be refused by who needs it
}

}  // namespace
}  // namespace anthrob
