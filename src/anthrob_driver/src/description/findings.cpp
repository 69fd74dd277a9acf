#include "anthrob_driver/findings.h"

#include <cstddef>

namespace anthrob {
namespace driver {

// clang-format off
const FindingInfo kFindings[kFindingCount] = {
    {Finding::kInterfaceDown, "interface_down", true, "the CAN interface is down or gone", "plug the adapter in; `ip link set can0 up type can bitrate 1000000 restart-ms 100` and `ip link set can0 txqueuelen 64`; enable again"},
    {Finding::kBusOff, "bus_off", true, "the host's CAN controller left the bus after 256 errors", "check cable, termination (120 ohm at both ends) and bit rate; enable again"},
    {Finding::kErrorPassive, "error_passive", true, "the host's CAN controller counted 128 errors", "check cable, termination (120 ohm at both ends) and bit rate; enable again; if that is refused, set the interface down and up"},
    {Finding::kErrorWarning, "error_warning", false, "the host's CAN controller counted 96 errors, or reported a bus error", "check cable and termination soon"},
    {Finding::kNoAcknowledge, "no_acknowledge", true, "no node on the bus acknowledges the driver's frames", "switch the ECUs on; check the cable and the bit rate; enable again"},
    {Finding::kQueueFull, "queue_full", true, "the CAN interface accepted no more frames (ENOBUFS) in three cycles in a row", "switch the ECUs on; check the cable and the bit rate; `ip link set can0 txqueuelen 64`, or lower the rate; enable again"},
    {Finding::kBusSilent, "bus_silent", true, "no ECU completely answers two SYNCs in a row, and all did before", "check the bus cable, the CAN interface and the ECUs' supply; enable again"},
    {Finding::kReceiveOverrun, "receive_overrun", false, "the host lost frames because it read them too late", "use `realtime:=true`; look for other programs that keep the computer busy"},
    {Finding::kBusFlooded, "bus_flooded", false, "far more frames in a cycle than the ECUs can send", "find the node that sends too much: `candump -t d can0`"},
    {Finding::kSecondHost, "second_host", true, "another driver or node sends SYNC, requests or references on this bus", "stop it: a bus has one host; then enable again"},
    {Finding::kForeignFrame, "foreign_frame", false, "a frame that is not of this protocol, or of a node that is not configured", "take other devices off the bus, or list the ECU in hardware.yaml"},
    {Finding::kCorruptFrame, "corrupt_frame", false, "a frame with a wrong checksum; it was ignored", "look for two ECUs with the same node number, faulty gateways or faulty memory"},
    {Finding::kWrongLength, "wrong_length", false, "a frame of wrong length; it was ignored", "check the firmware's version; look for foreign devices"},
    {Finding::kRepeatedFrame, "repeated_frame", false, "an old or repeated answer of an ECU; it was ignored", "look for gateways that repeat frames, two ECUs with the same node number, or a busy host"},
    {Finding::kLostFrame, "lost_frame", false, "an ECU did not answer a SYNC in time, or only in part; this measurement of its muscles is missing", "check the bus load and the error counters"},
    {Finding::kEcuSilent, "ecu_silent", false, "an ECU of hardware.yaml was never heard", "switch it on; check its node number"},
    {Finding::kEcuLost, "ecu_lost", true, "no complete answer of an ECU to two SYNCs in a row", "check its power and cable; clear_faults, enable"},
    {Finding::kEcuRestarted, "ecu_restarted", true, "an ECU restarted and lost its zero", "check its power; clear_faults, enable, home"},
    {Finding::kEcuFault, "ecu_fault", true, "an ECU reports a fault, named in its diagnostics", "look the fault up in docs/ecu_protocol.md; clear_faults, enable; home if its zero is lost"},
    {Finding::kEcuStopped, "ecu_stopped", true, "an ECU stopped by itself while enabled", "see the reason in its diagnostics; enable again"},
    {Finding::kStopLatched, "stop_latched", true, "an ECU holds an emergency stop that did not come from this driver", "find who sent it; clear_faults, enable"},
    {Finding::kWrongVersion, "wrong_version", true, "an ECU speaks another version of the protocol", "flash the firmware that belongs to this driver, or look for two ECUs with the same node number; clear_faults, enable; home if its zero is lost"},
    {Finding::kConfigurationRefused, "configuration_refused", false, "an ECU refuses a parameter or reads back another value; until it is configured, enable is refused", "compare hardware.yaml with the table of parameters in docs/ecu_protocol.md"},
    {Finding::kJointSensor, "joint_sensor", false, "a joint's potentiometer reads below 8 or above 4087 counts; the joint is not published", "check its cable and plug, and how it is turned on its axis"},
    {Finding::kEnableRefused, "enable_refused", false, "enable was refused or did not succeed on every ECU; none is enabled", "read the reply of the service: it says why"},
    {Finding::kLateCycle, "late_cycle", false, "a cycle of the driver started more than a period late", "use `realtime:=true`; look for other programs that keep the computer busy"},
    {Finding::kCommandTimeout, "command_timeout", true, "no fresh, valid muscle_command within `command_timeout`", "keep commands coming; enable again"},
    {Finding::kHomeFailed, "home_failed", true, "`home` met one of its limits, or an ECU did not confirm its zero", "check the muscle that is named: tendon, pulley, polarity, sensors; repair; enable, home"},
    {Finding::kTendonSlack, "tendon_slack", true, "a tendon lost its force in motion: it broke, slipped or left its pulley", "look at the tendon that is named; repair it; clear_faults, enable, home"},
    {Finding::kEncoderDead, "encoder_dead", true, "a motor turns, judging by its voltage and current, but its encoder does not count, or counts backwards", "check the encoder's cable and polarity, then the motor's cable and its current sensor; clear_faults, enable, home"},
    {Finding::kForceImplausible, "force_implausible", true, "a motor pulls, judging by its current, much harder than its force sensor reads", "check the force sensor and its cable, then that nothing holds the tendon between spindle and sensor; clear_faults, enable"},
    {Finding::kMotorHot, "motor_hot", true, "a motor drew more current than its winding withstands for long", "find what it pulls against; let it cool; clear_faults, enable"},
    {Finding::kUnregistered, "unregistered", true, "the ROS master is gone or does not know the driver any more: whoever starts now cannot stop it", "start roscore again, and the driver registers by itself; clear_faults, enable"},
    {Finding::kNoDescriptors, "no_descriptors", true, "the driver has hardly any file descriptors left: whoever connects now cannot stop it", "find who opens connections and leaves them idle (`ss -tnp`); clear_faults, enable"},
};
// clang-format on

const FindingInfo& info(Finding finding) {
  return kFindings[static_cast<std::size_t>(finding)];
}

void Findings::add(Finding finding, std::optional<int> ecu, double time,
                   const std::string& detail) {
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
