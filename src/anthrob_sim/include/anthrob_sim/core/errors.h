#pragma once

#include <stdexcept>
#include <string>

#include "anthrob_core/errors.h"

namespace anthrob {

/// The integration produced a value that is not a number or far outside of any physical range.
class NumericalFailure : public std::runtime_error {
 public:
  /// @param time [s] simulated time at the end of the step that failed
  /// @param where e.g. "body humerus" or "muscle biceps_brachii"
  NumericalFailure(double time, const std::string& where, const std::string& what)
      : std::runtime_error("numerical failure at t = " + std::to_string(time) + " s, " + where +
                           ": " + what),
        time_(time) {}
  double time() const { return time_; }

 private:
  double time_;
};

}  // namespace anthrob
