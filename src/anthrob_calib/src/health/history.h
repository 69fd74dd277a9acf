#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "health/tendon_figures.h"

namespace anthrob {
namespace health {

/// A figure of one test.
struct Test {
  double day = 0.0;  ///< since 1970-01-01 00:00 UTC
  Figure figure;
};

/// All tests of a robot, in the file health.csv: a line for each figure, with the columns time
/// (2026-12-01T08:30:00Z), muscle, quantity, value, low, high, unit. Nothing is ever taken out.
class History {
 public:
  /// A file that does not exist is an empty history. @throws BadInput with file, line and value
  static History load(const std::string& file);

  /// @throws BadInput if this is not later than the tests before
  void add(double day, const std::vector<TendonFigures>& tendons);
  /// Writes the file anew, at once. @throws std::runtime_error
  void save(const std::string& file) const;

  using Series = std::vector<Test>;  ///< in order of time
  /// By muscle, in order of their first test.
  const std::vector<std::string>& muscles() const { return muscles_; }
  const Series& series(const std::string& muscle, Quantity quantity) const;
  double last_day() const { return last_day_; }  ///< of the last test; 0: none

 private:
  void add(double day, const std::string& muscle, const Figure& figure);

  std::vector<std::string> muscles_;
  std::map<std::pair<std::string, Quantity>, Series> series_;
  double last_day_ = 0.0;
};

/// By this computer's clock.
double present_day();
/// "2026-12-01T08:30:00Z"
std::string time_of_day(double day);
/// Also a date alone. @throws BadInput
double day_of(const std::string& time);

}  // namespace health
}  // namespace anthrob
