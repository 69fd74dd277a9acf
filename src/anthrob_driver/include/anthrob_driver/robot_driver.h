#pragma once

#include <string>
#include <vector>

#include "anthrob_driver/bus/bus.h"
#include "anthrob_driver/ecu_link.h"
#include "anthrob_driver/enabling.h"
#include "anthrob_driver/first_step.h"
#include "anthrob_driver/home.h"
#include "anthrob_driver/live_gains.h"
#include "anthrob_driver/sampler.h"
#include "anthrob_driver/stopping.h"
#include "anthrob_driver/watch/bus_watch.h"
#include "anthrob_driver/watch/muscle_watch.h"
#include "anthrob_driver/zeros.h"
#include "anthrob_ecu/supervisor.h"

namespace anthrob {
namespace driver {

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

  /// Once every period. @param now [s] of a clock that never jumps
  void cycle(double now);
  void receive(const BusEvent& event, double now);
  /// @return false if there is no new one
  bool take_sample(Sample& sample) { return sampler_.take(sample); }
  bool take_analog(AnalogSample& sample) { return sampler_.take(sample); }

  /// @param age [s] of the command by its stamp; 0 if it has none. A command that is more than
  /// command_timeout old, or as far ahead of time, is refused: it cannot have been sent just now
  Outcome command(const std::vector<std::string>& names, const std::vector<std::uint8_t>& modes,
                  const std::vector<double>& references, double now, double age = 0.0);
  /// Refuses a command without checking it; it is counted and recorded like other refused ones.
  Outcome refuse(const std::string& reason) { return supervisor_.refuse(reason); }
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
  Outcome clear_faults(double now);

  /// Between clear_faults and the moment the ECUs have cleared too.
  bool clearing(double now) const;
  /// The first ECU that was heard and now does not answer, is in FAULT or holds an emergency stop,
  /// and which of these; empty: none.
  std::string not_cleared() const;

  Phase phase() const { return phase_; }
  const Outcome& last_outcome() const { return last_outcome_; }
  const Home& home() const { return home_; }
  const LiveGains& gains() const { return gains_; }
  const Hardware& hardware() const { return hardware_; }
  const ecu::Supervisor& supervisor() const { return supervisor_; }
  const WindingTemperatureModel& winding(std::size_t muscle) const {
    return muscles_[muscle].winding();
  }
  const EcuLink& link(std::size_t ecu) const { return links_[ecu]; }
  const Findings& findings() const { return findings_; }
  const BusWatch& bus_watch() const { return watch_; }
  std::uint64_t cycles() const { return cycles_; }
  /// How often everything was disabled or stopped, for whatever reason, whether anything was
  /// enabled or not.
  std::uint64_t halts() const { return halts_; }
  /// Stops that no user of this driver had asked for, with their reasons.
  const StopLog& stops() const { return stopping_.log(); }

  static constexpr double kSilence = 1.0;  ///< [s] before an unheard ECU is reported

 private:
  void send(const ecu::Frame& frame);
  /// @return the number of the request
  std::uint8_t request(ecu::Operation operation, int node, std::uint16_t configuration = 0,
                       std::uint8_t session = 0);
  void on_frame(const ecu::Frame& frame, double now);
  void check_bus(double now);
  bool bus_silent() const;
  void check_ecus(double now);
  void check_muscles(double now);
  void continue_enable(double now);
  void finish_enable(bool success, const std::string& reason);
  void continue_home(double now);
  void continue_zero(const std::vector<Home::Reading>& readings, double now);
  void send_cycle(double now);
  void send_parameters(double now);
  bool all_complete() const;
  std::string why_not_enable() const;

  // Everything that stops motors ends in disable(). Besides disable() and emergency_stop() of the
  // user these are: a finding (stop), a STOP that somebody else sent (obey_stop), and a failed home
  // (fail_home). These three record the reason in stops().

  /// @param ecu that failed: it stays in FAULT until cleared; -1: none
  /// @param detail which fault, which tendon; may be empty
  void stop(Finding finding, int ecu, const std::string& detail = "");
  /// An ECU reports that it stopped some frames before it reports why. So the motors are stopped at
  /// once, and the stop is recorded when its reason has arrived or is overdue (name_stop).
  void stop_for_unit(Finding finding, int ecu, double now);
  /// @param now HUGE_VAL: record the stop now, with or without the reason
  void name_stop(double now);
  void halt(Finding finding, int ecu, const std::string& what);
  /// Why the ECUs may not have received a stop; empty: no reason.
  std::string unconfirmed() const;
  /// @param ecu which holds the stop; -1: a frame on the bus
  void obey_stop(int ecu);
  void fail_home(double now);
  /// To be called when its tendon has moved on its spindle: the zero no longer holds.
  void revoke_zero(const MuscleHardware& muscle);

  Hardware hardware_;
  Options options_;
  Bus& bus_;
  Findings findings_;
  BusWatch watch_;
  ecu::Supervisor supervisor_;
  std::vector<EcuLink> links_;
  std::vector<int> link_of_node_;
  Sampler sampler_;
  FirstStep first_step_;
  Enabling enabling_;
  Home home_;
  Zeros zeros_;
  LiveGains gains_;
  std::vector<MuscleWatch> muscles_;
  Stopping stopping_;

  Phase phase_ = Phase::kDisabled;
  Outcome last_outcome_{true, ""};
  std::vector<ecu::MuscleReference> references_;  ///< one a muscle
  std::vector<ecu::MuscleReference> accepted_;
  std::uint64_t cycles_ = 0, halts_ = 0;
  std::uint8_t counter_ = 0, sequence_ = 0;
  double last_cycle_ = 0.0, started_ = 0.0, cleared_ = -1.0;
  int disable_repeats_ = 0, clear_repeats_ = 0;
};

}  // namespace driver
}  // namespace anthrob
