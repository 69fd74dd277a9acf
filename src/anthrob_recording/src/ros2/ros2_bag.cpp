#include "ros2/ros2_bag.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <utility>
#include <vector>

#include "anthrob_core/config_node.h"
#include "anthrob_core/errors.h"
#include "anthrob_core/text.h"
#include "dataset/clocks.h"
#include "dataset/recorded_topics.h"
#include "dataset/sources.h"
#include "ros2/cdr_reader.h"
#include "ros2/ros2_messages.h"
#include "ros2/sqlite_file.h"

namespace anthrob {
namespace {

namespace fs = std::filesystem;

/// [ns] in the year 2116; sums of times fit into 64 bits.
constexpr Nanoseconds kLatestArrival = Nanoseconds{1} << 62;

struct Topic {
  std::int64_t id = 0;
  std::string name, type, format;
};

/// A file of the bag.
struct Storage {
  explicit Storage(const std::string& file) : database(file) {
    for (const char* table : {"topics", "messages"}) {
      if (database.has_table(table)) continue;
      throw BadInput(file + ": has no table '" + table + "'; expected a bag of ROS 2 (rosbag2)");
    }
    SqliteRows rows(database, "SELECT id, name, type, serialization_format FROM topics");
    while (rows.next()) {
      topics.push_back({rows.integer(0), rows.text(1), rows.text(2), rows.text(3)});
      refuse_other_name(topics.back().name);
      refuse_other_name(topics.back().type);
    }
  }

  /// Names of ROS 2 are of letters, digits, _ and /; what else stands there is damage.
  void refuse_other_name(const std::string& name) const {
    const bool good = std::all_of(name.begin(), name.end(), [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '/';
    });
    if (!good || name.empty()) {
      throw BadInput(database.name() + ": a topic has a name or a type that ROS 2 does not allow");
    }
  }

  SqliteFile database;
  std::vector<Topic> topics;
};

/// The files of a bag that is a folder, in their order.
std::vector<std::string> files_of(const std::string& folder) {
  const ConfigNode metadata = ConfigNode::load((fs::path(folder) / "metadata.yaml").string());
  const ConfigNode bag = metadata.at("rosbag2_bagfile_information");
  if (bag.text("storage_identifier") != "sqlite3") {
    bag.at("storage_identifier")
        .fail_expected("sqlite3; convert it with `ros2 bag convert` (storage_id: sqlite3)");
  }
  // Without compression, it is an empty word.
  if (bag.has("compression_format") &&
      !trimmed(bag.at("compression_format").to_yaml(), " \"'\n").empty()) {
    bag.at("compression_format")
        .fail_expected("a bag without compression; convert it with `ros2 bag convert`");
}
std::vector<std::string> files;
for (const ConfigNode& file : bag.at("relative_file_paths").items()) {
  files.push_back((fs::path(folder) / fs::path(file.as_text()).filename()).string());
}
if (files.empty()) bag.at("relative_file_paths").fail("expected at least one file");
return files;
}

std::map<std::string, std::uint64_t> count_messages(const std::vector<Storage>& bag) {
  std::map<std::string, std::uint64_t> counts;
  for (const Storage& storage : bag) {
    std::map<std::int64_t, std::uint64_t> by_id;
    SqliteRows rows(storage.database, "SELECT topic_id, count(*) FROM messages GROUP BY topic_id");
    while (rows.next()) by_id[rows.integer(0)] = static_cast<std::uint64_t>(rows.integer(1));
    for (const Topic& topic : storage.topics) counts[topic.name] += by_id[topic.id];
  }
  return counts;
}

void refuse_other_messages(const std::string& file, const Topic& topic, const std::string& leaf) {
  const std::string said = file + ": topic " + topic.name + " is ";
  if (topic.type != ros2_type_of(leaf)) {
    throw BadInput(said + topic.type + ": expected " + ros2_type_of(leaf));
  }
  if (topic.format != "cdr")
    throw BadInput(said + "serialised as " + topic.format + ": expected cdr");
}

void add_all(const Storage& storage, const RecordedTopic& recorded, TopicTable& table) {
  const std::string& file = storage.database.name();
  for (const Topic& topic : storage.topics) {
    const std::vector<std::string>& names = recorded.topics;
    if (std::find(names.begin(), names.end(), topic.name) == names.end()) continue;
    refuse_other_messages(file, topic, recorded.leaf);
    SqliteRows rows(storage.database, "SELECT id, timestamp, data FROM messages WHERE topic_id = " +
                                          std::to_string(topic.id) + " ORDER BY timestamp, id");
    while (rows.next()) {
      const auto [data, size] = rows.blob(2);
      try {
        TopicRow row = read_ros2_message(recorded.leaf, data, size);
        row.arrival = rows.integer(1);
        if (row.arrival < 0 || row.arrival > kLatestArrival) {
          throw CdrError("arrived at " + std::to_string(row.arrival) + " ns");
        }
        table.add(row);
      } catch (const CdrError& error) {
        throw BadInput(file + ": topic " + topic.name + ": message " +
                       std::to_string(rows.integer(0)) + ": " + error.what() + "; expected a " +
                       ros2_type_of(recorded.leaf));
      }
    }
  }
}

}  // namespace

bool is_ros2_bag(const std::string& path) {
  if (fs::is_directory(path)) return fs::exists(fs::path(path) / "metadata.yaml");
  return fs::path(path).extension() == ".db3";
}

Dataset read_ros2_bag(const std::string& path, std::vector<std::string>* not_carried) {
  const bool folder = fs::is_directory(path);
  if (!fs::exists(path)) throw BadInput(path + ": no such recording; expected a bag of ROS 2");
  const std::string described = folder ? (fs::path(path) / "meta.yaml").string()
                                       : fs::path(path).replace_extension(".yaml").string();
  std::vector<Storage> bag;
  for (const std::string& file : folder ? files_of(path) : std::vector<std::string>{path}) {
    bag.emplace_back(file);
  }
  Dataset dataset;
  dataset.folder = path;
  std::vector<std::string> others;
  for (const RecordedTopic& topic :
       choose_topics(count_messages(bag), path, described, dataset, others)) {
    TopicTable table(topic.table);
    for (const Storage& storage : bag) add_all(storage, topic, table);
    table.finish(topic.topics.front(), dataset, others);
  }
  if (dataset.tables.empty()) throw BadInput(path + ": its topics hold no messages");
  check_clocks(dataset);
  check_sources(dataset);
  if (not_carried) *not_carried = std::move(others);
  return dataset;
}

}  // namespace anthrob
