#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace anthrob {

/// Time stamps are whole nanoseconds, as in ROS, so that they survive files bit for bit.
using Nanoseconds = std::int64_t;
inline double seconds(Nanoseconds t) {
  return 1e-9 * static_cast<double>(t);
}

/// One column of a table. Words (modes, states) are kept as the numbers they have in messages.
struct Column {
  std::string name;            ///< `<muscle>/position`, `<joint>/effort`, `<ball_joint>/w`, ...
  std::vector<double> values;  ///< one per row; meaningless where not present
  std::vector<char> present;   ///< 0 for an empty cell, which means not measured

  /// "biceps_brachii" of "biceps_brachii/position"
  std::string owner() const { return name.substr(0, name.find('/')); }
  /// "position" of "biceps_brachii/position"
  std::string quantity() const { return name.substr(name.find('/') + 1); }
};

/// One CSV file of a dataset folder, with its own time column and one row per sample.
struct Table {
  std::string name;  ///< "muscles" for muscles.csv
  std::vector<Nanoseconds> t;
  /// Header stamp and time of arrival of each message of a bag (columns `stamp` and `bag_time`);
  /// empty if they equal t.
  std::vector<Nanoseconds> stamp, bag_time;
  std::vector<Column> columns;

  const Column* find(const std::string& column) const;
  /// The column of this name; created with empty cells if there is none.
  Column& column(const std::string& column);
};

/// Shortest decimal text that reads back as the same double.
std::string exact_text(double value);
/// Seconds with up to nine decimals, exact.
std::string time_text(Nanoseconds t);

}  // namespace anthrob
