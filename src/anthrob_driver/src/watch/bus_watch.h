#pragma once

#include <optional>
#include <string>

#include "anthrob_driver/bus/bus.h"
#include "anthrob_driver/findings.h"

namespace anthrob {
namespace driver {

/// State of the host's end of the bus, determined from error frames, full queues and missing echoes
/// of our own frames.
class BusWatch {
 public:
  enum class Condition { kGood, kPassive, kOff, kDown };
  static constexpr double kEchoTimeout = 0.02;  ///< [s] without an echo of anything we sent
  static constexpr int kFullCycles = 3;         ///< cycles in which the queue was full
  /// Frames in a cycle. Chosen: 7 ECUs send 22 to 36.
  static constexpr int kFlood = 150;

  explicit BusWatch(Findings& findings, double rate) : findings_(findings), rate_(rate) {}

  /// To be called with every event of the bus, including frames.
  void receive(const BusEvent& event, double now);
  void sent(SendResult result, double now);
  /// Once a cycle, before SYNC is sent.
  /// @param late [s] for which the host itself was paused; missing echoes are excused for as long
  void cycle(double now, double late);

  Condition condition() const { return condition_; }
  /// Why motors must not be enabled on this bus, if anything is wrong with it.
  std::optional<std::string> trouble() const;
  /// What was found last that must stop the motors, since the last call.
  std::optional<Finding> take_stop();
  std::uint64_t frames() const { return frames_; }

 private:
  void found(Finding finding, double now);

  Findings& findings_;
  double rate_;
  Condition condition_ = Condition::kGood;
  std::optional<Finding> stop_;
  bool queue_full_ = false;
  int full_cycles_ = 0;
  bool echoes_ = false;  ///< whether this bus has ever returned an echo
  double last_echo_ = 0.0;
  bool unheard_ = false;
  std::uint64_t frames_ = 0;
  int frames_this_cycle_ = 0;
};

}  // namespace driver
}  // namespace anthrob
