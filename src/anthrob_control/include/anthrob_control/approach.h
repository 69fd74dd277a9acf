#pragma once

#include <memory>
#include <vector>

#include "anthrob_control/computed_force.h"

namespace anthrob {

/// Leads position references from where the motors are to those that are wanted, straight and at
/// one speed: motors that were just enabled must not jump. Once there, references are taken as they
/// are. Muscles that pulled before it began, held by somebody else, let go of it at first.
class Approach {
 public:
  static constexpr double kSpeed = 1.0;  ///< [rad/s], where nobody asks for another

  /// @param speed of the muscle that has the longest way [rad/s]
  /// @throws std::invalid_argument for one that is not above 0
  Approach(std::shared_ptr<const RobotModel> model, double speed);

  /// Begins anew, from where the motors are at the next step.
  void begin();

  /// References for now, one a muscle [rad], within the muscles' limits where the motors are
  /// beyond.
  /// @param wanted references, one a muscle [rad]   @param dt since the last step [s]
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
