#include "anthrob_driver/emulation/memory_bus.h"

#include <algorithm>

#include "bus/bit_count.h"

namespace anthrob {
namespace driver {

MemoryBus::Port& MemoryBus::attach() {
  ports_.push_back(std::make_unique<Port>(*this));
  return *ports_.back();
}

void MemoryBus::deliver(std::int64_t stamp_ns) {
  std::stable_sort(waiting_.begin(), waiting_.end(),
                   [](const Waiting& a, const Waiting& b) { return a.frame.id < b.frame.id; });
  while (!waiting_.empty()) {
    const Waiting next = waiting_.front();
    waiting_.pop_front();
    const std::vector<ecu::Frame> frames =
        tamper ? tamper(next.frame, *next.from) : std::vector<ecu::Frame>{next.frame};
    for (const ecu::Frame& frame : frames) {
      bits_ += static_cast<std::uint64_t>(count_bits(frame).exact);
      ++frames_;
      for (const auto& port : ports_) {
        if (!port->up_ || port->jammed_) continue;
        const bool own = port.get() == next.from;
        const auto kind = own ? BusEvent::Kind::kEcho : BusEvent::Kind::kFrame;
        port->inbox_.push_back({kind, frame, stamp_ns});
      }
    }
  }
}

SendResult MemoryBus::Port::send(const ecu::Frame& frame) {
  if (!up_) return SendResult::kDown;
  if (jammed_) return room_-- > 0 ? SendResult::kSent : SendResult::kQueueFull;
  bus_.waiting_.push_back({frame, this});
  return SendResult::kSent;
}

bool MemoryBus::Port::receive(BusEvent& event) {
  if (inbox_.empty()) return false;
  event = inbox_.front();
  inbox_.pop_front();
  return true;
}

void MemoryBus::Port::report(BusEvent::Kind kind, std::int64_t stamp_ns) {
  inbox_.push_back({kind, {}, stamp_ns});
}

void MemoryBus::Port::set_up(bool up) {
  if (up != up_) report(up ? BusEvent::Kind::kUp : BusEvent::Kind::kDown);
  up_ = up;
}

}  // namespace driver
}  // namespace anthrob
