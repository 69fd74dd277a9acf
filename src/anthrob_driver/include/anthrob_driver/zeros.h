#pragma once

#include <functional>
#include <string>
#include <vector>

#include "anthrob_driver/ecu_link.h"
#include "anthrob_ecu/supervisor.h"

namespace anthrob {
namespace driver {

/// Whether positions mean what they say: which ECUs have no zero, by their own word, and the new
/// one of `home` on its way to all of them. Without a zero the supervisor refuses POSITION.
class Zeros {
 public:
  static constexpr double kTimeout = 0.5;  ///< [s] for all ECUs to take over home's zero
  enum class State { kWaiting, kTaken, kRefused };
  using Send = std::function<void(const ecu::Frame& frame)>;

  /// @param links one an ECU   Both must outlive the zeros.
  Zeros(std::vector<EcuLink>& links, ecu::Supervisor& supervisor);

  /// Every cycle: the supervisor learns what the ECUs have said meanwhile.
  void update();
  /// The posture of now is to be the zero.
  void start(double now);
  /// One cycle after start().
  State step(double now, const Send& send);
  /// Which muscle's zero was not taken, and by whom.
  const std::string& refusal() const { return refusal_; }

 private:
  std::vector<EcuLink>& links_;
  ecu::Supervisor& supervisor_;
  double deadline_ = 0.0;
  std::string refusal_;
};

}  // namespace driver
}  // namespace anthrob
