#include "recorder.h"

#include <anthrob_msgs/ExternalWrenches.h>
#include <anthrob_msgs/GoTo.h>

#include <chrono>
#include <cmath>
#include <future>
#include <stdexcept>

namespace anthrob {

namespace {

/// Commands are repeated faster than they time out [s].
constexpr double kCommandPeriod = 0.02;
/// Older measurements do not count: what is not seen may be moving [s].
constexpr double kFresh = 0.1;
/// Silence after which the robot counts as gone; also how long a refusal may last [s].
constexpr double kSilence = 1.0;
constexpr double kAskAgain = 0.05;  ///< [s] of wall time
constexpr double kUndriven = 0.5;   ///< [s]: motors may start with the first commands
/// How long a robot may take to appear, of wall time [s].
constexpr double kPatience = 30.0;

}  // namespace

template <class Message>
void Recorder::listen(const char* topic) {
  subscribers_.push_back(nh_.subscribe<Message>(
      topic, 2000,
      [this, topic](const boost::shared_ptr<const Message>& message) {
        bags_.write(topic, *message);
      },
      ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay()));
}

Recorder::Recorder(ros::NodeHandle nh, ros::NodeHandle own, std::shared_ptr<const RobotModel> model,
                   const Protocol& protocol, const std::string& folder,
                   const RobotLink::Options& options, double approach_speed,
                   const std::string& robot_model)
    : nh_(nh),
      model_(model),
      protocol_(protocol),
      store_(folder, model, protocol, ros::Time::isSimTime() ? "simulated" : "true", robot_model),
      bags_(store_, model, nh.getNamespace() + "/"),
      link_(nh, model, options),
      lock_step_(options.lock_step),
      approach_(model, approach_speed) {
  const auto measure = [this](const char* topic) {
    return [this, topic](const auto& message) {
      bags_.write(topic, message);
      bags_.see(measured_names_(message), message.header);
    };
  };
  link_.on_joints = measure("joint_states");
  link_.on_ball_joints = measure("spherical_joint_states");
  link_.on_muscles = measure("muscle_states");
  // Who pushes the simulated robot, as a hand would, belongs to the recording.
  listen<anthrob_msgs::ExternalWrenches>("external_wrenches");
  if (protocol_.kind != Protocol::Kind::kZeroGravity) return;
  // The controller commands; what it says belongs to the recording.
  listen<anthrob_msgs::MuscleCommand>("muscle_command");
  if (protocol_.by_hand) sample_ = own.advertiseService("sample", &Recorder::on_sample, this);
}

bool Recorder::on_sample(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  response.success = visit_ && visit_->trigger();
  response.message =
      response.success
          ? "the posture will be recorded once the arm is at rest"
          : "the recorder is not waiting for a posture now; call again when it asks for one";
  return true;
}

bool Recorder::run() {
  if (!is_there()) {
    ROS_INFO_STREAM("moving slowly to the posture " << protocol_.rest.name
                                                    << " first, if it is far away");
  }
  std::string missed;
  for (int repeat = 1; repeat <= protocol_.repeats; ++repeat) {
    for (const Protocol::Target& target : protocol_.targets) {
      ++done_;
      bags_.begin(store_.names(target, repeat));
      bool complete = true;
      for (const std::string& name : bags_.names()) complete = complete && store_.complete(name);
      if (complete) continue;
      Result result = Result::kAgain;
      for (int attempt = 0; result == Result::kAgain && attempt <= protocol_.redo; ++attempt)
        result = record(target, repeat);
      if (result == Result::kShutdown) return false;
      if (result == Result::kAgain)
        missed += "\n  " + bags_.names().front() + ": " + trouble_.value();
    }
  }
  store_.summarise();
  if (!missed.empty()) {
    throw std::runtime_error("not recorded; the same command tries these again:" + missed);
  }
  ROS_INFO("all recorded");
  return true;
}

Recorder::Result Recorder::record(const Protocol::Target& target, int repeat) {
  Visit visit(model_, protocol_, store_.baseline());
  visit_ = &visit;
  aimed_ = false;
  order_ = {Visit::Aim::kRest, 0};
  refused_since_ = ros::WallTime();
  if (protocol_.by_hand) {
    ROS_INFO_STREAM(target.name << ": set the posture by hand, then: rosservice call "
                                << sample_.getService());
  }
  bool running = true;
  try {
    while (running && visit.outcome() == Visit::Outcome::kRunning) running = advance(visit, target);
    bags_.record(0, link_.now());  // of a trajectory, the last one ends with the visit
  } catch (...) {
    drop();
    throw;
  }
  visit_ = nullptr;
  if (!running) {
    drop();
    return Result::kShutdown;
  }
  trouble_ = visit.reason() ? visit.reason() : bags_.trouble();
  if (!trouble_) {
    store(visit, target, repeat);
    return Result::kDone;
  }
  ROS_WARN_STREAM(bags_.names().front() << ": " << *trouble_);
  drop();
  return Result::kAgain;
}

bool Recorder::advance(Visit& visit, const Protocol::Target& target) {
  if (!link_.wait()) return false;
  if (link_.time_jumped()) throw std::runtime_error("time jumped back");
  const double now = link_.now().toSec();
  if (const auto silence = link_.state().complaint(now, kFresh)) {
    // By the wall's clock: simulated time may outrun the messages.
    if ((ros::WallTime::now() - heard_).toSec() > (is_underway(visit) ? kSilence : kPatience))
      throw std::runtime_error("the robot is silent: " + *silence);
    // Nothing is sent to a robot that is gone, so that the command time-out stops its motors.
    if (is_underway(visit) && !link_.state().complaint(now, kSilence)) carry_out(visit, target);
    return true;
  }
  heard_ = ros::WallTime::now();
  check_motors();
  // However short the stop was, it would be in the recording.
  const std::optional<std::string> stopped = link_.take_disabled();
  // After a stop, the zero-gravity controller holds whatever posture it finds: the arm would be
  // sampled elsewhere.
  const bool spoilt =
      bags_.recording() || (protocol_.kind == Protocol::Kind::kZeroGravity && visit.begun());
  if (stopped && spoilt) visit.fail("the motor of " + *stopped + " stopped while it was recorded");
  if (stopped) approach_.begin();
  // Visits begin at the rest posture.
  if (refused_since_.isZero() && is_there()) {
    order_ = visit.step(link_.state().measurement(), now);
    if (visit.outcome() == Visit::Outcome::kRunning) bags_.record(order_.recording, link_.now());
  }
  if (visit.outcome() == Visit::Outcome::kRunning) carry_out(visit, target);
  return true;
}

bool Recorder::is_underway(const Visit& visit) const {
  return protocol_.kind == Protocol::Kind::kZeroGravity ? visit.begun() : approach_.begun();
}

void Recorder::carry_out(Visit& visit, const Protocol::Target& target) {
  const ros::WallTime now = ros::WallTime::now();
  if (!refused_since_.isZero() && (now - asked_).toSec() < kAskAgain) return;
  asked_ = now;
  const std::optional<std::string> refused = follow(order_, target);
  if (!refused) {
    obeyed_ = true;
    refused_since_ = ros::WallTime();
    return;
  }
  // The controller may not run yet, or may have missed a measurement.
  aimed_ = false;
  if (refused_since_.isZero()) refused_since_ = now;
  if ((now - refused_since_).toSec() > (obeyed_ ? kSilence : kPatience)) visit.fail(*refused);
}

void Recorder::check_motors() {
  // In zero gravity this is the controller's task.
  if (protocol_.kind != Protocol::Kind::kZeroGravity && !sent_.isZero()) {
    reference_watch_.look(link_.state(), link_.now(), lock_step_);
  }
  const std::optional<std::string> off = link_.state().disabled_muscle();
  if (!off || driven_.isZero()) driven_ = link_.now();
  if (off && (link_.now() - driven_).toSec() > kUndriven) {
    throw std::runtime_error(
        "the motor of " + *off +
        " is not enabled; call enable, then run the same command again to continue");
  }
}

std::optional<std::string> Recorder::follow(const Visit::Order& order,
                                            const Protocol::Target& target) {
  const bool changed = !aimed_ || order.aim != aim_;
  aimed_ = true;
  aim_ = order.aim;
  if (protocol_.kind == Protocol::Kind::kZeroGravity) {
    return changed ? call_controller(order.aim, target) : std::nullopt;
  }
  const double dt = sent_.isZero() ? 0.0 : (link_.now() - sent_).toSec();
  if (changed || sent_.isZero() || dt >= kCommandPeriod - 1e-6) {
    const bool rest = order.aim == Visit::Aim::kRest || !is_there();
    send_references(approach_.step(rest ? protocol_.rest.reference : target.reference,
                                   link_.state().measurement(), dt));
  }
  return std::nullopt;
}

void Recorder::send_references(const std::vector<double>& references) {
  anthrob_msgs::MuscleCommand command = make_command(*model_, ecu::Mode::kPosition, references);
  command.header.stamp = sent_ = link_.send(command);
  bags_.write_sent("muscle_command", command);
}

std::optional<std::string> Recorder::call_controller(Visit::Aim aim,
                                                     const Protocol::Target& target) {
  if (aim == Visit::Aim::kRelease) {
    std_srvs::Trigger call;
    if (!ros::service::call(nh_.resolveName("controller/zero_gravity"), call))
      return "controller/zero_gravity: no answer; is the computed-force controller running?";
    if (call.response.success) return std::nullopt;
    return "controller/zero_gravity: " + call.response.message;
  }
  anthrob_msgs::GoTo call;
  call.request.duration = protocol_.go_duration;
  const std::vector<double>& q = aim == Visit::Aim::kRest ? protocol_.rest.q : target.q;
  for (const JointModel& joint : model_->skeleton->joints) {
    const double* p = &q[joint.position_offset];
    if (joint.type == JointType::kBall) {
      geometry_msgs::Quaternion turn;
      turn.w = p[0], turn.x = p[1], turn.y = p[2], turn.z = p[3];
      call.request.ball_joint_name.push_back(joint.name);
      call.request.ball_joint_orientation.push_back(turn);
    } else {
      call.request.joint_name.push_back(joint.name);
      call.request.joint_position.push_back(p[0]);
    }
  }
  if (!ros::service::call(nh_.resolveName("controller/go_to"), call))
    return "controller/go_to: no answer; is the computed-force controller running?";
  if (call.response.success) return std::nullopt;
  return "controller/go_to: " + call.response.message;
}

void Recorder::drop() {
  visit_ = nullptr;
  bags_.discard();
}

DatasetMeta Recorder::describe(const Visit& visit, const Protocol::Target& target, int repeat,
                               int recording) const {
  DatasetMeta meta;
  meta.kind = protocol_.kind == Protocol::Kind::kTrajectories ? "trajectory" : "equilibrium";
  const std::string& rest = protocol_.rest.name;
  meta.other["posture"] = recording == 1 ? target.name + "\n" : rest + "\n";
  meta.other["from"] = recording == 1 ? rest + "\n" : target.name + "\n";
  meta.other["protocol"] = std::string(word(protocol_.kind)) + "\n";
  meta.other["run"] = std::to_string(repeat) + "\n";
  meta.other["hold"] = exact_text(protocol_.hold) + "\n";
  meta.other["largest_gap"] = exact_text(bags_.largest_gap(recording)) + "\n";
  if (protocol_.by_hand) return meta;
  meta.other["rest_drift"] = exact_text(visit.drift()) + "\n";
  meta.other["rest"] = sample_yaml(*model_, visit.rest_before()) + "\n";
  return meta;
}

void Recorder::store(const Visit& visit, const Protocol::Target& target, int repeat) {
  const auto write = [&] { write_files(visit, target, repeat); };
  if (lock_step_ || protocol_.kind == Protocol::Kind::kZeroGravity) {
    write();
  } else {
    // Motors stop if commands stay away, and a disk may take its time.
    std::future<void> done = std::async(std::launch::async, write);
    bool jumped = false;
    while (done.wait_for(std::chrono::seconds(0)) != std::future_status::ready && link_.wait()) {
      jumped = jumped || link_.time_jumped();
      if (link_.take_disabled()) approach_.begin();
      const bool fresh = !link_.state().complaint(link_.now().toSec(), kSilence);
      if (fresh && !jumped) follow({aim_, 0}, target);
    }
    done.get();
    if (jumped) throw std::runtime_error("time jumped back");
  }
  ++recorded_;
  report(bags_.names().front(), visit);
}

/// Touches nothing that commands or callbacks do between two visits.
void Recorder::write_files(const Visit& visit, const Protocol::Target& target, int repeat) {
  if (!store_.baseline() && !protocol_.by_hand) store_.set_baseline(visit.rest_before());
  bags_.close();
  for (int i = 0; i < static_cast<int>(bags_.names().size()); ++i) {
    store_.finish(bags_.names()[static_cast<std::size_t>(i)],
                  describe(visit, target, repeat, i + 1),
                  i == 0 ? visit.target() : visit.rest_after());
  }
  bags_.release();
  store_.summarise();
}

void Recorder::report(const std::string& name, const Visit& visit) {
  const int all = protocol_.repeats * static_cast<int>(protocol_.targets.size());
  const double each = (ros::WallTime::now() - start_).toSec() / recorded_;
  ROS_INFO(
      "[%d/%d] %s: settled after %.1f s, rest posture off by up to %.2f degrees; about %.0f s left",
      done_, all, name.c_str(), visit.settling_time(), kDegrees * visit.drift(),
      each * (all - done_));
}

}  // namespace anthrob
