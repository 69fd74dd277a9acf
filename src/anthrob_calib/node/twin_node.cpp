#include "twin_node.h"

#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/TransformStamped.h>
#include <ros/callback_queue.h>

#include <algorithm>
#include <cmath>

#include "anthrob_core/text.h"
#include "anthrob_ros/diagnostics.h"
#include "anthrob_sim/conversions.h"
#include "other_model.h"
#include "prediction.h"
#include "twin_messages.h"

namespace anthrob {

namespace {

constexpr std::uint32_t kQueue = 5000;      // messages; a start may take a second on a large robot
constexpr double kListening = 0.01;         // [s] of wall time between two looks at the queue
constexpr double kGhostRate = 25.0;         // [Hz of measured time] what eyes see
constexpr double kTooLate = 1.0;            // [s] behind the present
constexpr double kSilence = 2.0;            // [s] of wall time after which the robot is silent
constexpr double kDiagnosticsPeriod = 1.0;  // [s] of wall time
const std::string kPrefix = "twin/";

ros::Time time_of(Nanoseconds stamp) {
  ros::Time time;
  time.fromNSec(static_cast<std::uint64_t>(std::max<Nanoseconds>(stamp, 0)));
  return time;
}

geometry_msgs::Transform transform_of(const Pose& pose) {
  geometry_msgs::Transform transform;
  const Quat turn(pose.R);
  transform.translation.x = pose.p.x();
  transform.translation.y = pose.p.y();
  transform.translation.z = pose.p.z();
  transform.rotation.w = turn.w(), transform.rotation.x = turn.x();
  transform.rotation.y = turn.y(), transform.rotation.z = turn.z();
  return transform;
}

/// "1.3 floors"
std::string in_floors(double gap) {
  return std::isfinite(gap) ? significant(gap, gap < 10.0 ? 2 : 3) + " floors" : "not compared yet";
}

}  // namespace

TwinNode::TwinNode(std::shared_ptr<const RobotModel> model, const Options& options,
                   ros::NodeHandle nh)
    : options_(options), nh_(nh) {
  begin_with(*model);
  muscles_ = nh_.advertise<anthrob_msgs::MuscleStates>(kPrefix + "muscle_states", 10);
  joints_ = nh_.advertise<sensor_msgs::JointState>(kPrefix + "joint_states", 10);
  balls_ =
      nh_.advertise<anthrob_msgs::SphericalJointStates>(kPrefix + "spherical_joint_states", 10);
  gap_ = nh_.advertise<anthrob_msgs::Gap>("gap", 10);
  diagnostics_ = nh_.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 10);
  using anthrob_msgs::MuscleStates;
  using anthrob_msgs::SphericalJointStates;
  using sensor_msgs::JointState;
  using twin::Topic;
  subscribers_ = {
      nh_.subscribe<MuscleStates>(
          "muscle_states", kQueue,
          [this](const MuscleStates::ConstPtr& m) { hear(*m, Topic::kMuscles); }),
      nh_.subscribe<JointState>(
          "joint_states", kQueue,
          [this](const JointState::ConstPtr& m) { hear(*m, Topic::kJoints); }),
      nh_.subscribe<SphericalJointStates>(
          "spherical_joint_states", kQueue,
          [this](const SphericalJointStates::ConstPtr& m) { hear(*m, Topic::kBallJoints); }),
      nh_.subscribe<anthrob_msgs::ExternalWrenches>(
          "external_wrenches", kQueue,
          [this](const anthrob_msgs::ExternalWrenches::ConstPtr& m) { hear_pushes(*m); }),
  };
  using anthrob_msgs::Predict;
  using anthrob_msgs::TakeModel;
  services_ = {
      nh_.advertiseService<Predict::Request, Predict::Response>(
          "predict",
          [this](const Predict::Request& request, Predict::Response& response) {
            response = predict(*twins_, request);
            return true;
          }),
      nh_.advertiseService<TakeModel::Request, TakeModel::Response>(
          kPrefix + "take_model",
          [this](const TakeModel::Request& request, TakeModel::Response& response) {
            return serve_take_model(request, response);
          }),
  };
  timer_ = nh_.createWallTimer(ros::WallDuration(kDiagnosticsPeriod),
                               [this](const ros::WallTimerEvent&) { publish_diagnostics(); });
}

void TwinNode::begin_with(const RobotModel& model) {
  twin::Floors floors;
  if (!options_.floors.empty()) {
    floors = twin::load_floors(options_.floors, twin::Channels(model, options_.twins));
  }
  auto twins = std::make_unique<twin::Twins>(model, options_.twins, floors);
  reader_ = std::make_unique<SampleReader>(twins->model());
  watch_ = std::make_unique<twin::GapWatch>(options_.twins.warn);
  twins_ = std::move(twins);
  next_states_ = next_ghost_ = 0;
  starts_ = 0;
}

bool TwinNode::serve_take_model(const anthrob_msgs::TakeModel::Request& request,
                                anthrob_msgs::TakeModel::Response& response) {
  try {
    begin_with(*other_model(request.model, twins_->model()));
    ROS_INFO_STREAM("the twin takes over " << twins_->model().file);
    response.success = true;
  } catch (const BadInput& error) {
    response.message = error.what();
  }
  return true;
}

void TwinNode::run() {
  // Messages come one by one, and waking up for each costs more than to read it.
  while (ros::ok()) {
    ros::WallDuration(kListening).sleep();
    ros::getGlobalCallbackQueue()->callAvailable();
  }
}

template <class Message>
void TwinNode::hear(const Message& message, twin::Topic topic) {
  const auto* sample = reader_->read(message);
  if (sample == nullptr) {
    ++malformed_;
    return;
  }
  heard_ = ros::WallTime::now();
  take(*sample, topic);
  advance();
}

void TwinNode::hear_pushes(const anthrob_msgs::ExternalWrenches& message) {
  const auto pushes = reader_->read(message);
  if (pushes) {
    twins_->hear(*pushes);
  } else {
    ++malformed_;
  }
}

void TwinNode::advance() {
  while (twins_->advance()) {
    watch_->see(twins_->channels(), twins_->report());
    publish_gap();
  }
  tell_starts();
  publish_states();
}

void TwinNode::tell_starts() {
  const twin::Twins::Status& shown = twins_->status(options_.feed);
  if (shown.starts > starts_ && starts_ > 0) {
    ROS_WARN_STREAM("the twin lost the robot, and has started anew: " << shown.why);
  }
  starts_ = shown.starts;
}

void TwinNode::publish_states() {
  const auto now = twins_->time();
  if (!now || !twins_->status(options_.feed).in_step) {
    next_states_ = next_ghost_ = 0;
    return;
  }
  const Simulation& sim = twins_->sim(options_.feed);
  const ros::Time stamp = time_of(*now);
  if (*now >= next_states_) {
    next_states_ = *now + twin::nanoseconds(1.0 / options_.rate);
    const bool imposed =
        options_.feed == twin::Feed::kPositions || options_.feed == twin::Feed::kPostures;
    muscles_.publish(twin_muscle_states(sim, imposed, stamp));
    joints_.publish(joint_states(sim, stamp));
    balls_.publish(spherical_joint_states(sim, stamp));
  }
  if (*now >= next_ghost_) {
    next_ghost_ = *now + twin::nanoseconds(1.0 / kGhostRate);
    publish_ghost(stamp);
  }
}

void TwinNode::publish_ghost(const ros::Time& stamp) {
  const Simulation& sim = twins_->sim(options_.feed);
  const SkeletonModel& skeleton = *sim.model().skeleton;
  std::vector<geometry_msgs::TransformStamped> transforms;
  for (std::size_t f = 0; f < skeleton.frames.size(); ++f) {
    geometry_msgs::TransformStamped transform;
    transform.header.stamp = stamp;
    transform.header.frame_id = skeleton.bodies[0].name;
    transform.child_frame_id = kPrefix + skeleton.frames[f].name;
    transform.transform = transform_of(sim.link_pose(static_cast<int>(f)));
    transforms.push_back(transform);
  }
  transforms_.sendTransform(transforms);
}

void TwinNode::publish_gap() {
  const twin::GapReport& report = twins_->report();
  anthrob_msgs::Gap gap;
  gap.header.stamp = time_of(report.stamp);
  gap.header.frame_id = twins_->model().skeleton->bodies[0].name;
  gap.window.assign(std::begin(twin::kWindowBlocks), std::end(twin::kWindowBlocks));
  for (double& window : gap.window) window *= options_.twins.bin * options_.twins.bins_in_block;
  for (const twin::Channel& channel : twins_->channels().all) {
    gap.channel.push_back(channel.name);
    gap.unit.push_back(channel.unit);
  }
  gap.feed.assign(twin::kFeedNames.begin(), twin::kFeedNames.end());
  gap.floor = report.floor;
  gap.rms = report.rms;
  gap.gap = report.gap;
  gap_.publish(gap);
}

diagnostic_msgs::DiagnosticStatus TwinNode::own_status() const {
  using diagnostic_msgs::DiagnosticStatus;
  DiagnosticStatus status;
  status.name = nh_.getNamespace() + ": twin";
  status.hardware_id = twins_->model().file;
  const auto now = twins_->time();
  std::vector<std::string> lost;
  for (const twin::Feed feed : twin::kFeeds) {
    const twin::Twins::Status& twin = twins_->status(feed);
    const std::string name = twin::kFeedNames[static_cast<std::size_t>(feed)];
    if (!twin.in_step) lost.push_back(name + ": " + twin.why);
    status.values.push_back(key_value(name, !twin.in_step ? "lost: " + twin.why
                                            : twin.counts ? "in step"
                                                          : "settling"));
    status.values.push_back(key_value(name + "_starts", std::to_string(twin.starts)));
  }
  const double behind = now ? ros::Time::now().toSec() - seconds(*now) : 0.0;
  const double silent = heard_.isZero() ? 0.0 : (ros::WallTime::now() - heard_).toSec();
  if (heard_.isZero()) {
    status.message = "waiting for a robot";
  } else if (!now) {
    status.message = "lost: " + twins_->status(options_.feed).why;
  } else if (!lost.empty()) {
    status.message = "lost: " + joined(lost);
  } else if (silent > kSilence) {
    // Of a robot that has ended, time goes on.
    status.message = std::string(behind > kTooLate ? "lost" : "stands still") +
                     ": nothing was measured for " + duration_text(silent);
  } else if (behind > kTooLate) {
    status.message = duration_text(behind) + " behind: this computer is too slow for the model";
  } else {
    status.message = twins_->status(options_.feed).counts ? "in step" : "settling";
  }
  const bool well = heard_.isZero() || (now && lost.empty() && behind <= kTooLate);
  status.level = well ? DiagnosticStatus::OK : DiagnosticStatus::WARN;
  status.values.push_back(key_value("behind", text(behind)));
  const bool was_lost = starts_ > 1;
  status.values.push_back(
      key_value("last_loss", was_lost ? twins_->status(options_.feed).why : ""));
  for (int t = 0; t < twin::kTopicCount; ++t) {
    const auto topic = static_cast<twin::Topic>(t);
    if (!twins_->measurements().needed(topic)) continue;
    const twin::Arrivals& arrivals = twins_->measurements().arrivals(topic);
    const std::string name = twin::kTopicNames[t];
    status.values.push_back(key_value(name, std::to_string(arrivals.heard)));
    status.values.push_back(key_value(name + "_late", std::to_string(arrivals.late)));
    status.values.push_back(key_value(name + "_repeated", std::to_string(arrivals.repeated)));
    status.values.push_back(key_value(name + "_incomplete", std::to_string(arrivals.incomplete)));
  }
  status.values.push_back(key_value("malformed", std::to_string(malformed_)));
  return status;
}

std::vector<diagnostic_msgs::DiagnosticStatus> TwinNode::gap_statuses() const {
  using diagnostic_msgs::DiagnosticStatus;
  std::vector<DiagnosticStatus> statuses;
  const twin::GapReport& report = twins_->report();
  const auto& channels = twins_->channels().all;
  std::vector<double> largest;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    if (statuses.empty() || channels[c].owner != channels[c - 1].owner) {
      DiagnosticStatus status;
      status.name = nh_.getNamespace() + ": twin: " + channels[c].owner;
      status.hardware_id = channels[c].owner;
      statuses.push_back(status);
      largest.push_back(twin::kNotMeasured);
    }
    for (const twin::Feed feed : twin::kFeeds) {
      largest.back() =
          std::fmax(largest.back(), report.gap[report.at(twin::kWarningWindow, c, feed)]);
    }
    statuses.back().message = in_floors(largest.back());
  }
  for (const twin::GapWatch::Warning& warning : watch_->warnings()) {
    for (DiagnosticStatus& status : statuses) {
      if (status.hardware_id != warning.finding.owner) continue;
      status.level = DiagnosticStatus::WARN;
      status.message = warning.text();
      status.values = {key_value("gap", text(warning.finding.gap)),
                       key_value("part", twin::words(warning.finding.part))};
    }
  }
  return statuses;
}

void TwinNode::publish_diagnostics() {
  diagnostic_msgs::DiagnosticArray array;
  array.header.stamp = ros::Time::now();
  array.status = gap_statuses();
  array.status.insert(array.status.begin(), own_status());
  diagnostics_.publish(array);
}

}  // namespace anthrob
