#pragma once

#include <anthrob_msgs/ApplyWrench.h>
#include <interactive_markers/interactive_marker_server.h>
#include <ros/ros.h>

#include <map>
#include <optional>
#include <string>

#include "posture_input.h"
#include "touch/drag.h"
#include "touch/pull_spring.h"

namespace anthrob {

/// Links that the mouse pulls in RViz, in the simulator: interactive markers, and sim/apply_wrench.
class LinkPulls {
 public:
  /// @param skeleton, input must outlive it
  LinkPulls(ros::NodeHandle& nh, const Skeleton& skeleton, const PostureInput& input,
            const PullSpring& spring);

  /// With every new posture: renews the forces.
  void renew();
  /// Some times a second: ends what nobody holds, and looks whether the robot can be pushed.
  void look();

 private:
  /// A link, held by a window's mouse.
  struct Held {
    std::size_t link;
    Vec3 marker_L;  ///< the marker's position when it was grabbed
    Drag drag;
  };
  using Feedback = visualization_msgs::InteractiveMarkerFeedback;

  void hear(const Feedback& feedback);
  void grab(std::size_t link, const Feedback& feedback);
  void move(Held& held, const Feedback& feedback);
  void renew(const Held& held);
  void release(const std::string& link);
  bool apply(const SkeletonLink& link, const Vec3& point_L, const Vec3& force_W, double duration);
  void survey();
  void offer();
  void withdraw();

  ros::NodeHandle nh_;
  const Skeleton& skeleton_;
  const PostureInput& input_;
  PullSpring spring_;
  interactive_markers::InteractiveMarkerServer server_;
  ros::Publisher arrows_;
  ros::ServiceClient apply_wrench_;
  std::map<std::string, Held> held_;  ///< by link
  bool offered_ = false;
  bool told_ = false;  ///< that there is nothing to push
  double begun_, next_survey_ = 0.0;
  double renewed_ = 0.0;  ///< [s] of the robot's time
  RenewalPeriod period_;
  double drawn_ = 0.0;
};

}  // namespace anthrob
