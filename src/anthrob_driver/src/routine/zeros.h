#pragma once

#include <functional>
#include <string>
#include <vector>

#include "anthrob_ecu/supervisor.h"
#include "link/ecu_link.h"

namespace anthrob {
namespace driver {

/// The zeros from which positions count: which ECUs report that they have none, and writing the new
/// zeros of `home` to all of them, one after the other. Without a zero the supervisor refuses
/// POSITION commands.
class Zeros {
 public:
  static constexpr double kTimeout = 0.5;  ///< [s] for an ECU to confirm one zero of `home`
  enum class State { kWaiting, kTaken, kRefused };
  using Send = std::function<void(const ecu::Frame& frame)>;

  /// @param links, supervisor must outlive this object; one link for each ECU
  Zeros(std::vector<EcuLink>& links, ecu::Supervisor& supervisor);

  /// To be called every cycle: tells the supervisor which ECUs have a zero.
  void update();
  /// Begins to make the present posture the zero.
  void start();
  /// One cycle after start().
  State step(double now, const Send& send);
  /// Which muscle's zero was not confirmed, and by which ECU.
  const std::string& refusal() const { return refusal_; }

 private:
  std::vector<EcuLink>& links_;
  ecu::Supervisor& supervisor_;
  const MuscleHardware* asked_ = nullptr;  ///< whose zero is being written
  double deadline_ = 0.0;
  int cycles_ = 0;
  std::string refusal_;
};

}  // namespace driver
}  // namespace anthrob
