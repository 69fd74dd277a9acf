#include "mocap_node.h"

#include <diagnostic_msgs/DiagnosticArray.h>

#include <algorithm>
#include <sstream>

#include "anthrob_core/errors.h"
#include "conversions.h"

namespace anthrob {
namespace mocap {

namespace {

constexpr double kRefusalPeriod = 1.0;  // [s] between two in the log
constexpr double kReportPeriod = 0.5;   // [s] a lost camera is known within a second
constexpr double kMarkerPeriod = 0.04;  // [s]
constexpr double kDebugPeriod = 0.1;    // [s]
constexpr double kGreeting = 5.0;       // [s] that a recording waits for a first subscriber,
constexpr double kOthers = 0.5;         // [s] then for further subscribers,
constexpr double kFarewell = 1.0;       // [s] and at its end until what is queued is sent

bool due(ros::WallTime& last, double period) {
  const ros::WallTime now = ros::WallTime::now();
  if ((now - last).toSec() < period) return false;
  last = now;
  return true;
}

}  // namespace

MocapNode::MocapNode(ros::NodeHandle nh, const StereoRig& rig, const TargetSet& set,
                     const std::optional<Setup>& setup, const Options& options)
    : nh_(nh),
      images_(nh, "mocap"),
      rig_(rig),
      set_(set),
      setup_(setup),
      options_(options),
      last_report_(ros::WallTime::now()),
      status_(nh.getNamespace() + ": mocap", rig, set, options.tracker, options.recorded),
      recording_(rig, matching_of(set, options.tracker)),
      pipeline_(tracking_stages(rig, set, options.tracker), options.mode, 4,
                [this](PacketPtr packet) { publish(static_cast<StereoFrame&>(*packet)); }) {
  advertise();
  publish_camera_frame();
}

MocapNode::~MocapNode() = default;

void MocapNode::advertise() {
  const std::uint32_t queue = options_.recorded ? 0 : 100;  // 0: without a limit
  joints_ = BallJointPublisher(nh_, "", queue);
  markers_ = images_.advertise<visualization_msgs::MarkerArray>("markers", 2);
  debug_ = images_.advertise<sensor_msgs::Image>("debug_image", 1);
  diagnostics_ = nh_.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 10);
  for (const MarkerTarget& target : set_.targets) {
    target_poses_.push_back(images_.advertise<geometry_msgs::PoseWithCovarianceStamped>(
        "targets/" + target.name, queue));
  }
  for (const BallJoint& joint : set_.joints) {
    joint_estimates_.push_back(images_.advertise<sensor_msgs::Imu>("joints/" + joint.name, queue));
  }
}

void MocapNode::publish_camera_frame() {
  if (!setup_) return;
  std_msgs::Header header;
  header.stamp = ros::Time::now();
  header.frame_id = setup_->camera_parent;
  static_transforms_.sendTransform(transform(setup_->X_PC, header, options_.camera_frame));
}

void MocapNode::run() {
  TopicInput input(
      images_, options_.sync_tolerance, [this](const TimedImage pair[2]) { on_pair(pair); },
      [this](const std::string& why) { refuse(why); });
  const ros::WallTimer timer = nh_.createWallTimer(
      ros::WallDuration(kReportPeriod), [&](const ros::WallTimerEvent&) { report_on(input); });
  ros::spin();
  pipeline_.drain();
}

/// Slow cameras are judged by three of their periods. Half a second must have passed by simulated
/// time, too: where it runs slowly pictures are rare, and while it stands still there is nothing to
/// see.
void MocapNode::report_on(TopicInput& input) {
  const ros::Time now = ros::Time::now();
  const bool simulated = ros::Time::isSimTime();
  const bool still = simulated && now == last_report_time_;
  last_report_time_ = now;
  if (last_asked_.isZero()) last_asked_ = now;
  const double passed = now.toSec() - last_asked_.toSec();
  const double needed = std::max(simulated ? kReportPeriod : 0.0, 3.0 * input.period());
  if (passed < 0.0 || passed >= needed) {
    last_asked_ = now;
    last_counts_ = input.take_counts();
    last_trouble_ = Pairing::complaint(last_counts_, input.tolerance());
  }
  publish_diagnostics(still ? std::nullopt : last_trouble_, last_counts_);
  last_counts_.lost = 0;  // told
}

void MocapNode::run(FrameSource& source) {
  if (options_.recorded) wait_for_listeners();
  last_report_ = ros::WallTime::now();
  bool ended = false;
  while (ros::ok() && !ended) {
    auto frame = std::make_unique<StereoFrame>();
    const FrameSource::Grab grab = source.next(*frame, 0.1);
    if (grab == FrameSource::Grab::kFrame) take(std::move(frame));
    ended = grab == FrameSource::Grab::kEnd;
    if ((ros::WallTime::now() - last_report_).toSec() > kReportPeriod) {
      publish_diagnostics(source.trouble(), source.take_counts());
    }
    ros::spinOnce();
  }
  pipeline_.drain();
  if (!ended) return;
  publish_diagnostics(source.trouble(), source.take_counts());
  if (!untold_.empty()) ROS_WARN_STREAM(untold_);
  if (options_.recorded && accepted_ == 0 && !last_refusal_.empty()) throw BadInput(last_refusal_);
  log_findings();
  ros::WallDuration(kFarewell).sleep();
}

/// What a whole recording shows; nobody may have looked at the diagnostics while it ran.
void MocapNode::log_findings() const {
  if (!options_.recorded) return;
  if (const auto contradiction = recording_.contradiction()) {
    ROS_ERROR_STREAM("no pose: " << *contradiction);
  } else if (const auto advice = recording_.advice()) {
    ROS_WARN_STREAM("no pose: " << *advice);
  } else if (const auto crowd = recording_.crowd()) {
    ROS_WARN_STREAM(*crowd);
  }
  if (const auto bend = recording_.bend()) ROS_WARN_STREAM(*bend);
  if (recording_.given_up() > 0) {
    ROS_WARN_STREAM(recording_.given_up() << " searches of a target reached step_limit");
  }
  if (recording_.poses() > 0) log_missing();
}

void MocapNode::log_missing() const {
  const std::vector<std::size_t> targets = recording_.unseen_targets();
  for (const std::size_t k : targets) {
    ROS_WARN_STREAM("target " << set_.targets[k].name << " was never seen");
  }
  for (const std::size_t j : recording_.unseen_joints()) {
    ROS_WARN_STREAM("joint " << set_.joints[j].name << " was never seen"
                             << (targets.empty() ? ": its targets never in the same pair" : ""));
  }
  for (const std::size_t j : recording_.joints_without_velocity()) {
    ROS_WARN_STREAM(
        "joint " << set_.joints[j].name << " was seen, but in the end never twice within "
                 << JointEstimator::kLongestGap << " s: not published without velocity");
  }
}

bool MocapNode::heard() const {
  const auto listened = [](const ros::Publisher& p) { return p.getNumSubscribers() > 0; };
  return joints_.heard() || std::any_of(target_poses_.begin(), target_poses_.end(), listened) ||
         std::any_of(joint_estimates_.begin(), joint_estimates_.end(), listened);
}

void MocapNode::wait_for_listeners() const {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(kGreeting);
  while (ros::ok() && !heard() && ros::WallTime::now() < end) ros::WallDuration(0.02).sleep();
  if (heard()) {
    ros::WallDuration(kOthers).sleep();
  } else if (ros::ok()) {
    const std::string topics = images_.getNamespace();
    ROS_WARN_STREAM("no subscriber to " << joints_.topic() << ", " << topics << "/targets/... or "
                                        << topics << "/joints/...: starting anyway; later "
                                        << "subscribers miss the beginning");
  }
}

void MocapNode::on_pair(const TimedImage pair[2]) {
  auto frame = std::make_unique<StereoFrame>();
  frame->t = pair[kLeft].t;
  frame->ns = pair[kLeft].ns;
  for (const Side side : {kLeft, kRight}) {
    frame->image[side] = pair[side].image;
    frame->owner[side] = pair[side].owner;
  }
  take(std::move(frame));
}

void MocapNode::take(std::unique_ptr<StereoFrame> frame) {
  frame->index = index_++;
  if (frame->fault) {
    refuse(*frame->fault);
    return;
  }
  try {
    check_size(*frame);
    check_stamp(*frame);
  } catch (const BadInput& error) {
    refuse(error.what());
    return;
  }
  ++accepted_;
  if (frame->ns == 0) frame->ns = 1;  // 0 means "the latest" to those who look transforms up
  pipeline_.push(std::move(frame));
}

void MocapNode::refuse(const std::string& why) {
  // The last one of a recording is told at its end, if not here: a bag's sums up.
  untold_ = why;
  if (due(last_told_, kRefusalPeriod)) {
    ROS_WARN_STREAM(why);
    untold_.clear();
  }
  last_refusal_ = why;
  status_.refuse(why);
}

void MocapNode::check_size(const StereoFrame& frame) const {
  for (const Side side : {kLeft, kRight}) {
    const ImageView& image = frame.image[side];
    if (image.width == rig_.width() && image.height == rig_.height()) continue;
    throw BadInput(std::string(name(side)) + " image: " + std::to_string(image.width) + "x" +
                   std::to_string(image.height) + " pixels: expected " +
                   std::to_string(rig_.width()) + "x" + std::to_string(rig_.height()) +
                   ", as calibrated");
  }
}

void MocapNode::check_stamp(const StereoFrame& frame) const {
  // ROS counts nanoseconds from 0 and seconds in 32 bits; the difference of two times must fit into
  // 31 bits.
  constexpr std::int64_t kSecond = 1000000000;
  const auto now = static_cast<std::int64_t>(ros::Time::now().toNSec());
  if (frame.ns >= 0 && frame.ns < (kSecond << 32) && frame.ns - now < (kSecond << 31)) return;
  std::ostringstream text;
  text << "left image: stamp " << std::fixed << frame.t << " s: expected the time of the exposure; "
       << "the current time is " << 1e-9 * static_cast<double>(now) << " s";
  throw BadInput(text.str());
}

void MocapNode::publish(const StereoFrame& frame) {
  std_msgs::Header header;
  header.stamp.fromNSec(static_cast<std::uint64_t>(frame.ns));
  header.frame_id = options_.camera_frame;
  const anthrob_msgs::SphericalJointStates states = spherical_joint_states(frame, set_, header);
  if (!states.name.empty()) joints_.publish(states);
  for (std::size_t j = 0; j < frame.joints.size(); ++j) {
    const JointEstimate& joint = frame.joints[j];
    if (joint.valid && joint.velocity_valid) {
      joint_estimates_[j].publish(joint_message(joint, joint_header(header.stamp, j)));
    }
  }
  for (std::size_t k = 0; k < frame.targets.size(); ++k) {
    if (frame.targets[k].valid) {
      target_poses_[k].publish(pose_message(frame.targets[k], header));
    }
  }
  publish_transforms(frame, header);
  publish_pictures(frame, header);
  status_.add(frame, ros::Time::now().toSec() - frame.t);
  if (options_.recorded) recording_.add(frame);
}

/// A joint's quantities are in its child's axes, wherever the camera is.
std_msgs::Header MocapNode::joint_header(const ros::Time& stamp, std::size_t joint) const {
  std_msgs::Header header;
  header.stamp = stamp;
  if (setup_) header.frame_id = setup_->joints[joint].child;
  return header;
}

void MocapNode::publish_transforms(const StereoFrame& frame, const std_msgs::Header& header) {
  std::vector<geometry_msgs::TransformStamped> messages;
  for (std::size_t k = 0; k < frame.targets.size(); ++k) {
    if (!frame.targets[k].valid) continue;
    messages.push_back(transform(frame.targets[k].X, header, "mocap/" + set_.targets[k].name));
  }
  for (std::size_t j = 0; j < frame.joints.size() && options_.joint_tf && setup_; ++j) {
    if (!frame.joints[j].valid) continue;
    const Setup::JointFrame& joint = setup_->joints[j];
    std_msgs::Header link = header;
    link.frame_id = joint.parent;
    messages.push_back(transform(joint.at(frame.joints[j].q), link, joint.child));
  }
  if (!messages.empty()) transforms_.sendTransform(messages);
}

void MocapNode::publish_pictures(const StereoFrame& frame, const std_msgs::Header& header) {
  if (markers_.getNumSubscribers() > 0 && due(last_markers_, kMarkerPeriod)) {
    markers_.publish(marker_array(frame, set_, header));
  }
  if (debug_.getNumSubscribers() > 0 && due(last_debug_, kDebugPeriod)) {
    debug_.publish(image_message(annotate(frame, rig_, set_), header));
  }
}

void MocapNode::publish_diagnostics(const std::optional<std::string>& trouble,
                                    const Pairing::Counts& images) {
  const ros::WallTime now = ros::WallTime::now();
  diagnostic_msgs::DiagnosticArray array;
  array.header.stamp = ros::Time::now();
  array.status.push_back(status_.report((now - last_report_).toSec(), trouble, images));
  last_report_ = now;
  diagnostics_.publish(array);
}

}  // namespace mocap
}  // namespace anthrob
