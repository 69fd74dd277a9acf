#include "anthrob_driver/findings.h"

#include <cstddef>

namespace anthrob {
namespace driver {

// clang-format off
const FindingInfo kFindings[kFindingCount] = {
    {Finding::kInterfaceDown, "interface_down", true, "the CAN interface is down or gone", "plug the adapter in, `ip link set can0 up type can bitrate 1000000 restart-ms 100`; enable again"},
    {Finding::kBusOff, "bus_off", true, "the host's CAN controller has left the bus after 256 errors", "check cable, termination (120 ohm at both ends) and bit rate; enable again"},
    {Finding::kErrorPassive, "error_passive", true, "the host's CAN controller counted 128 errors", "as bus_off; if that is still refused, set the interface down and up"},
    {Finding::kErrorWarning, "error_warning", false, "the host's CAN controller counted 96 errors, or reports a bus error", "check cable and termination soon"},
    {Finding::kNoAcknowledge, "no_acknowledge", true, "nobody acknowledges our frames", "switch the ECUs on; check the cable and the bit rate; enable again"},
    {Finding::kQueueFull, "queue_full", true, "the interface takes no more frames (ENOBUFS) for three cycles", "as no_acknowledge; or lower the rate"},
    {Finding::kReceiveOverrun, "receive_overrun", false, "frames were lost on the host", "use `realtime:=true`; look for a busy machine"},
    {Finding::kBusFlooded, "bus_flooded", false, "far more frames than the ECUs can send", "find the node that talks too much: `candump -t d can0`"},
    {Finding::kSecondHost, "second_host", true, "somebody else sends SYNC, requests or references", "stop the other driver; one bus has one host"},
    {Finding::kForeignFrame, "foreign_frame", false, "a frame that is not of this protocol, or of a node that is not configured", "take other devices off the bus, or list the ECU in hardware.yaml"},
    {Finding::kCorruptFrame, "corrupt_frame", false, "a frame whose checksum is wrong; it was ignored", "look for two nodes with one number, bad gateways, broken memory"},
    {Finding::kWrongLength, "wrong_length", false, "a frame of wrong length; it was ignored", "check the firmware's version; look for foreign devices"},
    {Finding::kRepeatedFrame, "repeated_frame", false, "a status with an old counter; it was ignored", "look for gateways that repeat frames, two nodes with one number, a busy host"},
    {Finding::kLostFrame, "lost_frame", false, "an ECU did not answer a SYNC", "look at the bus load and error counters"},
    {Finding::kEcuSilent, "ecu_silent", false, "an ECU that is configured was never heard", "switch it on; check its node number"},
    {Finding::kEcuLost, "ecu_lost", true, "no complete answer of an ECU to two SYNCs in a row", "check its power and cable; clear_faults, enable"},
    {Finding::kEcuRestarted, "ecu_restarted", true, "an ECU started anew: its zero is lost", "check its power; clear_faults, enable, home"},
    {Finding::kEcuFault, "ecu_fault", true, "an ECU reports a fault, named in its diagnostics", "see the ECU's fault codes; clear_faults, enable; home if its zero is lost"},
    {Finding::kEcuStopped, "ecu_stopped", true, "an ECU stopped by itself while enabled", "see its reason in diagnostics; enable again"},
    {Finding::kStopLatched, "stop_latched", true, "an ECU holds an emergency stop that did not come from here", "find who sent it; clear_faults, enable"},
    {Finding::kWrongVersion, "wrong_version", true, "an ECU speaks another version of the protocol", "flash the firmware that belongs to this driver"},
    {Finding::kConfigurationRefused, "configuration_refused", false, "an ECU does not take a parameter, or reads back another value", "compare hardware.yaml with the table of parameters"},
    {Finding::kJointSensor, "joint_sensor", false, "a joint's potentiometer is at an end stop; the joint is not published", "check its cable and plug, and its turn on the axis"},
    {Finding::kEnableRefused, "enable_refused", false, "enable was refused, or did not succeed on every ECU; none is enabled", "the reply of the service says which and why"},
    {Finding::kLateCycle, "late_cycle", false, "a cycle of the driver came more than a period late", "use `realtime:=true`; look for a busy machine"},
    {Finding::kCommandTimeout, "command_timeout", true, "no fresh muscle_command in time", "keep commands coming; enable again"},
    {Finding::kHomeFailed, "home_failed", true, "homing met a limit: tendon broken, slack or slipped", "look at the tendon that is named; repair, enable, home"},
    {Finding::kTendonSlack, "tendon_slack", true, "a tendon lost its force in motion: broken, slipped or off its pulley", "look at the tendon that is named; repair, clear_faults, enable, home"},
    {Finding::kEncoderDead, "encoder_dead", true, "a motor turns by what it draws, and its encoder does not count", "check the encoder's cable, then the motor's own and its current sensor; clear_faults, enable, home"},
    {Finding::kMotorHot, "motor_hot", true, "a motor drew more than its winding stands for long", "find what it pulls against; let it cool; clear_faults, enable"},
};
// clang-format on

const FindingInfo& info(Finding finding) {
  return kFindings[static_cast<std::size_t>(finding)];
}

void Findings::add(Finding finding, int ecu, double time, const std::string& detail) {
  for (Entry& entry : entries_) {
    if (entry.finding != finding || entry.ecu != ecu) continue;
    entry.last = time;
    ++entry.count;
    if (!detail.empty()) entry.detail = detail;
    return;
  }
  entries_.push_back({finding, ecu, detail, time, time, 1});
}

std::uint64_t Findings::count(Finding finding) const {
  std::uint64_t count = 0;
  for (const Entry& entry : entries_) {
    if (entry.finding == finding) count += entry.count;
  }
  return count;
}

}  // namespace driver
}  // namespace anthrob
