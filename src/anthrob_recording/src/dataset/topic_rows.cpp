#include "dataset/topic_rows.h"

#include <algorithm>
#include <cctype>
#include <numeric>
#include <set>
#include <string_view>

#include "anthrob_core/errors.h"

namespace anthrob {

namespace {

/// How far commands of several publishers may overtake each other: no longer than a robot waits for
/// the next one. Beyond, a clock was put back.
constexpr Nanoseconds kMostOvertaken = 500000000;

template <class List>
static void permute(List& list, const std::vector<std::size_t>& order) {
  const List old = list;
  for (std::size_t i = 0; i < order.size(); ++i) list[i] = old[order[i]];
}

}  // namespace

bool are_column_owners(const std::vector<std::string>& names) {
  const auto bad = [](const std::string& name) {
    return name.find_first_of("/,\r\n") != std::string::npos ||
           (!name.empty() && (std::isspace(static_cast<unsigned char>(name.front())) ||
                              std::isspace(static_cast<unsigned char>(name.back()))));
  };
  return std::none_of(names.begin(), names.end(), bad) &&
         std::set<std::string_view>(names.begin(), names.end()).size() == names.size();
}

void TopicTable::add(const TopicRow& message) {
  if (!are_column_owners(message.owners) || !message.complete) {
    ++malformed_;
    return;
  }
  if (message.cells.empty() && !message.owners.empty()) ++bare_;
  publishers_.add(message.owners, message.node);
  const std::size_t row = table_.t.size();
  table_.t.push_back(message.stamp != 0 ? message.stamp : message.arrival);
  table_.stamp.push_back(message.stamp);
  table_.bag_time.push_back(message.arrival);
  if (row == 0) frame_ = message.frame;
  frames_differ_ = frames_differ_ || message.frame != frame_;
  for (const auto& [name, value] : message.cells) {
    Column& column = column_of(name);
    column.values.resize(row, 0.0);
    column.present.resize(row, 0);
    column.values.push_back(value);
    column.present.push_back(1);
  }
}

void TopicTable::finish(const std::string& topic, Dataset& dataset,
                        std::vector<std::string>& not_carried) {
  if (malformed_ > 0) {
    not_carried.push_back(topic + " (" + std::to_string(malformed_) + " malformed messages)");
  }
  if (bare_ > 0) {
    not_carried.push_back(topic + " (" + std::to_string(bare_) + " messages with names only)");
  }
  if (table_.t.empty()) return;
  // Commands may have several senders; a measurement has one.
  if (publishers_.conflict() && table_.name != "commands") {
    throw BadInput(dataset.folder + ": " + topic + ": " + *publishers_.conflict() +
                   "; expected one publisher of each measurement");
  }
  for (Column& column : table_.columns) {
    column.values.resize(table_.t.size(), 0.0);
    column.present.resize(table_.t.size(), 0);
  }
  put_in_order(topic, dataset);
  if (table_.stamp == table_.t) table_.stamp.clear();
  if (table_.bag_time == table_.t) table_.bag_time.clear();
  if (frames_differ_)
    not_carried.push_back(topic + ": frame_id, because it changes during the recording");
  if (!frames_differ_ && !frame_.empty()) {
    dataset.meta.other["frame_id_" + table_.name] = frame_ + "\n";
  }
  dataset.tables.push_back(std::move(table_));
}

Column& TopicTable::column_of(const std::string& name) {
  const auto found = index_.find(name);
  if (found != index_.end()) return table_.columns[found->second];
  index_[name] = table_.columns.size();
  table_.columns.push_back({name, {}, {}});
  return table_.columns.back();
}

/// Two publishers of commands may overtake each other; what one robot measures comes in order.
void TopicTable::put_in_order(const std::string& topic, Dataset& dataset) {
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
    throw BadInput(dataset.folder + ": " + topic + ": time goes backwards by " + time_text(worst) +
                   " s; expected a recording of one run");
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

}  // namespace anthrob
