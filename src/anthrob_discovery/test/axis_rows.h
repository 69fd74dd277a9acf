#pragma once

#include <cmath>
#include <string>

#include "anthrob_recording/dataset.h"

namespace anthrob {
namespace discovery {

/// A made recording of a driven joint, named axis, row by row.
class AxisRows {
 public:
  AxisRows(const std::string& folder, const std::string& robot) {
    data_.folder = folder;
    data_.meta.robot = robot;
    Table& table = data_.table("joints");
    table.column("axis/position");
    table.column("axis/effort");
  }

  /// @param t [s]   @param effort [Nm or N]
  void add(double t, double position, double effort) {
    Table& table = data_.tables.front();
    table.t.push_back(static_cast<Nanoseconds>(std::llround(1e9 * t)));
    const double row[] = {position, effort};
    for (std::size_t k = 0; k < 2; ++k) {
      table.columns[k].values.push_back(row[k]), table.columns[k].present.push_back(1);
    }
  }
  const Dataset& data() const { return data_; }

 private:
  Dataset data_;
};

}  // namespace discovery
}  // namespace anthrob
