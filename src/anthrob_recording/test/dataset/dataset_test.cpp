// Recordings as folders of CSV files.
#include "anthrob_recording/dataset.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

#include "anthrob_core/errors.h"
#include "anthrob_core/testing/random.h"

namespace anthrob {
namespace {

class TemporaryFolder {
 public:
  TemporaryFolder() {
    static int count = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("anthrob_recording_" + std::to_string(getpid()) + "_" + std::to_string(count++));
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  std::string path() const { return path_.string(); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
  }

 private:
  std::filesystem::path path_;
};

const char* const kMeta = "robot: anthrob\nkind: trajectory\n";

TEST(Dataset, TimesAreExact) {
  EXPECT_EQ(time_text(0), "0.000");
  EXPECT_EQ(time_text(1500000000), "1.500");
  EXPECT_EQ(time_text(1), "0.000000001");
  EXPECT_EQ(time_text(-250000001), "-0.250000001");
  const TemporaryFolder folder;
  folder.write("meta.yaml", kMeta);
  folder.write("m.csv", "t,a/position\n1700000000.123456789,1\n1700000000.2,2\n1.7e9,3\n");
  EXPECT_THROW(Dataset::load(folder.path()), BadInput);  // goes back
  folder.write("m.csv", "t,a/position\n-1,0\n0.1,1\n1700000000.123456789,2\n");
  const Dataset data = Dataset::load(folder.path());
  EXPECT_EQ(data.tables[0].t[0], -1000000000);
  EXPECT_EQ(data.tables[0].t[1], 100000000);
  EXPECT_EQ(data.tables[0].t[2], 1700000000123456789);
}

TEST(Dataset, SaveAndLoadKeepEveryBit) {
  testing_support::Random random(3);
  Dataset data;
  data.meta.robot = "anthrob";
  data.meta.kind = "equilibrium";
  data.meta.rate = 200.0;
  data.meta.start = "given";
  data.meta.start_position = {{"biceps_brachii", 0.1234567890123}};
  data.meta.settle_s = 2.5;
  data.meta.other["notes"] = "drift: 1.5 deg\noperator: me\n";
  Table& table = data.table("muscles");
  table.column("a/force");
  table.column("a/mode");
  Column &force = table.columns[0], &modes = table.columns[1];
  for (int i = 0; i < 1000; ++i) {
    table.t.push_back(1700000000000000000 + Nanoseconds{5000001} * i);
    force.values.push_back(std::ldexp(random.uniform(-1, 1), random.integer(-300, 300)));
    force.present.push_back(random.integer(0, 3) > 0);
  }
  force.values[0] = std::numeric_limits<double>::infinity();
  force.values[1] = std::nan("");
  force.values[2] = -0.0;
  force.values[3] = std::numeric_limits<double>::denorm_min();
  for (int i = 0; i < 4; ++i) force.present[i] = 1;
  modes.values.assign(1000, 1.0);
  modes.present.assign(1000, 1);
  modes.values[7] = 77.0;  // not a word of the contract, but a value

  const TemporaryFolder folder;
  data.save(folder.path() + "/sub");
  const Dataset back = Dataset::load(folder.path() + "/sub");
  ASSERT_EQ(back.tables.size(), 1u);
  EXPECT_EQ(back.tables[0].t, data.tables[0].t);
  for (int i = 0; i < 1000; ++i) {
    ASSERT_EQ(back.tables[0].find("a/force")->present[i], force.present[i]);
    if (!force.present[i]) continue;
    const double x = force.values[i], y = back.tables[0].find("a/force")->values[i];
    EXPECT_TRUE(std::memcmp(&x, &y, sizeof(x)) == 0) << x << " " << y;
  }
  EXPECT_EQ(back.tables[0].find("a/mode")->values, modes.values);
  EXPECT_EQ(back.meta.robot, "anthrob");
  EXPECT_EQ(back.meta.kind, "equilibrium");
  EXPECT_EQ(back.meta.rate, 200.0);
  EXPECT_EQ(back.meta.start, "given");
  EXPECT_EQ(back.meta.start_position, data.meta.start_position);
  EXPECT_EQ(back.meta.settle_s, 2.5);
  EXPECT_EQ(back.meta.other.at("notes"), data.meta.other.at("notes"));
}

Dataset one_column(const std::string& table, const std::string& column) {
  Dataset data;
  data.table(table).t = {0, 1000000};
  data.table(table).columns.push_back({column, {0.5, 0.75}, {1, 1}});
  return data;
}

TEST(Dataset, ARecordingReplacesAnotherAsAWhole) {
  const TemporaryFolder folder;
  one_column("measured", "a/position").save(folder.path());
  one_column("joints", "a/position").save(folder.path());
  const Dataset back = Dataset::load(folder.path());
  ASSERT_EQ(back.tables.size(), 1u);
  EXPECT_EQ(back.tables[0].name, "joints");
}

TEST(Dataset, WhatIsNotOfARecordingStays) {
  const auto refused = [](const TemporaryFolder& folder, const std::string& file,
                          const std::string& before) {
    try {
      one_column("joints", "a/position").save(folder.path());
      ADD_FAILURE() << "saved";
    } catch (const BadInput& error) {
      EXPECT_NE(std::string(error.what()).find(file), std::string::npos) << error.what();
    }
    std::ifstream in(folder.path() + "/" + file);
    std::string line;
    std::getline(in, line);
    EXPECT_EQ(line, before);
  };
  const TemporaryFolder raw, mixed;
  raw.write("joints.csv", "time [ms];angle\n");
  refused(raw, "joints.csv", "time [ms];angle");
  one_column("joints", "a/position").save(mixed.path());
  mixed.write("raw.csv", "time [ms];angle\n");
  refused(mixed, "raw.csv", "time [ms];angle");
}

TEST(Dataset, AFailureToWriteOneTableReplacesNone) {
  const TemporaryFolder folder;
  one_column("joints", "a/position").save(folder.path());
  Dataset next = one_column("joints", "b/position");
  next.tables.push_back(one_column("muscles", "c/force").tables[0]);
  // Where the second table is to be completed there is a folder.
  const std::string part = folder.path() + "/muscles.csv.part" + std::to_string(getpid());
  std::filesystem::create_directories(part + "/x");
  EXPECT_THROW(next.save(folder.path()), std::runtime_error);
  std::filesystem::remove_all(part);
  EXPECT_NE(Dataset::load(folder.path()).tables[0].find("a/position"), nullptr);
}

TEST(Dataset, AColumnIsMeasuredOnce) {
  const TemporaryFolder folder;
  folder.write("meta.yaml", kMeta);
  folder.write("commands.csv", "t,a/mode,a/reference\n0,POSITION,1\n");
  folder.write("muscles.csv", "t,a/mode,a/reference,a/force\n0,POSITION,1,7\n");
  EXPECT_NO_THROW(Dataset::load(folder.path()));
  folder.write("more.csv", "t,a/force\n0,8\n");
  try {
    Dataset::load(folder.path());
    ADD_FAILURE() << "accepted";
  } catch (const BadInput& error) {
    EXPECT_NE(std::string(error.what()).find("'a/force' is in more.csv and in muscles.csv"),
              std::string::npos)
        << error.what();
  }
}

TEST(Dataset, BadOnesAreRefusedWithOneLine) {
  const struct {
    const char* csv;
    const char* expected;
  } cases[] = {
      {"", "m.csv: empty"},
      {"time,a/position\n0,1\n", "first column to be 't'"},
      {"t,a\n0,1\n", "column 'a'"},
      {"t,a/posture\n0,1\n", "a/posture"},
      {"t,a/position,a/position\n0,1,1\n", "twice"},
      {"t,a/position\n0,1\n0.1\n", "m.csv:3: 1 cells: expected 2"},
      {"t,a/position\n0,1,2\n", "m.csv:2: 3 cells"},
      {"t,a/position\nzero,1\n", "t: 'zero'"},
      {"t,a/position\n0,one\n", "a/position: 'one'"},
      {"t,a/mode\n0,PUSH\n", "a/mode: 'PUSH'"},
      {"t,a/position\n0.2,1\n0.1,1\n", "earlier"},
  };
  for (const auto& test : cases) {
    const TemporaryFolder folder;
    folder.write("meta.yaml", kMeta);
    folder.write("m.csv", test.csv);
    try {
      Dataset::load(folder.path());
      FAIL() << test.csv;
    } catch (const BadInput& error) {
      EXPECT_NE(std::string(error.what()).find(test.expected), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
  const TemporaryFolder folder;
  EXPECT_THROW(Dataset::load(folder.path()), BadInput);  // no meta.yaml
  folder.write("meta.yaml", kMeta);
  EXPECT_THROW(Dataset::load(folder.path()), BadInput);  // no csv
  folder.write("m.csv", "t,a/position\n0,1\n");
  for (const char* meta : {"kind: dance\n", "start: zero\n", "start: {reference: last}\n"}) {
    folder.write("meta.yaml", meta);
    EXPECT_THROW(Dataset::load(folder.path()), BadInput) << meta;
  }
  EXPECT_THROW(Dataset::load(folder.path() + "/nowhere"), BadInput);
}

TEST(Dataset, ALongerTimeThanIsCountedIsRefused) {
  const TemporaryFolder folder;
  folder.write("meta.yaml", kMeta);
  folder.write("m.csv", "t,a/position\n-4e9,1\n5e9,1\n");
  const Dataset long_one = Dataset::load(folder.path());
  EXPECT_EQ(long_one.end() - long_one.begin(), Nanoseconds{9000000000} * 1000000000);
  folder.write("n.csv", "t,b/position\n9e9,1\n");
  try {
    Dataset::load(folder.path());
    FAIL() << "accepted";
  } catch (const BadInput& error) {
    EXPECT_NE(std::string(error.what())
                  .find("times from -4000000000.000 to 9000000000.000 s: expected a recording "
                        "shorter than 9.2e9 s"),
              std::string::npos)
        << error.what();
  }
}

TEST(Dataset, NamesOfAnyKindComeBack) {
  const TemporaryFolder folder;
  Dataset data;
  data.meta.robot = "left arm: #2";
  data.meta.start = "given";
  data.meta.start_position = {{"a, b: {c}", 0.5}, {"#d", -1e-7}, {"plain", 2.0}};
  data.meta.other["what: #is"] = "this\n";
  data.meta.other_start["and: [this"] = "too\n";
  data.table("m").t = {0};
  data.table("m").columns.push_back({"a/position", {1.0}, {1}});
  data.save(folder.path());
  const DatasetMeta back = Dataset::load(folder.path()).meta;
  EXPECT_EQ(back.robot, data.meta.robot);
  EXPECT_EQ(back.start_position, data.meta.start_position);
  EXPECT_EQ(back.other, data.meta.other);
  EXPECT_EQ(back.other_start, data.meta.other_start);
  // Plain names stay plain.
  data.meta = DatasetMeta();
  data.meta.robot = "anthrob";
  data.meta.start = "given";
  EXPECT_NE(meta_text(data.meta).find("  reference: {}\n"), std::string::npos);
  data.meta.start_position = {{"a", 0.5}, {"b", 1e-7}};
  EXPECT_EQ(meta_text(data.meta).find("robot: anthrob\n"), 0u);
  EXPECT_NE(meta_text(data.meta).find("  reference: {a: 0.5, b: 1e-07}\n"), std::string::npos);
}

TEST(Dataset, UnwritableFolderIsReported) {
  Dataset data;
  data.table("m").t.push_back(0);
  EXPECT_THROW(data.save("/proc/nowhere"), std::runtime_error);
  EXPECT_THROW(data.require_place("/proc/nowhere"), std::runtime_error);
  const TemporaryFolder folder;
  data.require_place(folder.path() + "/new");
  EXPECT_THROW(data.require_place(folder.path() + "/out.bag"), BadInput);
  EXPECT_THROW(data.save(folder.path() + "/out.bag"), BadInput);
  EXPECT_FALSE(std::filesystem::exists(folder.path() + "/new"));
  folder.write("other.csv", "a,b\n1,2\n");
  EXPECT_THROW(data.require_place(folder.path()), BadInput);
}

TEST(Series, InterpolatesAndHolds) {
  const Series s{{0.0, 1.0, 2.0}, {5.0, 7.0, 3.0}};
  EXPECT_EQ(s.at(-1.0), 5.0);
  EXPECT_EQ(s.at(0.5), 6.0);
  EXPECT_EQ(s.at(9.0), 3.0);
  EXPECT_EQ(s.held_at(0.999), 5.0);
  EXPECT_EQ(s.held_at(1.0), 7.0);
  EXPECT_EQ(s.held_at(-5.0), 5.0);
  EXPECT_EQ(s.acting_at(-5.0), 5.0);
  EXPECT_EQ(s.acting_at(9.0), 3.0);
  const Series late{{0.2, 1.0}, {5.0, 7.0}};
  EXPECT_EQ(late.acting_at(0.0), 0.0);
  EXPECT_EQ(late.acting_at(0.2), 5.0);
  EXPECT_EQ(Series().acting_at(1.0), 0.0);
}

TEST(HeldSeries, SaysWhatTheSeriesHoldsAndWhenItChanges) {
  const Series s{{0.0, 1.0, 1.0, 2.0, 2.5}, {5.0, 7.0, 6.0, 3.0, 3.0}};
  const struct {
    double time;
    bool changed;
  } asked[] = {{-1.0, true}, {-0.5, false},  {0.0, true}, {0.9, false}, {1.0, true},
               {1.0, false}, {1.999, false}, {9.0, true}, {9.5, false}};
  HeldSeries held(s);
  for (const auto& [time, changed] : asked) {
    EXPECT_EQ(held.advance(time), changed) << time;
    EXPECT_EQ(held.value(), s.held_at(time)) << time;
  }
  EXPECT_TRUE(HeldSeries(s).advance(1.5));
}

TEST(Dataset, OtherKeysOfTheDescriptionAreKept) {
  const TemporaryFolder folder;
  folder.write("meta.yaml", std::string(kMeta) +
                                "sensors: {mocap: vicon}\noperators: [{name: me}]\nrings: [2]\n"
                                "place: lab 3\nnested: {a: {b: 1}, c: 2}\n");
  folder.write("m.csv", "t,a/position\n0,1\n1,2\n");
  const Dataset first = Dataset::load(folder.path());
  const TemporaryFolder copy;
  first.save(copy.path());
  const Dataset second = Dataset::load(copy.path());
  EXPECT_EQ(second.meta.other.size(), 5u);
  EXPECT_EQ(second.meta.other, first.meta.other);
  EXPECT_EQ(first.remarks.size(), 4u);  // sensors are known
  EXPECT_EQ(second.remarks.size(), 4u);
  EXPECT_EQ(first.remarks[0], folder.path() + "/meta.yaml: operators: unknown key, kept");
}

TEST(Dataset, NumbersOfTheModelComeBackOrAreRefused) {
  const TemporaryFolder folder;
  folder.write("m.csv", "t,a/position\n0,1\n1,2\n");
  folder.write("meta.yaml", std::string(kMeta) + "model: {effects.0.mass: 0.1, gravity.2: -3}\n");
  const Dataset first = Dataset::load(folder.path());
  EXPECT_TRUE(first.remarks.empty());
  EXPECT_EQ(first.meta.model,
            (std::map<std::string, double>{{"effects.0.mass", 0.1}, {"gravity.2", -3.0}}));
  const TemporaryFolder copy;
  first.save(copy.path());
  EXPECT_EQ(Dataset::load(copy.path()).meta.model, first.meta.model);
  for (const char* wrong : {"[1, 2]", "{a.b: heavy}", "{a: {b: 1}}", "{a: .nan}", "{a: .inf}"}) {
    folder.write("meta.yaml", std::string(kMeta) + "model: " + wrong + "\n");
    try {
      Dataset::load(folder.path());
      ADD_FAILURE() << wrong;
    } catch (const BadInput& error) {
      const std::string line = error.what();
      EXPECT_NE(line.find("meta.yaml"), std::string::npos) << line;
      EXPECT_NE(line.find("model"), std::string::npos) << line;
      EXPECT_EQ(line.find('\n'), std::string::npos);
    }
  }
}

TEST(Dataset, ANameOfAModelIsKeptAndMentioned) {
  const TemporaryFolder folder;
  folder.write("m.csv", "t,a/position\n0,1\n1,2\n");
  folder.write("meta.yaml", std::string(kMeta) + "model: I\n");
  const Dataset named = Dataset::load(folder.path());
  EXPECT_TRUE(named.meta.model.empty());
  EXPECT_EQ(named.meta.other.at("model"), "I\n");
  ASSERT_EQ(named.remarks.size(), 1u);
  EXPECT_NE(named.remarks[0].find("model: unknown key, kept"), std::string::npos);
}

TEST(Dataset, UnknownKeysOfTheStartAreKeptAndMentioned) {
  const TemporaryFolder folder;
  folder.write("meta.yaml",
               std::string(kMeta) +
                   "start: {refrence: zero, reference: {a: 0.5}, posture: [1, 2], settle_s: 2}\n");
  folder.write("m.csv", "t,a/position\n0,1\n1,2\n");
  const Dataset first = Dataset::load(folder.path());
  EXPECT_EQ(
      first.remarks,
      (std::vector<std::string>{
          folder.path() +
              "/meta.yaml: start.refrence: unknown key, kept; expected reference or settle_s",
          folder.path() +
              "/meta.yaml: start.posture: unknown key, kept; expected reference or settle_s"}));
  const TemporaryFolder copy;
  first.save(copy.path());
  const Dataset second = Dataset::load(copy.path());
  EXPECT_EQ(second.meta.other_start.at("refrence"), "zero\n");
  EXPECT_EQ(second.meta.other_start, first.meta.other_start);
  EXPECT_EQ(second.meta.start_position.at("a"), 0.5);
  EXPECT_EQ(second.meta.settle_s, 2.0);
  EXPECT_TRUE(second.meta.other.empty());
}

TEST(Dataset, WhatTheSuiteWritesItselfIsNoSurprise) {
  const TemporaryFolder folder;
  folder.write("meta.yaml", std::string(kMeta) +
                                "rate: 200\nstart: {reference: zero, settle_s: 1}\nnotes: none\n"
                                "frame_id_muscles: base\nposture: E3\nspecimen: {number: 1}\n"
                                "simulated_by: anthrob_replay\nlargest_gap: 0.005\n");
  folder.write("m.csv", "t,a/position\n0,1\n1,2\n");
  EXPECT_TRUE(Dataset::load(folder.path()).remarks.empty());
}

TEST(Dataset, ByteOrderMarksOfSpreadsheetsAreNoPartOfAName) {
  const TemporaryFolder folder;
  folder.write("meta.yaml", kMeta);
  folder.write("m.csv", "\xef\xbb\xbft,a/position\r\n0,1\r\n1,2\r\n");
  EXPECT_EQ(Dataset::load(folder.path()).series("a/position").values, std::vector<double>({1, 2}));
}

}  // namespace
}  // namespace anthrob
