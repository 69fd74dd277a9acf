#include "bus/error_frame.h"

#include <linux/can/error.h>

namespace anthrob {
namespace driver {

BusEvent::Kind kind_of_error(std::uint32_t id, std::uint8_t controller) {
  using Kind = BusEvent::Kind;
  if (id & CAN_ERR_BUSOFF) return Kind::kBusOff;
  if (id & CAN_ERR_CRTL) {
    if (controller & (CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE)) {
      return Kind::kErrorPassive;
    }
    if (controller & CAN_ERR_CRTL_RX_OVERFLOW) return Kind::kReceiveOverrun;
    if (controller & (CAN_ERR_CRTL_RX_WARNING | CAN_ERR_CRTL_TX_WARNING)) {
      return Kind::kErrorWarning;
    }
    if (controller & CAN_ERR_CRTL_ACTIVE) return Kind::kErrorActive;
  }
  // After a time-out the controller gave up a frame that it sent again and again: nobody
  // acknowledged it.
  if (id & (CAN_ERR_ACK | CAN_ERR_TX_TIMEOUT)) return Kind::kNoAcknowledge;
  if (id & CAN_ERR_RESTARTED) return Kind::kErrorActive;
  return Kind::kBusError;
}

}  // namespace driver
}  // namespace anthrob
