#include "anthrob_ecu/fault.h"

#include <cstddef>

namespace anthrob {
namespace ecu {

const FaultInfo kFaults[kFaultCount] = {
    {Fault::kNone, "none", "nothing is wrong", "nothing"},
    {Fault::kSelfTest, "self_test",
     "the self test at power-up failed: a current sensor reads an end stop",
     "check the current sensor, then switch the unit off and on"},
    {Fault::kOverCurrent, "over_current", "current above `current_limit` for 20 ms",
     "look for a short; for a jammed spindle only if the limit is below the stall current; "
     "clear_faults, enable"},
    {Fault::kOverForce, "over_force", "tension above `force_limit` for 5 ms",
     "look for antagonists pulling against each other; clear_faults, enable"},
    {Fault::kPositionLimit, "position_limit", "position outside `position_low`..`position_high`",
     "unwind by hand; clear_faults, enable, home: the zero may be lost"},
    {Fault::kOverSpeed, "over_speed", "speed above `speed_limit` for 5 ms",
     "look at the encoder, `encoder_scale` and what drives the spindle: no motor goes beyond its "
     "no-load speed by itself; clear_faults, enable, home"},
    {Fault::kOverTemperature, "over_temperature", "power stage above `temperature_limit`",
     "let it cool, lower the load, then clear_faults"},
    {Fault::kSupplyLow, "supply_low", "supply below 9 V for 10 ms",
     "check the power supply and its current limit, then clear_faults"},
    {Fault::kSupplyHigh, "supply_high", "supply above 20 V for 10 ms",
     "check the power supply; braking motors feed back into it; then clear_faults"},
    {Fault::kForceSensor, "force_sensor", "force sensor at an end stop for 20 ms",
     "check the strain gauge's cable; calibrate again if it was bent"},
    {Fault::kEncoder, "encoder",
     "more than half of `voltage_limit` for 300 ms and no more than 1 mrad of travel, or 2 counts",
     "check the encoder's cable and the spindle, then clear_faults, enable, home"},
    {Fault::kSyncLost, "sync_lost", "no valid SYNC for 15 ms",
     "look at the driver and the bus; enable again"},
    {Fault::kReferenceLost, "reference_lost", "enabled, and no valid REFERENCE for 15 ms",
     "look at the driver and the bus; enable again"},
    {Fault::kBusOff, "bus_off", "the unit's CAN controller went bus-off",
     "check cable, termination and bit rate; enable again"},
};

const char* name(Fault fault) {
  const auto index = static_cast<std::size_t>(fault);
  return index < kFaultCount ? kFaults[index].name : "unknown_fault";
}

}  // namespace ecu
}  // namespace anthrob
