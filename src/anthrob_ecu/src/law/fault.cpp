#include "anthrob_ecu/fault.h"

#include <cstddef>

namespace anthrob {
namespace ecu {

const FaultInfo kFaults[kFaultCount] = {
    {Fault::kNone, "none", "nothing is wrong", "nothing"},
    {Fault::kSelfTest, "self_test",
     "the self test at power-up failed: a current sensor reads below 8 or above 4087 counts",
     "check the current sensor, then switch the unit off and on; clear_faults, enable, home"},
    {Fault::kOverCurrent, "over_current", "current above `current_limit` for 20 ms",
     "look for a short circuit, or for a jammed spindle if the limit is below the stall current; "
     "clear_faults, enable"},
    {Fault::kOverForce, "over_force", "tension above `force_limit` for 5 ms",
     "look for antagonists that pull against each other; clear_faults, enable"},
    {Fault::kPositionLimit, "position_limit",
     "position more than 0.5 rad outside `position_low`..`position_high`",
     "unwind by hand; clear_faults, enable, home: the zero may be lost"},
    {Fault::kOverSpeed, "over_speed", "speed above `speed_limit` for 5 ms",
     "check the encoder, `encoder_scale` and what drives the spindle: no motor exceeds its no-load "
     "speed by itself; clear_faults, enable, home"},
    {Fault::kOverTemperature, "over_temperature", "power stage above `temperature_limit`",
     "let it cool and lower the load; clear_faults, enable"},
    {Fault::kSupplyLow, "supply_low", "supply below 9 V for 10 ms",
     "check the power supply and its current limit; clear_faults, enable"},
    {Fault::kSupplyHigh, "supply_high", "supply above 20 V for 10 ms",
     "check the power supply: braking motors feed back into it; clear_faults, enable"},
    {Fault::kForceSensor, "force_sensor", "force sensor below 8 or above 4087 counts for 20 ms",
     "check the strain gauge's cable; recalibrate if it was bent; clear_faults, enable"},
    {Fault::kEncoder, "encoder",
     "more than half of `voltage_limit` for 300 ms, but no more than 1 mrad of travel (2 counts, "
     "if that is more)",
     "check the encoder's cable and the spindle; clear_faults, enable, home"},
    {Fault::kSyncLost, "sync_lost", "enabled, and no valid SYNC for 15 ms",
     "check the driver and the bus; enable again, after clear_faults if the driver found "
     "`ecu_lost`"},
    {Fault::kReferenceLost, "reference_lost", "enabled, and no valid REFERENCE for 15 ms",
     "check the driver and the bus; enable again"},
    {Fault::kBusOff, "bus_off", "enabled, and the unit's CAN controller went bus-off",
     "check cable, termination and bit rate; enable again, after clear_faults if the driver found "
     "`ecu_lost`"},
};

const char* name(Fault fault) {
  const auto index = static_cast<std::size_t>(fault);
  return index < kFaultCount ? kFaults[index].name : "unknown_fault";
}

}  // namespace ecu
}  // namespace anthrob
