#pragma once

#include <string>
#include <vector>

#include "anthrob_sim/recording/dataset.h"

namespace anthrob {

/// What the columns of somebody else's CSV file are in our words: the file MAP.yaml of
/// `anthrob_convert --columns MAP.yaml FILE.csv DIR`.
struct ForeignColumns {
  struct Entry {
    std::string from;                  ///< as in the file's header
    std::string to;                    ///< `<joint>/position`, ...
    double scale = 1.0, offset = 0.0;  ///< ours = scale * theirs + offset
    std::string table;                 ///< file of the dataset folder it goes to
  };
  std::string file;         ///< of the map, for messages
  std::string time;         ///< column of the time; empty: rows are evenly spaced
  double time_scale = 1.0;  ///< [s] a unit of it
  double rate = 0.0;        ///< [Hz] without a time column
  char separator = ',';
  std::vector<Entry> entries;
  DatasetMeta meta;

  /// @throws BadInput
  static ForeignColumns load(const std::string& file);
};

/// Numbers of a foreign file; empty cells are not measured.
/// @throws BadInput naming file, line and column
Dataset read_foreign_csv(const std::string& file, const ForeignColumns& columns);

}  // namespace anthrob
