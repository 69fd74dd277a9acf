#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "anthrob_core/random.h"
#include "anthrob_recording/dataset.h"

namespace anthrob {
namespace virtual_rig {

/// Deviations of one virtual rig from its drawings, one after the other, the same for equal seeds.
class Deviations {
 public:
  explicit Deviations(std::uint64_t seed, std::uint64_t stream) : random_(seed, stream) {}
  /// The next one, normal with this standard deviation.
  double next(double sigma) { return sigma * random_.normal(count_++); }

 private:
  CounterRandom random_;
  std::uint64_t count_ = 0;
};

/// Adds rows to a table of a recording that is being made.
class RowWriter {
 public:
  RowWriter(Table& table, const std::vector<std::string>& columns);
  /// @param time [s], rounded to a nanosecond   @param values one a column
  void add(double time, const std::vector<double>& values);

 private:
  Table& table_;
};

}  // namespace virtual_rig
}  // namespace anthrob
