#pragma once

#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "anthrob_core/config_node.h"
#include "anthrob_ecu/control_law.h"
#include "anthrob_sim/actuator/actuator.h"
#include "anthrob_sim/path/muscle_path.h"
#include "anthrob_sim/sensing/sensor.h"
#include "anthrob_sim/skeleton/skeleton_model.h"
#include "anthrob_sim/spring/series_elastic_element.h"

namespace anthrob {

class JointTorque;
class PowerEffect;
class ReadingEffect;

/// An effect at a place, as a file, a command line or a search names it; see effects/catalogue.h.
/// Parameters left out are neutral.
struct EffectInstance {
  std::string id, place;
  std::map<std::string, double> parameters;
};

/// Largest references that are accepted for a muscle, by size.
struct CommandLimits {
  double position = 30.0;  ///< [rad]
  double current = 10.0;   ///< [A]
  double force = 500.0;    ///< [N]; 0: no FORCE mode
};

/// What joins the motor of a drive to its joint.
struct Transmission {
  double stiffness = std::numeric_limits<double>::infinity();  ///< [Nm/rad, N/m]; infinite: rigid
  double damping = 0.0;                                        ///< [Nms/rad, Ns/m]
  double backlash = 0.0;                                       ///< play at the joint [rad, m]
};

/// One muscle: actuator, spring and path, and the ECU channel that drives it. A drive is a muscle
/// on the axis of a joint, whose tension is the torque on the joint, of either sign: metres become
/// radians, and newtons Nm, where the joint is a hinge.
struct MuscleModel {
  std::string name;
  std::string key;  ///< path in the model file: "muscles.brachialis", "joints.elbow.drive"
  std::string ecu;  ///< empty for a muscle without ECU
  std::shared_ptr<const Actuator> actuator;
  std::shared_ptr<const SeriesElasticElement> spring;
  std::shared_ptr<const PathModel> path;
  int spring_segment = 0;                    ///< k of Algorithm 4.1
  int sensor_segment = 0;                    ///< j of Algorithm 4.1
  std::optional<Transmission> transmission;  ///< of a drive; none: a tendon
  bool has_controller = false;
  CommandLimits limits;
  ecu::ControllerSettings controller;
  int steps_per_tick = 1;      ///< simulation steps between two ticks of the controller
  double command_delay = 0.0;  ///< until the controller gets a command [s]

  bool is_drive() const { return transmission.has_value(); }
  /// Sets the transmission of a drive, and the spring that goes with it.
  void transmit(const Transmission& by);
  /// Null: a ligament or a Hill muscle.
  const GearedMotor* motor() const;
  /// As on the robot: a unit whose force limit is 0 measures no force and has no mode FORCE.
  bool has_force_sensor() const { return !has_controller || limits.force > 0.0; }
};

struct SensorsModel {
  SensorModel position, velocity, current, force;  ///< of every muscle
  SensorModel joint_position;                      ///< of hinge and prismatic joints
  /// Steps per tick of the robot's fastest controller, for sensors without a controller (joints);
  /// 1 on a robot without controllers.
  int steps_per_tick = 1;
  std::uint64_t seed = 1;

  /// The same without chance: no noise and no counts. What remains can be predicted.
  SensorsModel predictable() const;
};

/// A robot as its files describe it: immutable, shared by any number of simulations.
struct RobotModel {
  std::string name;  ///< of the folder that holds the model file
  std::string file;
  std::string urdf_file;
  double step = 0.001;  ///< [s]
  Vec3 gravity = Vec3::Zero();
  bool collisions = false;
  std::shared_ptr<const SkeletonModel> skeleton;
  std::vector<MuscleModel> muscles;
  SensorsModel sensors;
  std::vector<TouchPadModel> touch_pads;
  std::vector<std::string> remarks;  ///< harmless or corrected oddities of the files, one line each
  std::vector<EffectInstance> effects;  ///< as requested; they are already built in
  std::vector<std::shared_ptr<const PowerEffect>> power_effects;
  std::vector<std::shared_ptr<const ReadingEffect>> reading_effects;
  std::vector<std::shared_ptr<const JointTorque>> joint_torques;

  /// Index in `muscles`, or -1.
  int find_muscle(const std::string& muscle) const;
  /// Index in `muscles`.   @throws BadInput with the muscles that there are
  int muscle_index(const std::string& muscle) const;
};

constexpr double kMinimumStep = 1e-7, kMaximumStep = 0.1;  ///< [s] of a simulation

struct LoadOptions {
  double step = 0.001;  ///< length of a simulation step [s]
  /// Numbers to replace before the model is built, by key path:
  /// "muscles.biceps_brachii.spindle_radius".
  std::map<std::string, double> overrides = {};
  /// Effects beside those of the model file.
  std::vector<EffectInstance> effects = {};
  /// Accept steps longer than a controller's period; the controller then acts once per step. For
  /// derivatives, not for results.
  bool slow_controllers = false;
};

struct RobotFiles;

/// The files of a robot, read once: model file, what it extends, URDF, meshes. Variants of the
/// robot are built from it without opening a file. Immutable: copies share it, also between
/// threads.
class RobotDescription {
 public:
  /// @throws BadInput with one line: file, line, key, value, what was expected
  static RobotDescription load(const std::string& file);
  /// Of a model file in memory, and the files that it names. `config` is copied.
  explicit RobotDescription(const ConfigNode& config);

  /// The model file with what it extends.
  const ConfigNode& config() const { return config_; }
  /// @throws BadInput as load()
  std::shared_ptr<const RobotModel> build(const LoadOptions& options = {}) const;

 private:
  ConfigNode config_;
  std::shared_ptr<const RobotFiles> files_;
};

/// Builds one robot from its files.   @throws BadInput as RobotDescription::load()
std::shared_ptr<const RobotModel> load_robot_model(const std::string& file,
                                                   const LoadOptions& options = {});
/// The same from a model file in memory; several threads may use one `config`. To build many
/// variants, use a RobotDescription.
std::shared_ptr<const RobotModel> build_robot_model(const ConfigNode& config,
                                                    const LoadOptions& options = {});

}  // namespace anthrob
