// Which column of a dataset folder goes to which topic of a bag.
#include "dataset/topic_tables.h"

#include <gtest/gtest.h>

namespace anthrob {
namespace {

using Names = std::vector<std::string>;

/// Two rows; a column whose name ends in '?' has a cell in the second one only.
void add(Dataset& data, const std::string& table, const Names& columns) {
  Table& made = data.table(table);
  made.t = {0, 5000000};
  for (const std::string& column : columns) {
    const bool late = column.back() == '?';
    made.columns.push_back({late ? column.substr(0, column.size() - 1) : column,
                            {0.25, 0.5},
                            {static_cast<char>(!late), 1}});
  }
}

/// "commands: flexor/reference" for each table
Names dealt(const TopicTables& topics) {
  Names lines;
  for (const Table& table : topics.tables) {
    lines.push_back(table.name + ":");
    for (const Column& column : table.columns) lines.back() += " " + column.name;
  }
  return lines;
}

TEST(TopicTables, ABagsFolderStaysWhatItWas) {
  Dataset data;
  // Names as of a robot that publishes its motors as joints.
  add(data, "commands", {"flexor/mode", "flexor/reference?"});
  add(data, "joints", {"flexor/position", "elbow/effort"});
  add(data, "muscles", {"elbow/position"});
  add(data, "spherical_joints", {});
  const TopicTables topics = topic_tables(data);
  EXPECT_EQ(dealt(topics),
            (Names{"commands: flexor/mode flexor/reference", "joints: flexor/position elbow/effort",
                   "muscles: elbow/position", "spherical_joints:"}));
  for (const Table& table : topics.tables) EXPECT_EQ(table.t.size(), 2u) << table.name;
  EXPECT_TRUE(topics.not_carried.empty());
  EXPECT_TRUE(topics.remarks.empty());
}

TEST(TopicTables, ColumnsOutOfPlaceGoByWhatTheyAre) {
  Dataset data;
  add(data, "joints", {"shoulder/w", "shoulder/x", "shoulder/y", "shoulder/z"});
  add(data, "commands", {"flexor/reference", "flexor/position?"});
  const TopicTables topics = topic_tables(data);
  EXPECT_EQ(dealt(topics), (Names{"spherical_joints: shoulder/w shoulder/x shoulder/y shoulder/z",
                                  "commands: flexor/reference", "muscles: flexor/position"}));
  EXPECT_EQ(topics.tables[2].t, (std::vector<Nanoseconds>{5000000}));  // no message says nothing
  EXPECT_EQ(topics.tables[2].columns[0].values, (std::vector<double>{0.5}));
  ASSERT_EQ(topics.remarks.size(), 2u);
  EXPECT_EQ(topics.remarks[1],
            "commands.csv: flexor/position: written to the topic of muscles.csv");
}

TEST(TopicTables, AJointAmongMusclesIsAJoint) {
  Dataset data;
  add(data, "muscles", {"flexor/position", "flexor/force", "elbow/position", "elbow/velocity"});
  const TopicTables topics = topic_tables(data);
  EXPECT_EQ(dealt(topics), (Names{"joints: elbow/position elbow/velocity",
                                  "muscles: flexor/position flexor/force"}));
  ASSERT_EQ(topics.remarks.size(), 2u);
  EXPECT_NE(topics.remarks[0].find("muscles.csv: elbow: has only positions or velocities"),
            std::string::npos);
  // A muscle of which another file tells more stays one: its rows are refused by write_bag().
  add(data, "commands", {"elbow/reference"});
  EXPECT_EQ(dealt(topic_tables(data))[0],
            "muscles: flexor/position flexor/force elbow/position elbow/velocity");
}

TEST(TopicTables, OtherFilesAreDealtOut) {
  Dataset data;
  add(data, "rig",
      {"flexor/force", "flexor/position", "elbow/position", "elbow/effort", "ball/wx"});
  add(data, "inputs", {"flexor/reference?"});
  EXPECT_EQ(dealt(topic_tables(data)),
            (Names{"joints: elbow/position elbow/effort", "muscles: flexor/force flexor/position",
                   "spherical_joints: ball/wx", "commands: flexor/reference"}));
  EXPECT_EQ(topic_tables(data).tables[3].t.size(), 1u);
}

TEST(TopicTables, NoTopicHasLoads) {
  Dataset data;
  add(data, "joints", {"elbow/position?", "elbow/load"});
  const TopicTables topics = topic_tables(data);
  EXPECT_EQ(dealt(topics), (Names{"joints: elbow/position"}));
  EXPECT_EQ(topics.tables[0].t.size(), 1u);
  EXPECT_EQ(topics.not_carried, (Names{"joints.csv: elbow/load"}));
}

}  // namespace
}  // namespace anthrob
