#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

namespace anthrob {
namespace driver {

/// How often motors were stopped, and the last few reasons, for readers that poll.
class StopLog {
 public:
  static constexpr std::size_t kRemembered = 8;

  void add(const std::string& reason) {
    ++count_;
    reasons_.push_back(reason);
    if (reasons_.size() > kRemembered) reasons_.pop_front();
  }
  std::uint64_t count() const { return count_; }
  /// Empty if there was none.
  std::string last() const { return reasons_.empty() ? "" : reasons_.back(); }
  /// The reasons of all stops after the first `count`, as far as they are still remembered.
  std::vector<std::string> since(std::uint64_t count) const {
    const auto missed = static_cast<std::size_t>(count_ - std::min(count, count_));
    return {reasons_.end() - static_cast<std::ptrdiff_t>(std::min(missed, reasons_.size())),
            reasons_.end()};
  }

 private:
  std::uint64_t count_ = 0;
  std::deque<std::string> reasons_;
};

}  // namespace driver
}  // namespace anthrob
