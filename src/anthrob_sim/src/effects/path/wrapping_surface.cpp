#include <algorithm>
#include <optional>

#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/effects/placed_effects.h"
#include "path/cylinder.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "wrapping_surface";
  i.name = "Unmodelled wrapping surface";
  i.description =
      "The model lets the tendon run straight across a joint, but in some postures a bone is in "
      "the way: a cylinder on the body beyond the joint, around a line through the joint's centre. "
      "The line runs along the axis of a hinge, or along the bone of a ball joint (towards the "
      "next joint, or the centre of mass). Moment arm and length are wrong in one region of "
      "postures, with a kink where the tendon touches down. MUSCLE means the last segment that "
      "crosses a joint, MUSCLE/k the segment that ends at entry k. Without friction; add "
      "wrap_friction for that.";
  i.equation = "shortest path over the cylinder, (4.28)-(4.33)";
  i.source = "thesis, sections 4.2.4, 7.2.2 and 7.5: model I against model II";
  i.where = "MUSCLE | MUSCLE/k";
  i.seam = Seam::kPath;
  i.stage = Stage::kParts;
  i.channels = {"joint", "force", "position"};
  i.parameters = {
      {"radius", "m", "of the cylinder", 0.0, 0.025, {0.0, 0.1}},
      {"offset_u",
       "m",
       "of the cylinder's axis, perpendicular to it",
       0.0,
       0.002,
       {-0.05, 0.05},
       EffectParameter::kShape},
      {"offset_v",
       "m",
       "the same, perpendicular to both",
       0.0,
       0.002,
       {-0.05, 0.05},
       EffectParameter::kShape},
  };
  return i;
}

/// A segment between two points with a joint between them: where a surface can be.
struct Spot {
  std::size_t obstacle;  ///< at which the segment ends
  int joint;
};

class WrappingSurfaceEffect final : public Effect {
 public:
  WrappingSurfaceEffect() : Effect(describe()) {}

  std::vector<std::string> places(const RobotModel& robot) const override {
    std::vector<std::string> list;
    for (const MuscleModel& muscle : robot.muscles) {
      if (muscle.is_drive()) continue;
      bool any = false;
      for (std::size_t i = 1; i < muscle.path->obstacles().size(); ++i) {
        if (!joint_of(*robot.skeleton, *muscle.path, i)) continue;
        any = true;
        list.push_back(muscle.name + "/" + std::to_string(muscle.path->obstacles()[i].entry));
      }
      if (any) list.push_back(muscle.name);
    }
    return list;
  }

  /// The radius ends where the nearer end of the segment would lie inside, at rest.
  std::vector<EffectParameter> parameters_at(const RobotModel& robot,
                                             const std::string& place) const override {
    std::vector<EffectParameter> list = info().parameters;
    const int muscle = robot.find_muscle(split_place(place)[0]);
    if (muscle < 0) return list;
    const std::optional<Spot> found = find(robot, place);
    if (!found) return list;
    const Spot spot = *found;
    std::vector<BodyState> bodies;
    const SkeletonModel& skeleton = *robot.skeleton;
    KinematicTree(skeleton).place(skeleton.rest_configuration(), {}, bodies);
    const Pose X_LC = line(skeleton, spot.joint);
    const int body = skeleton.joints[spot.joint].child;
    const Pose X_WC = bodies[body].X_WB * (skeleton.bodies[body].X_LB.inverse() * X_LC);
    double nearest = list[0].bounds.hi;
    for (const std::size_t end : {spot.obstacle - 1, spot.obstacle}) {
      const PathObstacle& point = robot.muscles[muscle].path->obstacles()[end];
      Vec3 p_C = X_WC.to_local(bodies[point.body].X_WB * point.point_B);
      p_C.y() = 0.0;
      nearest = std::min(nearest, p_C.norm());
    }
    list[0].bounds.hi = nearest;
    list[0].typical = std::min(list[0].typical, 0.9 * nearest);
    return list;
  }

  void build_in(const EffectSetting& setting, ModelDraft& draft) const override {
    const Spot spot = find(draft.robot, setting.place()).value();
    MuscleModel& muscle =
        draft.robot.muscles[draft.robot.find_muscle(split_place(setting.place())[0])];
    const SkeletonModel& skeleton = draft.skeleton;
    Pose X_LC = line(skeleton, spot.joint);
    X_LC.p += X_LC.R * Vec3(setting["offset_u"], 0.0, setting["offset_v"]);

    PathObstacle surface;
    surface.body = skeleton.joints[spot.joint].child;
    surface.surface =
        std::make_shared<Cylinder>(skeleton.bodies[surface.body].X_LB.inverse() * X_LC,
                                   CircleWrap(setting["radius"], WrapStart::kNotWrapping, 0));
    std::vector<PathObstacle> obstacles = muscle.path->obstacles();
    obstacles.insert(obstacles.begin() + static_cast<std::ptrdiff_t>(spot.obstacle), surface);
    muscle.path = std::make_shared<PathModel>(skeleton, std::move(obstacles));
    // Segments behind the new one move up.
    const int at = static_cast<int>(spot.obstacle);
    if (muscle.spring_segment >= at) ++muscle.spring_segment;
    if (muscle.sensor_segment >= at) ++muscle.sensor_segment;
  }

 private:
  static constexpr double kShortestLine = 1e-6;  // [m]

  /// The outermost joint between the ends of the segment that ends at obstacle i, if it has a line.
  static std::optional<int> joint_of(const SkeletonModel& skeleton, const PathModel& path,
                                     std::size_t i) {
    const PathObstacle &a = path.obstacles()[i - 1], &b = path.obstacles()[i];
    if (a.surface || b.surface || b.entry < 0) return std::nullopt;
    const auto joints = joints_between(skeleton, a.body, b.body);
    if (joints.empty()) return std::nullopt;
    const int joint =
        std::max_element(joints.begin(), joints.end(), [](const auto& x, const auto& y) {
          return x.joint < y.joint;
        })->joint;
    if (skeleton.joints[joint].type == JointType::kPrismatic) return std::nullopt;
    // A ball joint in the middle of the next one, or of its body's mass, has no line.
    if (!(direction(skeleton, joint).norm() > kShortestLine)) return std::nullopt;
    return joint;
  }

  static std::optional<Spot> find(const RobotModel& robot, const std::string& place) {
    const std::vector<std::string> parts = split_place(place);
    const PathModel& path = *robot.muscles[robot.find_muscle(parts[0])].path;
    std::optional<Spot> spot;
    for (std::size_t i = 1; i < path.obstacles().size(); ++i) {
      const std::optional<int> joint = joint_of(*robot.skeleton, path, i);
      if (!joint) continue;
      if (parts.size() > 1 && std::to_string(path.obstacles()[i].entry) != parts[1]) continue;
      spot = Spot{i, *joint};
    }
    return spot;
  }

  /// Along a hinge's axis; from a ball joint to the next joint, or to its body's centre of mass.
  static Vec3 direction(const SkeletonModel& skeleton, int index) {
    const JointModel& joint = skeleton.joints[index];
    if (joint.type != JointType::kBall) return joint.axis_C;
    for (const JointModel& next : skeleton.joints) {
      if (next.parent == joint.child) return next.X_PC_rest * next.center_C - joint.center_C;
    }
    return skeleton.bodies[joint.child].com_L - joint.center_C;
  }

  /// The line in the link frame of the body beyond the joint; y along it.
  static Pose line(const SkeletonModel& skeleton, int index) {
    const JointModel& joint = skeleton.joints[index];
    Vec3 axis = direction(skeleton, index);
    if (joint.type == JointType::kBall) axis.normalize();
    const Vec3 across = axis.unitOrthogonal();
    Pose X_LC;
    X_LC.R << across, axis, across.cross(axis);
    X_LC.p = joint.center_C;
    return X_LC;
  }
};

const EffectRegistration kRegistration(std::make_unique<WrappingSurfaceEffect>());

}  // namespace
}  // namespace anthrob
