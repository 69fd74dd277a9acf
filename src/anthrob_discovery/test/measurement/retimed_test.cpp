// Columns at other times than their table's.
#include "measurement/retimed.h"

#include <gtest/gtest.h>

namespace anthrob {
namespace discovery {
namespace {

Dataset two_columns() {
  Dataset data;
  data.folder = "run";
  Table& table = data.table("muscles");
  for (const char* name : {"flexor/voltage", "flexor/force"}) {
    Column& column = table.column(name);
    for (int i = 0; i < 4; ++i) column.values.push_back(i), column.present.push_back(1);
  }
  table.t = {0, 1000000000, 2000000000, 3000000000};
  return data;
}

TEST(Retimed, MovesColumnsAloneAndKeepsTheRecordingsExtent) {
  Dataset data = two_columns();
  retime(data, "muscles", {"flexor/voltage"}, "voltages",
         {-100000000, 900000000, std::nullopt, 2900000000});
  const Series voltage = data.series("flexor/voltage");
  ASSERT_EQ(voltage.t.size(), 2u);
  EXPECT_DOUBLE_EQ(voltage.t[0], 0.9);
  EXPECT_DOUBLE_EQ(voltage.t[1], 2.9);
  EXPECT_EQ(voltage.values, (std::vector<double>{1.0, 3.0}));
  EXPECT_EQ(data.series("flexor/force").t, (std::vector<double>{0.0, 1.0, 2.0, 3.0}));
  EXPECT_EQ(data.end(), 3000000000);
}

TEST(Retimed, OfAWholeTableTheNameStays) {
  Dataset data = two_columns();
  retime(data, "muscles", {"flexor/voltage", "flexor/force"}, "other",
         {0, 1000000000, std::nullopt, 2500000000});
  ASSERT_EQ(data.tables.size(), 1u);
  EXPECT_EQ(data.tables[0].name, "muscles");
  EXPECT_EQ(data.series("flexor/force").t, (std::vector<double>{0.0, 1.0, 2.5}));
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
