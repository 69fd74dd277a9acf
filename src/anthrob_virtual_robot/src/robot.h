#pragma once

#include <memory>
#include <vector>

#include "anthrob_reference/arm.h"
#include "anthrob_reference/controller.h"
#include "draft.h"
#include "sensors.h"

namespace anthrob::virtual_robot {

/// The virtual robot: reference arm, hidden laws, sensors and ECUs. The ECUs get the measured
/// values.
class Robot final {
 public:
  static constexpr double kStep =
      2.5e-4;  ///< of the arm; errs by less than 1e-3 of sensor noise [s]

  /// @param sensors null: no sensor errors
  Robot(Draft draft, const SensorSettings* sensors, std::uint64_t noise_seed);

  /// At the rest posture with spindles at these positions [rad], holding them.
  void place(const std::vector<double>& positions);
  void command(const std::vector<double>& references) { references_ = references; }
  /// One ECU period.
  void tick();

  double period() const { return period_; }
  std::size_t muscle_count() const { return controllers_.size(); }
  const reference::Arm& arm() const { return arm_; }
  /// Present measured values, and the true ones.
  const Readings& measured() const { return measured_; }
  const Readings& truth() const { return truth_; }
  /// Output of the control law of the last period [V].
  const std::vector<double>& voltages() const { return voltages_; }

 private:
  void read();

  reference::Arm arm_;
  std::vector<reference::Controller> controllers_;
  double period_;
  std::vector<std::shared_ptr<CommandLaw>> command_laws_;
  std::vector<std::shared_ptr<PowerLaw>> power_laws_;
  std::vector<std::shared_ptr<ReadingLaw>> reading_laws_;
  std::unique_ptr<Sensors> sensors_;
  std::vector<double> references_, obeyed_, voltages_, motor_voltages_;
  Readings truth_, measured_;
};

}  // namespace anthrob::virtual_robot
