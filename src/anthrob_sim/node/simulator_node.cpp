#include "simulator_node.h"

#include <diagnostic_msgs/DiagnosticArray.h>
#include <rosgraph_msgs/Clock.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "anthrob_ecu/gains.h"
#include "anthrob_ros/bounded_connection.h"
#include "anthrob_ros/diagnostics.h"
#include "anthrob_ros/replies.h"
#include "anthrob_ros/single_backend.h"
#include "anthrob_sim/conversions.h"
#include "anthrob_sim/placement.h"

namespace anthrob {

namespace {

const ros::TransportHints kNoDelay = ros::TransportHints().tcpNoDelay();
constexpr std::uint32_t kMostSteps = 10000000;  ///< of one call: nothing else is heard meanwhile
/// Between two postures without a motion from one to the other: tf keeps one an instant, and
/// robot_state_publisher looks at joints 50 times a second.
constexpr double kNewInstant = 0.02;  // [s]
/// While paused, so that who starts then knows the time.
constexpr std::chrono::milliseconds kClockRepeat(200);
/// However rarely states are published, commands and stops are heard as often as this.
constexpr double kHearing = 0.01;                   // [s] of simulated time
constexpr std::chrono::milliseconds kListening(5);  // of wall time
/// How long a stop is not answered while a step takes longer than that.
constexpr std::chrono::seconds kStopPatience(1);

const auto kEmergencyStop = [](ecu::Supervisor& all) { return all.emergency_stop(); };

}  // namespace

SimulatorNode::SimulatorNode(std::shared_ptr<const RobotModel> model, const Options& options,
                             ros::NodeHandle nh)
    : options_(options),
      sim_(std::move(model)),
      supervisor_(muscle_channels(sim_.model()), options.supervisor),
      driven_(*sim_.model().skeleton, options.supervisor),
      steps_per_state_(steps_in(1.0 / options.state_rate)),
      steps_per_cycle_(std::min(steps_per_state_, steps_in(kHearing))),
      steps_to_state_(steps_per_state_),
      nh_(nh),
      surfaces_(nh_, sim_.model()),
      pushes_(nh_, sim_),
      quantities_(nh_, sim_, options.quantities),
      snapshots_(
          nh_, sim_, [this] { return failure_; },
          [this](const Snapshot& snapshot) { restore(snapshot); }),
      tendons_(nh_, sim_, options.marker_rate, [this] { return failure_.empty(); }) {
  advertise_topics();
  subscribe_to_commands();
  offer_services();
  apply_supervision();
}

void SimulatorNode::advertise_topics() {
  clock_ = nh_.advertise<rosgraph_msgs::Clock>("/clock", 10);
  refuse_other_clocks();
  muscles_ = nh_.advertise<anthrob_msgs::MuscleStates>("muscle_states", 100);
  joints_ = nh_.advertise<sensor_msgs::JointState>("joint_states", 100);
  spherical_joints_ = BallJointPublisher(nh_, options_.motion_capture ? "sim/" : "", 100);
  muscle_paths_ = nh_.advertise<visualization_msgs::MarkerArray>("muscle_paths", 2);
  if (!sim_.model().touch_pads.empty()) {
    touch_ = nh_.advertise<anthrob_msgs::TouchStates>("touch", 100);
  }
  solved_paths_ = nh_.advertise<anthrob_msgs::MusclePaths>("solved_paths", 10);
  moment_arms_ = nh_.advertise<anthrob_msgs::MomentArms>("moment_arms", 10);
  diagnostics_ = nh_.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 10);
}

void SimulatorNode::subscribe_to_commands() {
  ros::NodeHandle commands(nh_), stops(nh_);
  commands.setCallbackQueue(&command_queue_);
  stops.setCallbackQueue(&stop_queue_);
  subscribers_ = {
      subscribe_bounded<anthrob_msgs::MuscleCommand>(
          commands, "muscle_command", 100,
          [this](const auto& command, const std::string& sender) { on_command(command, sender); },
          [this](const std::string& why) { supervisor_.refuse(why); }, kNoDelay),
      subscribe_bounded<sensor_msgs::JointState>(
          commands, "joint_effort_command", 100,
          [this](const auto& command, const std::string& sender) { on_effort(command, sender); },
          [this](const std::string& why) { driven_.refuse(why); }, kNoDelay),
      stops.subscribe<std_msgs::Empty>(
          "emergency_stop", 1,
          [this](const std_msgs::EmptyConstPtr&) {
            std_srvs::Trigger::Response unheard;
            supervise_between_steps(kEmergencyStop, unheard);
          },
          ros::VoidConstPtr(), kNoDelay),
  };
}

void SimulatorNode::offer_services() {
  ros::NodeHandle stops(nh_);
  stops.setCallbackQueue(&stop_queue_);
  services_ = {
      nh_.advertiseService("enable", &SimulatorNode::on_enable, this),
      nh_.advertiseService("home", &SimulatorNode::on_home, this),
      stops.advertiseService("disable", &SimulatorNode::on_disable, this),
      stops.advertiseService("emergency_stop", &SimulatorNode::on_emergency_stop, this),
      nh_.advertiseService("clear_faults", &SimulatorNode::on_clear_faults, this),
      advertise_bounded<anthrob_msgs::Gains>(
          nh_, "gains",
          [this](auto& request, auto& response) { return on_gains(request, response); }),
      nh_.advertiseService("sim/pause", &SimulatorNode::on_pause, this),
      nh_.advertiseService("sim/step", &SimulatorNode::on_step, this),
      nh_.advertiseService("sim/set_rate", &SimulatorNode::on_set_rate, this),
      nh_.advertiseService("sim/reset", &SimulatorNode::on_reset, this),
      advertise_bounded<anthrob_msgs::SetState>(
          nh_, "sim/set_state",
          [this](auto& request, auto& response) { return on_set_state(request, response); }),
  };
}

int SimulatorNode::steps_in(double time) const {
  return std::max(1, static_cast<int>(std::lround(time / sim_.step_length())));
}

ros::Time SimulatorNode::stamp() const {
  ros::Time t;
  t.fromNSec(static_cast<std::uint64_t>(std::llround(sim_.time() * 1e9)));
  return t;
}

// ---- commands

void SimulatorNode::on_command(const anthrob_msgs::MuscleCommand& command,
                               const std::string& sender) {
  note_stamp(command.header.stamp);
  const auto outcome = supervisor_.command(command.name, command.mode, command.reference,
                                           sim_.time(), accepted_, sender);
  if (!outcome.accepted) return warn_of_refusal("muscle_command", outcome.reason);
  apply_supervision();
  for (const ecu::MuscleReference& reference : accepted_) {
    if (supervisor_.follows_references(reference.muscle)) {
      sim_.command(reference.muscle, reference.mode, reference.reference);
    }
  }
}

void SimulatorNode::note_stamp(const ros::Time& commanded) {
  // Somebody else may send an older one, one without stamp, or one by another clock, far ahead.
  if (commanded <= stamp()) last_command_stamp_ = std::max(last_command_stamp_, commanded);
}

void SimulatorNode::on_effort(const sensor_msgs::JointState& command, const std::string& sender) {
  if (supervisor_.muscles().empty()) note_stamp(command.header.stamp);
  const auto outcome = driven_.command(command.name, command.effort, sim_, sender);
  if (!outcome.accepted) warn_of_refusal("joint_effort_command", outcome.reason);
}

void SimulatorNode::warn_of_refusal(const char* topic, const std::string& reason) {
  // Wall time: simulated time may stand still.
  const ros::WallTime now = ros::WallTime::now();
  ros::WallTime& last = last_warnings_[topic];
  if ((now - last).toSec() < 1.0) return;
  last = now;
  ROS_WARN_STREAM(topic << " refused: " << reason);
}

void SimulatorNode::apply_supervision() {
  for (std::size_t i = 0; i < sim_.muscle_count(); ++i) {
    const int muscle = static_cast<int>(i);
    const bool follows = supervisor_.follows_references(muscle);
    if (sim_.muscle(muscle).enabled() && !follows) {
      // A stopped muscle forgets its reference: enabling it again must not make it jump.
      sim_.command(muscle, ecu::Mode::kVoltage, 0.0);
    }
    sim_.muscle_inputs().set_enabled(muscle, follows);
  }
  driven_.apply(sim_);
}

template <typename Request>
void SimulatorNode::supervise(Request request, std_srvs::Trigger::Response* response) {
  const auto muscles = request(supervisor_);
  const auto joints = request(driven_.supervisor());
  apply_supervision();
  if (response == nullptr) return;
  response->success = muscles.accepted && joints.accepted;
  // A robot with one of the two only hears of that one; "nothing to clear" must hold for both.
  const bool joints_only = supervisor_.muscles().empty();
  const bool muscles_only = driven_.supervisor().muscles().empty();
  if (!joints_only && (muscles_only || !muscles.accepted)) {
    response->message = muscles.reason;
  } else if (joints_only || !joints.accepted || joints.reason == muscles.reason) {
    response->message = joints.reason;
  }
}

template <typename Request>
void SimulatorNode::supervise_between_steps(Request request,
                                            std_srvs::Trigger::Response& response) {
  // It may come after this call has ended.
  const auto answer = std::make_shared<std_srvs::Trigger::Response>();
  if (interrupts_.call([this, request, answer] { supervise(request, answer.get()); },
                       kStopPatience)) {
    response = *answer;
    return;
  }
  response.success = true;
  response.message = "the simulation is busy, and stops before its next step";
}

void SimulatorNode::stop_for(const std::string& why) {
  const auto stop = [this, why] {
    supervise(kEmergencyStop);
    stopped_for_ = why;
  };
  interrupts_.call(stop, kStopPatience);
  ROS_ERROR_STREAM("motors stopped: " << why << "; then: clear_faults, enable");
}

// ---- services

bool SimulatorNode::on_enable(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  // Where nobody finds this node, nobody can stop it.
  if (const auto lost = registration_->lost()) {
    response.message = *lost;
    return true;
  }
  supervise([this](ecu::Supervisor& all) { return all.enable(sim_.time()); }, &response);
  say_done(response, done::kEnabled);
  return true;
}

bool SimulatorNode::on_home(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  bool enabled = true;
  for (std::size_t m = 0; m < supervisor_.muscles().size(); ++m) {
    enabled = enabled && supervisor_.follows_references(static_cast<int>(m));
  }
  response.success = enabled;
  response.message =
      enabled ? "zero positions are those of the model" : "not enabled: call enable first";
  if (enabled) supervisor_.restart_watch(sim_.time());
  return true;
}

bool SimulatorNode::on_disable(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  supervise_between_steps([](ecu::Supervisor& all) { return all.disable(); }, response);
  say_done(response, done::kDisabled);
  return true;
}

bool SimulatorNode::on_emergency_stop(std_srvs::Trigger::Request&,
                                      std_srvs::Trigger::Response& response) {
  supervise_between_steps(kEmergencyStop, response);
  say_done(response, done::kStopped);
  return true;
}

bool SimulatorNode::on_clear_faults(std_srvs::Trigger::Request&,
                                    std_srvs::Trigger::Response& response) {
  supervise([](ecu::Supervisor& all) { return all.clear_faults(); }, &response);
  say_done(response, done::kCleared);
  stopped_for_.reset();
  return true;
}

bool SimulatorNode::on_gains(anthrob_msgs::Gains::Request& request,
                             anthrob_msgs::Gains::Response& response) {
  std::vector<ecu::GainChange> changes;
  const auto refused = ecu::read_gain_changes(supervisor_.muscles(), request.muscle, request.gain,
                                              request.value, changes);
  response.success = !refused;
  response.message = refused.value_or("");
  say_done(response, done::kGains);
  for (const ecu::GainChange& change : changes) {
    sim_.muscle_inputs().set_gain(change.gain.muscle, change.gain.parameter, change.value);
  }
  for (const ecu::Gain& gain : ecu::gains_of(supervisor_.muscles())) {
    ecu::ControllerSettings held = sim_.muscle(gain.muscle).controller();
    response.held_muscle.push_back(sim_.muscle(gain.muscle).model().name);
    response.held_gain.push_back(ecu::name(gain.parameter));
    response.held_value.push_back(*ecu::gain_of(held, gain.parameter));
  }
  return true;
}

bool SimulatorNode::on_pause(std_srvs::SetBool::Request& request,
                             std_srvs::SetBool::Response& response) {
  response.success = request.data || failure_.empty();
  response.message =
      response.success ? (request.data ? "paused" : "running") : failure_ + "; call sim/reset";
  if (!response.success) return true;
  // Where it stands from now on.
  if (request.data && !options_.paused && steps_to_state_ < steps_per_state_) publish(true);
  options_.paused = request.data;
  return true;
}

bool SimulatorNode::on_step(anthrob_msgs::Step::Request& request,
                            anthrob_msgs::Step::Response& response) {
  options_.paused = true;
  command_queue_.callAvailable();  // what was sent before this call counts from this step on
  if (request.steps == 0) {
    response.message = "steps: 0: expected a number > 0";
  } else if (request.steps > kMostSteps) {
    response.message = "steps: expected at most " + std::to_string(kMostSteps);
  } else if (!wait_for_command(request.command_stamp)) {
    response.message = std::string("no ") +
                       (supervisor_.muscles().empty() ? "joint_effort_command" : "muscle_command") +
                       " with the requested stamp arrived within 1 s";
  } else if (!failure_.empty()) {
    response.message = failure_ + "; call sim/reset";
  } else {
    response.success = advance(static_cast<int>(request.steps));
    response.message = failure_;
    say_done(response, "done");
    publish(true);
  }
  response.stamp = stamp();
  return true;
}

bool SimulatorNode::on_set_rate(anthrob_msgs::SetRate::Request& request,
                                anthrob_msgs::SetRate::Response& response) {
  const double factor = request.factor;
  response.success = std::isfinite(factor) && (factor == 0.0 || factor >= kSlowest);
  if (!response.success) {
    response.message = "factor: " + std::to_string(factor) +
                       ": expected 0, for as fast as possible, or at least 0.001";
    return true;
  }
  options_.rate = factor;
  deadline_ = Clock::now();
  response.message = factor > 0.0 ? "real-time factor " + text(factor) : "as fast as possible";
  return true;
}

bool SimulatorNode::on_reset(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  start_anew();
  last_command_stamp_ = ros::Time();
  publish(true);
  response.success = true;
  response.message = options_.paused
                         ? "at rest, paused; call sim/pause with data: false to continue"
                         : "at rest; simulated time continues";
  return true;
}

void SimulatorNode::skip_to_new_instant() {
  const int steps = static_cast<int>(std::ceil(kNewInstant / sim_.step_length() - 1e-9));
  sim_.skip(steps);
  for (ecu::Supervisor* watch : {&supervisor_, &driven_.supervisor()}) {
    watch->skip(steps * sim_.step_length());
  }
}

void SimulatorNode::restore(const Snapshot& snapshot) {
  const double before = sim_.time();
  sim_.skip(steps_in(kNewInstant));
  sim_.restore_in_present(snapshot);
  for (ecu::Supervisor* watch : {&supervisor_, &driven_.supervisor()}) {
    watch->skip(sim_.time() - before);
  }
  failure_.clear();
  apply_supervision();  // who was stopped since then remains so
  publish(true);
}

void SimulatorNode::start_anew() {
  skip_to_new_instant();
  sim_.reset();
  failure_.clear();
}

bool SimulatorNode::on_set_state(anthrob_msgs::SetState::Request& request,
                                 anthrob_msgs::SetState::Response& response) {
  try {
    // Nothing of a state that broke down may live on.
    Placement placement = failure_.empty() ? Placement(sim_) : Placement(sim_.model());
    read_state(request, placement);
    if (failure_.empty()) {
      skip_to_new_instant();
    } else {
      start_anew();
    }
    sim_.place(placement.q(), placement.positions());
    publish(true);
    response.success = true;
    response.message = "placed";
  } catch (const BadInput& error) {
    response.message = error.what();
  }
  return true;
}

// ---- time

bool SimulatorNode::wait_for_command(const ros::Time& stamp) {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(1.0);
  while (last_command_stamp_ < stamp) {
    if (!ros::ok() || ros::WallTime::now() > end) return false;
    interrupts_.serve();
    command_queue_.callOne(ros::WallDuration(0.01));
  }
  return true;
}

void SimulatorNode::watch_commands() {
  const double limit = options_.supervisor.command_timeout;
  const bool muscles = supervisor_.update(sim_.time());
  const bool joints = driven_.supervisor().update(sim_.time());
  if (muscles) ROS_WARN("no fresh muscle_command for %.3f s: motors stopped", limit);
  if (joints) ROS_WARN("no fresh joint_effort_command for %.3f s: joints stopped", limit);
  if (muscles || joints) apply_supervision();
}

bool SimulatorNode::advance(int steps) {
  try {
    for (int i = 0; i < steps; ++i) {
      if (!ros::ok()) return false;
      interrupts_.serve();
      watch_commands();
      sim_.step();
    }
    return true;
  } catch (const NumericalFailure& failure) {
    failure_ = failure.what();
    options_.paused = true;
    ROS_ERROR_STREAM(failure_ << "; paused: call sim/reset, then sim/pause with data: false");
    return false;
  }
}

void SimulatorNode::cycle() {
  if (options_.paused) return;
  steps_done_ = std::min(steps_per_cycle_, steps_to_state_);
  const bool sound = advance(steps_done_);
  steps_to_state_ -= steps_done_;
  if (sound && steps_to_state_ > 0) return;
  steps_to_state_ = steps_per_state_;
  publish(false);
  ++states_;
}

void SimulatorNode::publish_clock() {
  rosgraph_msgs::Clock clock;
  clock.clock = stamp();
  clock_.publish(clock);
  clock_time_ = Clock::now();
}

void SimulatorNode::repeat_clock() {
  if (options_.paused && Clock::now() - clock_time_ > kClockRepeat) publish_clock();
}

void SimulatorNode::publish(bool all) {
  publish_clock();
  if (!failure_.empty()) return;  // nobody must take what broke down for a state
  const ros::Time now = stamp();
  Penetration found = deepest_penetration(sim_);
  if (found.depth > deepest_.depth) deepest_ = std::move(found);
  muscles_.publish(muscle_states(sim_, supervisor_, now));
  joints_.publish(joint_states(sim_, now));
  spherical_joints_.publish(spherical_joint_states(sim_, now));
  if (touch_) touch_.publish(touch_states(sim_, now));
  pushes_.publish(now);
  quantities_.publish(now);
  const double period = steps_per_state_ * sim_.step_length();  // [s]
  const int states_per_tf =
      std::max(1, static_cast<int>(std::lround(1.0 / (options_.tf_rate * period))));
  if (all || states_ % static_cast<std::uint64_t>(states_per_tf) == 0) {
    transforms_.sendTransform(ball_joint_transforms(sim_, now));
    if (solved_paths_.getNumSubscribers() > 0) solved_paths_.publish(solved_paths(sim_, now));
    if (moment_arms_.getNumSubscribers() > 0) moment_arms_.publish(moment_arms(sim_, now));
  }
  const Clock::time_point wall = Clock::now();
  if (all ||
      std::chrono::duration<double>(wall - marker_time_).count() > 1.0 / options_.marker_rate) {
    marker_time_ = wall;
    muscle_paths_.publish(muscle_markers(sim_, spring_tensions(sim_), now));
  }
}

diagnostic_msgs::DiagnosticStatus SimulatorNode::own_status(double elapsed) const {
  using diagnostic_msgs::DiagnosticStatus;
  DiagnosticStatus simulator;
  simulator.name = nh_.getNamespace() + ": simulator";
  simulator.hardware_id = sim_.model().file;
  simulator.level = stopped_for_ || !failure_.empty() ? DiagnosticStatus::ERROR
                    : late_cycles_ > 0                ? DiagnosticStatus::WARN
                                                      : DiagnosticStatus::OK;
  simulator.message = stopped_for_        ? "emergency stop: " + *stopped_for_
                      : !failure_.empty() ? failure_
                      : options_.paused   ? "paused"
                      : late_cycles_ > 0  ? "slower than real time"
                                          : "running";
  const double factor = (sim_.time() - report_sim_time_) / elapsed;
  simulator.values = {
      key_value("real_time_factor", text(factor)),
      key_value("late_cycles", std::to_string(late_cycles_)),
      key_value("simulated_time", text(sim_.time())),
      key_value("rejected_commands", std::to_string(supervisor_.rejected_count())),
      key_value("last_rejection", supervisor_.last_rejection().value_or("")),
      key_value("command_age", text(supervisor_.command_age(sim_.time()).value_or(-1.0)))};
  if (!driven_.supervisor().muscles().empty()) {
    simulator.values.push_back(
        key_value("rejected_efforts", std::to_string(driven_.rejected_count())));
    simulator.values.push_back(key_value("last_effort_rejection", driven_.last_rejection()));
  }
  return simulator;
}

diagnostic_msgs::DiagnosticStatus SimulatorNode::path_status() const {
  using diagnostic_msgs::DiagnosticStatus;
  DiagnosticStatus paths;
  paths.name = nh_.getNamespace() + ": muscle paths";
  paths.hardware_id = sim_.model().file;
  const bool inside = deepest_.depth > kRoundingDepth;
  paths.level = inside ? DiagnosticStatus::WARN : DiagnosticStatus::OK;
  paths.message = inside ? deepest_.text() : "no path point inside a surface";
  paths.values = {key_value("deepest_penetration", text(deepest_.depth))};
  return paths;
}

void SimulatorNode::publish_diagnostics() {
  const Clock::time_point wall = Clock::now();
  const double elapsed = std::chrono::duration<double>(wall - report_time_).count();
  if (elapsed < 1.0) return;
  diagnostic_msgs::DiagnosticArray array;
  array.header.stamp = stamp();
  array.status.push_back(own_status(elapsed));
  for (const ecu::Supervisor* units : {&supervisor_, &driven_.supervisor()}) {
    const auto statuses = ecu_statuses(*units, nh_.getNamespace());
    array.status.insert(array.status.end(), statuses.begin(), statuses.end());
  }
  array.status.push_back(path_status());
  deepest_ = deepest_penetration(sim_);
  diagnostics_.publish(array);
  report_time_ = wall;
  report_sim_time_ = sim_.time();
  late_cycles_ = 0;
}

void SimulatorNode::pace() {
  if (options_.paused) {
    // Wakes at once for a call of sim/step: lock-step must not wait for a timer.
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.002));
    deadline_ = Clock::now();
    return;
  }
  if (options_.rate <= 0.0) return;
  const double period = steps_done_ * sim_.step_length() / options_.rate;
  deadline_ += std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(period));
  const Clock::time_point now = Clock::now();
  if (now > deadline_ + std::chrono::milliseconds(20)) {
    // Too late to make up for: go on from here rather than race.
    ++late_cycles_;
    deadline_ = now;
  }
  // In slow motion a cycle is long.
  while (deadline_ - Clock::now() > kListening && !options_.paused && ros::ok()) {
    std::this_thread::sleep_for(kListening);
    hear();
  }
  if (!options_.paused && ros::ok()) std::this_thread::sleep_until(deadline_);
}

void SimulatorNode::hear() {
  interrupts_.serve();
  command_queue_.callAvailable();
  ros::getGlobalCallbackQueue()->callAvailable();
}

void SimulatorNode::run() {
  registration_.emplace([this](const std::string& why) { stop_for(why); });
  descriptors_.emplace([this](const std::string& why) { stop_for(why); });
  ros::AsyncSpinner stops(1, &stop_queue_);
  stops.start();
  deadline_ = report_time_ = Clock::now();
  publish(true);
  ROS_INFO_STREAM("ready" << (options_.hint.empty() ? "" : "; " + options_.hint));
  while (ros::ok()) {
    hear();
    cycle();
    repeat_clock();
    publish_diagnostics();
    pace();
  }
}

}  // namespace anthrob
