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
    kErrorActive,     ///< the controller has recovered
    kErrorWarning,    ///< 96 errors, and less than 128
    kBusError,        ///< a single error
    kErrorPassive,    ///< 128 errors: it may send only in a restricted way
    kBusOff,          ///< 256 errors: it has left the bus
    kNoAcknowledge,   ///< no node acknowledged our frame (in time)
    kReceiveOverrun,  ///< frames were lost on the host
    kDown,            ///< the interface is down or gone
    kUp,              ///< the interface is up again
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
  /// May keep the frame until flush(), to pass many to the kernel at once. STOP never waits.
  virtual SendResult send(const ecu::Frame& frame) = 0;
  virtual SendResult flush() { return SendResult::kSent; }
  /// @return false if nothing more has come in
  virtual bool receive(BusEvent& event) = 0;
  /// Tries to reopen the interface. To be called regularly while it is down.
  virtual void recover() {}
};

}  // namespace driver
}  // namespace anthrob
