#include "ros/ros_connection.h"

#include <actionlib_msgs/GoalID.h>
#include <anthrob_msgs/CalibrateActionFeedback.h>
#include <anthrob_msgs/CalibrateActionResult.h>
#include <anthrob_msgs/DiscoverActionFeedback.h>
#include <anthrob_msgs/DiscoverActionResult.h>
#include <anthrob_msgs/Gap.h>
#include <anthrob_msgs/Health.h>
#include <anthrob_msgs/HealthTestActionFeedback.h>
#include <anthrob_msgs/HealthTestActionResult.h>
#include <anthrob_msgs/MomentArms.h>
#include <anthrob_msgs/MuscleCommand.h>
#include <anthrob_msgs/PlayerState.h>
#include <ros/service.h>
#include <std_msgs/Empty.h>

#include <mutex>
#include <utility>

#include "anthrob_core/monotonic_clock.h"
#include "anthrob_ros/bounded_connection.h"
#include "ros/gains_tool.h"
#include "ros/messages.h"
#include "ros/service_calls.h"

namespace anthrob {
namespace {

constexpr double kSurveyPeriod = 2.0;  // [s] between two questions to the master
const char* const kSurvey = "survey";  // among the calls; no service has that name

ReferenceLimits limits_at(const std::string& robot) {
  ReferenceLimits limits;
  for (const ControlMode mode : kControlModes) {
    double limit = 0.0;
    if (ros::param::get(robot + "/command_limits/" + limit_key(mode), limit)) {
      limits.set(mode, limit);
    }
  }
  return limits;
}

}  // namespace

struct RosConnection::Surroundings {
  mutable std::mutex mutex;
  bool simulated = false;
  ReferenceLimits limits;

  void ask(const std::string& robot) {
    const bool sim = ros::service::exists(robot + "/sim/pause", false);
    const ReferenceLimits found = limits_at(robot);
    const std::lock_guard<std::mutex> lock(mutex);
    simulated = sim;
    limits = found;
  }
};

RosConnection::RosConnection(Role role)
    : role_(role), surroundings_(std::make_shared<Surroundings>()) {}

void RosConnection::connect(const std::string& robot) {
  subscribers_.clear();
  commands_.shutdown();
  stop_.shutdown();
  cancels_.clear();
  queue_.clear();
  news_ = {};
  calls_ = {};
  surroundings_ = std::make_shared<Surroundings>();
  next_survey_ = 0.0;
  nh_ = ros::NodeHandle(robot);
  nh_.setCallbackQueue(&queue_);
  subscribe();
  if (role_ == Role::kCommander) {
    commands_ = nh_.advertise<anthrob_msgs::MuscleCommand>("muscle_command", 1);
  } else {
    stop_ = nh_.advertise<std_msgs::Empty>("emergency_stop", 1);
  }
}

void RosConnection::subscribe() {
  // Of the states only the newest counts; of diagnostics each message tells of something else.
  subscribers_.push_back(subscribe_bounded<anthrob_msgs::MuscleStates>(
      nh_, "muscle_states", 1,
      [this](const anthrob_msgs::MuscleStates& message, const std::string&) {
        hear_muscles(message);
      },
      {}, ros::TransportHints().tcpNoDelay()));
  subscribers_.push_back(subscribe_bounded<anthrob_msgs::PlayerState>(
      nh_, "player/state", 1, [this](const anthrob_msgs::PlayerState& message, const std::string&) {
        news_.player = reading_of(message);
      }));
  subscribers_.push_back(subscribe_bounded<anthrob_msgs::Gap>(
      nh_, "gap", 1, [this](const anthrob_msgs::Gap& message, const std::string&) {
        if (auto gap = reading_of(message)) news_.gap = std::move(gap);
      }));
  subscribe_job<anthrob_msgs::CalibrateActionFeedback, anthrob_msgs::CalibrateActionResult>(
      "calibrate");
  subscribe_job<anthrob_msgs::DiscoverActionFeedback, anthrob_msgs::DiscoverActionResult>(
      "discover");
  subscribe_job<anthrob_msgs::HealthTestActionFeedback, anthrob_msgs::HealthTestActionResult>(
      "health/test");
  subscribers_.push_back(subscribe_bounded<anthrob_msgs::Health>(
      nh_, "health", 1, [this](const anthrob_msgs::Health& message, const std::string&) {
        news_.health = HealthReading{message.headline, message.warning};
      }));
  arms_ = subscribe_bounded<anthrob_msgs::MomentArms>(
      nh_, "moment_arms", 1,
      [this](const anthrob_msgs::MomentArms& message, const std::string&) { hear_arms(message); });
  subscribers_.push_back(subscribe_bounded<diagnostic_msgs::DiagnosticArray>(
      nh_, "/diagnostics", 20,
      [this](const diagnostic_msgs::DiagnosticArray& message, const std::string&) {
        hear_diagnostics(message);
      }));
}

template <class Feedback, class Result>
void RosConnection::subscribe_job(const std::string& job) {
  subscribers_.push_back(subscribe_bounded<Feedback>(
      nh_, job + "/feedback", 10, [this, job](const Feedback& message, const std::string&) {
        const auto& feedback = message.feedback;
        news_.jobs.push_back(
            {job, true, feedback.stage, feedback.best, feedback.share, feedback.seconds_left});
      }));
  subscribers_.push_back(subscribe_bounded<Result>(
      nh_, job + "/result", 10, [this, job](const Result& message, const std::string&) {
        news_.jobs.push_back({job,
                              false,
                              {},
                              {},
                              1.0,
                              0.0,
                              message.result.headline,
                              static_cast<bool>(message.result.success)});
      }));
  cancels_[job] = nh_.advertise<actionlib_msgs::GoalID>(job + "/cancel", 1);
}

/// One message says enough, and each costs its sender time.
void RosConnection::hear_arms(const anthrob_msgs::MomentArms& message) {
  news_.antagonists = groups_by_axis(message.muscle, message.axis, message.arm);
  arms_.shutdown();
}

void RosConnection::hear_muscles(const anthrob_msgs::MuscleStates& message) {
  if (auto readings = readings_of(message)) news_.muscles = std::move(readings);
}

void RosConnection::hear_diagnostics(const diagnostic_msgs::DiagnosticArray& message) {
  for (const auto& status : message.status) news_.diagnostics.push_back(diagnosis_of(status));
}

News RosConnection::look() {
  const double now = monotonic_now();
  survey(now);
  queue_.callAvailable();
  for (CallResult& answer : calls_.finished(now)) {
    if (answer.service != kSurvey) news_.answers.push_back(std::move(answer));
  }
  return std::exchange(news_, {});
}

void RosConnection::survey(double now) {
  if (now < next_survey_) return;
  next_survey_ = now + kSurveyPeriod;
  // Without end: while the master does not answer there is one such thread, not one every 2 s.
  constexpr double kNever = 1e9;
  calls_.start(
      kSurvey,
      [surroundings = surroundings_, robot = nh_.getNamespace()] {
        surroundings->ask(robot);
        return CallResult{kSurvey, true, {}};
      },
      kNever, now);
}

void RosConnection::send(const std::vector<Reference>& references) {
  anthrob_msgs::MuscleCommand command = command_of(references);
  // Zero, which counts as no stamp, while simulated time has not begun.
  command.header.stamp = ros::Time::now();
  commands_.publish(command);
}

bool RosConnection::call(const ServiceRequest& request) {
  if (request.service == "save_gains") {
    return calls_.start(request.service, call_of_gains_tool(nh_.getNamespace(), request.name),
                        request.limit, monotonic_now());
  }
  return calls_.start(request.service, call_of(nh_.resolveName(request.service), request),
                      request.limit, monotonic_now());
}

void RosConnection::shout_stop() {
  if (stop_) stop_.publish(std_msgs::Empty());
}

void RosConnection::cancel(const std::string& job) {
  const auto publisher = cancels_.find(job);
  if (publisher != cancels_.end()) publisher->second.publish(actionlib_msgs::GoalID());  // all
}

bool RosConnection::simulated() const {
  const std::lock_guard<std::mutex> lock(surroundings_->mutex);
  return surroundings_->simulated;
}

std::string default_robot() {
  const std::string& own = ros::this_node::getNamespace();
  return own == "/" ? "anthrob" : own.substr(1);
}

ReferenceLimits RosConnection::limits() const {
  const std::lock_guard<std::mutex> lock(surroundings_->mutex);
  return surroundings_->limits;
}

}  // namespace anthrob
