#pragma once

#include <interactive_markers/interactive_marker_server.h>
#include <interactive_markers/menu_handler.h>
#include <ros/ros.h>

#include <optional>
#include <string>

#include "posture_input.h"
#include "timed_calls.h"
#include "touch/goal_posture.h"

namespace anthrob {

/// Rings and arrows in RViz that turn and shift the joints of a ghost; a menu sends the arm there,
/// by controller/go_to.
class PostureGoals {
 public:
  /// @param skeleton, input must outlive it
  PostureGoals(ros::NodeHandle& nh, const Skeleton& skeleton, const PostureInput& input);

  /// Some times a second: draws the ghost, and looks whether a controller is there.
  void look();

 private:
  using Feedback = visualization_msgs::InteractiveMarkerFeedback;
  enum class Phase { kPlanning, kAsking, kGoing, kRefused };

  void hear(const Feedback& feedback);
  void send();
  void forget();
  void hear_answers(double now);
  void follow(double now);
  void move_handles();
  void draw_ghost();
  std::string remark() const;
  void survey(double now);
  void offer();
  void withdraw();

  ros::NodeHandle nh_;
  const Skeleton& skeleton_;
  const PostureInput& input_;
  GoalPosture goal_;
  Phase phase_ = Phase::kPlanning;
  std::string answer_;
  TimedCalls calls_;
  interactive_markers::InteractiveMarkerServer server_;
  interactive_markers::MenuHandler menu_;
  ros::Publisher ghost_;
  std::optional<std::size_t> dragged_;  ///< the link whose handle the mouse holds
  bool offered_ = false;
  double next_survey_ = 0.0, next_picture_ = 0.0;
  double end_of_way_ = 0.0;  ///< when the arm should have arrived
};

}  // namespace anthrob
