#include "foreign/foreign_csv.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "anthrob_core/errors.h"
#include "anthrob_recording/bag.h"

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
  EXPECT_EQ(dataset.meta.settle_s, DatasetMeta().settle_s);  // unless the map says otherwise
  EXPECT_EQ(dataset.tables.size(), 1u);
}

TEST_F(ForeignCsv, SurvivesTheFolderBitForBit) {
  const Dataset dataset = read(kMap, "t [ms],y [mm],u\n0,0.1,3\n1,0.7,4\n2,1e-7,5\n");
  dataset.save((folder_ / "out").string());
  const Dataset back = Dataset::load((folder_ / "out").string());
  EXPECT_EQ(back.series("axis/position").values, dataset.series("axis/position").values);
  EXPECT_EQ(back.series("axis/effort").t, dataset.series("axis/effort").t);
}

TEST_F(ForeignCsv, MayKnowNumbersOfTheModel) {
  const std::string csv = "t [ms],y [mm],u\n0,0.1,3\n1,0.7,4\n";
  EXPECT_EQ(read(kMap + "model: {effects.0.mass: 1.3}\n", csv).meta.model,
            (std::map<std::string, double>{{"effects.0.mass", 1.3}}));
  const std::string wrong = error(kMap + "model: {effects.0.mass: heavy}\n", csv);
  EXPECT_NE(wrong.find("map.yaml:6: model.effects.0.mass: heavy: expected"), std::string::npos)
      << wrong;
}

TEST_F(ForeignCsv, RowsMayBeEvenlySpaced) {
  const Dataset dataset =
      read("robot: r\nrate: 400\nseparator: ;\ncolumns: [{from: f, to: flexor/force}]\n",
           "f;g\n1;2\n3;4\n5;6\n");
  EXPECT_EQ(dataset.series("flexor/force").t, (std::vector<double>{0.0, 0.0025, 0.005}));
  EXPECT_EQ(dataset.tables.front().name, "muscles");
  EXPECT_EQ(dataset.meta.rate, 400.0);
}

TEST_F(ForeignCsv, AnEmptyRowIsRefusedWhereRowsAreTime) {
  const std::string rate = "robot: r\nrate: 100\ncolumns: [{from: f, to: flexor/force}]\n";
  EXPECT_NE(error(rate, "f\n1\n\n\n3\n").find("data.csv:3: an empty row"), std::string::npos)
      << error(rate, "f\n1\n\n\n3\n");
  EXPECT_EQ(error(rate, "f\n1\n3\n\n\n"), "no error");
  EXPECT_EQ(error("robot: r\ntime: {column: t}\ncolumns: [{from: f, to: flexor/force}]\n",
                  "t,f\n1,1\n\n3,3\n"),
            "no error");
}

TEST(ForeignOrientation, EulerAnglesAreIntrinsic) {
  const auto expect = [](const std::string& order, const Eigen::Vector3d& degrees, double w,
                         double x, double y, double z) {
    const Eigen::Quaterniond q = from_euler(order, degrees * (M_PI / 180.0));
    EXPECT_LT((q.coeffs() - Eigen::Vector4d(x, y, z, w)).norm(), 1e-15)
        << order << " " << degrees.transpose() << ": " << q.coeffs().transpose();
  };
  const double half = std::sqrt(0.5);
  expect("xyz", {90.0, 0.0, 0.0}, half, half, 0.0, 0.0);
  expect("xyz", {90.0, 90.0, 0.0}, 0.5, 0.5, 0.5, 0.5);  // extrinsic: z -0.5
  expect("yxz", {90.0, 90.0, 0.0}, 0.5, 0.5, 0.5, -0.5);
  expect("zxz", {30.0, 0.0, 60.0}, half, 0.0, 0.0, half);
  expect("zyx", {270.0, 0.0, 0.0}, half, 0.0, 0.0, -half);  // the one with w >= 0
  // The matrix as books have it for x, y', z''.
  const double a = 0.3, b = -0.7, c = 1.9;
  const Eigen::Matrix3d R = from_euler("xyz", {a, b, c}).toRotationMatrix();
  EXPECT_NEAR(R(0, 2), std::sin(b), 1e-15);
  EXPECT_NEAR(R(1, 2), -std::sin(a) * std::cos(b), 1e-15);
  EXPECT_NEAR(R(2, 2), std::cos(a) * std::cos(b), 1e-15);
  EXPECT_NEAR(R(0, 1), -std::cos(b) * std::sin(c), 1e-15);
  EXPECT_NEAR(R(0, 0), std::cos(b) * std::cos(c), 1e-15);
}

TEST(ForeignOrientation, RotationVectorsAreAxisTimesAngle) {
  const double turn = M_PI / 3.0;
  const Eigen::Quaterniond q = from_rotation_vector({0.0, 0.6 * turn, -0.8 * turn});
  EXPECT_LT((q.coeffs() - Eigen::Vector4d(0.0, 0.3, -0.4, std::sqrt(0.75))).norm(), 1e-15);
  EXPECT_EQ(from_rotation_vector(Eigen::Vector3d::Zero()).w(), 1.0);
  const Eigen::Quaterniond small = from_rotation_vector({1e-200, 0.0, 0.0});
  EXPECT_EQ(small.w(), 1.0);
  EXPECT_NEAR(small.x(), 5e-201, 1e-215);
  const Eigen::Quaterniond far = from_rotation_vector({1.5 * M_PI, 0.0, 0.0});
  EXPECT_NEAR(far.x(), -std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(far.w(), std::sqrt(0.5), 1e-15);
}

const std::string kMuscleMap =
    "robot: my_robot\n"
    "rate: 100\n"
    "mode: {flexor: FORCE, extensor: CURRENT}\n"
    "columns:\n"
    "  - {from: F, to: flexor/reference}\n"
    "  - {from: I, to: extensor/reference}\n"
    "  - {from: enc, to: flexor/position, scale: 0.5}\n"
    "  - {from: elbow, to: elbow/position}\n"
    "  - {to: shoulder, euler: {from: [roll, pitch, yaw], order: xyz, unit: deg}}\n"
    "  - {to: hip, rotation_vector: {from: [rx, ry, rz]}}\n";
const std::string kMuscleData =
    "F,I,enc,elbow,roll,pitch,yaw,rx,ry,rz\n"
    "20,1.5,3,0.1,90,0,0,0.1,0.2,0.3\n"
    ",1.5,4,0.2,0,90,,0.1,0.2,0.4\n"
    "25,1,5,0.3,0,0,180,0,0,0\n";

TEST_F(ForeignCsv, MuscleRobotsSurviveTheFolderAndTheBag) {
  const Dataset dataset = read(kMuscleMap, kMuscleData);
  dataset.save((folder_ / "set").string());
  const std::string bag = (folder_ / "a.bag").string();
  const BagRemarks said = write_bag(Dataset::load((folder_ / "set").string()), bag);
  EXPECT_TRUE(said.not_carried.empty());
  EXPECT_TRUE(said.remarks.empty());
  const Dataset back = read_bag(bag).dataset;
  for (const char* table : {"commands", "muscles", "joints", "spherical_joints"}) {
    EXPECT_NE(back.find_table(table), nullptr) << table;
  }
  for (const Dataset* data : {&dataset, &back}) {
    EXPECT_EQ(data->series("flexor/mode").values, (std::vector<double>{3, 3}));
    EXPECT_EQ(data->series("flexor/reference").values, (std::vector<double>{20, 25}));
    EXPECT_EQ(data->series("extensor/mode").values, (std::vector<double>{2, 2, 2}));
    EXPECT_NE(data->find_table("muscles")->find("flexor/position"), nullptr);
    EXPECT_NE(data->find_table("joints")->find("elbow/position"), nullptr);
    const Series w = data->series("shoulder/w"), z = data->series("shoulder/z");
    ASSERT_EQ(w.t, (std::vector<double>{0.0, 0.02}));  // the second lacks an angle
    EXPECT_NEAR(w.values[0], std::sqrt(0.5), 1e-15);
    EXPECT_NEAR(z.values[1], 1.0, 1e-15);
  }
  for (const char* column : {"hip/w", "hip/x", "hip/y", "hip/z", "shoulder/x"}) {
    EXPECT_EQ(back.series(column).values, dataset.series(column).values) << column;
  }
}

TEST_F(ForeignCsv, WhereTheMotorsStoodBefore) {
  const auto meta = [&](const std::string& start) {
    const Dataset dataset = read(
        "robot: r\nrate: 10\n" + start + "columns: [{from: a, to: a/reference}]\n", "a\n1\n2\n");
    dataset.save((folder_ / "out").string());
    return Dataset::load((folder_ / "out").string()).meta;
  };
  EXPECT_EQ(meta("").start, "first");
  EXPECT_EQ(meta("start: zero\n").start, "zero");
  const DatasetMeta given = meta("start: {a: 0.5}\n");
  EXPECT_EQ(given.start, "given");
  EXPECT_EQ(given.start_position.at("a"), 0.5);
  EXPECT_NE(
      error("robot: r\nrate: 10\nstart: last\ncolumns: [{from: a, to: a/reference}]\n", "a\n1\n")
          .find("start: last: expected first, zero or {muscle: rad}"),
      std::string::npos);
}

TEST_F(ForeignCsv, OneModeForAll) {
  const Dataset dataset = read(
      "robot: r\nrate: 10\nmode: FORCE\ncolumns: [{from: a, to: a/reference}, {from: b, to: "
      "b/reference}]\n",
      "a,b\n1,2\n3,4\n");
  EXPECT_EQ(dataset.series("a/mode").values, (std::vector<double>{3, 3}));
  EXPECT_EQ(dataset.series("b/mode").values, (std::vector<double>{3, 3}));
}

TEST_F(ForeignCsv, WhatIsWrongWithModesAndAnglesIsSaid) {
  const auto expect = [&](const std::string& from, const std::string& to, const std::string& said) {
    std::string map = kMuscleMap;
    map.replace(map.find(from), from.size(), to);
    EXPECT_NE(error(map, kMuscleData).find(said), std::string::npos)
        << to << ": " << error(map, kMuscleData);
  };
  expect("order: xyz", "order: xxy", "euler.order: xxy: expected three of x, y and z");
  expect("unit: deg", "unit: turns", "euler.unit: turns: expected rad or deg");
  expect("[roll, pitch, yaw]", "[roll, pitch]", "euler.from: expected three columns");
  expect("to: shoulder", "to: shoulder/w", "expected the name of a ball joint");
  expect("to: hip", "to: shoulder", "used twice");
  expect("flexor: FORCE", "flexor: PUSH", "mode.flexor: PUSH: expected VOLTAGE, POSITION");
  expect("flexor: FORCE", "flexor: 3", "expected VOLTAGE, POSITION");
  expect("flexor: FORCE", "biceps: FORCE", "mode.biceps: no column has to: biceps/reference");
  expect("yaw]", "jaw]", "column 'jaw' is not in");
}

TEST_F(ForeignCsv, TextOfOtherProgramsIsRefusedWithTheReason) {
  const std::string rows = "t [ms],y [mm],u\n0,1,2\n1,2,3\n";
  std::string old_mac = rows, utf16 = "\xff\xfe";
  for (char& c : old_mac) c = c == '\n' ? '\r' : c;
  for (const char c : rows) utf16 += std::string{c, '\0'};
  EXPECT_NE(error(kMap, old_mac).find("data.csv:1: lines end with CR alone, as on old Macs"),
            std::string::npos);
  EXPECT_NE(error(kMap, utf16).find("data.csv:1: not text in UTF-8"), std::string::npos);
  EXPECT_NE(error(kMap, "t [ms],\"y\n[mm]\",u\n0,1,2\n1,2,3\n")
                .find("data.csv:1: a quote that has no end in its line"),
            std::string::npos);
  EXPECT_NE(error(kMap, "t [ms],y [mm],u\n0,\"1,2\n1,2,3\n")
                .find("data.csv:2: a quote that has no end in its line"),
            std::string::npos);
  // Those of Windows are read.
  EXPECT_EQ(error(kMap, "t [ms],y [mm],u\r\n0,1,2\r\n1,2,3\r\n"), "no error");
}

TEST_F(ForeignCsv, WhatIsWrongIsSaidInOneLine) {
  const std::string head = "t [ms],y [mm],u\n";
  EXPECT_NE(error(kMap, "t [ms],y [mm]\n0,1\n").find("column 'u' is not in"), std::string::npos);
  EXPECT_NE(error(kMap, "t [ms],y [mm],u,u\n0,1,2,3\n").find("column 'u' appears twice"),
            std::string::npos);
  EXPECT_NE(error(kMap, head + "0,1,2\n1,one,2\n").find("data.csv:3: column 'y [mm]': 'one'"),
            std::string::npos);
  EXPECT_NE(error(kMap, head + "0,1,2\n0,1,2\n").find(":3: time does not increase"),
            std::string::npos);
  EXPECT_NE(error(kMap, head + "1.7e15,1,2\n1.8e15,1,2\n")
                .find(":2: time 1.7e+12 s: expected at most 9e9 s; is it in another unit?"),
            std::string::npos);
  EXPECT_NE(error(kMap, head + "0,1,2\n1,1\n").find(":3: 2 cells; expected 3"), std::string::npos);
  EXPECT_NE(error(kMap, head + "0,nan,2\n").find("expected a number"), std::string::npos);
  EXPECT_NE(error(kMap, head + "0,1,2\n").find("fewer than two rows"), std::string::npos);
  EXPECT_NE(error("robot: r\nrate: 1\ncolumns: [{from: u, to: axis/warmth}]\n", "u\n1\n2\n")
                .find("axis/warmth: expected"),
            std::string::npos);
  for (const char* table : {"../evil", "sub/x", "muscles.csv", "' '", "a b"}) {
    const std::string map = std::string(", table: ") + table + "}]\n";
    const std::string expected = "expected a name of letters, digits, _ and -";
    EXPECT_NE(error("robot: r\nrate: 1\ncolumns: [{from: u, to: axis/position" + map, "u\n1\n2\n")
                  .find(expected),
              std::string::npos)
        << table;
    EXPECT_NE(
        error("robot: r\nrate: 1\ncolumns: [{to: hip, rotation_vector: {from: [u, u, u]}" + map,
              "u\n1\n2\n")
            .find(expected),
        std::string::npos)
        << table;
  }
  EXPECT_NE(error("robot: r\nrate: 1\ncolums: []\n", "u\n1\n").find("columns"), std::string::npos);
}

const std::string kDriveMap =
    "robot: screw\nseparator: \";\"\nheader: 3\nskip: 1\n"
    "time: {place: 1, scale: 0.001}\n"
    "columns:\n"
    "  - {from: Velocity, to: screw/velocity, scale: 0.1}\n"
    "  - {from: {integral: {column: Velocity, scale: 0.1}}, to: screw/position}\n"
    "  - {from: \"Torque, averaged\", to: screw/effort, scale: 9.84e-5}\n";
const std::string kDriveData =
    "Date:;2020-07-08;\"Firmware:;0x0120\"\n\"Sampling period:\";40.000\n"
    ";Velocity;\"Torque, averaged\"\nms;rpm;%\n0.000;0;0.0\n40.000;10;-25.5\n80.000;30;1\n";

TEST_F(ForeignCsv, FilesAsProgramsOfDrivesWriteThem) {
  const Dataset dataset = read(kDriveMap, kDriveData);
  EXPECT_EQ(dataset.series("screw/velocity").values, (std::vector<double>{0.0, 1.0, 3.0}));
  const Series position = dataset.series("screw/position");
  EXPECT_EQ(position.t, (std::vector<double>{0.0, 0.04, 0.08}));
  EXPECT_NEAR(position.values[2], 0.02 * 1.0 + 0.02 * 4.0, 1e-15);
  EXPECT_EQ(dataset.series("screw/effort").values[1], 9.84e-5 * -25.5);

  const auto expect = [&](const std::string& from, const std::string& to, const std::string& said) {
    std::string map = kDriveMap;
    map.replace(map.find(from), from.size(), to);
    EXPECT_NE(error(map, kDriveData).find(said), std::string::npos) << error(map, kDriveData);
  };
  expect("header: 3\n", "", "data.csv:1, but in line 3; expected header: 3?");
  expect("header: 3", "header: 300", "has 7 lines; expected one that names columns");
  expect("skip: 1\n", "", "data.csv:4: column 1: 'ms': expected a number; a row of units?");
  expect("separator: \";\"\n", "", "(is separator: \";\" missing?)");
}

TEST_F(ForeignCsv, CommasMayBePoints) {
  const std::string map =
      "robot: r\nrate: 10\nheader: 0\nseparator: \";\"\ndecimal: \",\"\n"
      "columns: [{from: {place: 2}, to: j/position}]\n";
  const Dataset dataset = read(map, "1;2,5\n3;-4,25e1\n");
  EXPECT_EQ(dataset.series("j/position").values, (std::vector<double>{2.5, -42.5}));
  EXPECT_NE(error(map, "1;2.5\n3;4\n").find("'2.5': expected a number"), std::string::npos);
  EXPECT_NE(error("robot: r\nrate: 10\nseparator: ;\ncolumns: [{from: a, to: j/position}]\n",
                  "a;b\n1;2\n1,5;2\n")
                .find("is decimal: \",\" missing?"),
            std::string::npos);
  EXPECT_NE(
      error("robot: r\nrate: 10\ndecimal: \",\"\ncolumns: [{from: a, to: j/position}]\n", "a\n")
          .find("decimal: ,: expected another character than the separator"),
      std::string::npos);
}

const std::string kStreams =
    "robot: r\n"
    "streams:\n"
    "  encoder: {file: encoder.csv, rate: 100, columns: [{from: q, to: j/position}]}\n"
    "  torque:\n"
    "    file: torque.csv\n"
    "    time: {column: t, offset: 0.001}\n"
    "    columns: [{from: u, to: j/effort}, {from: u, to: j/velocity}]\n";

TEST_F(ForeignCsv, StreamsKeepTheirClocksOrGetOneTimeBase) {
  write("encoder.csv", "q\n0\n1\n2\n3\n");
  write("torque.csv", "t,u\n0,5\n0.013,6\n0.02,7\n");
  const auto of = [&](const std::string& map) {
    return read_foreign_csv(folder_.string(), ForeignColumns::load(write("map.yaml", map)));
  };
  Dataset dataset = of(kStreams);
  ASSERT_NE(dataset.find_table("joints_encoder"), nullptr);
  ASSERT_NE(dataset.find_table("joints_torque"), nullptr);
  EXPECT_EQ(dataset.find_table("joints_torque")->t[1], 14000000);
  EXPECT_EQ(dataset.find_table("joints_encoder")->t[1], 10000000);
  dataset = of(kStreams + "rows: 200\n");
  ASSERT_EQ(dataset.tables.size(), 1u);
  EXPECT_EQ(dataset.tables.front().name, "joints");
  EXPECT_EQ(dataset.tables.front().t.size(), 7u);
  EXPECT_EQ(dataset.tables.front().find("j/position")->present,
            (std::vector<char>{1, 0, 1, 0, 1, 0, 1}));
  EXPECT_EQ(dataset.series("j/position").values, (std::vector<double>{0, 1, 2, 3}));
  EXPECT_EQ(dataset.meta.rate, 200.0);
}

TEST_F(ForeignCsv, WhatIsWrongWithStreamsAndPiecesIsSaid) {
  write("encoder.csv", "q\n0\n1\n2\n3\n");
  write("torque.csv", "t,u\n0,5\n0.013,6\n0.02,7\n");
  const auto expect = [&](const std::string& from, const std::string& to, const std::string& said) {
    std::string map = kStreams, what = "no error";
    map.replace(map.find(from), from.size(), to);
    try {
      read_foreign_csv(folder_.string(), ForeignColumns::load(write("map.yaml", map)));
    } catch (const BadInput& bad) {
      what = bad.what();
    }
    EXPECT_NE(what.find(said), std::string::npos) << what;
  };
  expect("torque.csv", "nowhere.csv", "nowhere.csv: cannot be read");
  expect("to: j/velocity", "to: j/position", "streams.torque.columns.1.to: used twice");
  expect("robot: r\n", "robot: r\nrate: 5\n", "rate: beside 'streams': expected it in each");
  expect("  torque:", "  Torque:", "streams.Torque: expected a lower-case name");
  expect("offset: 0.001", "offset: 1000", "not synchronised with the other files");
  expect("robot: r\n", "robot: r\nsplit: {train: [3, 1]}\n", "split.train: expected [from, to]");
  expect("robot: r\n", "robot: r\nsplit: {}\n", "split: expected {name: [from, to], ...}");
  EXPECT_NE(error(kStreams, "q\n1\n2\n").find("expected the folder of the files that 'streams'"),
            std::string::npos);
  EXPECT_NE(
      error("robot: r\nrate: 5\nrows: 5\ncolumns: [{from: a, to: base/force_x}]\n", "a\n1\n2\n")
          .find("rows: beside base/force_x: expected pushes with times of their own"),
      std::string::npos);
}

}  // namespace
}  // namespace anthrob
