#pragma once

#include <string>
#include <vector>

#include "anthrob_recording/dataset_meta.h"
#include "anthrob_recording/series.h"
#include "anthrob_recording/table.h"

namespace anthrob {

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

}  // namespace anthrob
