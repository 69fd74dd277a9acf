#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
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
  std::vector<double> reference;       ///< by muscle: N, rad or V as the mode says
  Eigen::VectorXd torque;              ///< wanted of the muscles [Nm]
  Eigen::VectorXd shortfall;           ///< the part of it that they cannot deliver [Nm]
  Eigen::VectorXd tension;             ///< least-effort tensions; ligaments: their own [N]
  bool converged = true;               ///< whether the split is the least-effort one
  std::optional<std::size_t> limited;  ///< a muscle whose POSITION reference ends at its limit
};

/// Computed-force control. The joint torques are the model's gravity, centrifugal and inertia terms
/// plus a servo on the joints; they are split over the muscles with least effort.
/// - In zero gravity, the arm holds its posture and yields to a hand. The muscles get force
///   references, so only the servo resists.
/// - After go_to, the arm moves to a posture and stays there. The muscles get the positions that
///   give the wanted forces, so that their springs help against friction.
/// (The settings may choose other outputs.)
///
/// Uses no clock, and does not allocate while running.
class ComputedForce {
 public:
  /// @throws BadInput if no muscle takes the commands that the settings ask for
  ComputedForce(std::shared_ptr<const RobotModel> model, const ControlSettings& settings);

  /// Starts again: the next update holds the posture that is measured then.
  void reset();
  /// From now on holds the posture that the arm is in.
  void zero_gravity();
  /// @param q posture, size position_count   @param duration [s], > 0
  /// @throws std::invalid_argument
  /// @throws BadInput if a joint would move faster than it may, or if a muscle would need a
  /// position beyond its limit there; the controller continues as before
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
  /// A muscle without input: its force follows from its stretch.
  struct Ligament {
    std::size_t muscle;
    double slack_length;  ///< of tendon and spring [m]
  };

  static std::vector<Ligament> ligaments_of(const RobotModel& model);
  void forget_voltages();
  void refuse_haste(const std::vector<double>& q, double duration) const;
  void refuse_beyond_limits(const std::vector<double>& q);
  void compute_torque(double dt);
  void split();
  void subtract_ligaments(const PostureModel& posture, Eigen::VectorXd& torque) const;
  double tension_of(const Ligament& ligament, const PostureModel& posture) const;
  double reference_for(std::size_t muscle, const ecu::Measurement& measured, double dt);

  ControlSettings settings_;
  PostureModel posture_, target_posture_;
  JointFilter filter_;
  PostureServo servo_;
  PostureMotion motion_;
  TensionSplit split_;
  std::vector<Ligament> ligaments_;
  Eigen::VectorXd wanted_;  ///< torque for the muscles with controllers [Nm]
  std::vector<ecu::ControllerMemory> voltage_memory_;
  std::vector<double> held_;
  Eigen::VectorXd zero_;
  bool fresh_ = true, moving_ = false;
  ForceCommand command_;
};

}  // namespace anthrob
