#pragma once

#include <optional>
#include <string>
#include <vector>

#include "anthrob_driver/robot_driver.h"
#include "link/ecu_link.h"
#include "link/sampler.h"
#include "routine/enabling.h"
#include "routine/first_step.h"
#include "routine/home.h"
#include "routine/live_gains.h"
#include "routine/zeros.h"
#include "stopping/stopping.h"
#include "stopping/stopping_rules.h"
#include "watch/bus_watch.h"
#include "watch/muscle_watch.h"

namespace anthrob {
namespace driver {

/// Behind RobotDriver, whose comments count here too: cycle.cpp, requests.cpp and stops.cpp.
class RobotDriver::Implementation {
 public:
  Implementation(Hardware hardware, const Options& options, Bus& bus);

  void cycle(double now);
  void receive(const BusEvent& event, double now);
  bool take_sample(Sample& sample) { return sampler_.take(sample); }
  bool take_analog(AnalogSample& sample) { return sampler_.take(sample); }

  Outcome command(const std::vector<std::string>& names, const std::vector<std::uint8_t>& modes,
                  const std::vector<double>& references, double now, double age,
                  const std::string& sender);
  Outcome refuse(const std::string& reason) { return supervisor_.refuse(reason); }
  Outcome start_enable(double now);
  Outcome start_home(double now);
  Outcome start_gains(const std::vector<std::string>& names, const std::vector<std::string>& gains,
                      const std::vector<double>& values, double now);
  Outcome disable();
  Outcome emergency_stop();
  Outcome clear_faults(double now);

  bool clearing(double now) const;
  std::optional<std::string> not_cleared() const;

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
  std::uint64_t halts() const { return halts_; }
  const StopLog& stops() const { return stopping_.log(); }

  /// Carries a rule out, whose condition holds.
  /// @param ecu index of the ECU that it concerns
  /// @param detail which fault, which tendon; may be empty
  void stop(const StoppingRule& rule, std::optional<int> ecu, double now,
            const std::string& detail = "");

 private:
  void send(const ecu::Frame& frame);
  /// @return the number of the request
  std::uint8_t request(ecu::Operation operation, int node, std::uint16_t configuration = 0,
                       std::uint8_t session = 0);
  void on_frame(const ecu::Frame& frame, double now);
  void check_bus(double now);
  void check_ecus(double now);
  void check_muscles(double now);
  void continue_enable(double now);
  void finish_enable(bool success, const std::string& reason);
  void continue_home(double now);
  void continue_zero(const std::vector<Home::Reading>& readings, double now);
  void send_cycle(double now);
  void send_parameters(double now);
  bool all_complete() const;
  std::optional<std::string> why_not_enable() const;

  // What stops the motors, and how, stands in kStoppingRules (stopping_rules.cpp). Everything ends
  // in disable().

  void disable_for(const StoppingRule& rule, std::optional<int> ecu, const std::string& what);
  /// Records a stop that waits for its reason. @param now HUGE_VAL: with or without the reason
  void explain_stop(double now);
  void obey_emergency_stop(std::optional<int> ecu);
  /// @param remedy null: the finding's
  void latch_stop(Finding finding, const std::string& what, const char* remedy = nullptr);
  void end_home();
  Situation situation(bool silent, double now) const;
  void check_ecu(int ecu, bool silent, double now);
  /// Why the ECUs may not have received a stop, if they may not.
  std::optional<std::string> unconfirmed() const;
  /// To be called when its tendon has moved on its spindle: the zero no longer holds.
  void revoke_zero(const MuscleHardware& muscle);

  Hardware hardware_;
  Options options_;
  Bus& bus_;
  Findings findings_;
  BusWatch watch_;
  ecu::Supervisor supervisor_;
  std::vector<EcuLink> links_;
  /// What a node of the bus is to this driver.
  struct Addressee {
    enum class Kind { kForeign, kIdle, kLinked } kind = Kind::kForeign;
    std::optional<int> link;  ///< index of the ECU, if it is linked
  };
  std::vector<Addressee> by_node_;
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
  double last_cycle_ = 0.0, started_ = 0.0;
  std::optional<double> cleared_;  ///< [s] when clear_faults was called last
  int disable_repeats_ = 0, clear_repeats_ = 0;
};

}  // namespace driver
}  // namespace anthrob
