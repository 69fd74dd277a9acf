#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iomanip>
#include <limits>
#include <set>
#include <sstream>

#include "anthrob_core/errors.h"
#include "anthrob_core/text.h"
#include "anthrob_ecu/model_file.h"
#include "anthrob_sim/actuator/actuator.h"
#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/model/robot_model.h"
#include "anthrob_sim/path/muscle_path.h"
#include "anthrob_sim/skeleton/kinematic_tree.h"
#include "anthrob_sim/spring/series_elastic_element.h"
#include "path/surface_types.h"
#include "path/undecided_side.h"
#include "skeleton/urdf.h"

namespace anthrob {

namespace {

/// How deep a path point may lie inside where an effect may have moved points or surfaces [m].
constexpr double kAllowedByEffects = 0.003;

void require_snake_case(const ConfigNode& node, const std::string& name) {
  if (!is_snake_case(name)) node.fail("'" + name + "': expected a name in lower_snake_case");
}

/// A point of a path in its link's frame [m]; millimetres would be far away.
Vec3 near_link(const ConfigNode& node) {
  constexpr double kFarthest = 10.0;
  const Vec3 point = node.as_vector3("m");
  if (point.cwiseAbs().maxCoeff() > kFarthest) {
    node.fail_expected("three numbers [x, y, z] from -10 to 10 [m]");
  }
  return point;
}

}  // namespace

/// What a model takes over from its files as it stands there.
struct RobotFiles {
  std::string name;  ///< of the folder that holds the model file
  std::string urdf;
  bool collisions = false;
  UrdfRobot robot;
  MeshFiles meshes;
};

namespace {

class Builder {
 public:
  Builder(const ConfigNode& config, const RobotFiles& files, const LoadOptions& options)
      : config_(config), files_(files), options_(options), model_(std::make_shared<RobotModel>()) {}

  std::shared_ptr<const RobotModel> build() {
    model_->file = config_.file();
    model_->step = options_.step;
    model_->name = files_.name;
    model_->gravity = config_.at("gravity").as_vector3("m/s^2");
    model_->collisions = files_.collisions;
    model_->urdf_file = files_.urdf;
    for (const char* key : {"collisions", "robot"}) {
      if (config_.has(key)) config_.at(key).ignore();  // read with the files
    }
    model_->remarks = files_.robot.remarks;
    skeleton_ = std::make_shared<SkeletonModel>(files_.robot.skeleton);
    read_joints();
    model_->skeleton = skeleton_;

    const std::vector<EffectSetting> effects = read_effects(config_, options_.effects, *model_);
    ModelDraft draft{*model_, *skeleton_};
    build_in(effects, Stage::kSkeleton, draft);
    read_muscles();
    read_sensors();
    read_touch_pads();
    for (const Stage stage : {Stage::kNumbers, Stage::kParts, Stage::kComponents}) {
      build_in(effects, stage, draft);
    }
    for (const EffectSetting& effect : effects) model_->effects.push_back(effect.instance());
    config_.refuse_unknown_keys();
    check_rest_posture();
    return model_;
  }

 private:
  void read_joints() {
    for (const JointModel& joint : skeleton_->joints) {
      if (is_snake_case(joint.name)) continue;
      throw BadInput(model_->urdf_file + ": joint '" + joint.name +
                     "': expected a name in lower_snake_case");
    }
    std::vector<bool> seen(skeleton_->joints.size(), false);
    if (config_.has("joints")) {
      for (const auto& [name, node] : config_.at("joints").entries()) {
        const int index = skeleton_->find_joint(name);
        if (index < 0) node.fail("no movable joint of that name in " + model_->urdf_file);
        seen[index] = true;
        read_joint(node, skeleton_->joints[index]);
      }
    }
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const JointModel& joint = skeleton_->joints[i];
      if (!seen[i] && joint.type == JointType::kBall) {
        config_.fail("joints: floating joint '" + joint.name + "' of " + model_->urdf_file +
                     " needs an entry with type: ball and its center");
      }
      if (!seen[i] && joint.stop.enabled) {
        config_.fail("joints: joint '" + joint.name +
                     "' has limits in the URDF and needs an entry with its stop");
      }
    }
  }

  void read_joint(const ConfigNode& node, JointModel& joint) {
    const bool ball = joint.type == JointType::kBall;
    const std::string torque = joint.type == JointType::kPrismatic ? "N" : "Nm";
    const std::string speed = joint.type == JointType::kPrismatic ? "m/s" : "rad/s";
    const std::string position = joint.type == JointType::kPrismatic ? "m" : "rad";
    if (ball && (!node.has("type") || node.text("type") != "ball")) {
      node.fail("expected type: ball (the URDF joint is floating)");
    }
    if (node.has("type") && !ball)
      node.at("type").fail("expected no 'type': only a joint that is floating in the URDF has one");
    if (ball) joint.center_C = node.at("center").as_vector3("m");
    if (node.has("friction")) {
      const ConfigNode friction = node.at("friction");
      joint.friction.static_torque = friction.number("static", Bounds::nonnegative(), torque);
      joint.friction.kinetic_torque = friction.number("kinetic", Bounds::nonnegative(), torque);
      joint.friction.viscous =
          friction.number("viscous", Bounds::nonnegative(), torque + "/(" + speed + ")");
      joint.friction.stribeck_velocity =
          friction.number("stribeck_velocity", Bounds::positive(), speed);
    }
    if (joint.stop.enabled || node.has("stop")) {
      const ConfigNode stop = node.at("stop");
      if (ball) {
        joint.stop.upper = stop.number("angle", Bounds{0.0, 3.0, true, false}, "rad");
      } else if (!joint.stop.enabled) {
        stop.fail("expected no 'stop': the joint has no limits in the URDF");
      }
      joint.stop.enabled = true;
      joint.stop.stiffness = stop.number("stiffness", Bounds::positive(), torque + "/" + position);
      joint.stop.damping =
          stop.number("damping", Bounds::nonnegative(), torque + "/(" + speed + ")");
    }
    if (node.has("driven")) {
      joint.driven = node.at("driven").as_bool();
      if (joint.driven && ball)
        node.at("driven").fail("only hinge and prismatic joints can be driven");
    }
  }

  void read_muscles() {
    // Also where every muscle has its own.
    eyelet_friction_ = friction_of(config_, "eyelet_friction", nullptr);
    surface_friction_ = friction_of(config_, "surface_friction", nullptr);
    if (config_.has("muscles")) {
      for (const auto& [name, node] : config_.at("muscles").entries()) add_muscle(name, node);
    }
    if (config_.has("joints")) {
      for (const auto& [name, node] : config_.at("joints").entries()) {
        if (node.has("drive")) add_drive(skeleton_->find_joint(name), node.at("drive"));
      }
    }
    read_unused_kinds();
  }

  /// What no muscle names must be whole nevertheless: a name misspelled in a file that changes a
  /// few keys of another one would else change nothing, without a word.
  void read_unused_kinds() {
    const auto each_of = [this](const char* library, auto read) {
      if (!config_.has(library)) return;
      for (const auto& [name, node] : config_.at(library).entries()) {
        if (!used_kinds_.count(std::string(library) + "." + name)) read(node);
      }
    };
    each_of("springs", [this](const ConfigNode& node) {
      make_series_elastic_element(node, 1, options_.step);
    });
    each_of("actuators", [](const ConfigNode& node) {
      require_actuator_type(node);
      node.ignore();  // the rest depends on the muscle
    });
    each_of("controllers", [this](const ConfigNode& node) {
      MuscleModel nobody;
      read_controller(node, nobody);
    });
  }

  void add_muscle(const std::string& name, const ConfigNode& node) {
    require_snake_case(node, name);
    if (name == "all") node.fail("'all' stands for all muscles: expected another name");
    if (skeleton_->find_joint(name) >= 0) {
      node.fail("a joint of " + model_->urdf_file +
                " has the same name: expected another one, because recordings contain both names");
    }
    model_->muscles.push_back(read_muscle(name, node));
  }

  void add_drive(int joint, const ConfigNode& node) {
    const JointModel& model = skeleton_->joints[joint];
    if (model.type == JointType::kBall) {
      node.fail("only hinge and prismatic joints can have a drive");
    }
    if (model.driven) {
      node.fail("expected either 'drive', whose motor makes the effort, or 'driven: true'");
    }
    const bool slide = model.type == JointType::kPrismatic;
    const std::string torque = slide ? "N" : "Nm", angle = slide ? "m" : "rad";
    MuscleModel drive;
    drive.name = model.name + "_drive";
    drive.key = node.path();
    if (model_->find_muscle(drive.name) >= 0) {
      node.fail("a muscle has the name of this drive, '" + drive.name + "'");
    }
    Transmission transmission;
    double ratio = 1.0;
    if (node.has("transmission")) {
      const ConfigNode shaft = node.at("transmission");
      ratio = shaft.number_or("ratio", 1.0, Bounds::positive(), slide ? "1/m" : "1");
      if (shaft.has("stiffness")) {
        transmission.stiffness =
            shaft.number("stiffness", Bounds::positive(), torque + "/" + angle);
      } else if (shaft.has("damping")) {
        shaft.at("damping").fail("a transmission without 'stiffness' is rigid: nothing damps it");
      }
      transmission.damping =
          shaft.number_or("damping", 0.0, Bounds::nonnegative(), torque + "s/" + angle);
    }
    drive.transmit(transmission);
    drive.actuator = make_drive_motor(kind("actuators", node.at("actuator")), ratio, options_.step);
    drive.path = std::make_shared<PathModel>(*skeleton_, joint);
    if (node.has("controller")) {
      drive.has_controller = true;
      read_controller(kind("controllers", node.at("controller")), drive);
      ecu::read_gains(node, drive.controller);
    } else if (node.has("gains")) {
      node.at("gains").fail("only a drive with a controller has gains");
    }
    model_->muscles.push_back(std::move(drive));
  }

  /// The entry of a library of kinds that a muscle names.
  ConfigNode kind(const std::string& library, const ConfigNode& choice) {
    const std::string name = choice.as_text();
    if (!config_.has(library) || !config_.at(library).has(name)) {
      choice.fail_expected("the name of an entry of '" + library + "'");
    }
    used_kinds_.insert(library + "." + name);
    return config_.at(library).at(name);
  }

  MuscleModel read_muscle(const std::string& name, const ConfigNode& node) {
    MuscleModel muscle;
    muscle.name = name;
    muscle.key = node.path();
    muscle.actuator = make_actuator(kind("actuators", node.at("actuator")), node, options_.step);
    muscle.path = read_path(node);
    const int segments = static_cast<int>(muscle.path->segment_count());

    if (!node.has("spring")) {
      node.fail(
          "key 'spring' is missing: without a spring the tension would depend on the masses that "
          "the muscle moves and could not be computed from the tendon alone (section 4.6); for a "
          "rigid tendon, expected a stiff spring");
    }
    const ConfigNode spring = node.at("spring");
    const int quantity = spring.has("quantity") ? spring.at("quantity").as_integer(1, 100) : 1;
    muscle.spring =
        make_series_elastic_element(kind("springs", spring.at("kind")), quantity, options_.step);
    muscle.spring_segment = spring.at("segment").as_integer(0, segments - 1);
    muscle.sensor_segment = node.at("force_sensor_segment").as_integer(0, segments - 1);

    if (node.has("ecu")) {
      muscle.ecu = node.text("ecu");
      require_snake_case(node.at("ecu"), muscle.ecu);
      if (muscle.ecu == "all" || muscle.ecu == "global") {
        node.at("ecu").fail_expected("another name: 'all' and 'global' are reserved");
      }
    }
    if (node.has("controller")) {
      if (!muscle.motor()) {
        node.at("controller")
            .fail(
                "only a motor can have a controller; expected null for ligaments and Hill muscles");
      }
      muscle.has_controller = true;
      read_controller(kind("controllers", node.at("controller")), muscle);
    }
    if (muscle.has_controller) ecu::read_gains(node, muscle.controller);
    ecu::check_muscle(node);
    return muscle;
  }

  void read_controller(const ConfigNode& node, MuscleModel& muscle) {
    const ecu::ControllerKind entry = ecu::read_controller(node);
    muscle.limits = {entry.largest_position, entry.largest_current, entry.largest_force};
    ecu::ControllerSettings& c = muscle.controller;
    c = entry.settings;
    if (options_.slow_controllers) c.period = std::max(c.period, options_.step);
    const double ratio = c.period / options_.step;
    muscle.steps_per_tick = static_cast<int>(std::lround(ratio));
    if (muscle.steps_per_tick < 1 || std::abs(ratio - muscle.steps_per_tick) > 1e-9 * ratio) {
      char step[32];
      std::snprintf(step, sizeof(step), "%g", options_.step);
      node.at("period").fail_expected(std::string("a whole multiple of the simulation step ") +
                                      step + " s");
    }
  }

  std::shared_ptr<const PathModel> read_path(const ConfigNode& muscle) {
    const ConfigNode path = muscle.at("path");
    const auto entries = path.items();
    if (entries.size() < 2) path.fail("expected at least two points: origin and insertion");
    const auto eyelets = friction_of(muscle, "eyelet_friction", eyelet_friction_);
    const auto surfaces = friction_of(muscle, "surface_friction", surface_friction_);
    std::vector<PathObstacle> obstacles;
    for (std::size_t i = 0; i < entries.size(); ++i) {
      obstacles.push_back(read_obstacle(entries[i], eyelets, surfaces));
      obstacles[i].entry = static_cast<int>(i);
      const bool end = i == 0 || i + 1 == entries.size();
      if (obstacles[i].surface && end) {
        entries[i].fail("a path begins and ends with a point, not with a surface");
      }
      if (end && entries[i].has("friction")) {
        entries[i]
            .at("friction")
            .fail("expected no friction: the tendon is fixed at both ends of a path");
      }
      if (end) obstacles[i].friction = nullptr;
      if (i == 0) continue;
      const PathObstacle& last = obstacles[i - 1];
      if (obstacles[i].surface && last.surface) {
        entries[i].fail("two surfaces in a row: put a point between them");
      }
      if (!obstacles[i].surface && !last.surface && obstacles[i].body == last.body &&
          (obstacles[i].point_B - last.point_B).norm() < 1e-6) {
        entries[i].fail("expected another place: this is the same place as the previous point");
      }
    }
    return std::make_shared<PathModel>(*skeleton_, std::move(obstacles));
  }

  std::shared_ptr<const FrictionLaw> friction_of(
      const ConfigNode& node, const std::string& key,
      const std::shared_ptr<const FrictionLaw>& otherwise) const {
    return node.has(key) ? make_friction_law(node.at(key), options_.step) : otherwise;
  }

  PathObstacle read_obstacle(const ConfigNode& entry,
                             const std::shared_ptr<const FrictionLaw>& eyelets,
                             const std::shared_ptr<const FrictionLaw>& surfaces) {
    PathObstacle obstacle;
    const ConfigNode body = entry.at("body");
    const int frame = skeleton_->find_frame(body.as_text());
    if (frame < 0) body.fail_expected("the name of a link in " + model_->urdf_file);
    obstacle.body = skeleton_->frames[frame].body;
    const Pose X_BF =
        skeleton_->bodies[obstacle.body].X_LB.inverse() * skeleton_->frames[frame].X_LF;
    obstacle.R_BL = X_BF.R;

    std::string type;
    for (const auto& item : entry.entries()) {
      if (item.first == "body" || item.first == "friction") continue;
      if (!type.empty())
        entry.fail("expected one obstacle, found '" + type + "' and '" + item.first + "'");
      type = item.first;
    }
    if (type.empty()) entry.fail("expected a point or one of: " + wrapping_surface_types());
    if (type == "point") {
      obstacle.point_B = X_BF * near_link(entry.at("point"));
      obstacle.friction = eyelets;
    } else {
      obstacle.surface = make_wrapping_surface(type, entry.at(type), X_BF, files_.meshes);
      for (const std::string& remark : obstacle.surface->remarks()) {
        model_->remarks.push_back(remark);
      }
      obstacle.friction = surfaces;
    }
    if (entry.has("friction"))
      obstacle.friction = make_friction_law(entry.at("friction"), options_.step);
    return obstacle;
  }

  void read_sensors() {
    int fastest = 0;
    for (const MuscleModel& muscle : model_->muscles) {
      if (!muscle.has_controller) continue;
      fastest = fastest == 0 ? muscle.steps_per_tick : std::min(fastest, muscle.steps_per_tick);
    }
    model_->sensors.steps_per_tick = std::max(1, fastest);
    if (!config_.has("sensors")) return;
    const ConfigNode node = config_.at("sensors");
    const auto read = [&](const std::string& key, const std::string& unit, SensorModel& model) {
      if (node.has(key)) model = SensorModel::load(node.at(key), unit);
    };
    read("position", "rad", model_->sensors.position);
    read("velocity", "rad/s", model_->sensors.velocity);
    read("current", "A", model_->sensors.current);
    read("force", "N", model_->sensors.force);
    read("joint_position", "rad", model_->sensors.joint_position);
    if (node.has("seed")) model_->sensors.seed = node.at("seed").as_integer(0, 2147483647);
  }

  void read_touch_pads() {
    if (!config_.has("touch_pads")) return;
    for (const auto& [name, node] : config_.at("touch_pads").entries()) {
      require_snake_case(node, name);
      TouchPadModel pad;
      pad.name = name;
      pad.joint = skeleton_->find_joint(node.text("joint"));
      if (pad.joint < 0 || skeleton_->joints[pad.joint].type != JointType::kHinge ||
          !skeleton_->joints[pad.joint].stop.enabled) {
        node.at("joint").fail_expected("a hinge with limits in " + model_->urdf_file);
      }
      pad.lever = node.number("lever", Bounds::positive(), "m");
      pad.share = node.number("share", Bounds::fraction(), "1");
      model_->touch_pads.push_back(pad);
    }
  }

  /// ", with wrapping_surface @ biceps_brachii/1": what may have moved points and surfaces.
  std::string with_effects_at(const std::string& muscle) const {
    std::string list;
    for (const EffectInstance& effect : model_->effects) {
      if (effect.place != muscle && effect.place.rfind(muscle + "/", 0) != 0) continue;
      list += (list.empty() ? ", with " : ", ") + effect.id + " @ " + effect.place;
    }
    return list;
  }

  static std::string millimetres(double metres) {
    char text[32];
    std::snprintf(text, sizeof(text), "%.2f mm", 1e3 * metres);
    return text;
  }

  /// A tendon may lie on either side of a surface whose middle it goes through.
  void remark_on_undecided_side(const PathModel& path, std::size_t i, const ConfigNode& entry,
                                const std::vector<BodyState>& bodies) {
    const auto& list = path.obstacles();
    if (!list[i].surface) return;
    const auto seen = [&](const PathObstacle& point) {
      return bodies[list[i].body].X_WB.to_local(bodies[point.body].X_WB * point.point_B);
    };
    const auto lengths = undecided_side(*list[i].surface, seen(list[i - 1]), seen(list[i + 1]));
    if (!lengths) return;
    model_->remarks.push_back(
        entry.file() + ": " + entry.path() +
        ": at rest the tendon goes through the middle of this " + list[i].surface->type() +
        ", and rounding decides on which side it lies (" + millimetres(lengths->first) +
        " on this side, " + millimetres(lengths->second) +
        " on another); expected a neighbouring point, or the surface, moved towards the side that "
        "is meant");
  }

  /// Points inside surfaces are easiest explained while the file is at hand.
  void check_rest_posture() {
    std::vector<BodyState> bodies;
    KinematicTree(*skeleton_).place(skeleton_->rest_configuration(), {}, bodies);
    if (!config_.has("muscles")) return;
    const auto nodes = config_.at("muscles").entries();
    const double allowed = model_->effects.empty() ? kRoundingDepth : kAllowedByEffects;
    for (std::size_t m = 0; m < nodes.size(); ++m) {
      const PathModel& path = *model_->muscles[m].path;
      std::vector<double> memory(path.state_size() + 1, 0.0);
      MusclePath posture(path);
      posture.initialise(bodies, StateView(memory.data()));
      const auto entries = nodes[m].second.at("path").items();
      for (std::size_t i = 0; i < path.obstacles().size(); ++i) {
        const ObstacleState& obstacle = posture.obstacles()[i];
        const int number = path.obstacles()[i].entry;
        const ConfigNode list = nodes[m].second.at("path");
        const ConfigNode entry = number >= 0 ? entries[number] : list;
        remark_on_undecided_side(path, i, entry, bodies);
        if (obstacle.penetration <= allowed) continue;
        const std::string message =
            "a neighbouring path point lies " + millimetres(obstacle.penetration) +
            " inside the surface at rest" + with_effects_at(model_->muscles[m].name) +
            "; expected it outside";
        const std::string who = number >= 0 ? "" : "surface added by an effect: ";
        if (obstacle.touching) entry.fail(who + message);
        // A tendon that runs clear of it is well defined, and calibrations try such radii.
        model_->remarks.push_back(entry.file() + ": " + entry.path() + ": " + who + message);
      }
    }
  }

  const ConfigNode& config_;
  const RobotFiles& files_;
  const LoadOptions& options_;
  std::shared_ptr<RobotModel> model_;
  std::shared_ptr<SkeletonModel> skeleton_;
  std::set<std::string> used_kinds_;
  std::shared_ptr<const FrictionLaw> eyelet_friction_, surface_friction_;  ///< null: none
};

/// Opens the meshes of all muscles. What is wrong with the description of a path is said when it is
/// built.
void read_meshes(const ConfigNode& config, const MeshFiles& files) {
  const auto has = [](const ConfigNode& node, const char* key) {
    return node.is_map() && node.has(key);
  };
  if (!has(config, "muscles") || !config.at("muscles").is_map()) return;
  for (const auto& [name, muscle] : config.at("muscles").entries()) {
    if (!has(muscle, "path") || !muscle.at("path").is_sequence()) continue;
    for (const ConfigNode& entry : muscle.at("path").items()) {
      if (!has(entry, "mesh") || !has(entry.at("mesh"), "file")) continue;
      const ConfigNode file = entry.at("mesh").at("file");
      if (file.is_scalar()) files.get(file);
    }
  }
}

void check_step(const LoadOptions& options) {
  if (options.step >= kMinimumStep && options.step <= kMaximumStep) return;
  std::ostringstream given;
  given << std::setprecision(std::numeric_limits<double>::digits10) << options.step;
  throw BadInput("simulation step " + given.str() + " s: expected a number in [1e-07, 0.1]");
}

}  // namespace

RobotDescription RobotDescription::load(const std::string& file) {
  return RobotDescription(ConfigNode::load(file));
}

RobotDescription::RobotDescription(const ConfigNode& config) : config_(config.clone()) {
  auto files = std::make_shared<RobotFiles>();
  files->name = std::filesystem::weakly_canonical(config_.file()).parent_path().filename().string();
  files->collisions = config_.has("collisions") && config_.at("collisions").as_bool();
  const ConfigNode robot = config_.at("robot");
  const auto urdf = std::filesystem::path(robot.file()).parent_path() / robot.as_text();
  if (!std::filesystem::exists(urdf)) robot.fail_expected("a URDF file beside this one");
  files->urdf = urdf.string();
  files->robot = read_urdf(files->urdf, files->collisions);
  read_meshes(config_, files->meshes);
  files_ = std::move(files);
}

std::shared_ptr<const RobotModel> RobotDescription::build(const LoadOptions& options) const {
  check_step(options);
  ConfigNode own = config_.clone();
  for (const auto& [path, value] : options.overrides) own.set_number(path, value);
  return Builder(own, *files_, options).build();
}

std::shared_ptr<const RobotModel> load_robot_model(const std::string& file,
                                                   const LoadOptions& options) {
  return build_robot_model(ConfigNode::load(file), options);
}

std::shared_ptr<const RobotModel> build_robot_model(const ConfigNode& config,
                                                    const LoadOptions& options) {
  check_step(options);
  return RobotDescription(config).build(options);
}

}  // namespace anthrob
