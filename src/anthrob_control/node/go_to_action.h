#pragma once

#include <actionlib/server/simple_action_server.h>
#include <anthrob_msgs/GoToAction.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace anthrob {

/// The action go_to around a controller: feedback on the way, an answer when the arm is there or
/// cannot get there, and a cancel that holds the arm where it is.
class GoToAction {
 public:
  struct Controller {
    /// Sends the arm. @return the posture, or why it does not go
    std::function<std::optional<std::string>(const anthrob_msgs::GoToGoal& goal,
                                             std::vector<double>& posture)>
        send;
    /// Holds the arm where it is.
    std::function<void()> hold;
    /// From a posture to the measured one, the largest of all joints [rad; m times ten].
    std::function<double(const std::vector<double>& posture)> distance;
  };

  GoToAction(const ros::NodeHandle& nh, Controller controller);

  /// Once a control period.
  /// @param dt since the last one [s]   @param obstacle why the arm does not go on, if it does not
  void update(double dt, const std::optional<std::string>& obstacle);
  /// The arm was sent elsewhere, by another request.
  void superseded();

 private:
  void on_goal();
  void on_cancel();
  void end(bool success, const std::string& message, double error);
  void give_feedback(double dt, double error);

  Controller controller_;
  actionlib::SimpleActionServer<anthrob_msgs::GoToAction> server_;
  std::vector<double> posture_;
  double left_ = 0.0;    ///< of the planned motion [s]; negative: since its end
  double silent_ = 0.0;  ///< since the last feedback [s]
};

}  // namespace anthrob
