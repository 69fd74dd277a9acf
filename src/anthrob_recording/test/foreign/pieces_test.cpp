#include "foreign/pieces.h"

#include <gtest/gtest.h>

#include "anthrob_core/errors.h"

namespace anthrob {
namespace {

Dataset whole() {
  Dataset data;
  Table& joints = data.table("joints");
  for (int i = 0; i < 100; ++i) joints.t.push_back(5000000000 + i * Nanoseconds{100000000});
  Column& position = joints.column("j/position");
  for (std::size_t i = 0; i < 100; ++i) position.values[i] = 1.0 * i, position.present[i] = 1;
  Column& load = joints.column("j/load");  // given once, it goes on
  load.values[3] = 7.0, load.present[3] = 1;
  Table& commands = data.table("commands");
  commands.t = {5000000000, 6000000000, 9500000000};
  Column& reference = commands.column("m/reference");
  reference.values = {1.0, 2.0, 3.0}, reference.present = {1, 1, 1};
  return data;
}

TEST(Pieces, RowsFromTheFirstTimeToBeforeTheSecond) {
  const Dataset part = cut(whole(), {"train", 2.0, 3.0});
  const Table& joints = *part.find_table("joints");
  EXPECT_EQ(joints.t.front(), 7000000000);
  EXPECT_EQ(joints.t.back(), 7900000000);
  EXPECT_EQ(part.series("j/position").values.front(), 20.0);
  // Two pieces share no row and leave none out.
  EXPECT_EQ(cut(whole(), {"a", 0.0, 3.3}).find_table("joints")->t.size() +
                cut(whole(), {"b", 3.3, 60.0}).find_table("joints")->t.size(),
            100u);
}

TEST(Pieces, WhatHeldBeforeHoldsInThem) {
  const Dataset part = cut(whole(), {"test", 2.0, 6.0});
  const Series load = part.series("j/load"), reference = part.series("m/reference");
  EXPECT_EQ(load.t, (std::vector<double>{0.0}));
  EXPECT_EQ(load.values, (std::vector<double>{7.0}));
  EXPECT_EQ(reference.t, (std::vector<double>{0.0, 2.5}));
  EXPECT_EQ(reference.values, (std::vector<double>{2.0, 3.0}));
  EXPECT_EQ(cut(whole(), {"start", 0.0, 6.0}).find_table("joints")->find("j/load")->present[0], 0);
}

TEST(Pieces, APieceWithoutRowsIsRefused) {
  try {
    cut(whole(), {"repeat", 20.0, 30.0});
    FAIL();
  } catch (const BadInput& bad) {
    EXPECT_NE(std::string(bad.what())
                  .find("split: repeat: fewer than two rows from 20 to 30 s; "
                        "expected times since the first row, up to 9.900 s"),
              std::string::npos)
        << bad.what();
  }
}

}  // namespace
}  // namespace anthrob
