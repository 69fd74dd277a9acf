#include "tendon_display.h"

#include <anthrob_msgs/MomentArms.h>
#include <anthrob_msgs/MusclePaths.h>
#include <anthrob_msgs/TendonPaths.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "anthrob_core/errors.h"
#include "anthrob_sim/conversions.h"

namespace anthrob {

namespace {

constexpr double kDrawingPeriod = 0.05;  // [s] of wall time
constexpr double kStaleAfter = 0.5;      // [s] what is older, or ahead, is not where the robot is
constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();
constexpr double kSlackForce = 1.0;  // [N] three times the noise of a sensor

/// Stamps lie ahead where clocks differ, or time was set back.
bool is_fresh(const ros::Time& stamp, const ros::Time& now) {
  return !stamp.isZero() && std::abs(now.toSec() - stamp.toSec()) <= kStaleAfter;
}

}  // namespace

TendonDisplay::TendonDisplay(std::shared_ptr<const RobotModel> model, ros::NodeHandle nh,
                             bool joint_tf)
    : sim_(std::move(model)),
      q_(sim_.model().skeleton->rest_configuration()),
      forces_(sim_.muscle_count(), kNotMeasured),
      stamps_(sim_.model().skeleton->joints.size()),
      surfaces_(nh, sim_.model()) {
  paths_ = nh.advertise<visualization_msgs::MarkerArray>("muscle_paths", 2);
  tendon_paths_ = nh.advertise<anthrob_msgs::TendonPaths>("tendon_paths", 2);
  solved_paths_ = nh.advertise<anthrob_msgs::MusclePaths>("solved_paths", 10);
  moment_arms_ = nh.advertise<anthrob_msgs::MomentArms>("moment_arms", 10);
  if (joint_tf) transforms_.emplace();
  const auto no_delay = ros::TransportHints().tcpNoDelay();
  subscribers_ = {
      nh.subscribe("muscle_states", 1, &TendonDisplay::see_muscles, this, no_delay),
      nh.subscribe("joint_states", 100, &TendonDisplay::see_joints, this, no_delay),
      nh.subscribe("spherical_joint_states", 100, &TendonDisplay::see_ball_joints, this, no_delay),
  };
  timer_ = nh.createWallTimer(ros::WallDuration(kDrawingPeriod),
                              [this](const ros::WallTimerEvent&) { draw(); });
}

void TendonDisplay::see_muscles(const anthrob_msgs::MuscleStates& message) {
  forces_stamp_ = message.header.stamp;
  std::fill(forces_.begin(), forces_.end(), kNotMeasured);
  for (std::size_t i = 0; i < std::min(message.name.size(), message.force.size()); ++i) {
    const int muscle = sim_.model().find_muscle(message.name[i]);
    if (muscle >= 0) forces_[static_cast<std::size_t>(muscle)] = message.force[i];
  }
}

void TendonDisplay::see_joints(const sensor_msgs::JointState& message) {
  for (std::size_t i = 0; i < std::min(message.name.size(), message.position.size()); ++i) {
    see_joint(message.name[i], {message.position[i]}, message.header.stamp);
  }
}

void TendonDisplay::see_ball_joints(const anthrob_msgs::SphericalJointStates& message) {
  for (std::size_t i = 0; i < std::min(message.name.size(), message.orientation.size()); ++i) {
    const auto& o = message.orientation[i];
    const double norm = std::sqrt(o.w * o.w + o.x * o.x + o.y * o.y + o.z * o.z);
    if (!(norm > 0.5 && norm < 2.0)) continue;
    see_joint(message.name[i], {o.w / norm, o.x / norm, o.y / norm, o.z / norm},
              message.header.stamp);
  }
}

void TendonDisplay::see_joint(const std::string& name, const std::vector<double>& position,
                              const ros::Time& stamp) {
  const int index = sim_.model().skeleton->find_joint(name);
  if (index < 0) return;  // a robot may carry more than the model
  const JointModel& joint = sim_.model().skeleton->joints[index];
  const bool fits = static_cast<int>(position.size()) == joint.position_size() &&
                    std::all_of(position.begin(), position.end(),
                                [](double value) { return std::isfinite(value); });
  if (!fits) return;
  std::copy(position.begin(), position.end(), q_.begin() + joint.position_offset);
  stamps_[index] = stamp;
}

std::optional<std::string> TendonDisplay::missing(const ros::Time& now) const {
  for (std::size_t j = 0; j < stamps_.size(); ++j) {
    if (!is_fresh(stamps_[j], now)) return sim_.model().skeleton->joints[j].name;
  }
  return std::nullopt;
}

void TendonDisplay::draw() {
  const ros::Time now = ros::Time::now();
  if (now.isZero()) return clock_wait_.look();
  const std::optional<std::string> joint = missing(now);
  if (!joint || whole_.isZero() || whole_ > now) whole_ = now;
  if (joint) {
    // Where a bag begins, or a robot, not all topics are there at once.
    if ((now - whole_).toSec() <= kStaleAfter) return;
    ROS_WARN_STREAM_THROTTLE(10.0, "tendons are not drawn: joint " << *joint << " is not measured");
    return;
  }
  try {
    // Where motors stand says nothing of where tendons run.
    sim_.place(q_, std::vector<double>(sim_.muscle_count(), 0.0));
  } catch (const BadInput& error) {
    ROS_WARN_STREAM_THROTTLE(10.0, "tendons are not drawn: " << error.what());
    return;
  }
  if (!is_fresh(forces_stamp_, now)) std::fill(forces_.begin(), forces_.end(), kNotMeasured);
  const ros::Time oldest =
      stamps_.empty() ? now : *std::min_element(stamps_.begin(), stamps_.end());
  visualization_msgs::MarkerArray markers = muscle_markers(sim_, forces_, oldest);
  for (auto& marker : markers.markers) marker.lifetime = ros::Duration(kStaleAfter);
  paths_.publish(markers);
  if (transforms_) transforms_->sendTransform(ball_joint_transforms(sim_, oldest));
  if (tendon_paths_.getNumSubscribers() > 0) {
    tendon_paths_.publish(tendon_paths(sim_, forces_, kSlackForce, oldest));
  }
  if (solved_paths_.getNumSubscribers() > 0) tell(oldest);
  if (moment_arms_.getNumSubscribers() > 0) moment_arms_.publish(moment_arms(sim_, oldest));
}

void TendonDisplay::tell(const ros::Time& stamp) {
  anthrob_msgs::MusclePaths paths = solved_paths(sim_, stamp);
  // What the simulation has to say of a robot at rest with motors at zero is not of this one.
  for (std::size_t m = 0; m < paths.muscles.size(); ++m) {
    anthrob_msgs::MusclePath& path = paths.muscles[m];
    path.velocity = path.spring_expansion = kNotMeasured;
    path.slack = forces_[m] < kSlackForce;
    for (auto& contact : path.contacts) contact.tension_in = contact.tension_out = kNotMeasured;
  }
  solved_paths_.publish(paths);
}

}  // namespace anthrob
