// bag -> dataset folder -> bag keeps every value and stamp of the five topics, bit for bit.
#include <anthrob_msgs/ExternalWrenches.h>
#include <anthrob_msgs/MuscleCommand.h>
#include <anthrob_msgs/MuscleStates.h>
#include <anthrob_msgs/SphericalJointStates.h>
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/JointState.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

#include "anthrob_core/errors.h"
#include "anthrob_recording/bag.h"

namespace anthrob {
namespace {

std::mt19937_64 engine(1);

double any_double() {
  const int exponent = std::uniform_int_distribution<int>(-300, 300)(engine);
  return std::ldexp(std::uniform_real_distribution<double>(-1, 1)(engine), exponent);
}

std::vector<double> any_doubles(std::size_t n) {
  std::vector<double> list(n);
  for (double& x : list) x = any_double();
  return list;
}

class Folder {
 public:
  Folder()
      : path_(std::filesystem::temp_directory_path() /
              ("anthrob_convert_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

const std::vector<std::string> kMuscles = {"lateral_deltoid", "biceps_brachii", "brachialis"};

void write_original(const std::string& file) {
  rosbag::Bag bag(file, rosbag::bagmode::Write);
  for (int i = 0; i < 400; ++i) {
    const ros::Time stamp(1700000000 + i / 200, (i % 200) * 5000000 + 123);
    const ros::Time arrival = stamp + ros::Duration(0, 777 + i % 13);
    anthrob_msgs::MuscleStates states;
    states.header.stamp = stamp;
    states.header.frame_id = "base";
    states.name = kMuscles;
    states.position = any_doubles(3), states.velocity = any_doubles(3),
    states.current = any_doubles(3);
    states.voltage = any_doubles(3), states.reference = any_doubles(3);
    if (i % 2) states.force = any_doubles(3);  // not measured in every message
    states.mode = {1, 1, static_cast<std::uint8_t>(i % 4)};
    states.ecu_state = {2, 3, static_cast<std::uint8_t>(i % 5)};
    if (i == 5) states.position[1] = std::nan("");
    if (i == 6) states.position[1] = -INFINITY;
    if (i == 7) states.mode[0] = 200;
    bag.write("/anthrob/muscle_states", arrival, states);

    sensor_msgs::JointState joints;
    joints.header.stamp = stamp;
    joints.name = {"elbow"};
    joints.position = any_doubles(1), joints.velocity = any_doubles(1);
    bag.write("/anthrob/joint_states", stamp, joints);

    anthrob_msgs::SphericalJointStates balls;
    balls.header.stamp = stamp;
    if (i % 3) {  // sometimes not seen
      balls.name = {"shoulder"};
      balls.orientation.resize(1);
      balls.orientation[0].w = any_double(), balls.orientation[0].x = any_double();
      balls.orientation[0].y = any_double(), balls.orientation[0].z = any_double();
      balls.angular_velocity.resize(1);
      balls.angular_velocity[0].x = any_double(), balls.angular_velocity[0].y = any_double();
      balls.angular_velocity[0].z = -0.0;
    }
    bag.write("/anthrob/spherical_joint_states", arrival, balls);

    if (i >= 100 && i <= 110) {
      anthrob_msgs::ExternalWrenches pushes;
      pushes.header.stamp = stamp;
      if (i < 110) pushes.link = {"forearm", "forearm", "humerus"};  // then they end
      for (std::size_t k = 0; k < pushes.link.size(); ++k) {
        pushes.point.emplace_back().z = any_double();
        pushes.wrench.emplace_back().force.x = any_double();
        pushes.wrench.back().torque.y = any_double();
        pushes.left.emplace_back(0.0);
      }
      bag.write("/anthrob/external_wrenches", arrival, pushes);
    }

    if (i % 50 == 0) {
      anthrob_msgs::MuscleCommand command;
      if (i % 100 == 0) command.header.stamp = stamp;  // rostopic pub leaves the stamp at zero
      command.name = {kMuscles[static_cast<std::size_t>(i / 50) % 3]};
      command.mode = {static_cast<std::uint8_t>(i / 50 % 4)};
      command.reference = any_doubles(1);
      bag.write("/anthrob/muscle_command", arrival, command);
    }
  }
}

template <class Message>
std::vector<std::pair<ros::Time, Message>> messages(const std::string& file,
                                                    const std::string& topic) {
  rosbag::Bag bag(file, rosbag::bagmode::Read);
  std::vector<std::pair<ros::Time, Message>> list;
  for (const auto& instance : rosbag::View(bag, rosbag::TopicQuery(topic))) {
    list.emplace_back(instance.getTime(), *instance.instantiate<Message>());
    list.back().second.header.seq = 0;  // counted anew by every publisher
  }
  return list;
}

template <class Message>
std::string bytes(const Message& message) {
  std::string buffer(ros::serialization::serializationLength(message), '\0');
  ros::serialization::OStream stream(reinterpret_cast<std::uint8_t*>(&buffer[0]), buffer.size());
  ros::serialization::serialize(stream, message);
  return buffer;
}

template <class Message>
void expect_same(const std::string& a, const std::string& b, const std::string& topic,
                 std::size_t count) {
  const auto one = messages<Message>(a, topic), two = messages<Message>(b, topic);
  ASSERT_EQ(one.size(), count) << topic;
  ASSERT_EQ(two.size(), count) << topic;
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_EQ(one[i].first, two[i].first) << topic << " " << i;
    EXPECT_EQ(bytes(one[i].second), bytes(two[i].second)) << topic << " " << i;
  }
}

TEST(Convert, BagToFolderToBagIsBitForBit) {
  const Folder folder;
  write_original(folder / "a.bag");
  const BagContents contents = read_bag(folder / "a.bag");
  EXPECT_TRUE(contents.not_carried.empty());
  EXPECT_EQ(contents.dataset.meta.robot, "anthrob");
  contents.dataset.save(folder / "set");
  for (const char* name : {"muscles", "commands", "joints", "spherical_joints", "wrenches"}) {
    EXPECT_TRUE(std::filesystem::exists(folder / ("set/" + std::string(name) + ".csv"))) << name;
  }
  write_bag(Dataset::load(folder / "set"), folder / "b.bag");
  expect_same<anthrob_msgs::MuscleStates>(folder / "a.bag", folder / "b.bag",
                                          "/anthrob/muscle_states", 400);
  expect_same<sensor_msgs::JointState>(folder / "a.bag", folder / "b.bag", "/anthrob/joint_states",
                                       400);
  expect_same<anthrob_msgs::SphericalJointStates>(folder / "a.bag", folder / "b.bag",
                                                  "/anthrob/spherical_joint_states", 400);
  expect_same<anthrob_msgs::MuscleCommand>(folder / "a.bag", folder / "b.bag",
                                           "/anthrob/muscle_command", 8);
  expect_same<anthrob_msgs::ExternalWrenches>(folder / "a.bag", folder / "b.bag",
                                              "/anthrob/external_wrenches", 11);
}

TEST(Convert, ReplacesOnlyRecordings) {
  const Folder folder;
  write_original(folder / "a.bag");
  const Dataset dataset = read_bag(folder / "a.bag").dataset;
  write_bag(dataset, folder / "b.bag");
  write_bag(dataset, folder / "b.bag");
  const auto expect_refused = [&](const std::string& expected) {
    try {
      write_bag(dataset, folder / "b.bag");
      ADD_FAILURE() << "replaced: " << expected;
    } catch (const BadInput& error) {
      EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
    }
  };
  {
    rosbag::Bag bag(folder / "b.bag", rosbag::bagmode::Append);
    sensor_msgs::JointState weather;
    bag.write("/weather", ros::Time(1.0), weather);
  }
  expect_refused("b.bag: holds /weather, which would be lost");
  std::ofstream(folder / "b.bag") << "a letter";
  expect_refused("b.bag: is no bag");
  std::filesystem::remove(folder / "b.bag");
  std::ofstream(folder / "b.yaml") << "robot: arm\nmuscles: []\n";
  expect_refused("b.yaml: is no description of a recording");
  EXPECT_FALSE(std::filesystem::exists(folder / "b.bag"));
}

TEST(Convert, SaysWhatItDoesNotCarry) {
  const Folder folder;
  write_original(folder / "a.bag");
  {
    rosbag::Bag bag(folder / "a.bag", rosbag::bagmode::Append);
    anthrob_msgs::MuscleCommand malformed;
    malformed.name = {"biceps_brachii"};
    bag.write("/anthrob/muscle_command", ros::Time(1700000001), malformed);
    bag.write("/anthrob/touch", ros::Time(1700000001), sensor_msgs::JointState());
  }
  const BagContents contents = read_bag(folder / "a.bag");
  ASSERT_EQ(contents.not_carried.size(), 2u);
  EXPECT_NE(contents.not_carried[0].find("touch"), std::string::npos);
  EXPECT_NE(contents.not_carried[1].find("malformed"), std::string::npos);
}

TEST(Convert, AnEmptyCommandComesBackEmpty) {
  const Folder folder;
  for (const bool only_empty : {false, true}) {
    {
      rosbag::Bag bag(folder / "a.bag", rosbag::bagmode::Write);
      for (int i = 1; i < 5; ++i) {
        anthrob_msgs::MuscleCommand command;
        command.header.stamp = ros::Time(i);
        if (!only_empty && i != 2 && i != 3) {
          command.name = {"flexor"}, command.mode = {3}, command.reference = {20.0};
        }
        bag.write("/rig/muscle_command", ros::Time(i), command);
      }
    }
    read_bag(folder / "a.bag").dataset.save(folder / "set");
    write_bag(Dataset::load(folder / "set"), folder / "b.bag");
    expect_same<anthrob_msgs::MuscleCommand>(folder / "a.bag", folder / "b.bag",
                                             "/rig/muscle_command", 4);
  }
}

/// A stamped publisher whose messages are late beside one that leaves the stamp to the bag.
void write_two_publishers(const std::string& file, double late) {
  rosbag::Bag bag(file, rosbag::bagmode::Write);
  for (int i = 1; i <= 10; ++i) {
    anthrob_msgs::MuscleCommand command;
    command.name = {i % 2 ? "flexor" : "extensor"};
    command.mode = {1};
    command.reference = {0.1 * i};
    const ros::Time arrival(100 + i);
    if (i % 2 == 0) command.header.stamp = arrival - ros::Duration(late);
    bag.write("/rig/muscle_command", arrival, command);
  }
}

TEST(Convert, CommandsOfTwoPublishersAreInTheOrderOfTheirStamps) {
  const Folder folder;
  write_two_publishers(folder / "a.bag", 0.4);
  EXPECT_TRUE(read_bag(folder / "a.bag").dataset.remarks.empty());
  {
    rosbag::Bag bag(folder / "a.bag", rosbag::bagmode::Append);
    anthrob_msgs::MuscleCommand command;
    command.header.stamp = ros::Time(109, 750000000);
    command.name = {"flexor"}, command.mode = {1}, command.reference = {7.0};
    bag.write("/rig/muscle_command", ros::Time(110, 2), command);  // after one of 110 s
    command.header.stamp = ros::Time(110), command.reference = {8.0};
    bag.write("/rig/muscle_command", ros::Time(110, 1), command);
  }
  const BagContents contents = read_bag(folder / "a.bag");
  ASSERT_EQ(contents.dataset.remarks.size(), 1u);
  EXPECT_NE(contents.dataset.remarks[0].find("/rig/muscle_command: 1 of 12 messages"),
            std::string::npos)
      << contents.dataset.remarks[0];
  EXPECT_NE(contents.dataset.remarks[0].find("by up to 0.250 s"), std::string::npos);
  EXPECT_EQ(contents.dataset.series("flexor/reference").values,
            (std::vector<double>{0.1, 0.1 * 3, 0.5, 0.1 * 7, 0.9, 7.0, 8.0}));
  contents.dataset.save(folder / "set");
  write_bag(Dataset::load(folder / "set"), folder / "b.bag");
  expect_same<anthrob_msgs::MuscleCommand>(folder / "a.bag", folder / "b.bag",
                                           "/rig/muscle_command", 12);
}

TEST(Convert, AClockPutBackIsRefused) {
  const Folder folder;
  write_two_publishers(folder / "a.bag", 1.75);
  try {
    read_bag(folder / "a.bag");
    ADD_FAILURE() << "read";
  } catch (const BadInput& error) {
    EXPECT_NE(std::string(error.what()).find("time goes backwards by 0.750 s"), std::string::npos)
        << error.what();
  }
  {
    rosbag::Bag bag(folder / "b.bag", rosbag::bagmode::Write);
    for (const int late : {0, 100}) {  // what a robot measures comes in order
      sensor_msgs::JointState joints;
      joints.header.stamp = ros::Time(5, 1000 - late);
      joints.name = {"elbow"}, joints.position = {0.5};
      bag.write("/rig/joint_states", ros::Time(5, 2000 + late), joints);
    }
  }
  EXPECT_THROW(read_bag(folder / "b.bag"), BadInput);
}

TEST(Convert, NamesThatCannotHeadColumnsAreNotCarried) {
  const Folder folder;
  {
    rosbag::Bag bag(folder / "a.bag", rosbag::bagmode::Write);
    int second = 0;
    const std::vector<std::vector<std::string>> lists = {
        {"a", "b"}, {"a", "a"}, {"a/b", "c"}, {"a,b", "c"}, {"a ", "c"}};
    for (const std::vector<std::string>& names : lists) {
      sensor_msgs::JointState joints;
      joints.name = names;
      joints.position = {1.0, 2.0};
      bag.write("/rig/joint_states", ros::Time(++second), joints);
    }
    sensor_msgs::JointState bare;
    bare.name = {"elbow"};
    bag.write("/rig/joint_states", ros::Time(++second), bare);
  }
  const BagContents contents = read_bag(folder / "a.bag");
  EXPECT_EQ(contents.not_carried,
            (std::vector<std::string>{"/rig/joint_states (4 malformed messages)",
                                      "/rig/joint_states (1 messages with names only)"}));
  contents.dataset.save(folder / "set");
  EXPECT_EQ(Dataset::load(folder / "set").series("b/position").values, (std::vector<double>{2.0}));
}

TEST(Convert, RefusesWhatIsNoRecording) {
  const Folder folder;
  std::ofstream(folder / "text.bag") << "hello";
  EXPECT_THROW(read_bag(folder / "text.bag"), BadInput);
  EXPECT_THROW(read_bag(folder / "nowhere.bag"), BadInput);
  {
    rosbag::Bag bag(folder / "other.bag", rosbag::bagmode::Write);
    bag.write("/tf", ros::Time(1), sensor_msgs::JointState());
  }
  EXPECT_THROW(read_bag(folder / "other.bag"), BadInput);
  {
    rosbag::Bag bag(folder / "two.bag", rosbag::bagmode::Write);
    bag.write("/a/joint_states", ros::Time(1), sensor_msgs::JointState());
    bag.write("/b/joint_states", ros::Time(1), sensor_msgs::JointState());
  }
  EXPECT_THROW(read_bag(folder / "two.bag"), BadInput);
}

TEST(Convert, WhatIsBelowARobotsNamespaceIsBesideItsContract) {
  const Folder folder;
  {
    rosbag::Bag bag(folder / "demo.bag", rosbag::bagmode::Write);
    bag.write("/a/joint_states", ros::Time(1), sensor_msgs::JointState());
    bag.write("/a/sim/joint_states", ros::Time(1), sensor_msgs::JointState());
  }
  const BagContents contents = read_bag(folder / "demo.bag");
  EXPECT_EQ(contents.dataset.meta.robot, "a");
  ASSERT_EQ(contents.not_carried.size(), 1u);
  EXPECT_NE(contents.not_carried[0].find("/a/sim/joint_states"), std::string::npos);
}

TEST(Convert, FolderToBagKeepsTimeZero) {
  const Folder folder;
  Dataset data;
  data.meta.robot = "rig";
  Table& table = data.table("joints");
  table.t = {0, 5000000};
  table.columns.push_back({"hinge/position", {0.25, 0.5}, {1, 1}});
  write_bag(data, folder / "zero.bag");
  const Dataset back = read_bag(folder / "zero.bag").dataset;
  EXPECT_EQ(back.tables[0].t, table.t);
  EXPECT_EQ(back.tables[0].find("hinge/position")->values, table.columns[0].values);
}

Dataset hinge() {
  Dataset data;
  data.meta.robot = "rig";
  data.table("joints").t = {0, 5000000};
  data.table("joints").columns.push_back({"hinge/position", {0.25, 0.5}, {1, 1}});
  return data;
}

TEST(Convert, FolderToBagKeepsWhatTheMetaSays) {
  const Folder folder;
  std::ofstream(folder / "a.yaml") << "kind: rig\nnotes: of another recording\n";
  Dataset data = hinge();
  data.meta.kind = "equilibrium";
  data.meta.start = "given";
  data.meta.start_position = {{"flexor", 0.3}};
  data.meta.settle_s = 2.5;
  data.meta.other["posture"] = "E7\n";
  write_bag(data, folder / "a.bag");
  const DatasetMeta back = read_bag(folder / "a.bag").dataset.meta;
  EXPECT_EQ(meta_text(back), meta_text(data.meta));
  EXPECT_EQ(back.settle_s, 2.5);
}

TEST(Convert, FolderToBagSaysWhatItDoesNotCarry) {
  const Folder folder;
  Dataset data = hinge();
  data.table("joints").columns.push_back({"hinge/load", {1.0, 2.0}, {1, 1}});
  const BagRemarks said = write_bag(data, folder / "a.bag");
  EXPECT_EQ(said.not_carried, (std::vector<std::string>{"joints.csv: hinge/load"}));
  EXPECT_EQ(read_bag(folder / "a.bag").dataset.series("hinge/position").values,
            (std::vector<double>{0.25, 0.5}));
  Dataset nothing;
  nothing.table("joints").t = {0};
  nothing.table("joints").columns.push_back({"hinge/load", {1.0}, {1}});
  EXPECT_THROW(write_bag(nothing, folder / "b.bag"), BadInput);
}

TEST(Convert, ATableOfBallJointsBecomesBallJoints) {
  const Folder folder;
  Dataset data = hinge();
  data.tables[0].columns.clear();
  for (const char* axis : {"w", "x", "y", "z"}) {
    data.tables[0].columns.push_back({std::string("shoulder/") + axis, {0.5, 0.5}, {1, 1}});
  }
  write_bag(data, folder / "a.bag");
  const auto balls =
      messages<anthrob_msgs::SphericalJointStates>(folder / "a.bag", "/rig/spherical_joint_states");
  ASSERT_EQ(balls.size(), 2u);
  EXPECT_EQ(balls[1].second.name, std::vector<std::string>{"shoulder"});
  EXPECT_TRUE(messages<sensor_msgs::JointState>(folder / "a.bag", "/rig/joint_states").empty());
}

TEST(Convert, ACommandHasAReference) {
  const Folder folder;
  Dataset data = hinge();
  Table& table = data.table("commands");
  table.t = {0, 5000000};
  table.columns.push_back({"flexor/mode", {1, 1}, {1, 1}});
  table.columns.push_back({"flexor/reference", {0.5, 0.0}, {1, 0}});
  EXPECT_THROW(write_bag(data, folder / "a.bag"), BadInput);
  table.columns[1].present[1] = 1;
  EXPECT_NO_THROW(write_bag(data, folder / "a.bag"));
}

TEST(Convert, CommandsWithoutAModeGetTheOneThatAReplayTakes) {
  const Folder folder;
  Dataset data = hinge();
  Table& table = data.table("commands");
  table.t = {0, 5000000, 10000000, 15000000};
  const std::vector<double> references = {6.0, 6.0, 6.0, 6.0};
  const std::vector<char> all = {1, 1, 1, 1};
  // FORCE from the second row on; CURRENT among the states only; none anywhere.
  table.columns = {{"flexor/mode", {0, 3, 0, 1}, {0, 1, 0, 1}},
                   {"flexor/reference", references, all},
                   {"extensor/reference", references, all},
                   {"third/reference", references, {1, 0, 1, 1}}};
  Table& states = data.table("muscles");
  states.t = {0, 10000000};
  states.columns = {{"extensor/mode", {2, 0}, {1, 1}}, {"extensor/force", {1, 1}, {1, 1}}};
  write_bag(data, folder / "a.bag");
  const auto commands =
      messages<anthrob_msgs::MuscleCommand>(folder / "a.bag", "/rig/muscle_command");
  ASSERT_EQ(commands.size(), 4u);
  const std::vector<std::vector<std::uint8_t>> expected = {{3, 2, 1}, {3, 2}, {3, 0, 1}, {1, 0, 1}};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(commands[i].second.mode, expected[i]) << i;
    EXPECT_EQ(commands[i].second.name[0], "flexor");
    EXPECT_EQ(commands[i].second.name[1], "extensor");
  }
}

TEST(Convert, ATopicNeedsNoLeadingSlash) {
  const Folder folder;
  {
    rosbag::Bag bag(folder / "a.bag", rosbag::bagmode::Write);
    sensor_msgs::JointState joints;
    joints.name = {"elbow"}, joints.position = {0.5};
    bag.write("rig/joint_states", ros::Time(1), joints);
    bag.write("/rig/joint_states", ros::Time(2), joints);
    anthrob_msgs::MuscleCommand command;
    command.name = {"flexor"}, command.mode = {1}, command.reference = {0.5};
    bag.write("/rig/muscle_command", ros::Time(1), command);
    bag.write("rig/sim/joint_states", ros::Time(1), joints);
  }
  const BagContents contents = read_bag(folder / "a.bag");
  EXPECT_EQ(contents.dataset.meta.robot, "rig");
  EXPECT_EQ(contents.dataset.find_table("joints")->t.size(), 2u);
  EXPECT_EQ(contents.dataset.find_table("commands")->t.size(), 1u);
  EXPECT_EQ(contents.not_carried, std::vector<std::string>{"rig/sim/joint_states (1 messages)"});
  {
    rosbag::Bag bag(folder / "b.bag", rosbag::bagmode::Write);
    bag.write("joint_states", ros::Time(1), sensor_msgs::JointState());
  }
  EXPECT_EQ(read_bag(folder / "b.bag").dataset.meta.robot, "");
}

TEST(Convert, ARobotKeepsItsName) {
  const Folder folder;
  const auto record = [&](const std::string& name, const std::string& topic) {
    std::filesystem::remove(folder / (name + ".yaml"));
    rosbag::Bag bag(folder / (name + ".bag"), rosbag::bagmode::Write);
    sensor_msgs::JointState joints;
    joints.name = {"hinge"}, joints.position = {0.5};
    bag.write(topic, ros::Time(1), joints);
  };
  const auto topic_of = [](const std::string& file) {
    rosbag::Bag bag(file, rosbag::bagmode::Read);
    return rosbag::View(bag).getConnections().front()->topic;
  };
  // As recorded by whole names; as other writers of bags have them; of a robot among others.
  for (const auto& [topic, robot] :
       {std::pair<std::string, std::string>("/rig/joint_states", "rig"),
        {"rig/joint_states", "rig"},
        {"/lab/rig/joint_states", "lab/rig"}}) {
    record("a", topic);
    const Dataset dataset = read_bag(folder / "a.bag").dataset;
    EXPECT_TRUE(dataset.remarks.empty()) << topic;
    dataset.save(folder / "set");
    EXPECT_TRUE(write_bag(Dataset::load(folder / "set"), folder / "b.bag").remarks.empty());
    EXPECT_EQ(topic_of(folder / "b.bag"), "/" + robot + "/joint_states");
    EXPECT_EQ(read_bag(folder / "b.bag").dataset.meta.robot, robot);
  }
  // Recorded within the robot's namespace: the name is nowhere, and that is said.
  record("a", "joint_states");
  Dataset nameless = read_bag(folder / "a.bag").dataset;
  ASSERT_EQ(nameless.remarks.size(), 1u);
  EXPECT_EQ(nameless.remarks[0].find((folder / "a.bag") + ": its topics are in no robot's"), 0u);
  nameless.save(folder / "set");
  const BagRemarks said = write_bag(Dataset::load(folder / "set"), folder / "b.bag");
  ASSERT_EQ(said.remarks.size(), 1u);
  EXPECT_EQ(said.remarks[0].find((folder / "set") + ": meta.yaml: robot: is missing"), 0u);
  // Unless the description has it.
  std::ofstream(folder / "a.yaml") << "robot: rig\nkind: trajectory\n";
  const Dataset named = read_bag(folder / "a.bag").dataset;
  EXPECT_TRUE(named.remarks.empty());
  EXPECT_EQ(named.meta.robot, "rig");
}

TEST(Convert, AnOrientationIsWholeOrNotThere) {
  const Folder folder;
  for (const char* missing : {"w", "x", "z", "wy"}) {
    Dataset data = hinge();
    Table& table = data.table("spherical_joints");
    table.t = {0};
    for (const char* axis : {"w", "x", "y", "z", "wx", "wy", "wz"}) {
      if (std::string(axis) != missing) {
        table.columns.push_back({std::string("shoulder/") + axis, {0.5}, {1}});
      }
    }
    EXPECT_THROW(write_bag(data, folder / "a.bag"), BadInput) << missing;
    EXPECT_FALSE(std::filesystem::exists(folder / "a.bag"));
    EXPECT_FALSE(std::filesystem::exists(folder / "a.yaml"));
  }
}

/// @return exit status of anthrob_convert; what it says goes to said.txt and errors.txt
int convert(const Folder& folder, const std::string& in, const std::string& out) {
  const std::string command = std::string(ANTHROB_CONVERT) + " " + in + " " + out + " >" +
                              (folder / "said.txt") + " 2>" + (folder / "errors.txt");
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string content(const std::string& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(ConvertTool, TellsWhatIsOddAndWhatItDoesNotCarry) {
  const Folder folder;
  Dataset data = hinge();
  data.table("joints").columns.push_back({"hinge/load", {1.0, 2.0}, {1, 1}});
  data.save(folder / "set");
  std::ofstream(folder / "set/meta.yaml", std::ios::app) << "weather: fine\n";
  ASSERT_EQ(convert(folder, folder / "set", folder / "a.bag"), 0);
  EXPECT_EQ(content(folder / "said.txt"), "wrote " + (folder / "a.bag") +
                                              ": 1 table, 2 rows, 0.005 s\n"
                                              "not converted: joints.csv: hinge/load\n");
  EXPECT_EQ(content(folder / "errors.txt"),
            "anthrob_convert: " + (folder / "set/meta.yaml") + ": weather: unknown key, kept\n");
  ASSERT_EQ(convert(folder, folder / "a.bag", folder / "back"), 0);
  EXPECT_EQ(content(folder / "errors.txt"),
            "anthrob_convert: " + (folder / "a.yaml") + ": weather: unknown key, kept\n");
  EXPECT_EQ(content(folder / "said.txt"),
            "wrote " + (folder / "back") + ": 1 table, 2 rows, 0.005 s\n");
  EXPECT_EQ(Dataset::load(folder / "back").meta.other.at("weather"), "fine\n");
}

TEST(ConvertTool, NothingThatIsReadIsReplaced) {
  const Folder folder;
  hinge().save(folder / "set");
  const std::string meta = content(folder / "set/meta.yaml");
  for (const char* bag : {"set/meta.bag", "nox/../set/meta.bag", "set/./meta.bag"}) {
    EXPECT_EQ(convert(folder, folder / "set", folder / bag), 2) << bag;
    EXPECT_NE(content(folder / "errors.txt").find("meta.yaml is an input of this run"),
              std::string::npos)
        << content(folder / "errors.txt");
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "set/meta.bag"));
  EXPECT_EQ(content(folder / "set/meta.yaml"), meta);
  // A CSV file that would have the name of a table, and what says what its columns are.
  std::ofstream(folder / "map.yaml") << "robot: rig\ntime: {column: t}\ncolumns:\n"
                                        "  - {from: hinge/position, to: hinge/position}\n";
  const std::string columns = " --columns " + (folder / "map.yaml");
  const std::string csv = content(folder / "set/joints.csv");
  ASSERT_EQ(convert(folder, (folder / "set/joints.csv") + columns, folder / "new"), 0)
      << content(folder / "errors.txt");
  for (const char* out : {"set", "nox/../set"}) {
    EXPECT_EQ(convert(folder, (folder / "set/joints.csv") + columns, folder / out), 2);
    EXPECT_NE(content(folder / "errors.txt").find("joints.csv is an input of this run"),
              std::string::npos)
        << content(folder / "errors.txt");
    EXPECT_EQ(content(folder / "set/joints.csv"), csv);
  }
}

TEST(ConvertTool, WhatCannotBeWrittenIsNoBadInput) {
  const Folder folder;
  hinge().save(folder / "set");
  EXPECT_EQ(convert(folder, folder / "set", "/proc/nowhere.bag"), 1);
  EXPECT_EQ(convert(folder, folder / "nothing", folder / "a.bag"), 2);
}

TEST(Plot, AnOrientationIsWhole) {
  const Folder folder;
  for (const char* missing : {"none", "w", "y", "z"}) {
    Dataset data = hinge();
    Table& table = data.table("spherical_joints");
    table.t = {0, 5000000};
    for (const char* axis : {"w", "x", "y", "z"}) {
      table.columns.push_back(
          {std::string("shoulder/") + axis, {0.5, 0.5}, {1, axis != std::string(missing)}});
    }
    data.save(folder / "set");
    const std::string command = std::string(ANTHROB_PLOT) + " " + (folder / "set") + " --out " +
                                (folder / "figures") + " 2>" + (folder / "errors.txt");
    const int status = std::system(command.c_str());
    ASSERT_TRUE(WIFEXITED(status)) << missing;
    EXPECT_EQ(WEXITSTATUS(status), missing == std::string("none") ? 0 : 2) << missing;
  }
  std::ifstream in(folder / "errors.txt");
  std::string line;
  std::getline(in, line);
  EXPECT_NE(line.find("shoulder: expected w, x, y and z of an orientation at the same times"),
            std::string::npos)
      << line;
}

TEST(Plot, WhatASensorDidNotAnswerIsLeftOut) {
  const Folder folder;
  Dataset data = hinge();
  Table& table = data.table("spherical_joints");
  table.t = {0, 5000000, 10000000};
  for (const char* axis : {"w", "x", "y", "z"}) {
    table.columns.push_back({std::string("shoulder/") + axis, {0.5, NAN, 0.5}, {1, 1, 1}});
  }
  data.save(folder / "set");
  const std::string command =
      std::string(ANTHROB_PLOT) + " " + (folder / "set") + " --out " + (folder / "figures");
  ASSERT_EQ(std::system((command + " 2>" + (folder / "errors.txt")).c_str()), 0);
  const std::string figure = content(folder / "figures/joint_angles.svg");
  EXPECT_NE(figure.find("shoulder"), std::string::npos);
  EXPECT_EQ(figure.find("nan"), std::string::npos);
}

TEST(Plot, ShowsAPeakOfOneSampleInALongRecording) {
  const Folder folder;
  Dataset data = hinge();
  Table& table = data.table("muscles");
  Column force{"flexor/force", {}, {}};
  for (int i = 0; i < 30001; ++i) {
    table.t.push_back(Nanoseconds{2000000} * i);
    force.values.push_back(i == 12345 ? 97.0 : 5.0);
    force.present.push_back(1);
  }
  table.columns.push_back(force);
  data.save(folder / "set");
  const std::string command = std::string(ANTHROB_PLOT) + " " + (folder / "set") + " --out " +
                              (folder / "figures") + " 2>" + (folder / "errors.txt");
  ASSERT_EQ(std::system(command.c_str()), 0);
  // The axis reaches beyond it.
  EXPECT_NE(content(folder / "figures/muscle_forces.svg").find(">100<"), std::string::npos);
}

TEST(Plot, AFigureWithoutLinesIsNotDrawn) {
  const Folder folder;
  hinge().save(folder / "set");
  const std::string command = std::string(ANTHROB_PLOT) + " " + (folder / "set") + " --out " +
                              (folder / "figures") + " >" + (folder / "said.txt") + " 2>" +
                              (folder / "errors.txt");
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(content(folder / "said.txt"), "wrote " + (folder / "figures/joint_angles.svg\n"));
  EXPECT_EQ(content(folder / "errors.txt"),
            "anthrob_plot: no actuator_positions.svg: the recording has no positions of muscles\n"
            "anthrob_plot: no muscle_forces.svg: the recording has no forces of muscles\n");
  EXPECT_TRUE(std::filesystem::exists(folder / "figures/joint_angles.svg"));
  EXPECT_FALSE(std::filesystem::exists(folder / "figures/actuator_positions.svg"));
  EXPECT_FALSE(std::filesystem::exists(folder / "figures/muscle_forces.svg"));
}

TEST(Convert, ABrokenBagIsNamed) {
  const Folder folder;
  write_original(folder / "a.bag");
  std::ifstream in(folder / "a.bag", std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(in)), {});
  int refused = 0;
  const auto expect_named = [&](const std::string& bytes) {
    std::ofstream(folder / "b.bag", std::ios::binary) << bytes;
    try {
      read_bag(folder / "b.bag");
    } catch (const BadInput& error) {
      ++refused;
      EXPECT_NE(std::string(error.what()).find("b.bag"), std::string::npos) << error.what();
    }
  };
  for (int i = 1; i < 40; ++i) {
    expect_named(whole.substr(0, whole.size() * static_cast<std::size_t>(i) / 40));
    std::string altered = whole;
    const std::size_t at = 14 + (whole.size() - 14) * static_cast<std::size_t>(i) / 40;
    altered.replace(at, 300, 300, static_cast<char>(i % 2 ? 0 : 255));
    expect_named(altered.substr(0, whole.size()));
  }
  EXPECT_GT(refused, 39);
}

TEST(Convert, ATimeThatABagCannotHoldIsBadInput) {
  const Folder folder;
  constexpr Nanoseconds kLater = Nanoseconds{4294967296} * 1000000000;
  for (const Nanoseconds bad : {Nanoseconds{-1}, kLater}) {
    Dataset late = hinge(), stamped = hinge(), arrived = hinge();
    late.tables[0].t[1] = bad;
    stamped.tables[0].stamp = {0, bad};
    arrived.tables[0].bag_time = {0, bad};
    for (const Dataset* data : {&late, &stamped, &arrived}) {
      EXPECT_THROW(write_bag(*data, folder / "late.bag"), BadInput);
      EXPECT_FALSE(std::filesystem::exists(folder / "late.bag"));
    }
  }
  Dataset last = hinge();
  last.tables[0].t[1] = kLater - 1;
  write_bag(last, folder / "last.bag");
}

TEST(Convert, UnwritableBagLeavesNothing) {
  Dataset data;
  data.table("joints").t = {0};
  EXPECT_THROW(write_bag(data, "/proc/nowhere/x.bag"), std::runtime_error);
}

}  // namespace
}  // namespace anthrob
