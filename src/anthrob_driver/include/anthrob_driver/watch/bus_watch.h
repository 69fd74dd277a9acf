#pragma once

#include <string>

#include "anthrob_driver/bus/bus.h"
#include "anthrob_driver/findings.h"

namespace anthrob {
namespace driver {

/// Health of our end of the bus, from error frames, full queues and echoes that do not come.
class BusWatch {
 public:
  enum class Condition { kGood, kPassive, kOff, kDown };
  static constexpr double kEchoTimeout = 0.02;  ///< [s] without an echo of anything we sent
  static constexpr int kFullCycles = 3;         ///< cycles in which the queue was full
  static constexpr int kFlood = 150;            ///< frames in a cycle; 7 ECUs send 22 to 36

  explicit BusWatch(Findings& findings, double rate) : findings_(findings), rate_(rate) {}

  /// Everything that came in, frames too.
  void receive(const BusEvent& event, double now);
  void sent(SendResult result, double now);
  /// Once a cycle, before SYNC is sent.
  /// @param late [s] in which the host did nothing: no echo is missed for it
  void cycle(double now, double late);

  Condition condition() const { return condition_; }
  /// Empty if the bus can be trusted to carry motion; otherwise what is wrong.
  std::string trouble() const;
  /// Something that must stop the motors came up since the last call.
  bool take_stop(Finding& finding);
  std::uint64_t frames() const { return frames_; }

 private:
  void found(Finding finding, double now);

  Findings& findings_;
  double rate_;
  Condition condition_ = Condition::kGood;
  bool stop_ = false;
  Finding stop_finding_ = Finding::kInterfaceDown;
  bool queue_full_ = false;
  int full_cycles_ = 0;
  bool echoes_ = false;  ///< this bus gives echoes at all
  double last_echo_ = 0.0;
  bool unheard_ = false;
  std::uint64_t frames_ = 0;
  int frames_this_cycle_ = 0;
};

}  // namespace driver
}  // namespace anthrob
