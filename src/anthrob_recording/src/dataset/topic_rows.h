#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "anthrob_core/publishers.h"
#include "anthrob_recording/dataset.h"

namespace anthrob {

/// Cells of one row: column name and value.
using Cells = std::vector<std::pair<std::string, double>>;

/// What one message of a recording's topic says.
struct TopicRow {
  Nanoseconds stamp = 0;    ///< of its header; 0: none
  Nanoseconds arrival = 0;  ///< in the bag
  std::string frame;        ///< frame_id
  std::string node;         ///< who published it; empty if the bag does not say
  std::vector<std::string> owners;
  bool complete = true;  ///< false: its lists differ in length
  Cells cells;
};

/// Whether names can head columns, and which value is whose: no separators in them, none twice.
bool are_column_owners(const std::vector<std::string>& names);

/// Collects the messages of one topic into a table.
class TopicTable {
 public:
  explicit TopicTable(const std::string& name) { table_.name = name; }

  void add(const TopicRow& row);

  /// Puts the finished table into the dataset and says what could not be carried.
  /// @param not_carried gets lines
  /// @throws BadInput for two publishers of a measurement, or time that goes backwards
  void finish(const std::string& topic, Dataset& dataset, std::vector<std::string>& not_carried);

 private:
  Column& column_of(const std::string& name);
  void put_in_order(const std::string& topic, Dataset& dataset);

  Table table_;
  std::map<std::string, std::size_t> index_;
  std::string frame_;
  bool frames_differ_ = false;
  Publishers publishers_;
  int malformed_ = 0;
  int bare_ = 0;  ///< messages with names and no values
};

}  // namespace anthrob
