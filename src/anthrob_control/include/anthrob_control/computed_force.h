#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "anthrob_control/control_settings.h"
#include "anthrob_control/joint_filter.h"
#include "anthrob_control/posture_model.h"
#include "anthrob_control/posture_motion.h"
#include "anthrob_control/posture_servo.h"
#include "anthrob_control/tension_split.h"

namespace anthrob {

/// What is measured at one instant.
struct RobotMeasurement {
  std::vector<double> q;                  ///< joint positions, as in a configuration
  Eigen::VectorXd u;                      ///< joint velocities, ball joints in the child's axes
  std::vector<ecu::Measurement> muscles;  ///< in the model's order
};

/// What the controller wants at one instant.
struct ForceCommand {
  ecu::Mode mode = ecu::Mode::kForce;
  std::vector<double> reference;  ///< by muscle: N, rad or V as the mode says
  Eigen::VectorXd torque;         ///< that was asked of the muscles [Nm]
  Eigen::VectorXd shortfall;      ///< what of it they cannot deliver [Nm]
  Eigen::VectorXd tension;        ///< least-effort tensions; of ligaments their own [N]
  bool converged = true;          ///< whether the split is the least-effort one
};

/// Computed-force control: a torque for every joint from the model's gravity, centrifugal and
/// inertia terms and a servo on the joints, split over the muscles at least effort. In zero gravity
/// the arm holds the posture it was left in and yields to a hand (the muscles are told forces, so
/// only the servo resists); or it goes to a posture and stays (the muscles are told the positions
/// that give those forces, so that their springs help against friction).
///
/// Free of clocks; does not allocate while running.
class ComputedForce {
 public:
  ComputedForce(std::shared_ptr<const RobotModel> model, const ControlSettings& settings);

  /// Begins anew: the next update holds the posture it finds.
  void reset();
  /// Holds, from now on, the posture the arm is in.
  void zero_gravity();
  /// @param q posture, size position_count   @param duration [s], > 0
  /// @throws std::invalid_argument
  /// @throws BadInput, and goes on as before, if a joint would move faster than it may
  void go_to(const std::vector<double>& q, double duration);

  /// @param dt since the last update [s]
  /// @throws std::invalid_argument if the measurement does not fit the robot or is not finite
  const ForceCommand& update(const RobotMeasurement& measured, double dt);

  bool holds() const { return !moving_; }
  bool arrived() const { return motion_.arrived(); }
  /// The posture that is held or aimed at now.
  const std::vector<double>& target() const { return moving_ ? motion_.configuration() : held_; }
  const RobotModel& model() const { return posture_.model(); }

 private:
  /// A muscle without an input: its stretch says how it pulls.
  struct Ligament {
    std::size_t muscle;
    double slack_length;  ///< of tendon and spring [m]
  };

  static std::vector<Ligament> ligaments_of(const RobotModel& model);
  void forget_voltages();
  void refuse_haste(const std::vector<double>& q, double duration) const;
  void compute_torque(double dt);
  void split();
  double tension_of(const Ligament& ligament) const;
  double reference_for(std::size_t muscle, const ecu::Measurement& measured, double dt);

  ControlSettings settings_;
  PostureModel posture_, target_posture_;
  JointFilter filter_;
  PostureServo servo_;
  PostureMotion motion_;
  TensionSplit split_;
  std::vector<Ligament> ligaments_;
  Eigen::VectorXd wanted_;  ///< torque that is left to the muscles with controllers [Nm]
  std::vector<ecu::ControllerMemory> voltage_memory_;
  std::vector<double> held_;
  Eigen::VectorXd zero_;
  bool fresh_ = true, moving_ = false;
  ForceCommand command_;
};

}  // namespace anthrob
