#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "anthrob_reference/controller.h"
#include "anthrob_reference/dynamics.h"
#include "anthrob_reference/joint_law.h"
#include "anthrob_reference/parameters.h"
#include "anthrob_reference/rosenbrock.h"

namespace anthrob::reference {

/// Quantities of one muscle.
struct MuscleReadings {
  double position = 0.0;       ///< gear output, winding in positive, 0 at l_T = l_T0 [rad]
  double velocity = 0.0;       ///< gear output [rad/s]
  double current = 0.0;        ///< of the motor [A]
  double voltage = 0.0;        ///< held since the last tick, after the clip [V]
  double force = 0.0;          ///< of the sensor: tension of the first segment [N]
  double ring_tension = 0.0;   ///< of the series elastic element [N]
  double length = 0.0;         ///< path length l_M [m]
  double tendon_length = 0.0;  ///< l_T [m]
  double wrap_angle = 0.0;     ///< arc on its cylinders, 0 when free [rad]
  double penetration = 0.0;    ///< of a via-point into a cylinder; see Path::penetration [m]
};

/// Reference model of the arm: the ideal robot as an accurately solved differential equation.
/// Deterministic; the same calls give the same bits.
///   Arm arm(Arm::load("model_II.yaml"));
///   arm.command_position(0, 0.5);
///   arm.advance(1.0);
class Arm final {
 public:
  static constexpr double kDefaultStep = 6.25e-5;  ///< 16 in the usual ECU period [s]

  static ArmParameters load(const std::string& model_file);

  /// At the rest posture, as after place(identity, 0, zeros).
  explicit Arm(const ArmParameters& parameters);

  /// Longest integration step [s]; the ECU period is divided evenly. A step that meets a stop, or a
  /// ring becoming taut or slack, is cut down to 1e-9 s around it.
  void set_step(double step);
  /// Multiplies the present friction coefficients of all eyelets.
  void scale_eyelet_friction(double factor);

  /// Adds a law to the equations of this arm. Laws have state: give each arm its own, before
  /// place().
  void add_law(std::size_t i, std::shared_ptr<MuscleLaw> law);
  void add_law(std::shared_ptr<JointLaw> law);

  /// Puts the arm at rest: no velocity, no current, rings relaxed at their stretch, all commands
  /// 0 V, time 0. Contacts are those of a continuous motion from the rest posture, shoulder along
  /// the shortest rotation and elbow in proportion.
  /// @param shoulder rotation from rest in humerus axes  @param elbow [rad]
  /// @param positions of the gear outputs [rad], one for each muscle
  void place(const Eigen::Quaterniond& shoulder, double elbow,
             const std::vector<double>& positions);

  /// Commands count from the next ECU tick, which is now if time() is a multiple of the period.
  void command_position(std::size_t i, double position);
  void command_voltage(std::size_t i, double voltage);

  void advance(double seconds);

  double time() const;                        ///< [s]
  Eigen::Quaterniond shoulder() const;        ///< rotation from rest, humerus axes, w >= 0
  Eigen::Vector3d shoulder_velocity() const;  ///< of the humerus, humerus axes [rad/s]
  double elbow() const;                       ///< [rad], flexion positive
  double elbow_velocity() const;              ///< [rad/s]

  std::size_t muscle_count() const { return names_.size(); }
  const std::vector<std::string>& muscle_names() const { return names_; }
  MuscleReadings muscle(std::size_t i) const;
  /// -d length / dq [m]: three components of the shoulder in humerus axes, then the elbow.
  Vector4 moment_arm(std::size_t i) const;

  double kinetic_energy() const;    ///< of the skeleton [J]
  double potential_energy() const;  ///< of the skeleton's weight, 0 at the shoulder centre [J]

 private:
  void tick();
  void advance_to(double phase);  // within the present ECU period [s]
  void integrate(double seconds);
  void step(double h);  // cuts itself where the equation is not smooth
  void move_contacts_from_rest(const JointState& target);

  std::vector<std::string> names_;
  Dynamics dynamics_;
  std::vector<Controller> controllers_;
  Rosenbrock integrator_;
  Eigen::VectorXd x_;
  double period_;
  double step_;
  std::int64_t ticks_ = 0;   // ECU periods that have ended
  double since_tick_ = 0.0;  // [s]
};

}  // namespace anthrob::reference
