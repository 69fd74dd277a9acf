#pragma once

#include <string>
#include <vector>

#include "anthrob_core/config_node.h"
#include "anthrob_ecu/control_law.h"
#include "anthrob_sim/core/state.h"
#include "anthrob_sim/model/robot_model.h"
#include "anthrob_sim/skeleton/kinematic_tree.h"

namespace anthrob {

/// Where an effect acts: the chain from the controller to the sensors, in this order.
enum class Seam {
  kController,
  kPowerStage,
  kMotor,
  kGear,
  kSpindle,
  kTendon,
  kSpring,
  kPath,
  kSkeleton,
  kJoints,
  kSensors
};
std::string seam_name(Seam seam);

/// When an effect is built into the model. Within a stage, effects follow the chain from controller
/// to sensors, so that a wrapper around a component finds the component's final numbers.
enum class Stage {
  kSkeleton,    ///< bodies, joints and gravity, before the muscles are read
  kNumbers,     ///< numbers of components
  kParts,       ///< components exchanged for others, or added
  kComponents,  ///< wrapped round components, or beside them
};

/// One number of an effect.
struct EffectParameter {
  enum Kind {
    kSize,   ///< how much of the effect there is; no effect if all sizes are neutral
    kShape,  ///< what the effect looks like; identifiable only if the effect is present
    kGiven,  ///< not identifiable beside a size: assumed to be known, not fitted
  };
  std::string name, unit, meaning;
  double neutral = 0.0;  ///< size: value without effect; shape or given: default value
  double typical = 0.0;  ///< plausible value; typical - neutral is the unit dose of a screening
  Bounds bounds;
  Kind kind = kSize;
};

/// What the catalogue says about an effect.
struct EffectInfo {
  std::string id;           ///< fixed name in files, reports and on command lines
  std::string name;         ///< for people
  std::string description;  ///< one paragraph
  std::string equation;
  std::string source;
  std::string where;  ///< kinds of places, "MUSCLE | all"
  Seam seam = Seam::kJoints;
  Stage stage = Stage::kComponents;
  /// Whether a robot with the effect loses more energy over a cycle than the plain model.
  bool dissipates = false;
  bool slow = false;                  ///< builds up over minutes
  bool once_a_muscle = false;         ///< refused twice on a muscle: two would not add up
  /// Id of the law that it becomes where one of its shapes ends; empty: none. That one is simpler.
  std::string limit;
  std::vector<std::string> channels;  ///< where it is visible: position, current, force, joint, ...
  std::vector<EffectParameter> parameters;

  const EffectParameter* find(const std::string& parameter) const;
};

/// A robot while its effects are built in. Until Stage::kNumbers it has no muscles.
struct ModelDraft {
  RobotModel& robot;
  SkeletonModel& skeleton;  ///< the robot's own
};

class EffectSetting;

/// A way in which a robot may differ from its plain model. Immutable; all robots share one object.
class Effect {
 public:
  explicit Effect(EffectInfo info) : info_(std::move(info)) {}
  virtual ~Effect() = default;

  const EffectInfo& info() const { return info_; }

  /// The places of this robot at which the effect can act; empty if there are none.
  virtual std::vector<std::string> places(const RobotModel& robot) const = 0;
  /// Its parameters at one of these places: units, typical values and bounds may depend on it.
  /// Also asked while a model file is read, of a robot whose muscles are not read yet: bounds that
  /// depend on a muscle then do not hold, and must not be looked up in its absence.
  virtual std::vector<EffectParameter> parameters_at(const RobotModel& robot,
                                                     const std::string& place) const;
  /// Changes the robot at one of its `places`. The parameters are within their bounds and not
  /// neutral.
  virtual void build_in(const EffectSetting& setting, ModelDraft& draft) const = 0;

 private:
  EffectInfo info_;
};

/// An effect with a place and all its numbers, ready to be built in.
class EffectSetting {
 public:
  /// @param origin entry of the file that asks for the effect, for error messages
  /// @throws BadInput for unknown parameters, values out of bounds, or if no size is given
  EffectSetting(const Effect& effect, EffectInstance instance,
                std::vector<EffectParameter> parameters, const ConfigNode& origin);

  const Effect& effect() const { return *effect_; }
  const EffectInstance& instance() const { return instance_; }
  const std::string& id() const { return instance_.id; }
  const std::string& place() const { return instance_.place; }
  /// Whether all sizes are neutral, so that the model stays the plain one.
  bool neutral() const;
  double operator[](const std::string& parameter) const;

  /// Always throws BadInput with one line: the key, its value and "expected <expectation>".
  [[noreturn]] void fail(const std::string& key, const std::string& expectation) const;

 private:
  const Effect* effect_;
  EffectInstance instance_;
  std::vector<EffectParameter> parameters_;
  std::vector<double> values_;
  ConfigNode origin_;
};

// Laws of the whole robot, which effects add to its model.

/// One muscle between its controller and its motor's terminals.
struct PowerLine {
  double voltage;  ///< of the controller; effects change it into that of the terminals [V]
  double current;  ///< of the motor [A]
};

/// Changes voltages on their way from the controllers to the motors.
class PowerEffect {
 public:
  virtual ~PowerEffect() = default;
  virtual std::size_t state_size() const { return 0; }
  /// The robot was placed, at rest.
  virtual void reset(StateView) const {}
  /// Once a step.  @param lines one a muscle
  virtual void apply(std::vector<PowerLine>& lines, StateView state) const = 0;
};

/// A posture-dependent joint torque, such as that of a spring.
class JointTorque {
 public:
  virtual ~JointTorque() = default;
  /// Adds to generalised forces, ball joints in world axes [Nm, N].
  /// @param q joint positions
  virtual void add(const KinematicTree& tree, const std::vector<double>& q, double* tau) const = 0;
  /// Its potential energy [J].
  virtual double energy(const std::vector<double>& q) const = 0;
};

/// The values that sensors measure: the true values, as changed by the effects so far.
struct Readings {
  ecu::Measurement* muscles;  ///< one per muscle
  /// Joints as in Simulation::configuration, and their velocities, ball joints in the child's axes.
  double* positions;
  double* velocities;
};

/// A systematic error of sensors, applied before their delay, noise and rounding to counts.
/// Recordings of the simulator contain it, and controllers see it.
class ReadingEffect {
 public:
  virtual ~ReadingEffect() = default;
  virtual std::size_t state_size() const { return 0; }
  /// The robot was placed. Resets the state as if the readings so far had always been the given
  /// ones.
  virtual void reset(const Readings&, StateView) const {}
  /// Once a step.
  virtual void apply(Readings& readings, StateView state) const = 0;

  // Recordings contain readings. To impose recorded positions, the true ones must be known. So an
  // effect that changes how positions of muscles or joints are read also gives delay and inverse.
  /// Delay of a muscle's position reading [s].
  virtual double position_delay(std::size_t /*muscle*/) const { return 0.0; }
  /// Inverse: the true position of a muscle [rad] that the next apply() turns into `position`, not
  /// counting the delay.
  virtual double true_position(std::size_t /*muscle*/, double position, StateView) const {
    return position;
  }
  /// Delay of the readings of joint positions [s].
  virtual double joint_delay() const { return 0.0; }
  /// Inverse: replaces joint positions (as in Simulation::configuration) by the true ones that the
  /// next apply() turns into them, not counting the delay.
  virtual void true_joint_positions(double* /*positions*/) const {}
};

}  // namespace anthrob
