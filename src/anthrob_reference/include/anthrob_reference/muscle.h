#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "anthrob_reference/friction.h"
#include "anthrob_reference/motor.h"
#include "anthrob_reference/muscle_law.h"
#include "anthrob_reference/parameters.h"
#include "anthrob_reference/path.h"
#include "anthrob_reference/ring.h"

namespace anthrob::reference {

/// State of one force chain; the order in the arm's state vector.
struct MuscleState {
  double ring = 0.0;      ///< y of the Zener ring [Pa]
  double current = 0.0;   ///< [A]
  double speed = 0.0;     ///< of the gear's output, winding in positive [rad/s]
  double position = 0.0;  ///< of the gear's output, 0 at l_T = l_T0 [rad]
};

/// Tensions along the path in one state.
struct MuscleSolution {
  PathSolution path;
  double strain = 0.0;               ///< of the ring [1]
  std::vector<double> tensions;      ///< of each span [N]
  std::vector<double> sliding;       ///< speed at each eyelet, towards the origin positive [m/s]
  Vector4 torque = Vector4::Zero();  ///< generalised force on the skeleton [Nm]
};

/// Spindle, tendon, ring, eyelets and path of one muscle. From the ring the tension changes at
/// every eyelet by the capstan law (4.76): f_origin side = f_insertion side exp(mu(v) deflection),
/// v > 0 where the tendon slides towards its origin. Before the ring v = r_S speed, beyond it v =
/// -d/dt(path length from the eyelet to the insertion).
class Muscle final {
 public:
  explicit Muscle(const MuscleParameters& parameters);

  const Motor& motor() const { return motor_; }
  const Ring& ring() const { return ring_; }
  Path& path() { return path_; }
  const Path& path() const { return path_; }
  void scale_eyelet_friction(double factor) { friction_.scale(factor); }

  /// Laws act in the order in which they were added.
  void add_law(std::shared_ptr<MuscleLaw> law) { laws_.push_back(std::move(law)); }
  bool has_laws() const { return !laws_.empty(); }
  void settle(double h, const MuscleState& state, const MuscleSolution& solution);

  /// l_T = l_T0 - r_S position, and what laws add [m]
  double tendon_length(double position) const;

  void solve(const Posture& posture, const Vector4& velocity, const MuscleState& state,
             MuscleSolution* solution) const;
  /// d state / dt under a held voltage [V].
  MuscleState rate(const MuscleState& state, double voltage, const MuscleSolution& solution) const;
  /// Adds -d torque / d velocity that the eyelets beyond the ring cause [Nms/rad].
  void add_damping(const MuscleSolution& solution, Matrix4* damping) const;

  double ring_tension(const MuscleSolution& solution) const;  ///< [N]
  double sensor_force(const MuscleSolution& solution) const;  ///< [N]

 private:
  double friction(std::size_t eyelet, double sliding) const;
  double friction_slope(std::size_t eyelet, double sliding) const;
  void spread_towards_origin(const MuscleState& state, MuscleSolution* solution) const;
  void spread_towards_insertion(const Vector4& velocity, MuscleSolution* solution) const;

  Path path_;
  Ring ring_;
  Motor motor_;
  SmoothStribeck friction_;
  std::size_t ring_span_;
  std::size_t sensor_span_;
  double spindle_radius_;
  double rest_tendon_length_;
  double ring_rest_length_;
  MotorParameters motor_parameters_;
  std::vector<std::shared_ptr<MuscleLaw>> laws_;
};

}  // namespace anthrob::reference
