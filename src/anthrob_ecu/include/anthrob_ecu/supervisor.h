#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "anthrob_ecu/control_law.h"
#include "anthrob_ecu/state_machine.h"

namespace anthrob {
namespace ecu {

/// What a back end (simulator or driver) must know about a muscle to accept commands for it.
struct MuscleChannel {
  std::string name;
  std::string ecu;                          ///< muscles of one ECU stop together
  bool takes_commands = true;               ///< a ligament does not
  std::array<bool, kModeCount> modes{};     ///< which modes it has
  std::array<double, kModeCount> lowest{};  ///< smallest reference by mode [V, rad, A, N]
  std::array<double, kModeCount> highest{};
};

/// One entry of an accepted command.
struct MuscleReference {
  int muscle;
  Mode mode;
  double reference;
};

/// Supervises the commands to all ECUs of a robot, and their states, in the same way on simulator
/// and hardware:
/// - Nothing moves before enable.
/// - A command that is malformed or names a stopped muscle is refused as a whole.
/// - A command that is not renewed in time stops the motors.
/// - A muscle has one sender: while one commands it, commands of others are refused.
/// - An emergency stop holds until it is cleared.
///
/// It reads no clock: time is passed as an argument [s] and may jump.
class Supervisor {
 public:
  struct Options {
    double command_timeout = 0.5;  ///< [s]; 0: never (simulator only)
    /// Simulator only: enabled from the start, and again by the next command after a time-out.
    /// Never after a disable, an emergency stop or a fault.
    bool auto_enable = false;
  };
  /// Outcome of a request, with a reason if it was refused.
  struct Outcome {
    bool accepted;
    std::string reason;
  };

  Supervisor(std::vector<MuscleChannel> muscles, const Options& options);

  /// Checks a whole command; fills `accepted` only if all of it is good and all of its muscles
  /// follow references.
  /// @param sender node that sent it; empty: not known, and not asked for
  Outcome command(const std::vector<std::string>& names, const std::vector<std::uint8_t>& modes,
                  const std::vector<double>& references, double time,
                  std::vector<MuscleReference>& accepted, const std::string& sender = "");
  /// Records (count and reason) a command that the back end refuses for a reason of its own.
  Outcome refuse(const std::string& reason);

  /// If everything is enabled already, this changes nothing: the command time-out keeps running.
  Outcome enable(double time);
  Outcome disable();
  Outcome emergency_stop();
  Outcome clear_faults();
  Outcome fault(const std::string& ecu);
  /// This ECU restarted, or it is unknown whether it accepted a new zero. The positions of its
  /// muscles are then unknown, so none of them accepts POSITION commands until regain_zero().
  void lose_zero(const std::string& ecu);
  void regain_zero(const std::string& ecu);
  bool zero_lost(int muscle) const { return zero_lost_[ecu_of_[muscle]]; }

  /// The back end is moving the muscles itself: the command time-out restarts at `time`, as if a
  /// command had arrived.
  void restart_watch(double time) {
    commanded_ = true;
    last_command_ = time;
  }
  /// Simulated time jumped ahead by `seconds` in which nothing happened, so this time is not
  /// counted in the age of commands.
  void skip(double seconds) { last_command_ += seconds; }
  /// To be called often: handles the command time-out.
  /// @return whether motors were stopped by it just now
  bool update(double time);

  bool follows_references(int muscle) const {
    return machines_[ecu_of_[muscle]].follows_references();
  }
  State state(int muscle) const { return machines_[ecu_of_[muscle]].state(); }
  bool stop_latched() const;

  const std::vector<MuscleChannel>& muscles() const { return muscles_; }
  /// Names of the ECUs, in the order of their first muscle.
  const std::vector<std::string>& ecus() const { return ecus_; }
  State ecu_state(std::size_t ecu) const { return machines_[ecu].state(); }

  std::size_t rejected_count() const { return rejected_; }
  /// Why the last command was refused, if one ever was.
  const std::optional<std::string>& last_rejection() const { return last_rejection_; }
  /// Age of the last command that was accepted since the last enable [s].
  std::optional<double> command_age(double time) const {
    if (!commanded_) return std::nullopt;
    return time - last_command_;
  }

 private:
  /// Why a command is refused, if it is.
  std::optional<std::string> check(const std::vector<std::string>& names,
                                   const std::vector<std::uint8_t>& modes,
                                   const std::vector<double>& references,
                                   std::vector<MuscleReference>& accepted) const;
  std::string why_stopped(int muscle) const;
  void forget_owners();
  /// How long a muscle belongs to whoever commanded it last [s].
  double hold() const;
  /// Why somebody else commands one of these muscles; none if nobody does.
  std::optional<std::string> taken(const std::vector<MuscleReference>& muscles, double time,
                                   const std::string& sender) const;
  void set_zero_lost(const std::string& ecu, bool lost);
  bool handle_all(Event event);

  std::vector<MuscleChannel> muscles_;
  Options options_;
  std::vector<std::string> ecus_;
  std::vector<std::size_t> ecu_of_;
  std::vector<StateMachine> machines_;
  std::vector<char> zero_lost_;  ///< by ECU
  struct Owner {
    std::string sender;
    double time;  ///< [s] of its last command
  };
  std::vector<Owner> owners_;  ///< by muscle
  bool commanded_ = false;     ///< since the last enable
  bool timed_out_ = false;     ///< whether motors stopped because no command came
  double last_command_ = 0.0;
  std::size_t rejected_ = 0;
  std::optional<std::string> last_rejection_;
};

}  // namespace ecu
}  // namespace anthrob
