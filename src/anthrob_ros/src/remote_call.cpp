#include "remote_call.h"

#include <netdb.h>
#include <poll.h>
#include <ros/init.h>
#include <ros/time.h>
#include <sys/socket.h>
#include <unistd.h>
#include <xmlrpcpp/XmlRpc.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <memory>

namespace anthrob {

namespace {

struct Socket {
  int fd;
  explicit Socket(int family)
      : fd(::socket(family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {}
  ~Socket() {
    if (fd >= 0) ::close(fd);
  }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
};

double seconds_until(const ros::SteadyTime& end) {
  return std::max(0.0, (end - ros::SteadyTime::now()).toSec());
}

/// What became of a connection that was begun.
int error_of_connection(int fd, const ros::SteadyTime& end) {
  pollfd writable{fd, POLLOUT, 0};
  if (::poll(&writable, 1, static_cast<int>(std::ceil(1e3 * seconds_until(end)))) <= 0)
    return ETIMEDOUT;
  int error = 0;
  socklen_t size = sizeof(error);
  ::getsockopt(fd, SOL_SOCKET, SO_ERROR, &error, &size);
  return error;
}

/// kSilent if a connection can be made. XmlRpcClient does not tell why it failed.
Reach try_connection(const std::string& host, std::uint32_t port, const ros::SteadyTime& end) {
  // Without a descriptor no name is resolved either.
  if (Socket(AF_INET).fd < 0) return Reach::kNoDescriptor;
  addrinfo hints{}, *found = nullptr;
  hints.ai_socktype = SOCK_STREAM;
  if (::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &found) != 0)
    return Reach::kUnreachable;
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> owner(found, &::freeaddrinfo);
  bool refused = true;
  for (const addrinfo* address = found; address != nullptr; address = address->ai_next) {
    const Socket socket(address->ai_family);
    if (socket.fd < 0) continue;
    int error = ::connect(socket.fd, address->ai_addr, address->ai_addrlen) == 0 ? 0 : errno;
    if (error == EINPROGRESS) error = error_of_connection(socket.fd, end);
    if (error == 0) return Reach::kSilent;
    refused = refused && error == ECONNREFUSED;
  }
  return refused ? Reach::kRefused : Reach::kUnreachable;
}

}  // namespace

Reply remote_call(const std::string& host, std::uint32_t port, const std::string& method,
                  const XmlRpc::XmlRpcValue& arguments, double patience) {
  const ros::SteadyTime end = ros::SteadyTime::now() + ros::WallDuration(patience);
  Reply reply;
  reply.reach = try_connection(host, port, end);
  if (reply.reach != Reach::kSilent) return reply;
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
  if (!client.executeNonBlock(method.c_str(), arguments)) return reply;
  XmlRpc::XmlRpcDispatch dispatch;
  dispatch.addSource(&client,
                     XmlRpc::XmlRpcDispatch::WritableEvent | XmlRpc::XmlRpcDispatch::Exception);
  while (client.getfd() >= 0 && ros::SteadyTime::now() < end && !ros::isShuttingDown()) {
    dispatch.work(0.05);
    if (!client.executeCheckDone(reply.value)) continue;
    reply.reach = reply.value.valid() ? Reach::kAnswered : Reach::kBroken;
    return reply;
  }
  dispatch.removeSource(&client);
  return reply;
}

std::optional<XmlRpc::XmlRpcValue> payload_of(const Reply& reply) {
  using XmlRpc::XmlRpcValue;
  if (reply.reach != Reach::kAnswered) return std::nullopt;
  XmlRpcValue answer = reply.value;
  if (answer.getType() != XmlRpcValue::TypeArray || answer.size() != 3) return std::nullopt;
  if (answer[0].getType() != XmlRpcValue::TypeInt || static_cast<int>(answer[0]) != 1)
    return std::nullopt;
  return answer[2];
}

}  // namespace anthrob
