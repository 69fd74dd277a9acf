#include "anthrob_recording/extent.h"

#include <gtest/gtest.h>

namespace anthrob {
namespace {

TEST(Extent, CountsTablesRowsAndTime) {
  Dataset data;
  EXPECT_EQ(extent_of(data), "0 tables, 0 rows, 0.000 s");
  data.table("joints").t = {7000000000};
  EXPECT_EQ(extent_of(data), "1 table, 1 row, 0.000 s");
  data.table("muscles").t = {5000000000, 8250000000};
  EXPECT_EQ(extent_of(data), "2 tables, 3 rows, 3.250 s");
}

}  // namespace
}  // namespace anthrob
