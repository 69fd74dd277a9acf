#include "dataset/topic_tables.h"

#include <algorithm>
#include <map>
#include <set>

namespace anthrob {

namespace {

const std::map<std::string, std::set<std::string>>& quantities_by_topic() {
  static const std::map<std::string, std::set<std::string>> kQuantities = {
      {"commands", {"mode", "reference"}},
      {"muscles",
       {"position", "velocity", "current", "voltage", "force", "reference", "mode", "ecu_state"}},
      {"joints", {"position", "velocity", "effort"}},
      {"spherical_joints", {"w", "x", "y", "z", "wx", "wy", "wz"}},
      {"wrenches",
       {"force_x", "force_y", "force_z", "torque_x", "torque_y", "torque_z", "point_x", "point_y",
        "point_z"}}};
  return kQuantities;
}

bool is_topic(const std::string& table) {
  return quantities_by_topic().count(table) > 0;
}
bool has_place(const std::string& table, const std::string& quantity) {
  const auto topic = quantities_by_topic().find(table);
  return topic != quantities_by_topic().end() && topic->second.count(quantity) > 0;
}
bool is_motion(const std::string& quantity) {
  return quantity == "position" || quantity == "velocity";
}
bool is_command(const std::string& quantity) {
  return quantity == "mode" || quantity == "reference";
}

class Dealer {
 public:
  explicit Dealer(const Dataset& dataset) : dataset_(dataset) {
    for (const Table& table : dataset.tables) {
      for (const Column& column : table.columns) {
        const std::string q = column.quantity();
        if (has_place("muscles", q) && !is_motion(q)) muscles_.insert(column.owner());
      }
    }
  }

  TopicTables deal() {
    for (const Table& table : dataset_.tables) deal(table);
    return std::move(dealt_);
  }

 private:
  void deal(const Table& table) {
    const std::set<std::string> strangers = joints_among_muscles(table);
    for (const std::string& name : strangers) {
      dealt_.remarks.push_back(
          table.name + ".csv: " + name +
          ": has only positions or velocities, unlike muscles; written as a joint");
    }
    const bool only_commands = has_only_commands(table);
    std::map<std::string, Table> parts;
    for (const Column& column : table.columns) {
      if (column.quantity() == "load" || column.quantity() == "direction") {
        dealt_.not_carried.push_back(table.name + ".csv: " + column.name);
        continue;
      }
      const bool stays =
          has_place(table.name, column.quantity()) && strangers.count(column.owner()) == 0;
      const bool asked_for = only_commands && is_command(column.quantity());
      const std::string topic = stays ? table.name : asked_for ? "commands" : topic_of(column);
      parts[topic].columns.push_back(column);
    }
    if (table.columns.empty() && is_topic(table.name)) parts[table.name];
    for (auto& [topic, part] : parts) {
      part.name = topic;
      part.t = table.t, part.stamp = table.stamp, part.bag_time = table.bag_time;
      const bool whole = topic == table.name && part.columns.size() == table.columns.size();
      // Where another's cells are left out, nothing tells of a message without names.
      if (!whole) drop_empty_rows(part);
      if (topic != table.name && is_topic(table.name)) remark_moved(table, part);
      dealt_.tables.push_back(std::move(part));
    }
  }

  /// By what it is, whatever file it stands in.
  std::string topic_of(const Column& column) const {
    const std::string q = column.quantity();
    for (const char* topic : {"spherical_joints", "wrenches"}) {
      if (has_place(topic, q)) return topic;
    }
    return q != "effort" && muscles_.count(column.owner()) ? "muscles" : "joints";
  }

  /// A file of a name of its own that holds what was asked for and nothing of what was done.
  bool has_only_commands(const Table& table) const {
    if (is_topic(table.name) || dataset_.find_table("commands")) return false;
    return std::all_of(table.columns.begin(), table.columns.end(), [&](const Column& column) {
      return is_command(column.quantity()) || topic_of(column) != "muscles";
    });
  }

  /// Names in muscles.csv that have positions or velocities only, in rows where muscles have more,
  /// as no message of muscles could.
  std::set<std::string> joints_among_muscles(const Table& table) const {
    std::set<std::string> found;
    if (table.name != "muscles") return found;
    std::vector<char> more(table.t.size(), 0);
    for (const Column& column : table.columns) {
      if (is_motion(column.quantity()) || !has_place("muscles", column.quantity())) continue;
      for (std::size_t i = 0; i < more.size(); ++i) more[i] = more[i] || column.present[i];
    }
    for (const Column& column : table.columns) {
      if (!is_motion(column.quantity()) || muscles_.count(column.owner())) continue;
      for (std::size_t i = 0; i < more.size(); ++i) {
        if (more[i] && column.present[i]) found.insert(column.owner());
      }
    }
    return found;
  }

  void remark_moved(const Table& table, const Table& part) {
    std::string names;
    for (const Column& column : part.columns) names += (names.empty() ? "" : ", ") + column.name;
    dealt_.remarks.push_back(table.name + ".csv: " + names + ": written to the topic of " +
                             part.name + ".csv");
  }

  static void drop_empty_rows(Table& table) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < table.t.size(); ++i) {
      const bool any = std::any_of(table.columns.begin(), table.columns.end(),
                                   [&](const Column& column) { return column.present[i] != 0; });
      if (!any) continue;
      for (auto* times : {&table.t, &table.stamp, &table.bag_time}) {
        if (!times->empty()) (*times)[kept] = (*times)[i];
      }
      for (Column& column : table.columns) {
        column.values[kept] = column.values[i];
        column.present[kept] = column.present[i];
      }
      ++kept;
    }
    for (auto* times : {&table.t, &table.stamp, &table.bag_time}) {
      if (!times->empty()) times->resize(kept);
    }
    for (Column& column : table.columns) {
      column.values.resize(kept);
      column.present.resize(kept);
    }
  }

  const Dataset& dataset_;
  std::set<std::string> muscles_;  ///< with something that only muscles have
  TopicTables dealt_;
};

}  // namespace

TopicTables topic_tables(const Dataset& dataset) {
  return Dealer(dataset).deal();
}

}  // namespace anthrob
