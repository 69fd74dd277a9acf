#include "anthrob_control/ros/robot_link.h"

#include <anthrob_msgs/Step.h>
#include <ros/callback_queue.h>

#include <stdexcept>

#include "anthrob_ros/bounded_connection.h"

namespace anthrob {

namespace {

/// How long a simulator may take to answer, of wall time [s].
constexpr double kStepPatience = 10.0;
constexpr int kFirstAttempts = 10;
/// How long no muscle_states may come before a warning, of wall time [s].
constexpr double kSilence = 5.0;
/// How long two nodes must not alternate with one measurement before one of them is believed again,
/// of wall time [s].
constexpr double kPublisherWindow = 3.0;

bool fits(std::size_t names, std::size_t values) {
  return values == names;
}

}  // namespace

RobotLink::RobotLink(ros::NodeHandle nh, std::shared_ptr<const RobotModel> model,
                     const Options& options)
    : nh_(nh), options_(options), state_(std::move(model)) {
  commands_ = nh_.advertise<anthrob_msgs::MuscleCommand>("muscle_command", 10);
  subscribers_ = {
      listen("muscle_states", &RobotLink::see_muscles),
      listen("joint_states", &RobotLink::see_joints),
      listen("spherical_joint_states", &RobotLink::see_ball_joints),
  };
}

template <class M>
ros::Subscriber RobotLink::listen(const std::string& topic, void (RobotLink::*see)(const M&)) {
  const auto take = [this, see](const M& message, const std::string& node) {
    note_publisher(message.name, node);
    (this->*see)(message);
  };
  return subscribe_bounded<M>(nh_, topic, 2000, take, {}, ros::TransportHints().tcpNoDelay());
}

/// In lock-step measurements come with their step, whatever the clock has come to.
void RobotLink::note_receipt() {
  if (!options_.lock_step) state_.receive_at(ros::Time::now().toSec());
}

/// Whoever publishes beside another one may end some time; after a while all is asked anew.
void RobotLink::note_publisher(const std::vector<std::string>& names, const std::string& node) {
  const ros::SteadyTime now = ros::SteadyTime::now();
  if ((now - publishers_begin_).toSec() > kPublisherWindow) {
    two_publishers_ = publishers_.conflict();
    publishers_ = {};
    publishers_begin_ = now;
  }
  publishers_.add(names, node);
  if (publishers_.conflict()) two_publishers_ = publishers_.conflict();
}

void RobotLink::see_muscles(const anthrob_msgs::MuscleStates& m) {
  heard_ = true;
  note_receipt();
  const std::size_t n = m.name.size();
  if (fits(n, m.position.size()) && fits(n, m.velocity.size()) && fits(n, m.current.size()) &&
      fits(n, m.force.size()) && fits(n, m.ecu_state.size())) {
    for (std::size_t i = 0; i < n; ++i) {
      state_.see_muscle(m.name[i], {m.position[i], m.velocity[i], m.current[i], m.force[i]},
                        m.ecu_state[i] == anthrob_msgs::MuscleStates::ENABLED,
                        m.header.stamp.toSec());
      if (fits(n, m.mode.size())) state_.see_mode(m.name[i], static_cast<ecu::Mode>(m.mode[i]));
    }
  }
  if (on_muscles) on_muscles(m);
}

void RobotLink::see_joints(const sensor_msgs::JointState& m) {
  note_receipt();
  if (fits(m.name.size(), m.position.size()) && fits(m.name.size(), m.velocity.size())) {
    for (std::size_t i = 0; i < m.name.size(); ++i)
      state_.see_joint(m.name[i], m.position[i], m.velocity[i], m.header.stamp.toSec());
  }
  if (on_joints) on_joints(m);
}

void RobotLink::see_ball_joints(const anthrob_msgs::SphericalJointStates& m) {
  note_receipt();
  if (fits(m.name.size(), m.orientation.size()) && fits(m.name.size(), m.angular_velocity.size())) {
    for (std::size_t i = 0; i < m.name.size(); ++i) {
      const auto& o = m.orientation[i];
      const auto& w = m.angular_velocity[i];
      state_.see_ball_joint(m.name[i], Quat(o.w, o.x, o.y, o.z), Vec3(w.x, w.y, w.z),
                            m.header.stamp.toSec());
    }
  }
  if (on_ball_joints) on_ball_joints(m);
}

void RobotLink::advance_to(const ros::Time& time) {
  jumped_ = time < now_;
  dt_ = jumped_ || now_.isZero() ? 0.0 : (time - now_).toSec();
  if (jumped_) {
    // A bag loops, a simulator was started anew: nothing of the old time counts.
    state_.clear();
    next_ = time;
  }
  now_ = time;
}

void RobotLink::look_for_robot() {
  if (heard_ || warned_) return;
  if ((ros::SteadyTime::now() - started_).toSec() < kSilence) return;
  const ros::Subscriber& states = subscribers_.front();
  if (states.getNumPublishers() > 0) return;
  warned_ = true;
  ROS_WARN_STREAM("waiting for "
                  << states.getTopic()
                  << ", which nobody publishes: is the robot or the simulator running? Start this "
                     "node in the robot's namespace, e.g. __ns:=/anthrob");
}

std::optional<std::string> RobotLink::obstacle() const {
  const auto lost = registration_ ? registration_->lost() : std::nullopt;
  return lost ? lost : two_publishers_;
}

bool RobotLink::wait() {
  // By now the node's own topics and services are there, too.
  if (!registration_) registration_.emplace();
  return options_.lock_step ? step_simulator() : wait_for_period();
}

bool RobotLink::wait_for_period() {
  ros::CallbackQueue& queue = *ros::getGlobalCallbackQueue();
  while (ros::ok()) {
    queue.callAvailable(ros::WallDuration(0.001));
    const ros::Time time = ros::Time::now();
    if (time.isZero()) {
      clock_wait_.look();
      continue;
    }
    look_for_robot();
    if (time >= now_ && time < next_) {
      if (ros::Time::isSimTime()) clock_watch_.look(time);
      continue;
    }
    advance_to(time);
    // Late periods are left out rather than made up for.
    next_ += ros::Duration(options_.period);
    if (next_ <= time) next_ = time + ros::Duration(options_.period);
    return true;
  }
  return false;
}

bool RobotLink::connected() const {
  for (const ros::Subscriber& subscriber : subscribers_) {
    if (subscriber.getNumPublishers() == 0) return false;
  }
  return commands_.getNumSubscribers() > 0;
}

bool RobotLink::wait_for_simulator() {
  const std::string step = nh_.resolveName("sim/step");
  while (ros::ok() && !ros::service::waitForService(step, ros::Duration(0.5))) look_for_robot();
  while (ros::ok() && !connected()) {
    look_for_robot();
    ros::WallDuration(0.01).sleep();
  }
  step_ = nh_.serviceClient<anthrob_msgs::Step>(step, true);
  return ros::ok();
}

bool RobotLink::step_simulator() {
  if (!step_.isValid() && !wait_for_simulator()) return false;
  // A connection counts a moment before it carries anything: the very first states may be lost.
  const bool first = now_.isZero();
  for (int attempt = 1;; ++attempt) {
    const ros::Time stamp = call_step();
    if (states_arrive(stamp, first ? 1.0 : kStepPatience)) {
      advance_to(stamp);
      return true;
    }
    if (!ros::ok()) return false;
    if (!first || attempt == kFirstAttempts) {
      throw std::runtime_error("sim/step: not all states of the last step arrived: " +
                               state_.complaint(stamp.toSec(), 0.0).value_or(""));
    }
  }
}

ros::Time RobotLink::call_step() {
  anthrob_msgs::Step call;
  call.request.steps = static_cast<std::uint32_t>(options_.steps);
  call.request.command_stamp = unstepped_command_;
  unstepped_command_ = ros::Time();
  const bool commanded = !call.request.command_stamp.isZero();
  for (int attempt = 1;; ++attempt) {
    if (!step_.call(call)) {
      if (!ros::ok()) return now_;
      throw std::runtime_error("sim/step: the simulator does not answer");
    }
    if (call.response.success) break;
    // As the first states, the first command may be lost.
    if (!commanded || command_arrived_ || attempt == kFirstAttempts)
      throw std::runtime_error("sim/step: " + call.response.message);
    commands_.publish(command_);
  }
  command_arrived_ = command_arrived_ || commanded;
  return call.response.stamp;
}

bool RobotLink::states_arrive(const ros::Time& stamp, double patience) {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(patience);
  while (ros::ok() && ros::WallTime::now() < end) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.001));
    if (state_.complete_since(stamp.toSec())) return true;
  }
  return false;
}

ros::Time RobotLink::send(anthrob_msgs::MuscleCommand command) {
  if (obstacle()) return now_;
  command.header.stamp = now_;
  commands_.publish(command);
  command_ = std::move(command);
  unstepped_command_ = now_;
  return now_;
}

anthrob_msgs::MuscleCommand make_command(const RobotModel& model, ecu::Mode mode,
                                         const std::vector<double>& references, bool release) {
  anthrob_msgs::MuscleCommand command;
  for (std::size_t m = 0; m < model.muscles.size(); ++m) {
    const MuscleModel& muscle = model.muscles[m];
    if (!muscle.has_controller) continue;
    const bool blind = mode == ecu::Mode::kForce && !muscle.has_force_sensor();
    if (blind && !release) continue;
    command.name.push_back(muscle.name);
    command.mode.push_back(static_cast<std::uint8_t>(blind ? ecu::Mode::kVoltage : mode));
    command.reference.push_back(blind ? 0.0 : references[m]);
  }
  return command;
}

}  // namespace anthrob
