#include "anthrob_recording/bag.h"

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>

#include "anthrob_core/config_node.h"
#include "anthrob_core/errors.h"
#include "anthrob_core/files.h"
#include "anthrob_recording/bag_records.h"
#include "anthrob_ros/bounded_message.h"
#include "dataset/clocks.h"
#include "dataset/recorded_topics.h"
#include "dataset/sources.h"
#include "dataset/topic_rows.h"
#include "dataset/topic_tables.h"
#include "ros/bag_rows.h"
#include "ros2/ros2_bag.h"

namespace anthrob {

namespace {

using anthrob_msgs::ExternalWrenches;
using anthrob_msgs::MuscleCommand;
using anthrob_msgs::MuscleStates;
using anthrob_msgs::SphericalJointStates;
using sensor_msgs::JointState;

/// Bags cannot hold time 0; the first representable instant stands for it.
constexpr Nanoseconds kFirstBagTime = 1;
/// ROS counts seconds in 32 bits.
constexpr Nanoseconds kEndOfTime = (Nanoseconds{1} << 32) * 1000000000;

Nanoseconds to_nanoseconds(const ros::Time& t) {
  return static_cast<Nanoseconds>(t.sec) * 1000000000 + t.nsec;
}

ros::Time to_ros(Nanoseconds t) {
  ros::Time time;
  time.fromNSec(static_cast<std::uint64_t>(t));
  return time;
}

// ---- bag to dataset -----------------------------------------------------------------------------

template <class Message>
void add_all(rosbag::Bag& bag, const std::vector<std::string>& topics, TopicTable& table) {
  for (const rosbag::MessageInstance& instance : rosbag::View(bag, rosbag::TopicQuery(topics))) {
    const auto message = instance.instantiate<Bounded<Message>>();
    if (!message) {
      throw BadInput(bag.getFileName() + ": topic " + instance.getTopic() + " is " +
                     instance.getDataType() + ": expected " +
                     ros::message_traits::DataType<Message>::value());
    }
    if (message->refusal)
      throw BadInput(bag.getFileName() + ": topic " + instance.getTopic() + ": " +
                     *message->refusal);
    TopicRow row;
    row.stamp = to_nanoseconds(message->message.header.stamp);
    row.arrival = to_nanoseconds(instance.getTime());
    if (row.arrival == kFirstBagTime) row.arrival = 0;
    row.frame = message->message.header.frame_id;
    row.node = instance.getCallerId();
    row.owners = owners_of(message->message);
    row.complete = to_cells(message->message, row.cells);
    table.add(row);
  }
}

std::string meta_beside(const std::string& bag) {
  return std::filesystem::path(bag).replace_extension(".yaml").string();
}

BagContents contents_of(const std::string& file) {
  check_bag_records(file);
  rosbag::Bag bag(file, rosbag::bagmode::Read);
  BagContents contents;
  contents.dataset.folder = file;

  std::map<std::string, std::uint64_t> counts;
  rosbag::View everything(bag);
  for (const rosbag::ConnectionInfo* connection : everything.getConnections())
    counts[connection->topic];
  for (const rosbag::MessageInstance& instance : everything) ++counts[instance.getTopic()];

  for (const RecordedTopic& topic :
       choose_topics(counts, file, meta_beside(file), contents.dataset, contents.not_carried)) {
    TopicTable table(topic.table);
    if (topic.leaf == "muscle_command") add_all<MuscleCommand>(bag, topic.topics, table);
    if (topic.leaf == "muscle_states") add_all<MuscleStates>(bag, topic.topics, table);
    if (topic.leaf == "joint_states") add_all<JointState>(bag, topic.topics, table);
    if (topic.leaf == "spherical_joint_states") {
      add_all<SphericalJointStates>(bag, topic.topics, table);
    }
    if (topic.leaf == "external_wrenches") add_all<ExternalWrenches>(bag, topic.topics, table);
    table.finish(topic.topics.front(), contents.dataset, contents.not_carried);
  }
  if (contents.dataset.tables.empty()) throw BadInput(file + ": its topics hold no messages");
  check_clocks(contents.dataset);
  check_sources(contents.dataset);
  return contents;
}

}  // namespace

BagContents read_bag(const std::string& file) {
  try {
    return contents_of(file);
  } catch (const BadInput&) {
    throw;
  } catch (const std::exception& e) {
    // A corrupt bag can fail anywhere, e.g. with impossible sizes.
    throw BadInput(file + ": cannot be read as a bag: " + e.what());
  }
}

// ---- dataset to bag -----------------------------------------------------------------------------

namespace {

/// Fills in the modes that are not written, as a replay does: the last one, before the first one
/// the first. POSITION where there is none at all: which muscles have a controller is not known.
Table with_all_modes(Table commands, const Dataset& dataset) {
  const std::vector<Column> columns = commands.columns;
  const Nanoseconds begin = dataset.begin();
  for (const Column& reference : columns) {
    if (reference.quantity() != "reference") continue;
    const std::string name = reference.owner() + "/mode";
    const Series said = dataset.series(name);
    Column& mode = commands.column(name);
    for (std::size_t row = 0; row < commands.t.size(); ++row) {
      if (!reference.present[row] || mode.present[row]) continue;
      mode.present[row] = 1;
      mode.values[row] = said.empty() ? static_cast<double>(MuscleCommand::POSITION)
                                      : said.held_at(seconds(commands.t[row] - begin));
    }
  }
  return commands;
}

template <class Message>
void write_rows(const Table& table, const Dataset& dataset, const std::string& topic,
                rosbag::Bag& bag) {
  const auto frame = dataset.meta.other.find("frame_id_" + table.name);
  for (std::size_t row = 0; row < table.t.size(); ++row) {
    const Nanoseconds t = table.t[row], stamp = table.stamp.empty() ? t : table.stamp[row],
                      arrival = table.bag_time.empty() ? t : table.bag_time[row];
    for (const auto& [key, time] : {std::pair("t", t), {"stamp", stamp}, {"bag_time", arrival}}) {
      if (time >= 0 && time < kEndOfTime) continue;
      throw BadInput(table.name + ".csv: " + key + " = " + time_text(time) +
                     ": expected a time from 0 to below 2^32 s, as a bag needs");
    }
    Message message;
    from_row(table, row, message);
    message.header.stamp = to_ros(stamp);
    if (frame != dataset.meta.other.end()) {
      message.header.frame_id = frame->second.substr(0, frame->second.find('\n'));
    }
    bag.write(topic, to_ros(std::max(arrival, kFirstBagTime)), message);
  }
}

}  // namespace

/// Only a recording may be replaced by one.
/// @throws BadInput if `file` or the description beside it is something else
void check_replaceable(const std::string& file) {
  const std::string beside = meta_beside(file);
  if (std::filesystem::exists(beside)) {
    const ConfigNode there = ConfigNode::load(beside);
    if (!there.is_map() || !there.has("kind")) {
      throw BadInput(beside +
                     ": is no description of a recording and would be overwritten; "
                     "expected another name for the bag");
    }
  }
  if (!std::filesystem::exists(file)) return;
  rosbag::Bag bag;
  try {
    bag.open(file, rosbag::bagmode::Read);
  } catch (const rosbag::BagException&) {
    throw BadInput(file + ": is no bag and would be overwritten; expected another name");
  }
  for (const rosbag::ConnectionInfo* connection : rosbag::View(bag).getConnections()) {
    if (is_of_a_recording(connection->topic)) continue;
    throw BadInput(file + ": holds " + connection->topic +
                   ", which would be lost; expected another name");
  }
}

BagRemarks write_bag(const Dataset& dataset, const std::string& file) {
  check_replaceable(file);
  const TopicTables topics = topic_tables(dataset);
  if (topics.tables.empty()) {
    throw BadInput(dataset.folder + ": contains no column that a bag can store");
  }
  const std::string robot = dataset.meta.robot.empty() ? "robot" : dataset.meta.robot;
  const std::string prefix = "/" + robot + "/";
  PartFile part(file);
  auto bag = std::make_unique<rosbag::Bag>();
  try {
    bag->open(part.path(), rosbag::bagmode::Write);
    for (const Table& table : topics.tables) {
      if (table.name == "commands")
        write_rows<MuscleCommand>(with_all_modes(table, dataset), dataset,
                                  prefix + "muscle_command", *bag);
      if (table.name == "muscles")
        write_rows<MuscleStates>(table, dataset, prefix + "muscle_states", *bag);
      if (table.name == "joints")
        write_rows<JointState>(table, dataset, prefix + "joint_states", *bag);
      if (table.name == "spherical_joints") {
        write_rows<SphericalJointStates>(table, dataset, prefix + "spherical_joint_states", *bag);
      }
      if (table.name == "wrenches")
        write_rows<ExternalWrenches>(table, dataset, prefix + "external_wrenches", *bag);
    }
    bag->close();
    keep_on_disk(part.path());
    // Write meta first: a meta.yaml without a bag is harmless, a bag with a stale one is not.
    write_file_atomically(meta_beside(file), meta_text(dataset.meta));
    part.move_to(file);
    BagRemarks remarks = {topics.not_carried, topics.remarks};
    if (dataset.meta.robot.empty()) {
      remarks.remarks.push_back(dataset.folder +
                                ": meta.yaml: robot: is missing: the topics are in " + prefix);
    }
    return remarks;
  } catch (const rosbag::BagException& e) {
    (void)bag.release();  // its destructor would write again, and throw, which ends the program
    part.fail(e.what());
  }
}

Dataset load_recording(const std::string& path) {
  if (is_ros2_bag(path)) return read_ros2_bag(path);
  if (std::filesystem::is_directory(path)) return Dataset::load(path);
  if (!std::filesystem::exists(path))
    throw BadInput(path + ": no such recording; expected a bag or a dataset folder");
  return read_bag(path).dataset;
}

namespace {

/// "E2" before "E10".
bool natural_less(const std::string& a, const std::string& b) {
  std::size_t i = 0, k = 0;
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  while (i < a.size() && k < b.size()) {
    if (digit(a[i]) && digit(b[k])) {
      std::size_t i_end = i, k_end = k;
      while (i_end < a.size() && digit(a[i_end])) ++i_end;
      while (k_end < b.size() && digit(b[k_end])) ++k_end;
      const std::string x = a.substr(i, i_end - i), y = b.substr(k, k_end - k);
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
      i = i_end, k = k_end;
    } else {
      if (a[i] != b[k]) return a[i] < b[k];
      ++i, ++k;
    }
  }
  return a.size() - i < b.size() - k;
}

}  // namespace

std::vector<Dataset> load_recordings(const std::string& folder) {
  std::vector<std::string> paths;
  const bool is_recording = std::filesystem::path(folder).extension() == ".bag" ||
                            is_ros2_bag(folder) ||
                            std::filesystem::exists(std::filesystem::path(folder) / "meta.yaml");
  if (is_recording) {
    paths.push_back(folder);
  } else {
    if (!std::filesystem::is_directory(folder))
      throw BadInput(folder + ": no such folder of recordings");
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      std::error_code error;  // of a link that leads in circles
      if (!std::filesystem::exists(entry.status(error))) {
        throw BadInput(entry.path().string() +
                       ": a link to something that is not there; mend or remove it");
      }
      const std::string kind = entry.path().extension().string();
      if (entry.is_directory() || kind == ".bag" || kind == ".db3") {
        paths.push_back(entry.path().string());
      }
    }
  }
  if (paths.empty()) {
    throw BadInput(folder + ": holds no recordings; expected bags or dataset folders");
  }
  std::sort(paths.begin(), paths.end(), natural_less);
  std::vector<Dataset> recordings;
  for (const std::string& path : paths) recordings.push_back(load_recording(path));
  return recordings;
}

}  // namespace anthrob
