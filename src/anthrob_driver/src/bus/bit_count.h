#pragma once

#include "anthrob_ecu/frame.h"

namespace anthrob {
namespace driver {

/// Bits of a data frame with an 11-bit identifier on the wire, the three of the pause included.
struct BitCount {
  int plain;  ///< without stuff bits
  int exact;  ///< with the stuff bits of this very frame
  int worst;  ///< with as many stuff bits as a frame of this length can have
};
BitCount count_bits(const ecu::Frame& frame);

}  // namespace driver
}  // namespace anthrob
