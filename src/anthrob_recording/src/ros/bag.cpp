#include "anthrob_recording/bag.h"

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <numeric>
#include <set>

#include "anthrob_core/config_node.h"
#include "anthrob_core/errors.h"
#include "anthrob_core/files.h"
#include "anthrob_core/publishers.h"
#include "anthrob_ros/bounded_message.h"
#include "dataset/clocks.h"
#include "dataset/sources.h"
#include "dataset/topic_tables.h"
#include "anthrob_recording/bag_records.h"
#include "ros/bag_rows.h"

namespace anthrob {

namespace {

using anthrob_msgs::ExternalWrenches;
using anthrob_msgs::MuscleCommand;
using anthrob_msgs::MuscleStates;
using anthrob_msgs::SphericalJointStates;
using sensor_msgs::JointState;

/// How far commands of several publishers may overtake each other: no longer than a robot waits for
/// the next one. Beyond, a clock was put back.
constexpr Nanoseconds kMostOvertaken = 500000000;

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

/// Collects the messages of one topic into a table.
class TableBuilder {
 public:
  explicit TableBuilder(const std::string& name) { table_.name = name; }

  template <class Message>
  void add(const Message& message, const ros::Time& arrival, const std::string& node) {
    Cells cells;
    const std::vector<std::string> owners = owners_of(message);
    if (!are_column_owners(owners) || !to_cells(message, cells)) {
      ++malformed_;
      return;
    }
    if (cells.empty() && !owners.empty()) ++bare_;
    Nanoseconds bag_time = to_nanoseconds(arrival);
    if (bag_time == kFirstBagTime) bag_time = 0;
    const Nanoseconds stamp = to_nanoseconds(message.header.stamp);
    publishers_.add(owners, node);
    const std::size_t row = table_.t.size();
    table_.t.push_back(stamp != 0 ? stamp : bag_time);
    table_.stamp.push_back(stamp);
    table_.bag_time.push_back(bag_time);
    if (row == 0) frame_ = message.header.frame_id;
    frames_differ_ = frames_differ_ || message.header.frame_id != frame_;
    for (const auto& [name, value] : cells) {
      Column& column = column_of(name);
      column.values.resize(row, 0.0);
      column.present.resize(row, 0);
      column.values.push_back(value);
      column.present.push_back(1);
    }
  }

  /// Puts the finished table into the dataset and says what could not be carried.
  void finish(const std::string& topic, BagContents& contents) {
    if (malformed_ > 0) {
      contents.not_carried.push_back(topic + " (" + std::to_string(malformed_) +
                                     " malformed messages)");
    }
    if (bare_ > 0) {
      contents.not_carried.push_back(topic + " (" + std::to_string(bare_) +
                                     " messages with names only)");
    }
    if (table_.t.empty()) return;
    // Commands may have several senders; a measurement has one.
    if (publishers_.conflict() && table_.name != "commands") {
      throw BadInput(contents.dataset.folder + ": " + topic + ": " + *publishers_.conflict() +
                     "; expected one publisher of each measurement");
    }
    for (Column& column : table_.columns) {
      column.values.resize(table_.t.size(), 0.0);
      column.present.resize(table_.t.size(), 0);
    }
    put_in_order(topic, contents.dataset);
    if (table_.stamp == table_.t) table_.stamp.clear();
    if (table_.bag_time == table_.t) table_.bag_time.clear();
    if (frames_differ_)
      contents.not_carried.push_back(topic + ": frame_id, because it changes during the recording");
    if (!frames_differ_ && !frame_.empty()) {
      contents.dataset.meta.other["frame_id_" + table_.name] = frame_ + "\n";
    }
    contents.dataset.tables.push_back(std::move(table_));
  }

 private:
  Column& column_of(const std::string& name) {
    const auto found = index_.find(name);
    if (found != index_.end()) return table_.columns[found->second];
    index_[name] = table_.columns.size();
    table_.columns.push_back({name, {}, {}});
    return table_.columns.back();
  }

  /// Two publishers of commands may overtake each other; what one robot measures comes in order.
  void put_in_order(const std::string& topic, Dataset& dataset) {
    const std::vector<Nanoseconds> t = table_.t;
    Nanoseconds latest = t.front(), worst = 0;
    int late = 0;
    for (const Nanoseconds stamp : t) {
      latest = std::max(latest, stamp);
      worst = std::max(worst, latest - stamp);
      late += stamp < latest;
    }
    if (late == 0) return;
    if (table_.name != "commands" || worst > kMostOvertaken) {
      throw BadInput(dataset.folder + ": " + topic + ": time goes backwards by " +
                     time_text(worst) + " s; expected a recording of one run");
    }
    std::vector<std::size_t> order(t.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return t[a] < t[b]; });
    for (auto* times : {&table_.t, &table_.stamp, &table_.bag_time}) permute(*times, order);
    for (Column& column : table_.columns) {
      permute(column.values, order);
      permute(column.present, order);
    }
    dataset.remarks.push_back(dataset.folder + ": " + topic + ": " + std::to_string(late) + " of " +
                              std::to_string(t.size()) + " messages came out of order, by up to " +
                              time_text(worst) + " s: sorted by their stamps");
  }

  template <class List>
  static void permute(List& list, const std::vector<std::size_t>& order) {
    const List old = list;
    for (std::size_t i = 0; i < order.size(); ++i) list[i] = old[order[i]];
  }

  Table table_;
  std::map<std::string, std::size_t> index_;
  std::string frame_;
  bool frames_differ_ = false;
  Publishers publishers_;
  int malformed_ = 0;
  int bare_ = 0;  ///< messages with names and no values
};

const std::pair<const char*, const char*> kTopics[] = {
    {"muscle_command", "commands"},
    {"muscle_states", "muscles"},
    {"joint_states", "joints"},
    {"spherical_joint_states", "spherical_joints"},
    {"external_wrenches", "wrenches"}};

template <class Message>
void add_all(rosbag::Bag& bag, const std::vector<std::string>& topics, TableBuilder& builder) {
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
    builder.add(message->message, instance.getTime(), instance.getCallerId());
  }
}

std::string meta_beside(const std::string& bag) {
  return std::filesystem::path(bag).replace_extension(".yaml").string();
}

std::string leaf(const std::string& topic) {
  return topic.substr(topic.rfind('/') + 1);
}
std::string parent(const std::string& topic) {
  const auto slash = topic.rfind('/');
  return slash == std::string::npos || slash == 0 ? "" : topic.substr(0, slash);
}
/// Not all writers of bags begin a topic with a slash.
std::string without_leading_slash(const std::string& topic) {
  return topic.substr(topic.rfind('/', 0) == 0 ? 1 : 0);
}
/// "anthrob" of "/anthrob/joint_states"; empty if there is no namespace.
std::string namespace_of(const std::string& topic) {
  return without_leading_slash(parent(topic));
}
bool is_of_a_recording(const std::string& topic) {
  return std::any_of(std::begin(kTopics), std::end(kTopics),
                     [name = leaf(topic)](const auto& known) { return name == known.first; });
}

BagContents contents_of(const std::string& file) {
  check_bag_records(file);
  rosbag::Bag bag(file, rosbag::bagmode::Read);
  BagContents contents;
  contents.dataset.folder = file;

  std::map<std::string, std::uint32_t> counts;
  rosbag::View everything(bag);
  for (const rosbag::ConnectionInfo* connection : everything.getConnections())
    counts[connection->topic];
  for (const rosbag::MessageInstance& instance : everything) ++counts[instance.getTopic()];

  std::set<std::string> namespaces;
  std::map<std::string, std::vector<std::string>> chosen;
  for (const auto& [topic, count] : counts) {
    if (is_of_a_recording(topic)) namespaces.insert(namespace_of(topic));
  }
  // What stands below a robot's namespace (sim/...) is beside its contract.
  const std::set<std::string> all = namespaces;
  for (const std::string& outer : all) {
    for (const std::string& inner : all) {
      const bool below = inner.compare(0, outer.size() + 1, outer + "/") == 0;
      if (!outer.empty() && below) namespaces.erase(inner);
    }
  }
  for (const auto& [topic, count] : counts) {
    if (is_of_a_recording(topic) && namespaces.count(namespace_of(topic))) {
      chosen[leaf(topic)].push_back(topic);
    } else {
      contents.not_carried.push_back(topic + " (" + std::to_string(count) + " messages)");
    }
  }
  if (namespaces.empty()) {
    throw BadInput(file +
                   ": contains no topic of a recording; expected muscle_command, muscle_states, "
                   "joint_states or spherical_joint_states in the namespace of a robot");
  }
  if (namespaces.size() > 1) {
    throw BadInput(file + ": topics of several robots: " + *namespaces.begin() + " and " +
                   *std::next(namespaces.begin()) + "; expected one robot per bag");
  }
  const std::string robot = *namespaces.begin();
  const std::string beside = meta_beside(file);
  if (std::filesystem::exists(beside))
    contents.dataset.meta = load_meta(beside, &contents.dataset.remarks);
  if (!robot.empty()) contents.dataset.meta.robot = robot;
  if (contents.dataset.meta.robot.empty()) {
    contents.dataset.remarks.push_back(
        file +
        ": its topics are in no robot's namespace, so that the robot is not known; give its "
        "name by robot: in meta.yaml, or in " +
        leaf(beside) + " beside the bag");
  }
  for (const auto& [topic, table] : kTopics) {
    if (!chosen.count(topic)) continue;
    TableBuilder builder(table);
    const std::string name(topic);
    if (name == "muscle_command") add_all<MuscleCommand>(bag, chosen[name], builder);
    if (name == "muscle_states") add_all<MuscleStates>(bag, chosen[name], builder);
    if (name == "joint_states") add_all<JointState>(bag, chosen[name], builder);
    if (name == "spherical_joint_states") add_all<SphericalJointStates>(bag, chosen[name], builder);
    if (name == "external_wrenches") add_all<ExternalWrenches>(bag, chosen[name], builder);
    builder.finish(chosen[name].front(), contents);
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
      if (entry.is_directory() || entry.path().extension() == ".bag") {
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
