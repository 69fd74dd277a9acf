#pragma once

#include <optional>
#include <vector>

#include "muscle_row.h"

namespace anthrob {

/// Decides when a command is due: twenty times a second, until a deadline. Time as of DeadMan.
class CommandRepeater {
 public:
  static constexpr double kPeriod = 0.05;  ///< [s] ten commands within the time-out of the robot

  /// What is to be sent from now on; empty: nothing.
  void set(std::vector<Reference> references, double deadline);
  /// What is to be sent now; empty: nothing. To be asked more often than one is due. What was
  /// missed is not made up for.
  std::vector<Reference> take_due(double now);

 private:
  std::vector<Reference> references_;
  double deadline_ = 0.0;
  std::optional<double> next_;  ///< when a command is due
};

}  // namespace anthrob
