#pragma once

#include <ros/ros.h>

#include <functional>
#include <string>
#include <utility>

#include "anthrob_ros/bounded_message.h"

namespace anthrob {

/// Warns that a message was refused, once a second of wall time at most: simulated time may stand
/// still, and whoever sends nonsense sends it often.
class RefusalWarning {
 public:
  explicit RefusalWarning(std::string what) : what_(std::move(what)) {}
  void warn(const std::string& why);

 private:
  std::string what_;
  ros::SteadyTime last_;
};

/// NodeHandle::subscribe, for messages with lists (bounded_message.h). What is malformed is warned
/// of and never reaches `accept`.
/// @param accept called with the message and the name of the node that sent it
/// @param refuse for counting; may be empty
template <class M, class Accept>
ros::Subscriber subscribe_bounded(ros::NodeHandle& nh, const std::string& topic,
                                  std::uint32_t queue_size, Accept accept,
                                  std::function<void(const std::string& why)> refuse = {},
                                  const ros::TransportHints& hints = {}) {
  const auto warning = std::make_shared<RefusalWarning>(topic);
  using Event = ros::MessageEvent<const Bounded<M>>;
  const boost::function<void(const Event&)> receive = [=](const Event& event) {
    const Bounded<M>& received = *event.getConstMessage();
    if (received.refusal) {
      warning->warn(*received.refusal);
      if (refuse) refuse(*received.refusal);
    } else {
      accept(received.message, event.getPublisherName());
    }
  };
  ros::SubscribeOptions options;
  options.initByFullCallbackType<const Event&>(topic, queue_size, receive);
  options.transport_hints = hints;
  return nh.subscribe(options);
}

/// NodeHandle::advertiseService, for requests with lists. The answer to what is malformed is
/// `success` false and the reason as `message`.
/// @param Service with `success` and `message` in its answer
template <class Service>
ros::ServiceServer advertise_bounded(
    ros::NodeHandle& nh, const std::string& name,
    std::function<bool(typename Service::Request&, typename Service::Response&)> serve) {
  using Request = Bounded<typename Service::Request>;
  using Response = typename Service::Response;
  const boost::function<bool(Request&, Response&)> receive = [=](Request& request,
                                                                 Response& response) {
    if (!request.refusal) return serve(request.message, response);
    response.success = false;
    response.message = *request.refusal;
    return true;
  };
  return nh.advertiseService<Request, Response>(name, receive);
}

}  // namespace anthrob
