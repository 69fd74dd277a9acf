#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <vector>

#include "anthrob_driver/bus/bus.h"

namespace anthrob {
namespace driver {

/// A bus in memory for tests: frames wait until deliver(), the lowest identifier goes first as in
/// CAN's arbitration, everybody but the sender gets it and the sender gets an echo.
///
/// `tamper` sees every frame on its way: what it returns is delivered instead, so a test drops,
/// doubles, changes or delays frames there.
class MemoryBus {
 public:
  class Port;
  /// A frame on its way, and the port it came from.
  using Tamper = std::function<std::vector<ecu::Frame>(const ecu::Frame&, const Port& from)>;

  /// Ports live as long as the bus.
  Port& attach();
  /// Moves all waiting frames. @param stamp_ns given to what is delivered
  void deliver(std::int64_t stamp_ns);
  Tamper tamper;
  /// Bits that went over the wire, with stuffing.
  std::uint64_t bits() const { return bits_; }
  std::uint64_t frames() const { return frames_; }

 private:
  struct Waiting {
    ecu::Frame frame;
    Port* from;
  };
  std::vector<std::unique_ptr<Port>> ports_;
  std::deque<Waiting> waiting_;
  std::uint64_t bits_ = 0, frames_ = 0;
};

class MemoryBus::Port final : public Bus {
 public:
  explicit Port(MemoryBus& bus) : bus_(bus) {}
  SendResult send(const ecu::Frame& frame) override;
  bool receive(BusEvent& event) override;
  void recover() override {}

  /// The driver of this port reports something, such as an error of the controller.
  void report(BusEvent::Kind kind, std::int64_t stamp_ns = 0);
  /// Off: hears nothing and cannot send; the kernel reports it like a removed interface.
  void set_up(bool up);
  /// Like a controller that gets no acknowledge: its queue takes `left` frames more, which go
  /// nowhere.
  void jam(int left) { jammed_ = true, room_ = left; }
  void release() { jammed_ = false; }

 private:
  friend class MemoryBus;
  MemoryBus& bus_;
  std::deque<BusEvent> inbox_;
  bool up_ = true, jammed_ = false;
  int room_ = 0;
};

}  // namespace driver
}  // namespace anthrob
