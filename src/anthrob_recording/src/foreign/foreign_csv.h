#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "anthrob_recording/dataset.h"
#include "foreign/foreign_sheet.h"
#include "foreign/foreign_value.h"
#include "foreign/pieces.h"

namespace anthrob {

/// A CSV file of another program, with a clock of its own.
struct ForeignStream {
  struct Entry {
    ForeignValue from;                 ///< what is taken or made of the file's columns
    std::string to;                    ///< `<joint>/position`, ...
    double scale = 1.0, offset = 0.0;  ///< value = scale * from + offset
    std::string table = {};            ///< file of the dataset folder it goes to
    std::optional<int> mode = {};      ///< of a reference, if given
  };
  /// A ball joint's orientation from three columns.
  struct Orientation {
    std::string joint;
    std::vector<ForeignValue> from;  ///< three
    std::string order;               ///< of Euler angles, "xyz"; empty: a rotation vector
    double unit = 1.0;               ///< [rad] of the columns
    std::string table;
  };
  std::string name;  ///< among the streams; empty: the only one
  std::string file;  ///< in the folder that is converted; empty: the file that is converted
  ForeignFormat format;
  std::vector<Entry> entries;
  std::vector<Orientation> orientations;
};

/// Meaning of the columns of CSV files of another program: the file MAP.yaml of
/// `anthrob_convert --columns MAP.yaml FILE.csv DIR`.
struct ForeignColumns {
  std::string file;  ///< of the map, for messages
  std::vector<ForeignStream> streams;
  double rows = 0.0;         ///< [Hz] of the time base of all streams; 0: each keeps its own
  std::vector<Piece> split;  ///< what becomes data sets of their own; empty: the whole
  DatasetMeta meta;

  /// @throws BadInput
  static ForeignColumns load(const std::string& file);
};

/// @param angles [rad] intrinsic, about the axes that `order` names: R = R_1(a) R_2(b) R_3(c)
/// @param order three of x, y and z, no two neighbours the same
/// @return unit, w >= 0
Eigen::Quaterniond from_euler(const std::string& order, const Eigen::Vector3d& angles);
/// @param rotation axis times angle [rad]   @return unit, w >= 0
Eigen::Quaterniond from_rotation_vector(const Eigen::Vector3d& rotation);

/// Reads CSV files of another program; empty cells count as not measured. The whole recording, not
/// split.
/// @param path the file, or the folder of the files that `streams` names
/// @throws BadInput naming file, line and column
Dataset read_foreign_csv(const std::string& path, const ForeignColumns& columns);

}  // namespace anthrob
