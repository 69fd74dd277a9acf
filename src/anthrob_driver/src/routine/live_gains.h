#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "anthrob_ecu/gains.h"
#include "link/ecu_link.h"

namespace anthrob {
namespace driver {

/// Writes gains that the user changes to the ECUs, enabled or not, one after the other, and reads
/// each back. A value that an ECU has confirmed belongs to the configuration from then on.
class LiveGains {
 public:
  static constexpr double kTimeout = 0.5;  ///< [s] for one gain, and for the final checksum
  using Outcome = ecu::Supervisor::Outcome;
  using Send = std::function<void(const ecu::Frame& frame)>;

  /// @param hardware, links must outlive this object; one link for each ECU
  LiveGains(Hardware& hardware, std::vector<EcuLink>& links) : hardware_(hardware), links_(links) {}

  /// Not while changing().
  void start(std::vector<ecu::GainChange> changes, double now);
  /// One cycle after start().
  /// @param disabled whether the motors are disabled: then the changes end only when the ECUs
  /// report the checksum of the new parameters, which the next enable requires
  void step(double now, bool disabled, const Send& send);
  /// Ends changes to this ECU that are in progress.
  void abort(int ecu, const std::string& reason, double now);
  bool changing() const { return changing_; }
  /// Outcome of the last changes that ended, and how many have ended.
  const Outcome& outcome() const { return outcome_; }
  std::uint64_t ended() const { return ended_; }

 private:
  const MuscleHardware& muscle_of(const ecu::GainChange& change) const;
  const MuscleHardware& muscle() const { return muscle_of(changes_[at_]); }
  EcuLink& link_of(const ecu::GainChange& change) {
    return links_[static_cast<std::size_t>(muscle_of(change).ecu)];
  }
  EcuLink& link() { return link_of(changes_[at_]); }
  void begin_next(double now);
  void take(double now);
  void finish(const std::optional<std::string>& refusal, double now);

  Hardware& hardware_;
  std::vector<EcuLink>& links_;
  std::vector<ecu::GainChange> changes_;
  std::size_t at_ = 0;
  int cycles_ = 0;
  bool changing_ = false;
  double deadline_ = 0.0;
  Outcome outcome_{true, ""};
  std::uint64_t ended_ = 0;
};

}  // namespace driver
}  // namespace anthrob
