#include "driver_diagnostics.h"

#include <algorithm>

#include "anthrob_ros/diagnostics.h"
#include "link/ecu_link.h"
#include "routine/home.h"
#include "watch/bus_watch.h"
#include "watch/winding_temperature_model.h"

namespace anthrob {
namespace driver {

namespace {

using diagnostic_msgs::DiagnosticStatus;
using Level = DiagnosticStatus::_level_type;

void raise(DiagnosticStatus& status, Level level) {
  status.level = std::max(status.level, level);
}

/// All that was found since the last clear; what is recent also shows in level and message.
void add_findings(DiagnosticStatus& status, const Findings& findings, std::optional<int> ecu,
                  double now) {
  for (const Findings::Entry& entry : findings.entries()) {
    if (entry.ecu != ecu) continue;
    const FindingInfo& what = info(entry.finding);
    const std::string detail = entry.detail.empty() ? "" : ": " + entry.detail;
    status.values.push_back(key_value(what.name, std::to_string(entry.count) + "x" + detail));
    if (!findings.recent(entry, now)) continue;
    raise(status, what.stops ? DiagnosticStatus::ERROR : DiagnosticStatus::WARN);
    status.message += std::string("; ") + what.name + ": " + what.meaning + " - " + what.remedy;
  }
}

}  // namespace

DiagnosticStatus driver_status(const RobotDriver& driver, double now, const std::string& robot) {
  DiagnosticStatus status;
  status.name = robot + ": driver";
  status.level = DiagnosticStatus::OK;
  using Phase = RobotDriver::Phase;
  status.message = driver.supervisor().stop_latched()   ? "emergency stop"
                   : driver.home().running()            ? "homing"
                   : driver.phase() == Phase::kEnabled  ? "enabled"
                   : driver.phase() == Phase::kEnabling ? "enabling"
                                                        : "disabled";
  if (driver.supervisor().stop_latched()) raise(status, DiagnosticStatus::WARN);
  if (const auto trouble = driver.bus_watch().trouble()) {
    status.message += ": " + *trouble;
    raise(status, DiagnosticStatus::ERROR);
  }
  const ecu::Supervisor& supervisor = driver.supervisor();
  const auto late = driver.findings().count(Finding::kLateCycle);
  status.values = {
      key_value("rejected_commands", std::to_string(supervisor.rejected_count())),
      key_value("last_rejection", supervisor.last_rejection().value_or("")),
      key_value("command_age", text(supervisor.command_age(now).value_or(-1.0))),
      key_value("last_outcome", driver.last_outcome().reason),
      key_value("stops", std::to_string(driver.stops().count())),
      key_value("last_stop", driver.stops().last().value_or("")),
      key_value("frames_received", std::to_string(driver.bus_watch().frames())),
      key_value("late_cycles", std::to_string(late)),
  };
  add_findings(status, driver.findings(), std::nullopt, now);
  return status;
}

DiagnosticStatus ecu_status(const RobotDriver& driver, std::size_t ecu, double now,
                            const std::string& robot) {
  const EcuLink& link = driver.link(ecu);
  const ecu::StateReport& report = link.report();
  const ecu::Health& health = link.health();
  DiagnosticStatus status;
  status.name = robot + ": " + link.own().name;
  status.hardware_id = link.own().name;
  // The unit may be idle again while the driver wants it cleared, as after a restart.
  const int first = link.own().muscles.front();
  const bool held = driver.supervisor().state(first) == ecu::State::kFault;
  const ecu::State state = held ? ecu::State::kFault : link.state();
  status.level = DiagnosticStatus::OK;
  if (state == ecu::State::kFault) raise(status, DiagnosticStatus::ERROR);
  if (state == ecu::State::kStopping) raise(status, DiagnosticStatus::WARN);
  status.message = ecu::name(state);
  if (held && link.state() != ecu::State::kFault) {
    status.message += std::string(", held by the driver until clear_faults (the ECU itself: ") +
                      ecu::name(link.state()) + ")";
  }
  if (!link.heard() || !link.alive()) {
    raise(status, DiagnosticStatus::ERROR);
    status.message = link.heard() ? "lost" : "never heard";
  } else if (!link.configured()) {
    raise(status, DiagnosticStatus::WARN);
    status.message += ", not configured";
  }
  const bool zero_lost = driver.supervisor().zero_lost(first);
  if (zero_lost) {
    raise(status, DiagnosticStatus::WARN);
    status.message += ", zero lost: home first";
  }
  if (report.fault != ecu::Fault::kNone) {
    status.message += std::string("; ") + ecu::name(report.fault);
    if (!ecu::concerns_unit(report.fault)) {
      status.message += " (" + link.muscle(report.muscle).name + ")";
    }
  }
  const bool recent = link.health_known(now);
  const auto known = [recent](const std::string& value) { return recent ? value : "unknown"; };
  status.values = {
      key_value("stop_latched", link.stop_latched() ? "true" : "false"),
      key_value("fault", ecu::name(report.fault)),
      key_value("session", std::to_string(report.session)),
      key_value("configured", link.configured() ? "true" : "false"),
      key_value("zero_lost", zero_lost ? "true" : "false"),
      key_value("supply", known(text(health.supply))),
      key_value("refused_frames", known(std::to_string(health.refused_frames))),
      key_value("transmit_errors", known(std::to_string(health.transmit_errors))),
      key_value("receive_errors", known(std::to_string(health.receive_errors))),
  };
  for (int c = 0; c < static_cast<int>(link.own().muscles.size()); ++c) {
    status.values.push_back(key_value(link.muscle(c).name + " temperature",
                                      known(std::to_string(health.temperature[c]))));
  }
  for (const int muscle : link.own().muscles) {
    const WindingTemperatureModel& winding = driver.winding(static_cast<std::size_t>(muscle));
    if (!winding.known()) continue;
    const std::string& name = driver.hardware().muscles[static_cast<std::size_t>(muscle)].name;
    status.values.push_back(key_value(name + " heat", text(winding.relative_temperature_rise())));
    if (winding.relative_temperature_rise() <= WindingTemperatureModel::kCool) continue;
    raise(status, DiagnosticStatus::WARN);
    status.message += "; the motor of " + name + " is hot, judging by its current";
  }
  add_findings(status, driver.findings(), static_cast<int>(ecu), now);
  return status;
}

}  // namespace driver
}  // namespace anthrob
