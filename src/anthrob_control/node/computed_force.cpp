// Computed-force control of a robot, simulated or real: zero gravity, and going to postures.
#include <anthrob_msgs/GoTo.h>
#include <diagnostic_msgs/DiagnosticArray.h>
#include <std_srvs/Trigger.h>

#include <optional>

#include "anthrob_control/posture_sequence.h"
#include "anthrob_control/ros/robot_link.h"
#include "anthrob_core/errors.h"
#include "anthrob_ros/bounded_connection.h"
#include "anthrob_ros/parameters.h"
#include "anthrob_ros/run_node.h"
#include "anthrob_sim/placement.h"
#include "go_to_action.h"

namespace {

using anthrob::BadInput;

/// @param q positions of the joints that the request does not name   @throws BadInput
template <class Request>
std::vector<double> posture_of(const Request& request, const anthrob::RobotModel& model,
                               const std::vector<double>& q) {
  if (request.joint_name.size() != request.joint_position.size() ||
      request.ball_joint_name.size() != request.ball_joint_orientation.size()) {
    throw BadInput(
        "names and values differ in number: expected one joint_position for each joint_name, and "
        "one ball_joint_orientation for each ball_joint_name");
  }
  anthrob::refuse_repeated("joint", request.joint_name);
  anthrob::refuse_repeated("ball joint", request.ball_joint_name);
  anthrob::Placement posture(model, q);
  for (std::size_t i = 0; i < request.joint_name.size(); ++i) {
    posture.set_joint(request.joint_name[i], request.joint_position[i]);
  }
  for (std::size_t i = 0; i < request.ball_joint_name.size(); ++i) {
    const auto& o = request.ball_joint_orientation[i];
    posture.set_ball_joint(request.ball_joint_name[i], anthrob::Quat(o.w, o.x, o.y, o.z));
  }
  if (!(request.duration > 0.0) || !std::isfinite(request.duration))
    throw BadInput("duration: expected a number > 0 [s]");
  return posture.q();
}

/// How long a robot may take to follow POSITION after another mode [s]: its states are under way,
/// and after command_timeout (0.5 s) its motors would stop.
constexpr double kPatience = 0.2;

class ComputedForceNode {
 public:
  ComputedForceNode(ros::NodeHandle nh, std::shared_ptr<const anthrob::RobotModel> model,
                    const anthrob::ControlSettings& settings,
                    const anthrob::RobotLink::Options& options)
      : name_(nh.getNamespace() + ": computed_force"),
        settings_(settings),
        options_(options),
        controller_(model, settings),
        link_(nh, model, options),
        diagnostics_(nh.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 10)),
        action_(nh, {[this](const auto& goal, auto& posture) { return send(goal, posture); },
                     [this] { controller_.zero_gravity(); },
                     [this](const auto& posture) { return distance_to(posture); }}) {
    services_ = {nh.advertiseService("controller/zero_gravity", &ComputedForceNode::on_zero, this),
                 anthrob::advertise_bounded<anthrob_msgs::GoTo>(
                     nh, "controller/go_to", [this](auto& request, auto& response) {
                       return on_go_to(request, response);
                     })};
  }

  void run() {
    while (link_.wait()) {
      check_period();
      if (link_.time_jumped()) {
        controller_.reset();
        silent_ = 0.0;
        unheeded_ = 0.0;
      }
      trouble_ = link_.obstacle();
      if (!trouble_) trouble_ = link_.state().complaint(link_.now().toSec(), settings_.stale_after);
      if (!trouble_) trouble_ = missing_force();
      if (trouble_) {
        // Nothing is sent on stale measurements, nor while nobody could find us: after
        // command_timeout the motors stop. The controller gets the length of the pause, and decides
        // what it still holds.
        silent_ += link_.dt();
      } else {
        control();
      }
      action_.update(link_.dt(), refused_ ? refused_ : hindrance());
      report();
    }
  }

 private:
  /// @throws BadInput if ~steps simulation steps are not one period of the settings
  void check_period() {
    const double dt = link_.dt(), period = 1.0 / settings_.rate;
    // sim/reset and sim/set_state make one longer.
    const bool again = std::abs(dt - last_dt_) < 1e-6;
    last_dt_ = dt;
    if (!options_.lock_step || !again || dt == 0.0 || std::abs(dt - period) < 1e-6) return;
    throw BadInput("parameter ~steps: " + std::to_string(options_.steps) + ": these steps take " +
                   std::to_string(dt) + " s; expected as many as take " + std::to_string(period) +
                   " s, one period of 'rate' in the settings file");
  }

  /// Voltages are this node's own force law; FORCE and POSITION are the units'.
  std::optional<std::string> missing_force() const {
    const bool needed = settings_.hold_output == anthrob::ecu::Mode::kVoltage ||
                        settings_.move_output == anthrob::ecu::Mode::kVoltage;
    if (!needed) return std::nullopt;
    const std::optional<std::string> muscle = link_.state().muscle_without_force();
    if (!muscle) return std::nullopt;
    return "muscle " + *muscle + ": its force is not measured; output VOLTAGE needs it";
  }

  void control() {
    idle_ = link_.state().disabled_muscle();
    // Whatever posture the arm is in when the motors are enabled is the one that is held.
    // Also of those that were, and are again, while this node had no processor.
    if (link_.take_disabled() || idle_) controller_.reset();
    // Nor is it moved back to where a sensor said that it was.
    if (link_.take_jump()) controller_.reset();
    break_off_if_refused();
    const anthrob::ForceCommand& wanted =
        controller_.update(link_.state().measurement(), silent_ + link_.dt());
    silent_ = 0.0;
    shortfall_ = wanted.shortfall.norm();
    converged_ = wanted.converged;
    limited_ = wanted.limited;
    mode_ = wanted.mode;
    // A muscle that FORCE leaves alone must not go on holding a position that was ours.
    const bool other = wanted.mode != anthrob::ecu::Mode::kForce;
    placed_ = placed_ || (other && !link_.state().muscle_not_in(wanted.mode));
    link_.send(anthrob::make_command(controller_.model(), wanted.mode, wanted.reference, placed_));
  }

  /// A robot may refuse to go over to POSITION: too far from where its muscles are, or no zero. It
  /// refuses the whole command, so nobody would hold the arm, and soon its motors would stop.
  void break_off_if_refused() {
    const bool positions = !idle_ && !controller_.holds() && mode_ == anthrob::ecu::Mode::kPosition;
    const std::optional<std::string> other =
        positions ? link_.state().muscle_not_in(anthrob::ecu::Mode::kPosition) : std::nullopt;
    unheeded_ = other ? unheeded_ + silent_ + link_.dt() : 0.0;
    if (!other || unheeded_ <= kPatience) return;
    unheeded_ = 0.0;
    controller_.reset();
    refused_ = "go_to was broken off: the robot refused its POSITION references (muscle " + *other +
               "); its diagnostics say why (last_rejection)";
    ROS_ERROR_STREAM(*refused_ << "; holding the arm where it is");
  }

  /// Why no request can be carried out now; none if they can.
  std::optional<std::string> hindrance() const {
    if (trouble_) return trouble_;
    if (idle_) return "the motor of " + *idle_ + " is not enabled";
    return std::nullopt;
  }

  bool on_zero(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
    const std::optional<std::string> why = hindrance();
    response.success = !why;
    response.message = why.value_or("zero gravity");
    if (response.success) {
      controller_.zero_gravity();
      refused_.reset();
      action_.superseded();
    }
    return true;
  }

  bool on_go_to(anthrob_msgs::GoTo::Request& request, anthrob_msgs::GoTo::Response& response) {
    std::vector<double> posture;
    const std::optional<std::string> why = send(request, posture);
    response.success = !why;
    response.message = why.value_or("on the way");
    if (!why) action_.superseded();
    return true;
  }

  /// Sends the arm to a posture. @return why not
  template <class Request>
  std::optional<std::string> send(const Request& request, std::vector<double>& posture) {
    if (const auto why = hindrance()) return why;
    try {
      posture = posture_of(request, controller_.model(), controller_.target());
      controller_.go_to(posture, request.duration);
      refused_.reset();
      return std::nullopt;
    } catch (const BadInput& error) {
      return error.what();
    }
  }

  double distance_to(const std::vector<double>& posture) const {
    return anthrob::posture_distance(*controller_.model().skeleton, link_.state().measurement().q,
                                     posture);
  }

  void report() {
    const ros::WallTime now = ros::WallTime::now();
    const bool changed = trouble_.has_value() != reported_trouble_.has_value();
    if (!changed && (now - reported_).toSec() < 1.0) return;
    if (changed && trouble_) ROS_WARN_STREAM("no commands: " << *trouble_);
    reported_ = now;
    reported_trouble_ = trouble_;
    using diagnostic_msgs::DiagnosticStatus;
    DiagnosticStatus status;
    status.name = name_;
    status.hardware_id = controller_.model().file;
    const bool short_of = shortfall_ > 0.01 || !converged_;
    const bool at_limit = !idle_ && limited_;
    status.level = trouble_ || refused_            ? DiagnosticStatus::ERROR
                   : idle_ || short_of || at_limit ? DiagnosticStatus::WARN
                                                   : DiagnosticStatus::OK;
    status.message = trouble_   ? "no commands: " + *trouble_
                     : refused_ ? *refused_
                     : idle_    ? "the motor of " + *idle_ + " is not enabled"
                     : short_of ? "the muscles cannot deliver the torque"
                     : at_limit ? "muscle " + controller_.model().muscles[*limited_].name +
                                      " would need a position beyond its limit"
                     : controller_.holds()   ? "zero gravity"
                     : controller_.arrived() ? "holding a posture"
                                             : "on the way to a posture";
    status.values.resize(1);
    status.values[0].key =
        "shortfall [" + anthrob::torque_unit(*controller_.model().skeleton) + "]";
    status.values[0].value = std::to_string(shortfall_);
    diagnostic_msgs::DiagnosticArray array;
    array.header.stamp = link_.now();
    array.status.push_back(status);
    diagnostics_.publish(array);
  }

  std::string name_;
  anthrob::ControlSettings settings_;
  anthrob::RobotLink::Options options_;
  anthrob::ComputedForce controller_;
  anthrob::RobotLink link_;
  ros::Publisher diagnostics_;
  anthrob::GoToAction action_;
  std::vector<ros::ServiceServer> services_;
  std::optional<std::string> trouble_ = "nothing measured yet";  ///< why nothing is sent
  std::optional<std::string> reported_trouble_;
  std::optional<std::string> idle_;     ///< a muscle whose motor is not enabled
  std::optional<std::string> refused_;  ///< why the last go_to ended early, until the next request
  anthrob::ecu::Mode mode_ = anthrob::ecu::Mode::kVoltage;  ///< of the last command
  double unheeded_ = 0.0;  ///< for how long a muscle has not followed it [s]
  double shortfall_ = 0.0;
  double silent_ = 0.0;  ///< since the last command [s]
  double last_dt_ = 0.0;
  bool converged_ = true;
  bool placed_ = false;                 ///< whether muscles without force sensor were commanded
  std::optional<std::size_t> limited_;  ///< muscle whose reference ends at its position limit
  ros::WallTime reported_;
};

}  // namespace

int main(int argc, char** argv) {
  anthrob::NodeInfo info;
  info.name = "computed_force";
  info.role = anthrob::NodeInfo::Role::kCommander;
  info.purpose = "Computed-force control of the joints: zero gravity, and going to postures.";
  info.parameters = {
      {"model",
       "model that the controller computes with: a file, or a name such as anthrob/II (required)"},
      {"settings", "path of the controller's settings, such as control.yaml (required)"},
      {"lock_step", "true: the controller steps the simulator (default: false)"},
      {"steps", "with lock_step: simulation steps per control period (default: 5)"},
      {"simulator_rate",
       "without lock_step, real-time factor of the simulator that is commanded, only checked: "
       "above 0 and at most 1, since otherwise measurements come too late (default: 1)"},
  };
  return anthrob::run_node(argc, argv, info, [](ros::NodeHandle& nh, ros::NodeHandle& settings) {
    const auto model = anthrob::load_robot_model(anthrob::required_model(settings));
    const auto control = anthrob::ControlSettings::load(
        anthrob::required(settings, "settings", "a settings file"), *model);
    anthrob::RobotLink::Options options;
    options.period = 1.0 / control.rate;
    anthrob::take(settings, "lock_step", anthrob::truth_of, options.lock_step);
    anthrob::take(settings, "steps", anthrob::positive_whole_number_of, options.steps);
    double simulator_rate = 1.0;
    if (!options.lock_step) {
      anthrob::take(settings, "simulator_rate", anthrob::real_time_factor_of, simulator_rate);
    }
    ComputedForceNode(nh, model, control, options).run();
    return 0;
  });
}
