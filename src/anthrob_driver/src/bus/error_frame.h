#pragma once

#include <cstdint>

#include "anthrob_driver/bus/bus.h"

namespace anthrob {
namespace driver {

/// What an error frame of Linux says (linux/can/error.h), the worst first.
/// @param id of the frame: bits CAN_ERR_... of the classes of errors
/// @param controller its data[1]: bits CAN_ERR_CRTL_..., valid if the class CAN_ERR_CRTL is set
BusEvent::Kind kind_of_error(std::uint32_t id, std::uint8_t controller);

}  // namespace driver
}  // namespace anthrob
