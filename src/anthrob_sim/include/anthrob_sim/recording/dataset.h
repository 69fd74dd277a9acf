#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "anthrob_sim/model/config_node.h"

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

/// A quantity over time, without the rows in which it was not measured.
struct Series {
  std::vector<double> t;  ///< [s] since the start of the recording
  std::vector<double> values;

  bool empty() const { return t.empty(); }
  /// Value interpolated linearly between samples, constant beyond the ends.
  double at(double time) const;
  /// Value of the last sample not later than `time`; before the first sample, that of the first.
  double held_at(double time) const;
  /// For efforts and loads: as held_at(), but 0 before the first sample if that comes later than
  /// 0.1 s.
  double acting_at(double time) const;
};

/// Fast Series::held_at() for times that never decrease, as in a simulation run. It continues the
/// search at the last sample, and says when a new sample begins to hold.
class HeldSeries {
 public:
  /// @param series must outlive this
  explicit HeldSeries(const Series& series) : series_(&series) {}

  /// Advances to `time`. @return whether a new sample holds since the last call; true at the first
  bool advance(double time);
  /// Value of the current sample; the series must not be empty.
  double value() const { return series_->values[passed_ == 0 ? 0 : passed_ - 1]; }

 private:
  const Series* series_;
  std::size_t passed_ = 0;  ///< samples not later than the last time
  bool begun_ = false;
};

/// meta.yaml of a dataset folder. What is not listed here is kept in `other`.
struct DatasetMeta {
  std::string robot;
  std::string kind = "trajectory";                 ///< equilibrium | trajectory | rig
  double rate = 0.0;                               ///< [Hz], 0: not given
  std::string start = "first";                     ///< first | zero | given
  std::map<std::string, double> start_position;    ///< [rad] by muscle, if `given`
  double settle_s = 5.0;                           ///< [s]
  std::map<std::string, std::string> other_start;  ///< unknown keys of `start`, as YAML text
  std::map<std::string, std::string> other;  ///< sensors, notes and unknown keys, as YAML text
};

/// meta.yaml of a dataset folder, or NAME.yaml beside NAME.bag.
/// @param remarks gets one line for each unknown key
/// @throws BadInput for values that are not allowed
DatasetMeta load_meta(const std::string& file, std::vector<std::string>* remarks);
std::string meta_text(const DatasetMeta& meta);

/// A recording as a folder of CSV files and a meta.yaml.
struct Dataset {
  std::string folder;  ///< where it came from, for messages
  DatasetMeta meta;
  std::vector<Table> tables;
  std::vector<std::string> remarks;  ///< harmless oddities found while reading; not saved

  /// @throws BadInput with one line: file, line or row, value, what was expected
  static Dataset load(const std::string& folder);
  /// Writes the folder. Files are written under temporary names and renamed when all are complete.
  /// Replaces a recording that the folder already holds, all its tables included.
  /// @throws std::runtime_error naming the file that cannot be written
  /// @throws BadInput if the folder holds CSV files that are no part of a recording
  void save(const std::string& folder) const;
  /// Checks before a long computation whether save() will be possible.  @throws as save()
  void require_place(const std::string& folder) const;

  const Table* find_table(const std::string& name) const;
  Table& table(const std::string& name);
  /// Time of the first and of the last row of any table.
  Nanoseconds begin() const;
  Nanoseconds end() const;
  /// Samples of a column, in whichever table it is; the table of commands is searched first. Empty
  /// if there is no such column.
  Series series(const std::string& column) const;
};

/// Quantities that a column may hold.
bool is_known_quantity(const std::string& quantity);
/// Word for a number of a `mode` or `ecu_state` column, and back; -1 for an unknown word.
std::string word_of(const std::string& quantity, int value);
int number_of(const std::string& quantity, const std::string& word);
bool holds_words(const std::string& quantity);

/// Shortest decimal text that reads back as the same double.
std::string exact_text(double value);
/// Seconds with up to nine decimals, exact.
std::string time_text(Nanoseconds t);

}  // namespace anthrob
