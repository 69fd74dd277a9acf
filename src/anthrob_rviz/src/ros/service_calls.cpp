#include "ros/service_calls.h"

#include <anthrob_msgs/Gains.h>
#include <anthrob_msgs/Seek.h>
#include <anthrob_msgs/SetRate.h>
#include <anthrob_msgs/Snapshot.h>
#include <anthrob_msgs/Step.h>
#include <ros/service.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <algorithm>

namespace anthrob {
namespace {

template <class Service>
CallResult result_of(const std::string& name, const std::string& service, Service call) {
  if (!ros::service::exists(name, false)) return {service, false, "there is no service " + name};
  if (!ros::service::call(name, call)) return {service, false, "the call failed"};
  return {service, static_cast<bool>(call.response.success), call.response.message};
}

CallResult result_of_gains(const std::string& name, anthrob_msgs::Gains call) {
  CallResult result;
  result.service = "gains";
  if (!ros::service::exists(name, false)) {
    result.message = "there is no service " + name;
  } else if (!ros::service::call(name, call)) {
    result.message = "the call failed";
  } else {
    const auto& held = call.response;
    result.success = held.success != 0;
    result.message = held.message;
    const std::size_t count =
        std::min({held.held_muscle.size(), held.held_gain.size(), held.held_value.size()});
    for (std::size_t i = 0; i < count; ++i) {
      result.gains.push_back({held.held_muscle[i], held.held_gain[i], held.held_value[i]});
    }
  }
  return result;
}

}  // namespace

TimedCalls::Call call_of(const std::string& name, const ServiceRequest& request) {
  const std::string& service = request.service;
  if (service == "sim/pause" || service == "player/pause") {
    std_srvs::SetBool pause;
    pause.request.data = request.pause;
    return [=] { return result_of(name, service, pause); };
  }
  if (service == "sim/step") {
    anthrob_msgs::Step step;
    step.request.steps = static_cast<std::uint32_t>(request.steps);
    return [=] { return result_of(name, service, step); };
  }
  if (service == "sim/set_rate" || service == "player/set_rate") {
    anthrob_msgs::SetRate rate;
    rate.request.factor = request.factor;
    return [=] { return result_of(name, service, rate); };
  }
  if (service == "player/seek") {
    anthrob_msgs::Seek seek;
    seek.request.position = request.position;
    return [=] { return result_of(name, service, seek); };
  }
  if (service == "sim/save" || service == "sim/restore") {
    anthrob_msgs::Snapshot snapshot;
    snapshot.request.name = request.name;
    return [=] { return result_of(name, service, snapshot); };
  }
  if (service == "gains") {
    anthrob_msgs::Gains gains;
    for (const Gain& gain : request.gains) {
      gains.request.muscle.push_back(gain.muscle);
      gains.request.gain.push_back(gain.name);
      gains.request.value.push_back(gain.value);
    }
    return [=] { return result_of_gains(name, gains); };
  }
  return [=] { return result_of(name, service, std_srvs::Trigger()); };
}

}  // namespace anthrob
