#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "anthrob_recording/dataset.h"

namespace anthrob {

/// Meaning of the columns of a CSV file of another program: the file MAP.yaml of
/// `anthrob_convert --columns MAP.yaml FILE.csv DIR`.
struct ForeignColumns {
  struct Entry {
    std::string from;                  ///< as in the file's header
    std::string to;                    ///< `<joint>/position`, ...
    double scale = 1.0, offset = 0.0;  ///< value = scale * cell + offset
    std::string table;                 ///< file of the dataset folder it goes to
    std::optional<int> mode;           ///< of a reference, if given
  };
  /// A ball joint's orientation from three columns.
  struct Orientation {
    std::string joint;
    std::array<std::string, 3> from;  ///< as in the file's header
    std::string order;                ///< of Euler angles, "xyz"; empty: a rotation vector
    double unit = 1.0;                ///< [rad] of the columns
    std::string table;
  };
  std::string file;         ///< of the map, for messages
  std::string time;         ///< column of the time; empty: rows are evenly spaced
  double time_scale = 1.0;  ///< seconds per unit of that column
  double rate = 0.0;        ///< [Hz] without a time column
  char separator = ',';
  std::vector<Entry> entries;
  std::vector<Orientation> orientations;
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

/// Reads a CSV file of another program; empty cells count as not measured.
/// @throws BadInput naming file, line and column
Dataset read_foreign_csv(const std::string& file, const ForeignColumns& columns);

}  // namespace anthrob
