#include "anthrob_sim/conversions.h"

#include <algorithm>
#include <cmath>

#include "anthrob_core/force_colour.h"
#include "anthrob_ecu/fault.h"
#include "anthrob_ros/diagnostics.h"
#include "path/cylinder.h"
#include "path/mesh_surface.h"
#include "path/sphere.h"
#include "report/solved_path.h"

namespace anthrob {

namespace {

/// The frame in which nothing moves.
const std::string& base_of(const Simulation& sim) {
  return sim.model().skeleton->bodies[0].name;
}

}  // namespace

std::vector<ecu::MuscleChannel> muscle_channels(const RobotModel& model) {
  std::vector<ecu::MuscleChannel> channels;
  for (const MuscleModel& muscle : model.muscles) {
    ecu::MuscleChannel channel;
    channel.name = muscle.name;
    channel.ecu = muscle.ecu;
    channel.takes_commands = muscle.actuator->takes_input();
    const CommandLimits& limits = muscle.limits;
    if (muscle.has_controller) {
      const double volts = muscle.controller.voltage_limit;
      channel.modes = {true, true, true, muscle.has_force_sensor()};
      const double lowest_force = muscle.is_drive() ? -limits.force : 0.0;
      channel.lowest = {-volts, -limits.position, -limits.current, lowest_force};
      channel.highest = {volts, limits.position, limits.current, limits.force};
    } else {
      channel.modes = {channel.takes_commands, false, false, false};
      channel.lowest[0] = muscle.actuator->input_low();
      channel.highest[0] = muscle.actuator->input_high();
    }
    channels.push_back(channel);
  }
  return channels;
}

void read_state(const anthrob_msgs::SetState::Request& request, Placement& placement) {
  if (request.joint_name.size() != request.joint_position.size() ||
      request.ball_joint_name.size() != request.ball_joint_orientation.size() ||
      request.muscle_name.size() != request.muscle_position.size()) {
    throw BadInput("names and values differ in number");
  }
  refuse_repeated("joint", request.joint_name);
  refuse_repeated("ball joint", request.ball_joint_name);
  refuse_repeated("muscle", request.muscle_name);
  for (std::size_t i = 0; i < request.joint_name.size(); ++i) {
    placement.set_joint(request.joint_name[i], request.joint_position[i]);
  }
  for (std::size_t i = 0; i < request.ball_joint_name.size(); ++i) {
    const auto& o = request.ball_joint_orientation[i];
    placement.set_ball_joint(request.ball_joint_name[i], Quat(o.w, o.x, o.y, o.z));
  }
  for (std::size_t i = 0; i < request.muscle_name.size(); ++i) {
    placement.set_muscle(request.muscle_name[i], request.muscle_position[i]);
  }
}

anthrob_msgs::MuscleStates muscle_states(const Simulation& sim, const ecu::Supervisor& supervisor,
                                         const ros::Time& stamp) {
  anthrob_msgs::MuscleStates states;
  states.header.stamp = stamp;
  states.header.frame_id = base_of(sim);
  for (std::size_t i = 0; i < sim.muscle_count(); ++i) {
    const Muscle& muscle = sim.muscle(static_cast<int>(i));
    const ecu::Measurement& measured = muscle.measured();
    states.name.push_back(muscle.model().name);
    states.position.push_back(measured.position);
    states.velocity.push_back(measured.velocity);
    states.current.push_back(measured.current);
    states.voltage.push_back(muscle.voltage());
    states.force.push_back(muscle.model().has_force_sensor() ? measured.force : NAN);
    states.reference.push_back(muscle.reference());
    states.mode.push_back(static_cast<std::uint8_t>(muscle.mode()));
    states.ecu_state.push_back(static_cast<std::uint8_t>(supervisor.state(static_cast<int>(i))));
  }
  return states;
}

sensor_msgs::JointState joint_states(const Simulation& sim, const ros::Time& stamp) {
  sensor_msgs::JointState states;
  states.header.stamp = stamp;
  states.header.frame_id = base_of(sim);
  const auto& joints = sim.model().skeleton->joints;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (joints[j].type == JointType::kBall) continue;
    states.name.push_back(joints[j].name);
    states.position.push_back(sim.measured_joint_position(static_cast<int>(j)));
    states.velocity.push_back(sim.read_velocity(static_cast<int>(j)));
    states.effort.push_back(sim.joint_effort(static_cast<int>(j)));
  }
  return states;
}

anthrob_msgs::SphericalJointStates spherical_joint_states(const Simulation& sim,
                                                          const ros::Time& stamp) {
  anthrob_msgs::SphericalJointStates states;
  states.header.stamp = stamp;
  states.header.frame_id = base_of(sim);
  const auto& joints = sim.model().skeleton->joints;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (joints[j].type != JointType::kBall) continue;
    const double* q = sim.read_positions() + joints[j].position_offset;
    const Vec3 w = sim.read_ball_velocity(static_cast<int>(j));
    geometry_msgs::Quaternion orientation;
    orientation.w = q[0], orientation.x = q[1], orientation.y = q[2], orientation.z = q[3];
    geometry_msgs::Vector3 velocity;
    velocity.x = w.x(), velocity.y = w.y(), velocity.z = w.z();
    states.name.push_back(joints[j].name);
    states.orientation.push_back(orientation);
    states.angular_velocity.push_back(velocity);
  }
  return states;
}

anthrob_msgs::TouchStates touch_states(const Simulation& sim, const ros::Time& stamp) {
  anthrob_msgs::TouchStates states;
  states.header.stamp = stamp;
  states.header.frame_id = base_of(sim);
  for (const TouchPadModel& pad : sim.model().touch_pads) {
    states.name.push_back(pad.name);
    states.force.push_back(pad_force(pad, sim.tree(), sim.configuration()));
  }
  return states;
}

std::vector<diagnostic_msgs::DiagnosticStatus> ecu_statuses(const ecu::Supervisor& supervisor,
                                                            const std::string& ns) {
  std::vector<diagnostic_msgs::DiagnosticStatus> statuses;
  for (std::size_t e = 0; e < supervisor.ecus().size(); ++e) {
    diagnostic_msgs::DiagnosticStatus unit;
    const ecu::State state = supervisor.ecu_state(e);
    unit.name = ns + ": " + supervisor.ecus()[e];
    unit.hardware_id = supervisor.ecus()[e];
    unit.level = state == ecu::State::kFault      ? diagnostic_msgs::DiagnosticStatus::ERROR
                 : state == ecu::State::kStopping ? diagnostic_msgs::DiagnosticStatus::WARN
                                                  : diagnostic_msgs::DiagnosticStatus::OK;
    unit.message = ecu::name(state);
    // As the driver has them; nothing goes wrong with simulated units.
    unit.values = {key_value("stop_latched", supervisor.stop_latched() ? "true" : "false"),
                   key_value("fault", ecu::name(ecu::Fault::kNone)),
                   key_value("zero_lost", "false")};
    statuses.push_back(unit);
  }
  return statuses;
}

std::vector<geometry_msgs::TransformStamped> ball_joint_transforms(const Simulation& sim,
                                                                   const ros::Time& stamp) {
  std::vector<geometry_msgs::TransformStamped> transforms;
  const SkeletonModel& skeleton = *sim.model().skeleton;
  for (const JointModel& joint : skeleton.joints) {
    if (joint.type != JointType::kBall) continue;
    const int parent = skeleton.find_frame(joint.parent_link);
    const int child = skeleton.find_frame(joint.child_link);
    const Pose X_PC = sim.link_pose(parent).inverse() * sim.link_pose(child);
    const Quat q = canonical(Quat(X_PC.R));
    geometry_msgs::TransformStamped transform;
    transform.header.stamp = stamp;
    transform.header.frame_id = joint.parent_link;
    transform.child_frame_id = joint.child_link;
    transform.transform.translation.x = X_PC.p.x();
    transform.transform.translation.y = X_PC.p.y();
    transform.transform.translation.z = X_PC.p.z();
    transform.transform.rotation.w = q.w(), transform.transform.rotation.x = q.x();
    transform.transform.rotation.y = q.y(), transform.transform.rotation.z = q.z();
    transforms.push_back(transform);
  }
  return transforms;
}

namespace {

constexpr double kTendonWidth = 0.0022;  // [m] thicker than real, to be seen

geometry_msgs::Point to_point(const Vec3& p) {
  geometry_msgs::Point point;
  point.x = p.x(), point.y = p.y(), point.z = p.z();
  return point;
}

}  // namespace

anthrob_msgs::MusclePaths solved_paths(const Simulation& sim, const ros::Time& stamp) {
  anthrob_msgs::MusclePaths paths;
  paths.header.stamp = stamp;
  paths.header.frame_id = base_of(sim);
  for (std::size_t i = 0; i < sim.muscle_count(); ++i) {
    const SolvedPath solved = solved_path(sim, static_cast<int>(i));
    anthrob_msgs::MusclePath path;
    path.name = solved.muscle;
    path.length = solved.length;
    path.velocity = solved.velocity;
    path.spring_expansion = solved.spring_expansion;
    path.slack = solved.slack;
    for (const SolvedContact& contact : solved.contacts) {
      anthrob_msgs::PathContact message;
      message.obstacle = contact.entry < 0 ? anthrob_msgs::PathContact::OF_AN_EFFECT
                                           : static_cast<std::uint32_t>(contact.entry);
      message.surface = contact.surface;
      message.body = contact.body;
      message.touching = contact.touching;
      message.entry = to_point(contact.entry_W);
      message.exit = to_point(contact.exit_W);
      message.wrap_angle = contact.wrap_angle;
      message.length = contact.length;
      message.tension_in = contact.tension_in;
      message.tension_out = contact.tension_out;
      message.penetration = contact.penetration;
      path.contacts.push_back(message);
    }
    paths.muscles.push_back(path);
  }
  return paths;
}

anthrob_msgs::MomentArms moment_arms(const Simulation& sim, const ros::Time& stamp) {
  anthrob_msgs::MomentArms message;
  message.header.stamp = stamp;
  message.header.frame_id = base_of(sim);
  for (const SweepAxis& axis : sweep_axes(*sim.model().skeleton)) message.axis.push_back(axis.name);
  for (std::size_t m = 0; m < sim.muscle_count(); ++m) {
    message.muscle.push_back(sim.model().muscles[m].name);
    const std::vector<double> arms = sim.moment_arms(static_cast<int>(m));
    message.arm.insert(message.arm.end(), arms.begin(), arms.end());
  }
  return message;
}

std::vector<double> spring_tensions(const Simulation& sim) {
  std::vector<double> tensions;
  for (std::size_t i = 0; i < sim.muscle_count(); ++i) {
    tensions.push_back(sim.muscle(static_cast<int>(i)).spring_tension());
  }
  return tensions;
}

visualization_msgs::MarkerArray muscle_markers(const Simulation& sim,
                                               const std::vector<double>& forces,
                                               const ros::Time& stamp) {
  visualization_msgs::MarkerArray markers;
  for (std::size_t i = 0; i < sim.muscle_count(); ++i) {
    const Muscle& muscle = sim.muscle(static_cast<int>(i));
    visualization_msgs::Marker marker;
    marker.header.stamp = stamp;
    marker.header.frame_id = base_of(sim);
    marker.ns = muscle.model().name;
    marker.type = visualization_msgs::Marker::LINE_STRIP;
    marker.pose.orientation.w = 1.0;
    marker.scale.x = kTendonWidth;
    const Colour colour = force_colour(forces[i]);
    marker.color.r = colour.r, marker.color.g = colour.g, marker.color.b = colour.b;
    marker.color.a = 1.0f;
    for (const Vec3& point : muscle.path().polyline(sim.bodies()))
      marker.points.push_back(to_point(point));
    markers.markers.push_back(marker);
  }
  return markers;
}

anthrob_msgs::TendonPaths tendon_paths(const Simulation& sim, const std::vector<double>& forces,
                                       double slack_force, const ros::Time& stamp) {
  const std::vector<BodyModel>& bodies = sim.model().skeleton->bodies;
  anthrob_msgs::TendonPaths paths;
  paths.header.stamp = stamp;
  for (std::size_t i = 0; i < sim.muscle_count(); ++i) {
    const Muscle& muscle = sim.muscle(static_cast<int>(i));
    anthrob_msgs::TendonPath path;
    path.name = muscle.model().name;
    path.force = forces[i];
    path.slack = forces[i] <= slack_force;
    for (const CarriedPoint& point : muscle.path().carried_points()) {
      const BodyModel& body = bodies[point.body];
      path.link.push_back(body.name);
      path.point.push_back(to_point(body.X_LB * point.point_B));
    }
    paths.muscles.push_back(path);
  }
  return paths;
}

namespace {

/// The facets of a hull, in its body's frame.
void add_facets(const ConvexHull& hull, visualization_msgs::Marker& marker) {
  marker.type = visualization_msgs::Marker::TRIANGLE_LIST;
  marker.scale.x = marker.scale.y = marker.scale.z = 1.0;
  for (int h = 0; h < hull.half_edge_count(); ++h) marker.points.push_back(to_point(hull.from(h)));
}

/// Gives a marker the shape of a surface.
/// @param X_LS where the marker sits; the pose of the surface's body on entry
/// @return false for a surface that has no shape to show
bool take_shape(const WrappingSurface& surface, visualization_msgs::Marker& marker, Pose& X_LS) {
  if (const auto* cylinder = dynamic_cast<const Cylinder*>(&surface)) {
    // RViz's cylinders stand on z, ours turn about y. Infinite ones are shown 80 mm long.
    Mat3 R;
    R << Vec3::UnitX(), -Vec3::UnitZ(), Vec3::UnitY();
    X_LS = X_LS * cylinder->pose() * Pose{R, Vec3::Zero()};
    marker.type = visualization_msgs::Marker::CYLINDER;
    marker.scale.x = marker.scale.y = 2.0 * cylinder->radius();
    marker.scale.z = 0.08;
  } else if (const auto* sphere = dynamic_cast<const Sphere*>(&surface)) {
    X_LS.p = X_LS * sphere->center();
    marker.type = visualization_msgs::Marker::SPHERE;
    marker.scale.x = marker.scale.y = marker.scale.z = 2.0 * sphere->radius();
  } else if (const auto* mesh = dynamic_cast<const MeshSurface*>(&surface)) {
    add_facets(mesh->hull(), marker);
  } else {
    // The surface of the thesis's selection is another one in every posture.
    return false;
  }
  return true;
}

}  // namespace

visualization_msgs::MarkerArray surface_markers(const RobotModel& model) {
  visualization_msgs::MarkerArray markers;
  for (const MuscleModel& muscle : model.muscles) {
    for (const PathObstacle& obstacle : muscle.path->obstacles()) {
      if (!obstacle.surface) continue;
      const BodyModel& body = model.skeleton->bodies[obstacle.body];
      visualization_msgs::Marker marker;
      Pose X_LS = body.X_LB;
      if (!take_shape(*obstacle.surface, marker, X_LS)) continue;
      marker.header.frame_id = body.name;
      marker.frame_locked = true;
      marker.ns = muscle.name;
      marker.id = static_cast<int>(markers.markers.size());
      marker.color.r = 0.3f, marker.color.g = 0.6f, marker.color.b = 0.9f, marker.color.a = 0.08f;
      const Quat q(X_LS.R);
      marker.pose.position = to_point(X_LS.p);
      marker.pose.orientation.w = q.w(), marker.pose.orientation.x = q.x();
      marker.pose.orientation.y = q.y(), marker.pose.orientation.z = q.z();
      markers.markers.push_back(marker);
    }
  }
  return markers;
}

}  // namespace anthrob
