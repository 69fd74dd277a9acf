#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace anthrob {
namespace driver {

/// Faults of host, bus or ECUs that the driver can notice.
enum class Finding : std::uint8_t {
  kInterfaceDown,
  kBusOff,
  kErrorPassive,
  kErrorWarning,
  kNoAcknowledge,
  kQueueFull,
  kBusSilent,
  kReceiveOverrun,
  kBusFlooded,
  kSecondHost,
  kForeignFrame,
  kCorruptFrame,
  kWrongLength,
  kRepeatedFrame,
  kLostFrame,
  kEcuSilent,
  kEcuLost,
  kEcuRestarted,
  kEcuFault,
  kEcuStopped,
  kStopLatched,
  kWrongVersion,
  kConfigurationRefused,
  kJointSensor,
  kEnableRefused,
  kLateCycle,
  kCommandTimeout,
  kHomeFailed,
  kTendonSlack,
  kEncoderDead,
  kForceImplausible,
  kMotorHot,
  kUnregistered,
  kNoDescriptors,
};
constexpr int kFindingCount = 34;

struct FindingInfo {
  Finding finding;
  const char* name;
  bool stops;  ///< the driver stops all motors; they stay disabled until the user calls enable
  const char* meaning;
  const char* remedy;  ///< what the user should do
};

/// One row for each finding, in the order of the enum.
extern const FindingInfo kFindings[kFindingCount];
const FindingInfo& info(Finding finding);

/// What was found, when, and how often.
class Findings {
 public:
  struct Entry {
    Finding finding;
    std::optional<int> ecu;  ///< index of the ECU; none: does not concern a single one
    std::string detail;
    double first = 0.0, last = 0.0;  ///< [s]
    std::uint64_t count = 0;
  };

  void add(Finding finding, std::optional<int> ecu, double time, const std::string& detail = "");
  /// Everything that was found since the last clear().
  const std::vector<Entry>& entries() const { return entries_; }
  /// Whether it was last seen at most `seconds` ago.
  bool recent(const Entry& entry, double time, double seconds = 3.0) const {
    return time - entry.last <= seconds;
  }
  std::uint64_t count(Finding finding) const;
  void clear() { entries_.clear(); }

 private:
  std::vector<Entry> entries_;
};

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
  std::optional<std::string> last() const {
    if (reasons_.empty()) return std::nullopt;
    return reasons_.back();
  }
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
