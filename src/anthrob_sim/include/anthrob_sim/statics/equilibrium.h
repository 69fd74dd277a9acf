#pragma once

#include <Eigen/Core>
#include <vector>

#include "anthrob_sim/simulation.h"

namespace anthrob {

/// How to hold a posture at rest, derived from the model without friction.
struct Equilibrium {
  /// Least-effort tension by muscle [N]; for a muscle without input (ligament) that of its stretch.
  std::vector<double> tension;
  std::vector<double> position;  ///< actuator position by muscle [rad]
  /// Reference of the ECU's position controller that holds the actuator at `position`. It differs
  /// from `position`, because proportional control needs a steady-state error for the voltage that
  /// carries the load. For a muscle without controller: the input that holds it.
  std::vector<double> reference;
  Eigen::VectorXd shortfall;  ///< torque that the muscles cannot deliver [Nm, N]
};

struct EquilibriumOptions {
  double lowest_tension = 1.0;     ///< keeps driven tendons from going slack [N]
  double highest_tension = 120.0;  ///< [N]
};

/// Moment arms of all muscles in the simulation's posture [m]: one row per generalised velocity
/// (ball joints in the child's axes), one column per muscle.
Eigen::MatrixXd moment_arm_matrix(const Simulation& sim);

/// Generalised forces that hold the posture against gravity and against all other torques that the
/// model has on its joints at rest (ball joints in the child's axes) [Nm, N].
Eigen::VectorXd holding_load(const Simulation& sim);

/// Reference of a muscle's position controller that holds a tension at a muscle length, see
/// Equilibrium::reference. Not included are friction, what a tendon or spring remembers (creep,
/// softening, hysteresis), dead zone, sagging supply, cogging, heating and effects of sensors.
/// @param length [m]   @param tension [N], > 0
/// @throws BadInput if the controller has no proportional gain
double position_reference(const MuscleModel& muscle, double length, double tension);

/// @param q posture, size position_count. The simulation is used as scratch: it is placed there.
Equilibrium find_equilibrium(Simulation& sim, const std::vector<double>& q,
                             const EquilibriumOptions& options = {});

/// Distribution of joint torques over muscles, which can only pull.
struct LeastEffort {
  Eigen::VectorXd tension;  ///< [N], one per muscle
  /// Torque that no allowed tensions can deliver: required - delivered [Nm]; zero if the posture
  /// can be held.
  Eigen::VectorXd shortfall;
};

/// Finds the tensions f of least sum of squares with A f = tau and lowest <= f <= highest. If there
/// are none, finds the tensions whose torque is nearest to tau.
/// @param moment_arms A, one row per generalised velocity, one column per muscle [m]
/// @param torque tau, which the muscles have to deliver [Nm]
/// @param lowest,highest by muscle [N]; lowest <= highest; a drive also pushes
/// @throws std::invalid_argument if sizes or bounds do not fit
LeastEffort least_effort(const Eigen::MatrixXd& moment_arms, const Eigen::VectorXd& torque,
                         const Eigen::VectorXd& lowest, const Eigen::VectorXd& highest);

}  // namespace anthrob
