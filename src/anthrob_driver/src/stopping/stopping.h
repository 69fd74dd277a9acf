#pragma once

#include <optional>
#include <string>
#include <vector>

#include "anthrob_driver/findings.h"
#include "link/ecu_link.h"

namespace anthrob {
namespace driver {

/// What is known of stops: the reason of each in words and its remedy, recorded in a log. It stops
/// nothing.
///
/// An ECU reports that it stopped some frames before it reports why. Such a stop is kept here until
/// the reason has come (expect_reason, take_reason).
class Stopping {
 public:
  /// A stop whose reason has come, or for which it did not come in time.
  struct Explained {
    Finding finding;
    int ecu;
    std::optional<std::string> fault;  ///< that the ECU named, if it named one
    std::string told;  ///< the reason in words, as far as it was known when the motors stopped
    std::string what;  ///< the reason in words, as it is known now
    const char* remedy;
  };

  /// @param links must outlive this object; one for each ECU
  explicit Stopping(const std::vector<EcuLink>& links) : links_(links) {}

  /// The reason in words.
  /// @param ecu that the finding is about
  /// @param detail which fault, which tendon; may be empty
  std::string reason(Finding finding, std::optional<int> ecu, const std::string& detail) const;
  /// The fault that an ECU reports. None until its STATE has named it: on the bus, STATE comes
  /// after all measurements.
  std::optional<std::string> fault_of(int ecu) const;
  /// The name of an ECU and a colon.
  std::string prefix(int ecu) const;

  /// Adds a stop to the log.
  /// @param remedy null: the finding's
  void record(Finding finding, const std::string& what, const char* remedy = nullptr);
  const StopLog& log() const { return log_; }

  /// A stop for an ECU whose reason may still come.
  /// @param told its reason in words, as far as it is known now
  void expect_reason(Finding finding, int ecu, const std::string& told, double now);
  /// @param now HUGE_VAL: do not wait any longer
  /// @return once, the stop that waited for its reason
  std::optional<Explained> take_reason(double now);

 private:
  struct Waiting {
    Finding finding;
    int ecu;
    double until;  ///< [s]
    std::string told;
  };
  /// What to do about the fault that an ECU reports; if it reports none, about the finding.
  const char* remedy_of(Finding finding, int ecu) const;

  const std::vector<EcuLink>& links_;
  StopLog log_;
  std::optional<Waiting> waiting_;
};

}  // namespace driver
}  // namespace anthrob
