#pragma once

#include <actionlib/server/action_server.h>
#include <ros/ros.h>

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "jobs/job.h"

namespace anthrob {

/// One action, whose goals are refused while one is at work: actionlib's simple server would end
/// that for the new one.
template <class Action>
class JobServer {
 public:
  using Goal = typename Action::_action_goal_type::_goal_type;
  /// @throws BadInput for a goal that is to be refused
  using Reader = std::function<jobs::JobCommand(const Goal&)>;

  JobServer(const ros::NodeHandle& nh, const std::string& name, Reader read)
      : name_(name),
        read_(std::move(read)),
        server_(
            nh, name, [this](Handle handle) { on_goal(std::move(handle)); },
            [this](const Handle& handle) { on_cancel(handle); }, false) {
    server_.start();
    timer_ = ros::NodeHandle(nh).createWallTimer(ros::WallDuration(kPeriod),
                                                 [this](const ros::WallTimerEvent&) { look(); });
  }

 private:
  /// [s] of wall time between two looks at a job, and two feedbacks.
  static constexpr double kPeriod = 0.25;

  using Server = actionlib::ActionServer<Action>;
  using Handle = typename Server::GoalHandle;
  using Result = typename Action::_action_result_type::_result_type;
  using Feedback = typename Action::_action_feedback_type::_feedback_type;

  static Result result_of(const jobs::JobResult& from) {
    Result result;
    result.success = from.success;
    result.headline = from.headline;
    result.files = from.files;
    result.log = from.log;
    result.exit_code = from.exit_code;
    result.error = from.error;
    return result;
  }

  static Result failure(const std::string& line) {
    Result result;
    result.headline = result.error = line;
    return result;
  }

  void on_goal(Handle handle) {
    if (job_) {
      refuse(handle, "busy with goal " + handle_.getGoalID().id + ", which writes into " + out_ +
                         ": cancel it first, or wait");
      return;
    }
    try {
      const jobs::JobCommand command = read_(*handle.getGoal());
      job_.emplace(command);
      out_ = command.out;
    } catch (const std::exception& error) {
      refuse(handle, error.what());
      return;
    }
    handle_ = handle;
    handle_.setAccepted();
    ROS_INFO_STREAM(name_ << ": process " << job_->pid() << " writes into " << out_);
  }

  void refuse(Handle& handle, const std::string& why) {
    const std::string line = name_ + ": refused: " + why;
    ROS_WARN_STREAM(line);
    handle.setRejected(failure(line), line);
  }

  void on_cancel(const Handle& handle) {
    if (!job_ || handle != handle_) return;
    ROS_INFO_STREAM(name_ << ": cancelled");
    job_->interrupt();
  }

  void look() {
    if (!job_) return;
    if (end_) {
      const jobs::JobResult end = *end_;
      end_.reset();
      job_.reset();
      finish(end);
      return;
    }
    end_ = job_->update();
    jobs::JobProgress progress = job_->progress();
    if (end_ && end_->success) {
      progress.stage = "done";
      progress.share = 1.0;
      progress.seconds_left = 0.0;
    }
    // Clients hear no feedback after the result, so that comes at the next look.
    publish(progress);
  }

  void finish(const jobs::JobResult& end) {
    ROS_INFO_STREAM(name_ << ": " << end.headline);
    const Result result = result_of(end);
    if (end.success) {
      handle_.setSucceeded(result, end.headline);
    } else if (end.interrupted) {
      handle_.setCanceled(result, end.headline);
    } else {
      handle_.setAborted(result, end.headline);
    }
  }

  void publish(const jobs::JobProgress& progress) {
    Feedback feedback;
    feedback.stage = progress.stage;
    feedback.share = progress.share;
    feedback.seconds_left =
        progress.seconds_left.value_or(std::numeric_limits<double>::quiet_NaN());
    feedback.best = progress.best;
    handle_.publishFeedback(feedback);
  }

  std::string name_, out_;
  Reader read_;
  std::optional<jobs::Job> job_;
  std::optional<jobs::JobResult> end_;  ///< of the job, until it is told
  Handle handle_;                       ///< of the job
  Server server_;
  ros::WallTimer timer_;
};

}  // namespace anthrob
