#include "prediction.h"

#include <ros/time.h>

#include <string>
#include <vector>

#include "anthrob_core/text.h"
#include "anthrob_ecu/supervisor.h"
#include "anthrob_sim/conversions.h"
#include "twin/forward_model.h"
#include "twin_messages.h"

namespace anthrob {

namespace {

constexpr double kLongest = 60.0;     // [s] that is predicted
constexpr double kMostStates = 6000;  // in an answer

/// As on muscle_command, to a robot that is enabled. @throws BadInput
std::vector<twin::Order> orders_of(const anthrob_msgs::MuscleCommand& command,
                                   const RobotModel& model) {
  if (command.name.empty() && command.mode.empty() && command.reference.empty()) return {};
  ecu::Supervisor supervisor(muscle_channels(model), {0.0, true});
  std::vector<ecu::MuscleReference> accepted;
  const auto outcome =
      supervisor.command(command.name, command.mode, command.reference, 0.0, accepted);
  if (!outcome.accepted) throw BadInput("command: " + outcome.reason);
  std::vector<twin::Order> orders;
  for (const ecu::MuscleReference& one : accepted) {
    orders.push_back({one.muscle, one.mode, one.reference});
  }
  return orders;
}

twin::Outlook outlook_of(const anthrob_msgs::Predict::Request& request, const RobotModel& model) {
  if (!(request.duration > 0.0 && request.duration <= kLongest)) {
    throw BadInput("duration: " + short_number(request.duration) +
                   " s: expected a number above 0, at most " + short_number(kLongest));
  }
  if (!(request.rate >= 0.0 && request.rate * request.duration <= kMostStates)) {
    throw BadInput("rate: " + short_number(request.rate) + " Hz: expected 0 or more, and at most " +
                   short_number(kMostStates) + " states in the answer");
  }
  return {orders_of(request.command, model), static_cast<bool>(request.enable), request.duration,
          request.rate};
}

}  // namespace

anthrob_msgs::Predict::Response predict(const twin::Twins& twins,
                                        const anthrob_msgs::Predict::Request& request) {
  anthrob_msgs::Predict::Response response;
  const ros::WallTime begin = ros::WallTime::now();
  try {
    const twin::Outlook outlook = outlook_of(request, twins.model());
    const auto sim = twin::present(twins);
    ros::Time now;
    now.fromNSec(static_cast<std::uint64_t>(*twins.time()));
    const auto crossings = twin::run_ahead(*sim, outlook, [&](double time) {
      const ros::Time then = now + ros::Duration(time);
      response.muscle_states.push_back(twin_muscle_states(*sim, false, then));
      response.joint_states.push_back(joint_states(*sim, then));
      response.spherical_joint_states.push_back(spherical_joint_states(*sim, then));
    });
    for (const twin::Crossing& crossing : crossings) response.warnings.push_back(crossing.text());
    response.success = true;
    response.safe = crossings.empty();
  } catch (const BadInput& error) {
    response.message = error.what();
  } catch (const NumericalFailure& error) {
    response.message = std::string("the model fails: ") + error.what();
  }
  response.computed = (ros::WallTime::now() - begin).toSec();
  return response;
}

}  // namespace anthrob
