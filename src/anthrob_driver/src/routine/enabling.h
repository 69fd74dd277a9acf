#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "link/ecu_link.h"

namespace anthrob {
namespace driver {

/// Asks every ECU to enable, repeatedly, until each has confirmed a request of this attempt, or one
/// refuses or does not answer in time.
class Enabling {
 public:
  static constexpr double kTimeout = 0.25;  ///< [s]
  enum class State { kWaiting, kConfirmed, kRefused };
  /// Sends the request to this ECU. @return the request's number, never 0
  using Ask = std::function<std::uint8_t(const EcuLink& link)>;

  void start(std::size_t ecus, double now);
  /// One cycle. @param links one for each ECU
  State step(const std::vector<EcuLink>& links, double now, const Ask& ask);
  /// Which ECU refused, and why.
  const std::string& refusal() const { return refusal_; }

 private:
  double deadline_ = 0.0, retry_ = 0.0;
  std::vector<std::uint8_t> sequence_;  ///< of the last request, by ECU; 0: none yet
  std::string refusal_;
};

}  // namespace driver
}  // namespace anthrob
