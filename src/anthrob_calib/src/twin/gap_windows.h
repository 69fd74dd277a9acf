#pragma once

#include <array>
#include <vector>

#include "twin/twin_options.h"

namespace anthrob {
namespace twin {

/// Root mean squares over the last 1, 10 and 60 blocks of any number of series.
class GapWindows {
 public:
  GapWindows(std::size_t series, const TwinOptions& options);

  /// A bin of the block that is being filled; what is not finite does not count.
  void add(std::size_t series, double value);
  /// Ends the block.
  void close_block();
  void clear();

  struct Sum {
    double squares = 0.0, count = 0.0;
  };
  /// @param window index in kWindowBlocks
  Sum sum(std::size_t series, int window) const;
  /// Bins in a window that must have been compared.
  double least(int window) const;

 private:
  double told_;
  std::size_t series_;
  std::vector<Sum> blocks_;  ///< of the longest window, and the one that is being filled
  std::size_t current_ = 0;
};

}  // namespace twin
}  // namespace anthrob
