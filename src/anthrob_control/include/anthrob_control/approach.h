#pragma once

#include <memory>
#include <vector>

#include "anthrob_control/computed_force.h"

namespace anthrob {

/// Moves position references from where the motors are to the wanted ones, straight and at constant
/// speed, so that motors that were just enabled do not jump. After arrival, wanted references are
/// passed through unchanged. Since it begins at the measured positions, muscles that were holding
/// a load before may give way at first.
class Approach {
 public:
  static constexpr double kSpeed = 1.0;  ///< default [rad/s]

  /// @param speed of the muscle with the longest way [rad/s]
  /// @throws std::invalid_argument unless speed > 0
  Approach(std::shared_ptr<const RobotModel> model, double speed);

  /// Starts again at the next step, from where the motors are then.
  void begin();

  /// @return references for now, one per muscle [rad]; the start is clamped to the muscles' limits
  /// @param wanted references, one per muscle [rad]   @param dt since the last step [s]
  const std::vector<double>& step(const std::vector<double>& wanted,
                                  const RobotMeasurement& measured, double dt);

  bool begun() const { return phase_ != Phase::kNotBegun; }
  bool arrived() const { return phase_ == Phase::kArrived; }

 private:
  enum class Phase { kNotBegun, kUnderWay, kArrived };

  void start_where(const RobotMeasurement& measured);

  std::shared_ptr<const RobotModel> model_;
  double speed_;
  Phase phase_ = Phase::kNotBegun;
  std::vector<double> reference_;
};

}  // namespace anthrob
