#include "anthrob_calib/convert/foreign_csv.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "anthrob_sim/core/errors.h"

namespace anthrob {
namespace {

class ForeignCsv : public ::testing::Test {
 protected:
  ForeignCsv()
      : folder_(std::filesystem::temp_directory_path() /
                ("anthrob_foreign_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~ForeignCsv() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) {
    std::ofstream((folder_ / name).string()) << text;
    return (folder_ / name).string();
  }
  Dataset read(const std::string& map, const std::string& csv) {
    return read_foreign_csv(write("data.csv", csv), ForeignColumns::load(write("map.yaml", map)));
  }
  std::string error(const std::string& map, const std::string& csv) {
    try {
      read(map, csv);
    } catch (const BadInput& bad) {
      return bad.what();
    }
    return "no error";
  }

  std::filesystem::path folder_;
};

const std::string kMap =
    "robot: driven_axis\n"
    "time: {column: \"t [ms]\", scale: 0.001}\n"
    "columns:\n"
    "  - {from: \"y [mm]\", to: axis/position, scale: 0.001}\n"
    "  - {from: u, to: axis/effort, scale: -2, offset: 1}\n";

TEST_F(ForeignCsv, ColumnsGetNamesAndUnits) {
  const Dataset dataset = read(kMap,
                               "\xef\xbb\xbf\"t [ms]\",other,\"y [mm]\",u\r\n"
                               "0,words,1.5,+3\r\n1,,,4\r\n2.5,x,-2e1,5\r\n");
  const Series position = dataset.series("axis/position");
  EXPECT_EQ(position.t, (std::vector<double>{0.0, 0.0025}));
  EXPECT_EQ(position.values, (std::vector<double>{0.0015, -0.02}));
  EXPECT_EQ(dataset.series("axis/effort").values, (std::vector<double>{-5.0, -7.0, -9.0}));
  EXPECT_EQ(dataset.meta.robot, "driven_axis");
  EXPECT_EQ(dataset.tables.size(), 1u);
}

TEST_F(ForeignCsv, SurvivesTheFolderBitForBit) {
  const Dataset dataset = read(kMap, "t [ms],y [mm],u\n0,0.1,3\n1,0.7,4\n2,1e-7,5\n");
  dataset.save((folder_ / "out").string());
  const Dataset back = Dataset::load((folder_ / "out").string());
  EXPECT_EQ(back.series("axis/position").values, dataset.series("axis/position").values);
  EXPECT_EQ(back.series("axis/effort").t, dataset.series("axis/effort").t);
}

TEST_F(ForeignCsv, RowsMayBeEvenlySpaced) {
  const Dataset dataset =
      read("robot: r\nrate: 400\nseparator: ;\ncolumns: [{from: f, to: flexor/force}]\n",
           "f;g\n1;2\n3;4\n5;6\n");
  EXPECT_EQ(dataset.series("flexor/force").t, (std::vector<double>{0.0, 0.0025, 0.005}));
  EXPECT_EQ(dataset.tables.front().name, "muscles");
  EXPECT_EQ(dataset.meta.rate, 400.0);
}

TEST_F(ForeignCsv, WhatIsWrongIsSaidInOneLine) {
  const std::string head = "t [ms],y [mm],u\n";
  EXPECT_NE(error(kMap, "t [ms],y [mm]\n0,1\n").find("column 'u' is not in"), std::string::npos);
  EXPECT_NE(error(kMap, "t [ms],y [mm],u,u\n0,1,2,3\n").find("column 'u' is there twice"),
            std::string::npos);
  EXPECT_NE(error(kMap, head + "0,1,2\n1,one,2\n").find("data.csv:3: column 'y [mm]': 'one'"),
            std::string::npos);
  EXPECT_NE(error(kMap, head + "0,1,2\n0,1,2\n").find(":3: time does not grow"), std::string::npos);
  EXPECT_NE(error(kMap, head + "0,1,2\n1,1\n").find(":3: 2 cells; expected 3"), std::string::npos);
  EXPECT_NE(error(kMap, head + "0,nan,2\n").find("expected a number"), std::string::npos);
  EXPECT_NE(error(kMap, head + "0,1,2\n").find("less than two rows"), std::string::npos);
  EXPECT_NE(error("robot: r\nrate: 1\ncolumns: [{from: u, to: axis/warmth}]\n", "u\n1\n2\n")
                .find("axis/warmth: expected"),
            std::string::npos);
  EXPECT_NE(error("robot: r\nrate: 1\ncolums: []\n", "u\n1\n").find("columns"), std::string::npos);
}

}  // namespace
}  // namespace anthrob
