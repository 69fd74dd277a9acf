#include "bus/error_frame.h"

#include <gtest/gtest.h>
#include <linux/can.h>
#include <linux/can/error.h>

namespace anthrob {
namespace driver {
namespace {

using Kind = BusEvent::Kind;

TEST(ErrorFrame, SaysTheWorst) {
  struct Case {
    std::uint32_t id;
    std::uint8_t controller;
    Kind expected;
  };
  const Case cases[] = {
      {CAN_ERR_BUSOFF, 0, Kind::kBusOff},
      {CAN_ERR_BUSOFF | CAN_ERR_CRTL | CAN_ERR_ACK, CAN_ERR_CRTL_TX_PASSIVE, Kind::kBusOff},
      {CAN_ERR_CRTL, CAN_ERR_CRTL_RX_PASSIVE, Kind::kErrorPassive},
      {CAN_ERR_CRTL, CAN_ERR_CRTL_TX_PASSIVE, Kind::kErrorPassive},
      {CAN_ERR_CRTL, CAN_ERR_CRTL_TX_PASSIVE | CAN_ERR_CRTL_RX_OVERFLOW, Kind::kErrorPassive},
      {CAN_ERR_CRTL, CAN_ERR_CRTL_RX_OVERFLOW, Kind::kReceiveOverrun},
      {CAN_ERR_CRTL, CAN_ERR_CRTL_RX_WARNING, Kind::kErrorWarning},
      {CAN_ERR_CRTL, CAN_ERR_CRTL_TX_WARNING, Kind::kErrorWarning},
      {CAN_ERR_CRTL, CAN_ERR_CRTL_ACTIVE, Kind::kErrorActive},
      {CAN_ERR_ACK, 0, Kind::kNoAcknowledge},
      {CAN_ERR_TX_TIMEOUT, 0, Kind::kNoAcknowledge},
      {CAN_ERR_CRTL | CAN_ERR_TX_TIMEOUT, 0, Kind::kNoAcknowledge},
      {CAN_ERR_RESTARTED, 0, Kind::kErrorActive},
      {CAN_ERR_PROT, 0, Kind::kBusError},
      {CAN_ERR_BUSERROR, 0, Kind::kBusError},
      // Without its class the byte means nothing.
      {CAN_ERR_ACK, CAN_ERR_CRTL_TX_PASSIVE, Kind::kNoAcknowledge},
  };
  for (const Case& c : cases) {
    EXPECT_EQ(kind_of_error(CAN_ERR_FLAG | c.id, c.controller), c.expected)
        << std::hex << c.id << " " << int(c.controller);
  }
}

}  // namespace
}  // namespace driver
}  // namespace anthrob
