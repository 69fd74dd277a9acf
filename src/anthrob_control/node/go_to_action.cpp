#include "go_to_action.h"

#include <algorithm>
#include <limits>

#include "anthrob_ros/diagnostics.h"

namespace anthrob {

namespace {

constexpr double kThere = 0.05;          // [rad] three degrees: what friction may keep the arm from
constexpr double kSettling = 3.0;        // [s] after the planned motion, until springs are at rest
constexpr double kFeedbackPeriod = 0.1;  // [s]
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

}  // namespace

GoToAction::GoToAction(const ros::NodeHandle& nh, Controller controller)
    : controller_(std::move(controller)), server_(nh, "go_to", false) {
  server_.registerGoalCallback([this] { on_goal(); });
  server_.registerPreemptCallback([this] { on_cancel(); });
  server_.start();
}

void GoToAction::on_goal() {
  const auto goal = server_.acceptNewGoal();  // ends the one before
  if (const auto why = controller_.send(*goal, posture_)) return end(false, *why, kUnknown);
  left_ = goal->duration;
  silent_ = 0.0;
}

void GoToAction::on_cancel() {
  // A newer goal is no reason to stop in between.
  if (!server_.isActive() || server_.isNewGoalAvailable()) return;
  controller_.hold();
  anthrob_msgs::GoToResult result;
  result.message = "cancelled: the arm is held where it is";
  result.error = controller_.distance(posture_);
  server_.setPreempted(result, result.message);
}

void GoToAction::superseded() {
  if (server_.isActive())
    end(false, "the arm was sent elsewhere by another request", controller_.distance(posture_));
}

void GoToAction::update(double dt, const std::optional<std::string>& obstacle) {
  if (!server_.isActive()) return;
  if (obstacle) return end(false, *obstacle, kUnknown);
  left_ -= dt;
  const double error = controller_.distance(posture_);
  give_feedback(dt, error);
  if (left_ > 0.0) return;
  if (error <= kThere) {
    end(true, "there", error);
  } else if (left_ < -kSettling) {
    end(false, "the arm stands " + text(error) + " rad away from the posture", error);
  }
}

void GoToAction::give_feedback(double dt, double error) {
  silent_ += dt;
  if (silent_ < kFeedbackPeriod) return;
  silent_ = 0.0;
  anthrob_msgs::GoToFeedback feedback;
  feedback.time_left = std::max(0.0, left_);
  feedback.error = error;
  server_.publishFeedback(feedback);
}

void GoToAction::end(bool success, const std::string& message, double error) {
  anthrob_msgs::GoToResult result;
  result.success = success;
  result.message = message;
  result.error = error;
  if (success) {
    server_.setSucceeded(result, message);
  } else {
    server_.setAborted(result, message);
  }
}

}  // namespace anthrob
