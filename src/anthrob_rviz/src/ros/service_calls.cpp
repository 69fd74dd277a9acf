#include "ros/service_calls.h"

#include <anthrob_msgs/SetRate.h>
#include <anthrob_msgs/Snapshot.h>
#include <anthrob_msgs/Step.h>
#include <ros/service.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

namespace anthrob {
namespace {

template <class Service>
CallResult result_of(const std::string& name, const std::string& service, Service call) {
  if (!ros::service::exists(name, false)) return {service, false, "there is no service " + name};
  if (!ros::service::call(name, call)) return {service, false, "the call failed"};
  return {service, static_cast<bool>(call.response.success), call.response.message};
}

}  // namespace

TimedCalls::Call call_of(const std::string& name, const ServiceRequest& request) {
  const std::string& service = request.service;
  if (service == "sim/pause") {
    std_srvs::SetBool pause;
    pause.request.data = request.pause;
    return [=] { return result_of(name, service, pause); };
  }
  if (service == "sim/step") {
    anthrob_msgs::Step step;
    step.request.steps = static_cast<std::uint32_t>(request.steps);
    return [=] { return result_of(name, service, step); };
  }
  if (service == "sim/set_rate") {
    anthrob_msgs::SetRate rate;
    rate.request.factor = request.factor;
    return [=] { return result_of(name, service, rate); };
  }
  if (service == "sim/save" || service == "sim/restore") {
    anthrob_msgs::Snapshot snapshot;
    snapshot.request.name = request.name;
    return [=] { return result_of(name, service, snapshot); };
  }
  return [=] { return result_of(name, service, std_srvs::Trigger()); };
}

}  // namespace anthrob
