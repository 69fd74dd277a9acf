#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace anthrob {

/// The levels of diagnostic_msgs/DiagnosticStatus, with their values there.
enum class Level { kOk = 0, kWarning = 1, kError = 2, kStale = 3 };

/// One status of a message on /diagnostics.
struct Diagnosis {
  std::string name;  ///< "/anthrob: ecu_1"
  Level level = Level::kOk;
  std::string message;
  std::vector<std::pair<std::string, std::string>> values;

  std::optional<std::string> value(const std::string& key) const;
  /// Whether it is about a muscle, too, as the driver's units are: "biceps_brachii temperature".
  bool names(const std::string& muscle) const;
};

/// What was last said about everything on /diagnostics.
class Diagnostics {
 public:
  static constexpr double kStale = 5.0;  ///< [s] five messages were missed

  void hear(const Diagnosis& diagnosis, double now);
  void clear() { last_.clear(); }

  /// All of them, in the order in which they first came; those that are no longer repeated are
  /// stale.
  std::vector<Diagnosis> all(double now) const;
  /// Of one part of a robot, if it is not stale. @param part "simulator"
  std::optional<Diagnosis> of(const std::string& robot, const std::string& part, double now) const;
  /// Of the motor unit on which a muscle hangs, if that says so: the driver's units name their
  /// muscles. For a muscle in a fault.
  std::optional<Diagnosis> unit_of_muscle(const std::string& robot, const std::string& muscle,
                                          double now) const;

 private:
  struct Heard {
    Diagnosis diagnosis;
    double time = 0.0;
  };
  std::vector<Heard> last_;
};

/// "/anthrob: ecu_1" is the part "ecu_1" of "/anthrob"; a name without colon is a part of nothing.
std::pair<std::string, std::string> whole_and_part(const std::string& name);

}  // namespace anthrob
