#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

namespace anthrob::reference {

// Everything the reference arm is made of, as plain data: load it, change what you like, build the
// arm. SI units. Frames: W world (z up), B base, H humerus (origin: elbow), F forearm; S is the
// shoulder centre. Each muscle owns copies of its motor, ring and gains, so that they can differ.

enum class Body { kBase, kHumerus, kForearm };

/// Rigid body; centre of mass and inertia about it in body axes.
struct BodyParameters {
  double mass = 0.0;                                      ///< [kg]
  Eigen::Vector3d com = Eigen::Vector3d::Zero();          ///< [m]
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Identity();  ///< [kg m^2]
};

/// Stribeck curve (3.6) with the sign made smooth as in (4.75). The two levels and the velocity are
/// torques and rad/s for a joint, friction coefficients and m/s for an eyelet.
struct StribeckParameters {
  double static_level = 0.0;
  double kinetic_level = 0.0;
  double velocity = 1.0;    ///< v_s, > 0
  double steepness = 10.0;  ///< kappa [1], > 0
};

/// Friction of one joint: smooth dry part and viscous part [Nms/rad].
struct JointFrictionParameters {
  StribeckParameters dry;
  double viscous = 0.0;
};

/// One-sided spring-dampers at both ends of the elbow's range [rad].
struct StopParameters {
  double lower = 0.0;
  double upper = 0.0;
  double stiffness = 0.0;  ///< [Nm/rad]
  double damping = 0.0;    ///< [Nms/rad]
};

struct SkeletonParameters {
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();       ///< base, fixed
  Eigen::Isometry3d X_WH_rest = Eigen::Isometry3d::Identity();  ///< humerus at rest
  Eigen::Isometry3d X_HF_zero = Eigen::Isometry3d::Identity();  ///< forearm at elbow angle 0
  Eigen::Vector3d p_HS = Eigen::Vector3d::Zero();               ///< shoulder centre [m]
  Eigen::Vector3d elbow_axis_F = Eigen::Vector3d::UnitX();      ///< unit, positive = flexion
  Eigen::Vector3d gravity_W = Eigen::Vector3d::Zero();          ///< [m/s^2]
  BodyParameters humerus;
  BodyParameters forearm;
  JointFrictionParameters shoulder_friction;
  JointFrictionParameters elbow_friction;
  StopParameters elbow_stop;
};

/// Infinite cylinder; its origin is the position of its path entry.
struct CylinderShape {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitY();  ///< body axes, any length > 0
  double radius = 0.0;                              ///< [m]
};

/// Via-point, or cylinder between two via-points; position in the frame of the body [m].
struct PathEntry {
  Body body = Body::kBase;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  std::optional<CylinderShape> cylinder;
};

/// O-rings in parallel, Zener material (4.47).
struct RingParameters {
  double rest_length = 0.0;       ///< l_0, inner diameter [m]
  double section_diameter = 0.0;  ///< d [m]
  double strands = 2.0;           ///< cross sections that carry the force, per ring [1]
  double quantity = 1.0;          ///< rings in parallel [1]
  double modulus = 0.0;           ///< E_0 [Pa]
  double arm_modulus = 0.0;       ///< E_1 [Pa]
  double relaxation_time = 1.0;   ///< tau_1 [s]
};

/// DC motor with gear, fed through the power stage (4.1)-(4.13).
struct MotorParameters {
  double resistance = 0.0;              ///< R_A [ohm]
  double power_stage_resistance = 0.0;  ///< [ohm]
  double inductance = 0.0;              ///< L [H]
  double torque_constant = 0.0;         ///< K_T [Nm/A]
  double back_emf_constant = 0.0;       ///< K_E [Vs/rad]
  double rotor_inertia = 0.0;           ///< J_M [kg m^2]
  double gear_inertia = 0.0;            ///< J_G at the gear's input [kg m^2]
  double gear_ratio = 1.0;              ///< N [1]
  double efficiency = 1.0;              ///< eta [1]
  double steepness = 0.0;               ///< kappa of (4.13) [1/W]
  double shift = 0.0;                   ///< xi of (4.13) [1]
};

/// ECU channel: V = clip(proportional (r - position) - derivative speed + force_feedforward force).
struct ControllerParameters {
  double period = 1e-3;            ///< [s], the same for all muscles
  double voltage_limit = 0.0;      ///< [V]
  double proportional = 0.0;       ///< [V/rad]
  double derivative = 0.0;         ///< [Vs/rad]
  double force_feedforward = 0.0;  ///< [V/N]
};

struct MuscleParameters {
  std::string name;
  std::vector<PathEntry> path;  ///< origin to insertion, both via-points
  int ring_segment = 0;         ///< segment k lies between path[k] and path[k + 1]
  int sensor_segment = 0;
  double spindle_radius = 0.0;      ///< r_S, tendon included [m]
  double rest_tendon_length = 0.0;  ///< l_T0 [m]
  RingParameters ring;
  MotorParameters motor;
  ControllerParameters controller;
  StribeckParameters eyelet_friction;  ///< capstan coefficients [1], [m/s]
};

struct ArmParameters {
  SkeletonParameters skeleton;
  std::vector<MuscleParameters> muscles;
};

}  // namespace anthrob::reference
