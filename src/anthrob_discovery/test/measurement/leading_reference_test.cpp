// References that make up for a derivative of the error.
#include "measurement/leading_reference.h"

#include <gtest/gtest.h>

#include "anthrob_ecu/control_law.h"

namespace anthrob {
namespace discovery {
namespace {

constexpr double kLead = 0.08, kLeadTick = 0.001;  // [s]

/// References of a muscle every so many milliseconds, beside those of another one.
Dataset commanded(int every, const std::vector<double>& references,
                  const std::vector<ecu::Mode>& modes) {
  Dataset data;
  data.folder = "run";
  Table& table = data.table("commands");
  for (const char* name : {"flexor/mode", "flexor/reference", "extensor/reference"}) {
    table.column(name);
  }
  for (std::size_t i = 0; i < references.size(); ++i) {
    table.t.push_back(static_cast<Nanoseconds>(i) * every * 1000000);
    const double row[] = {static_cast<double>(modes[i]), references[i], 7.0};
    for (std::size_t k = 0; k < 3; ++k) {
      table.columns[k].values.push_back(row[k]), table.columns[k].present.push_back(1);
    }
  }
  return data;
}

TEST(LeadingReference, IsTheReferenceAndItsRateInEveryTick) {
  const std::vector<double> asked = {1.0, 1.0, 1.002, 1.003, 1.003};
  Dataset data = commanded(1, asked, std::vector<ecu::Mode>(5, ecu::Mode::kPosition));
  lead_reference("flexor", kLead, kLeadTick, data);
  const Series series = data.series("flexor/reference");
  ASSERT_EQ(series.values.size(), 5u);
  const double rates[] = {0.0, 0.0, 2.0, 1.0, 0.0};  // [rad/s]
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(series.values[i], asked[i] + kLead * rates[i], 1e-12) << i;
  }
}

TEST(LeadingReference, OfAStepActsForOneTick) {
  Dataset data = commanded(10, {1.0, 1.5, 1.5}, std::vector<ecu::Mode>(3, ecu::Mode::kPosition));
  lead_reference("flexor", kLead, kLeadTick, data);
  const Series series = data.series("flexor/reference");
  EXPECT_DOUBLE_EQ(series.held_at(0.0095), 1.0);
  EXPECT_DOUBLE_EQ(series.held_at(0.0105), 1.5 + kLead * 0.5 / kLeadTick);
  EXPECT_DOUBLE_EQ(series.held_at(0.0115), 1.5);
  EXPECT_DOUBLE_EQ(series.held_at(0.021), 1.5);
  // Nobody else is told anything new.
  EXPECT_EQ(data.series("extensor/reference").values, (std::vector<double>(3, 7.0)));
  EXPECT_EQ(data.find_table("commands")->t.size(), 5u);
}

TEST(LeadingReference, LeavesReferencesOfOtherModes) {
  const std::vector<ecu::Mode> modes = {ecu::Mode::kForce, ecu::Mode::kForce, ecu::Mode::kPosition,
                                        ecu::Mode::kPosition};
  Dataset data = commanded(1, {20.0, 30.0, 1.0, 1.001}, modes);
  lead_reference("flexor", kLead, kLeadTick, data);
  const Series series = data.series("flexor/reference");
  EXPECT_EQ(series.values[0], 20.0);
  EXPECT_EQ(series.values[1], 30.0);
  EXPECT_EQ(series.values[2], 1.0);  // not from a force
  EXPECT_NEAR(series.values[3], 1.001 + kLead, 1e-12);
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
