#pragma once

#include <cstdint>

#include "anthrob_ecu/frame.h"

namespace anthrob {
namespace driver {

/// Something that came in from a bus.
struct BusEvent {
  enum class Kind : std::uint8_t {
    kFrame,           ///< from another node
    kEcho,            ///< our own frame, now acknowledged on the wire
    kForeign,         ///< extended, remote or otherwise not of this protocol
    kErrorActive,     ///< the controller is well again
    kErrorWarning,    ///< 96 errors
    kErrorPassive,    ///< 128 errors: it may hardly speak any more
    kBusOff,          ///< 256 errors: it has left the bus
    kNoAcknowledge,   ///< nobody heard our frame
    kReceiveOverrun,  ///< frames were lost on our side
    kDown,            ///< the interface is down or gone
    kUp,              ///< and back
  };
  Kind kind = Kind::kFrame;
  ecu::Frame frame;
  std::int64_t stamp_ns = 0;  ///< the kernel's, of the wall clock; 0: unknown
};

enum class SendResult : std::uint8_t { kSent, kQueueFull, kDown };

/// One end of a CAN bus. Never blocks.
class Bus {
 public:
  virtual ~Bus() = default;
  /// May keep the frame until flush(), to hand many over at once; STOP never waits.
  virtual SendResult send(const ecu::Frame& frame) = 0;
  virtual SendResult flush() { return SendResult::kSent; }
  /// @return false if nothing more has come in
  virtual bool receive(BusEvent& event) = 0;
  /// To be called now and then while the interface is down: tries to get it back.
  virtual void recover() {}
};

}  // namespace driver
}  // namespace anthrob
