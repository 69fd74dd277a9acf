#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "anthrob_recording/table.h"

namespace anthrob {

/// A column of another program's file: by the name in its header, or by its place.
struct ForeignColumn {
  std::string name;
  int place = 0;  ///< 1: the first; 0: by its name

  bool operator<(const ForeignColumn& other) const {
    return place != other.place ? place < other.place : name < other.name;
  }
};

/// How the text of such a file is laid out.
struct ForeignFormat {
  std::string map;  ///< file that says so, for messages
  char separator = ',';
  char decimal = '.';
  int header = 1;                     ///< line that names the columns; 0: none does
  int skip = 0;                       ///< lines between the names and the first row, such as units
  std::optional<ForeignColumn> time;  ///< none: rows are evenly spaced
  double time_scale = 1.0;            ///< [s] per unit of that column
  double time_offset = 0.0;           ///< [s] added: the start of this clock on the others'
  double rate = 0.0;                  ///< [Hz] without a column of times
};

/// The columns of a file that are used. NaN: an empty cell, not measured.
struct ForeignSheet {
  std::string file;
  std::vector<Nanoseconds> stamp;
  std::map<ForeignColumn, std::vector<double>> columns;

  /// [s] since the first row
  std::vector<double> times() const;
};

/// @throws BadInput naming file, line and column
ForeignSheet read_foreign_sheet(const std::string& file, const ForeignFormat& format,
                                const std::set<ForeignColumn>& wanted);

}  // namespace anthrob
