#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "anthrob_driver/bus/bus.h"
#include "anthrob_driver/findings.h"
#include "anthrob_driver/hardware.h"
#include "anthrob_driver/link/sample.h"
#include "anthrob_ecu/supervisor.h"

namespace anthrob {
namespace driver {

// What the driver is made of; only programs of this package look into it.
class BusWatch;
class EcuLink;
class Home;
class LiveGains;
class WindingTemperatureModel;

/// Drives a robot over a bus: sends SYNC and references, collects answers and decides whether
/// motors may move. It has no ROS, no clock and no thread: the caller calls cycle() at the rate and
/// receive() for every event of the bus.
///
/// The rules: nothing moves before enable has succeeded on every ECU. Every finding that stops (see
/// kFindings) stops all motors, and they stay disabled until the user enables them again. An
/// emergency stop takes precedence over everything and holds until it is cleared.
class RobotDriver {
 public:
  struct Options {
    double rate = 200.0;           ///< [Hz] of cycle()
    double command_timeout = 0.5;  ///< [s] without a command after which motors are disabled
    /// [rad] How far the first POSITION reference of a muscle after enable, home or another mode
    /// may be from its position; 0: no limit
    double first_step = 0.0;
  };
  using Outcome = ecu::Supervisor::Outcome;
  enum class Phase { kDisabled, kEnabling, kEnabled };

  /// @param bus must outlive the driver   @throws BadInput for options out of range
  RobotDriver(Hardware hardware, const Options& options, Bus& bus);
  ~RobotDriver();

  /// Once every period. @param now [s] of a clock that never jumps
  void cycle(double now);
  void receive(const BusEvent& event, double now);
  /// @return false if there is no new one
  bool take_sample(Sample& sample);
  bool take_analog(AnalogSample& sample);

  /// @param age [s] of the command by its stamp; 0 if it has none. A command that is more than
  /// command_timeout old, or as far ahead of time, is refused: it cannot have been sent just now
  /// @param sender node that sent it; empty: not known. A muscle has one at a time
  Outcome command(const std::vector<std::string>& names, const std::vector<std::uint8_t>& modes,
                  const std::vector<double>& references, double now, double age = 0.0,
                  const std::string& sender = "");
  /// Refuses a command without checking it; it is counted and recorded like other refused ones.
  Outcome refuse(const std::string& reason);
  /// Begins; phase() and last_outcome() show the result within Enabling::kTimeout.
  Outcome start_enable(double now);
  /// Begins; home().running() and home().failure() show the result.
  Outcome start_home(double now);
  /// Begins, enabled or not; gains() shows the progress. The gains that ECUs hold are in
  /// hardware().
  /// @param names, gains, values as of read_gain_changes
  Outcome start_gains(const std::vector<std::string>& names, const std::vector<std::string>& gains,
                      const std::vector<double>& values, double now);
  /// Always accepted; `reason` tells if the ECUs may not have received it.
  Outcome disable();
  Outcome emergency_stop();
  /// An emergency stop because nobody may be able to stop the driver any more.
  /// @param finding kUnregistered or kNoDescriptors   @param detail in words
  void stop_unreachable(Finding finding, const std::string& detail, double now);
  Outcome clear_faults(double now);

  /// Between clear_faults and the moment the ECUs have cleared too.
  bool clearing(double now) const;
  /// The first ECU that was heard and now does not answer, is in FAULT or holds an emergency stop,
  /// and which of these.
  std::optional<std::string> not_cleared() const;

  Phase phase() const;
  const Outcome& last_outcome() const;
  const Home& home() const;
  const LiveGains& gains() const;
  const Hardware& hardware() const;
  const ecu::Supervisor& supervisor() const;
  const WindingTemperatureModel& winding(std::size_t muscle) const;
  const EcuLink& link(std::size_t ecu) const;
  const Findings& findings() const;
  const BusWatch& bus_watch() const;
  std::uint64_t cycles() const;
  /// How often everything was disabled or stopped, for whatever reason, whether anything was
  /// enabled or not.
  std::uint64_t halts() const;
  /// Stops that no user of this driver had asked for, with their reasons.
  const StopLog& stops() const;

  static constexpr double kSilence = 1.0;  ///< [s] before an unheard ECU is reported

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace driver
}  // namespace anthrob
