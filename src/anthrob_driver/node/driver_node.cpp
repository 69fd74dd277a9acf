#include "driver_node.h"

#include <anthrob_msgs/MuscleStates.h>
#include <anthrob_msgs/TouchStates.h>
#include <sensor_msgs/JointState.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <limits>
#include <thread>

#include "anthrob_core/monotonic_clock.h"
#include "anthrob_ros/bounded_connection.h"
#include "anthrob_ros/diagnostics.h"
#include "anthrob_ros/replies.h"
#include "driver_diagnostics.h"
#include "publishing/measurement_age.h"
#include "routine/home.h"
#include "routine/live_gains.h"
#include "thread/call_guard.h"

namespace anthrob {
namespace driver {

namespace {

/// The frame of what is measured, though it is in none; as the root of our robots' URDFs.
const char* const kBase = "world";
constexpr std::chrono::milliseconds kPause{2};  ///< between two looks at what a call waits for
/// One call that waits does not hold up the others.
constexpr std::uint32_t kRequestThreads = 4;
const ros::TransportHints kNoDelay = ros::TransportHints().tcpNoDelay();

void answer(const RobotDriver::Outcome& outcome, std_srvs::Trigger::Response& response,
            const char* done) {
  response.success = outcome.accepted;
  response.message = outcome.reason;
  say_done(response, done);
}

std::int64_t wall_clock_ns() {
  timespec t;
  clock_gettime(CLOCK_REALTIME, &t);
  return static_cast<std::int64_t>(t.tv_sec) * 1000000000 + t.tv_nsec;
}

}  // namespace

DriverNode::DriverNode(Hardware hardware, const DriverThread::Options& options,
                       const std::string& interface, bool check_stamps, ros::NodeHandle nh)
    : thread_(hardware, options, interface),
      hardware_(std::move(hardware)),
      interface_(interface),
      pace_(options.pace),
      check_stamps_(check_stamps),
      joint_readings_(hardware_.joints.size()),
      touch_readings_(hardware_.touch.size()),
      nh_(nh),
      stop_nh_(nh),
      command_nh_(nh),
      request_nh_(nh),
      request_queue_([this] { return thread_.halts(); }) {
  stop_nh_.setCallbackQueue(&stop_queue_);
  command_nh_.setCallbackQueue(&command_queue_);
  request_nh_.setCallbackQueue(&request_queue_);
  muscles_ = nh_.advertise<anthrob_msgs::MuscleStates>("muscle_states", 100);
  joints_ = nh_.advertise<sensor_msgs::JointState>("joint_states", 100);
  if (!hardware_.touch.empty()) touch_ = nh_.advertise<anthrob_msgs::TouchStates>("touch", 100);
  diagnostics_ = nh_.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 10);
  for (const std::string& note : thread_.notes()) ROS_WARN_STREAM(note);
}

// ---- commands and services ----

void DriverNode::on_command(const anthrob_msgs::MuscleCommand& command, const std::string& sender) {
  RobotDriver::Outcome outcome;
  double time = 0.0;
  const double old = command_age(command.header.stamp);
  thread_.call([&](RobotDriver& driver, double now) {
    outcome = dropping_
                  ? driver.refuse("sent before enable or home had answered")
                  : driver.command(command.name, command.mode, command.reference, now, old, sender);
    time = now;
  });
  if (outcome.accepted || time - warning_time_ < 1.0) return;
  warning_time_ = time;
  ROS_WARN_STREAM("muscle_command refused: " << outcome.reason);
}

void DriverNode::on_malformed_command(const std::string& why) {
  thread_.call([&](RobotDriver& driver, double) { driver.refuse(why); });
}

double DriverNode::command_age(const ros::Time& stamp) const {
  const ros::Time now = ros::Time::now();
  // `rostopic pub` sends no stamp; simulated time may not have begun.
  if (!check_stamps_ || stamp.isZero() || now.isZero()) return 0.0;
  return now.toSec() - stamp.toSec();  // ros::Duration throws where it ends, at 68 years
}

void DriverNode::pass_commands() {
  // The round that runs now may have begun before the last of them came.
  const std::uint64_t passed = command_rounds_ + 2;
  while (command_rounds_ < passed && !ros::isShuttingDown()) std::this_thread::sleep_for(kPause);
}

DriverNode::Outcome DriverNode::carry_out(const Step& begin, const Step& look, Commands commands) {
  const CallGuard guard(RequestQueue::received());
  Outcome outcome{false, ""};
  bool pending = false, refusing = false;
  thread_.call([&](RobotDriver& driver, double now) {
    pending = guard.may_begin(driver, outcome) && begin(driver, now, outcome);
    refusing = pending && commands == Commands::kRefused;
    if (refusing) ++dropping_;
  });
  while (pending && !ros::isShuttingDown()) {
    std::this_thread::sleep_for(kPause);
    thread_.call([&](RobotDriver& driver, double now) { pending = look(driver, now, outcome); });
  }
  // What the last look saw was not the end of it.
  if (pending) outcome = {false, "the driver is shutting down"};
  if (refusing) {
    pass_commands();
    thread_.call([&](RobotDriver& driver, double) {
      --dropping_;
      guard.confirm(driver, outcome);
    });
  }
  return outcome;
}

bool DriverNode::on_enable(Trigger::Request&, Trigger::Response& response) {
  // Where nobody finds this node, nobody can stop it.
  if (const auto lost = registration_->lost()) {
    answer({false, *lost}, response, done::kEnabled);
    return true;
  }
  const auto begin = [](RobotDriver& driver, double now, Outcome& outcome) {
    outcome = driver.start_enable(now);
    return driver.phase() == RobotDriver::Phase::kEnabling;
  };
  const auto look = [](RobotDriver& driver, double, Outcome& outcome) {
    outcome = driver.last_outcome();
    return driver.phase() == RobotDriver::Phase::kEnabling;
  };
  answer(carry_out(begin, look, Commands::kRefused), response, done::kEnabled);
  return true;
}

bool DriverNode::on_home(Trigger::Request&, Trigger::Response& response) {
  const auto begin = [](RobotDriver& driver, double now, Outcome& outcome) {
    outcome = driver.start_home(now);
    return outcome.accepted;
  };
  const auto look = [](RobotDriver& driver, double, Outcome& outcome) {
    const auto& failure = driver.home().failure();
    outcome = {!failure, failure.value_or("")};
    return driver.home().running();
  };
  answer(carry_out(begin, look, Commands::kRefused), response, done::kHomed);
  return true;
}

bool DriverNode::on_disable(TriggerEvent& event) {
  thread_.call([&](RobotDriver& driver, double) {
    answer(driver.disable(), event.getResponse(), done::kDisabled);
  });
  ROS_WARN_STREAM("disabled by " << event.getCallerName());
  return true;
}

bool DriverNode::on_emergency_stop(TriggerEvent& event) {
  thread_.call([&](RobotDriver& driver, double) {
    answer(driver.emergency_stop(), event.getResponse(), done::kStopped);
  });
  ROS_WARN_STREAM("emergency stop by " << event.getCallerName());
  return true;
}

void DriverNode::on_stop_message(const ros::MessageEvent<const std_msgs::Empty>& event) {
  thread_.call([](RobotDriver& driver, double) { driver.emergency_stop(); });
  ROS_WARN_STREAM_THROTTLE(1.0, "emergency stop by " << event.getPublisherName());
}

void DriverNode::stop_unreachable(Finding finding, const std::string& why) {
  thread_.call(
      [&](RobotDriver& driver, double now) { driver.stop_unreachable(finding, why, now); });
}

bool DriverNode::on_clear_faults(Trigger::Request&, Trigger::Response& response) {
  std::uint64_t halts = 0;
  const auto begin = [&](RobotDriver& driver, double now, Outcome& outcome) {
    halts = driver.halts();
    outcome = driver.clear_faults(now);
    return driver.clearing(now);
  };
  // Until the ECUs have cleared too: enable may follow at once.
  const auto look = [&](RobotDriver& driver, double now, Outcome& outcome) {
    if (driver.halts() != halts) {
      outcome = {false, "the motors were stopped meanwhile; call it again"};
      return false;
    }
    if (driver.clearing(now)) return true;
    if (const auto left = driver.not_cleared()) outcome = {false, *left};
    return false;
  };
  answer(carry_out(begin, look, Commands::kTaken), response, done::kCleared);
  return true;
}

bool DriverNode::on_gains(anthrob_msgs::Gains::Request& request,
                          anthrob_msgs::Gains::Response& response) {
  std::uint64_t ended = 0;
  const auto begin = [&](RobotDriver& driver, double now, Outcome& outcome) {
    ended = driver.gains().ended();
    outcome = driver.start_gains(request.muscle, request.gain, request.value, now);
    return outcome.accepted && driver.gains().changing();
  };
  // Somebody else's may have begun since.
  const auto look = [&](RobotDriver& driver, double, Outcome& outcome) {
    outcome = driver.gains().outcome();
    return driver.gains().ended() == ended;
  };
  const Outcome outcome = carry_out(begin, look, Commands::kTaken);
  response.success = outcome.accepted;
  response.message = outcome.reason;
  say_done(response, done::kGains);
  thread_.call([&](RobotDriver& driver, double) {
    for (const ecu::Gain& gain : ecu::gains_of(driver.supervisor().muscles())) {
      const auto& muscle = driver.hardware().muscles[static_cast<std::size_t>(gain.muscle)];
      response.held_muscle.push_back(muscle.name);
      response.held_gain.push_back(ecu::name(gain.parameter));
      response.held_value.push_back(muscle.parameters.get(gain.parameter));
    }
  });
  return true;
}

// ---- measurements ----

double DriverNode::age(double time, std::int64_t kernel_ns) const {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  // The wall clock first: read later it would make the wire's age longer than sending's.
  const double since_wire =
      kernel_ns == 0 ? nan : 1e-9 * pace_ * static_cast<double>(wall_clock_ns() - kernel_ns);
  return measurement_age(pace_ * monotonic_now() - time, since_wire);
}

ros::Time DriverNode::ros_now() {
  ros::Time now = ros::Time::now();
  if (ros::Time::isSimTime()) {
    now.fromSec(stamp_clock_.now(now.toSec(), pace_ * monotonic_now()));
  }
  return now;
}

std::optional<ros::Time> DriverNode::stamp(double time, std::int64_t kernel_ns) {
  // ROS time may differ from both clocks of the driver; only the age carries over. ROS time is read
  // first: if this thread is held up between the two, a stamp is too old, never too new.
  const ros::Time now = ros_now();
  const double old = age(time, kernel_ns);
  if (!(old <= kOldestMeasurement)) return std::nullopt;
  return now.toSec() > old ? now - ros::Duration(old) : now;
}

void DriverNode::publish_measurements(double wait) {
  const DriverThread::Batch batch = thread_.wait(wait);
  for (const Sample& sample : batch.samples) {
    const std::optional<ros::Time> measured = stamp(sample.time, sample.stamp_ns);
    if (measured) publish(sample, *measured);
  }
  for (const AnalogSample& sample : batch.analogs) {
    if (sample.kind == AnalogSample::Kind::kJoint) {
      publish_joints(joint_readings_.add(sample));
    } else {
      publish_touch(touch_readings_.add(sample));
    }
  }
}

void DriverNode::publish(const Sample& sample, const ros::Time& stamp) {
  ++samples_;
  longest_round_trip_ = std::max(longest_round_trip_, sample.round_trip);
  anthrob_msgs::MuscleStates states;
  states.header.stamp = stamp;
  states.header.frame_id = kBase;
  for (std::size_t m = 0; m < sample.muscles.size(); ++m) {
    const MuscleSample& muscle = sample.muscles[m];
    states.name.push_back(hardware_.muscles[m].name);
    states.position.push_back(muscle.position);
    states.velocity.push_back(muscle.velocity);
    states.current.push_back(muscle.current);
    states.voltage.push_back(muscle.voltage);
    states.force.push_back(muscle.force);
    states.reference.push_back(muscle.reference);
    states.mode.push_back(static_cast<std::uint8_t>(muscle.mode));
    states.ecu_state.push_back(static_cast<std::uint8_t>(muscle.state));
  }
  muscles_.publish(states);
}

void DriverNode::publish_joints(const std::vector<AnalogSample>& readings) {
  if (readings.empty()) return;
  const auto measured = stamp(readings.front().time, readings.front().stamp_ns);
  if (!measured) return;
  sensor_msgs::JointState states;
  states.header.stamp = *measured;
  states.header.frame_id = kBase;
  for (const AnalogSample& reading : readings) {
    states.name.push_back(hardware_.joints[reading.sensor].joint);
    states.position.push_back(reading.value);
    states.velocity.push_back(reading.rate);
  }
  joints_.publish(states);
}

void DriverNode::publish_touch(const std::vector<AnalogSample>& readings) {
  if (readings.empty()) return;
  const auto measured = stamp(readings.front().time, readings.front().stamp_ns);
  if (!measured) return;
  anthrob_msgs::TouchStates touch;
  touch.header.stamp = *measured;
  touch.header.frame_id = kBase;
  for (const AnalogSample& reading : readings) {
    touch.name.push_back(hardware_.touch[reading.sensor].name);
    touch.force.push_back(reading.value);
  }
  touch_.publish(touch);
}

// ---- diagnostics ----

void DriverNode::publish_diagnostics() {
  const double time = monotonic_now();
  if (time - report_time_ < 1.0) return;
  diagnostic_msgs::DiagnosticArray array;
  array.header.stamp = ros::Time::now();
  thread_.call([&](RobotDriver& driver, double now) {
    array.status.push_back(driver_status(driver, now, nh_.getNamespace()));
    auto& own = array.status.front();
    own.hardware_id = interface_;
    const auto published = static_cast<double>(samples_ - reported_samples_);
    own.values.push_back(key_value("state_rate", text(published / (time - report_time_))));
    own.values.push_back(key_value("longest_round_trip_ms", text(1e3 * longest_round_trip_)));
    if (const auto lost = registration_->lost()) {
      own.level = diagnostic_msgs::DiagnosticStatus::ERROR;
      own.message += "; not registered: " + *lost;
    }
    for (std::size_t e = 0; e < hardware_.ecus.size(); ++e) {
      array.status.push_back(ecu_status(driver, e, now, nh_.getNamespace()));
    }
  });
  diagnostics_.publish(array);
  report_time_ = time;
  reported_samples_ = samples_;
  longest_round_trip_ = 0.0;
}

void DriverNode::log_stops() {
  const double time = monotonic_now();
  if (time - look_time_ < 0.05) return;
  look_time_ = time;
  std::vector<std::string> reasons;
  thread_.call([&](RobotDriver& driver, double) {
    reasons = driver.stops().since(logged_stops_);
    logged_stops_ = driver.stops().count();
  });
  for (const std::string& reason : reasons) ROS_ERROR_STREAM("motors stopped: " << reason);
}

void DriverNode::run() {
  subscribers_ = {
      subscribe_bounded<anthrob_msgs::MuscleCommand>(
          command_nh_, "muscle_command", 100,
          [this](const auto& command, const std::string& sender) { on_command(command, sender); },
          [this](const std::string& why) { on_malformed_command(why); }, kNoDelay),
      stop_nh_.subscribe("emergency_stop", 1, &DriverNode::on_stop_message, this, kNoDelay),
  };
  services_ = {
      request_nh_.advertiseService("enable", &DriverNode::on_enable, this),
      request_nh_.advertiseService("home", &DriverNode::on_home, this),
      request_nh_.advertiseService("clear_faults", &DriverNode::on_clear_faults, this),
      advertise_bounded<anthrob_msgs::Gains>(
          request_nh_, "gains",
          [this](auto& request, auto& response) { return on_gains(request, response); }),
      stop_nh_.advertiseService("disable", &DriverNode::on_disable, this),
      stop_nh_.advertiseService("emergency_stop", &DriverNode::on_emergency_stop, this),
  };
  registration_.emplace(
      [this](const std::string& why) { stop_unreachable(Finding::kUnregistered, why); },
      1.0 / pace_);
  descriptors_.emplace(
      [this](const std::string& why) { stop_unreachable(Finding::kNoDescriptors, why); });
  ros::AsyncSpinner stops(1, &stop_queue_);
  stops.start();
  ros::AsyncSpinner requests(kRequestThreads, &request_queue_);
  requests.start();
  // Whatever ends this loop stops the motors, and then ends calls that wait for it, before their
  // threads are joined. ros::ok() would end it only after those calls, for which shutting down
  // waits: `home` would go on winding.
  struct End {
    DriverThread& thread;
    ~End() {
      thread.call([](RobotDriver& driver, double) { driver.disable(); });
      ros::shutdown();
    }
  } end{thread_};
  report_time_ = monotonic_now();
  while (!ros::isShuttingDown()) {
    publish_measurements(0.002);
    ros::getGlobalCallbackQueue()->callAvailable();
    command_queue_.callAvailable();
    ++command_rounds_;
    publish_diagnostics();
    log_stops();
  }
}

}  // namespace driver
}  // namespace anthrob
