#include "twin/gap_windows.h"

#include <algorithm>
#include <cmath>

namespace anthrob {
namespace twin {

namespace {

constexpr std::size_t kSlots = kWindowBlocks[kWindowCount - 1] + 1;

}  // namespace

GapWindows::GapWindows(std::size_t series, const TwinOptions& options)
    : told_(options.half_told * options.bins_in_block), series_(series), blocks_(kSlots * series) {}

void GapWindows::add(std::size_t series, double value) {
  if (!std::isfinite(value)) return;
  Sum& sum = blocks_[current_ * series_ + series];
  sum.squares += value * value;
  sum.count += 1.0;
}

void GapWindows::close_block() {
  current_ = (current_ + 1) % kSlots;
  std::fill_n(blocks_.begin() + static_cast<std::ptrdiff_t>(current_ * series_), series_, Sum{});
}

void GapWindows::clear() {
  std::fill(blocks_.begin(), blocks_.end(), Sum{});
}

GapWindows::Sum GapWindows::sum(std::size_t series, int window) const {
  Sum all;
  for (int b = 1; b <= kWindowBlocks[window]; ++b) {
    const std::size_t block = (current_ + kSlots - static_cast<std::size_t>(b)) % kSlots;
    const Sum& one = blocks_[block * series_ + series];
    all.squares += one.squares;
    all.count += one.count;
  }
  return all;
}

double GapWindows::least(int window) const {
  return told_ * kWindowBlocks[window];
}

}  // namespace twin
}  // namespace anthrob
