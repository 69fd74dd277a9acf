#include "external_pushes.h"

#include <anthrob_msgs/ExternalWrenches.h>

#include <cmath>

#include "anthrob_core/nearest_name.h"
#include "anthrob_ros/bounded_connection.h"
#include "anthrob_sim/core/errors.h"

namespace anthrob {

namespace {

template <class M>
Vec3 vector_of(const M& message) {
  return {message.x, message.y, message.z};
}

template <class M>
M message_of(const Vec3& vector) {
  M message;
  message.x = vector.x();
  message.y = vector.y();
  message.z = vector.z();
  return message;
}

/// @throws BadInput
Wrench wrench_of(const anthrob_msgs::ApplyWrench::Request& request, const Simulation& sim) {
  const SkeletonModel& skeleton = *sim.model().skeleton;
  Wrench wrench;
  wrench.frame = skeleton.find_frame(request.link);
  if (wrench.frame < 0) {
    std::vector<std::string> names;
    for (const FrameModel& frame : skeleton.frames) names.push_back(frame.name);
    throw BadInput("link '" + request.link + "': unknown" + expected_names(request.link, names));
  }
  if (request.duration < ros::Duration(0))
    throw BadInput("duration: expected zero or more, in seconds of simulated time");
  wrench.point = vector_of(request.point);
  wrench.force = vector_of(request.force);
  wrench.torque = vector_of(request.torque);
  wrench.steps_left =
      static_cast<std::uint64_t>(std::ceil(request.duration.toSec() / sim.step_length() - 1e-6));
  return wrench;
}

}  // namespace

ExternalPushes::ExternalPushes(ros::NodeHandle& nh, Simulation& sim)
    : sim_(sim),
      publisher_(nh.advertise<anthrob_msgs::ExternalWrenches>("external_wrenches", 100)),
      service_(advertise_bounded<anthrob_msgs::ApplyWrench>(
          nh, "sim/apply_wrench",
          [this](auto& request, auto& response) { return on_apply(request, response); })) {}

bool ExternalPushes::on_apply(anthrob_msgs::ApplyWrench::Request& request,
                              anthrob_msgs::ApplyWrench::Response& response) {
  try {
    const Wrench wrench = wrench_of(request, sim_);
    sim_.external_wrenches().push(wrench);
    response.success = true;
    response.message = wrench.steps_left > 0 ? "pushes from the next step on" : "ended";
  } catch (const BadInput& error) {
    response.message = error.what();
  }
  return true;
}

void ExternalPushes::publish(const ros::Time& stamp) {
  const std::vector<Wrench>& acting = sim_.external_wrenches().acting();
  if (acting.empty() && !acted_) return;
  acted_ = !acting.empty();
  const SkeletonModel& skeleton = *sim_.model().skeleton;
  anthrob_msgs::ExternalWrenches all;
  all.header.stamp = stamp;
  all.header.frame_id = skeleton.bodies[0].name;
  for (const Wrench& wrench : acting) {
    all.link.push_back(skeleton.frames[wrench.frame].name);
    all.point.push_back(message_of<geometry_msgs::Point>(wrench.point));
    geometry_msgs::Wrench pushing;
    pushing.force = message_of<geometry_msgs::Vector3>(wrench.force);
    pushing.torque = message_of<geometry_msgs::Vector3>(wrench.torque);
    all.wrench.push_back(pushing);
    all.left.emplace_back(static_cast<double>(wrench.steps_left) * sim_.step_length());
  }
  publisher_.publish(all);
}

}  // namespace anthrob
