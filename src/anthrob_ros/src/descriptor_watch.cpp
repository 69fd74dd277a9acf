#include "anthrob_ros/descriptor_watch.h"

#include <fcntl.h>
#include <linux/tcp.h>
#include <netinet/in.h>
#include <poll.h>
#include <ros/connection_manager.h>
#include <ros/console.h>
#include <ros/init.h>
#include <ros/time.h>
#include <ros/xmlrpc_manager.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <vector>

#include "anthrob_core/monotonic_clock.h"

namespace anthrob {

namespace {

constexpr rlim_t kMostDescriptors = 8192;
constexpr std::chrono::milliseconds kLookPeriod(200);
constexpr double kScarceTime = 2.0;       // [s]
constexpr std::uint32_t kIdleAge = 1000;  // [ms]

std::size_t descriptor_limit() {
  rlimit limit{};
  ::getrlimit(RLIMIT_NOFILE, &limit);
  return std::min<rlim_t>(limit.rlim_cur, 1 << 20);
}

std::vector<pollfd> all_descriptors() {
  std::vector<pollfd> all(descriptor_limit());
  for (std::size_t fd = 0; fd < all.size(); ++fd) all[fd].fd = static_cast<int>(fd);
  ::poll(all.data(), all.size(), 0);
  return all;
}

bool is_open(const pollfd& descriptor) {
  return (descriptor.revents & POLLNVAL) == 0;
}

/// Looks at descriptors of other threads, which may close them and use their numbers again at any
/// time. This one stays the same connection while it is looked at, and needs no free descriptor.
class Hand {
 public:
  Hand() : nothing_(::open("/dev/null", O_RDONLY | O_CLOEXEC)), held_(::dup(nothing_)) {}
  ~Hand() {
    ::close(held_);
    ::close(nothing_);
  }
  Hand(const Hand&) = delete;
  Hand& operator=(const Hand&) = delete;

  /// @return the same connection; that of before is let go
  int take(int fd) {
    if (fd == held_ || fd == nothing_ || ::dup3(fd, held_, O_CLOEXEC) < 0) release();
    return held_;
  }
  void release() { ::dup3(nothing_, held_, O_CLOEXEC); }

 private:
  int nothing_, held_;
};

std::optional<std::uint32_t> local_port(int fd) {
  sockaddr_storage address{};
  socklen_t size = sizeof(address);
  if (::getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size) != 0) return std::nullopt;
  if (address.ss_family == AF_INET)
    return ntohs(reinterpret_cast<const sockaddr_in&>(address).sin_port);
  if (address.ss_family == AF_INET6)
    return ntohs(reinterpret_cast<const sockaddr_in6&>(address).sin6_port);
  return std::nullopt;
}

bool is_of_a_server(int fd) {
  const auto port = local_port(fd);
  int listening = 0;
  socklen_t size = sizeof(listening);
  ::getsockopt(fd, SOL_SOCKET, SO_ACCEPTCONN, &listening, &size);
  return port && listening == 0 &&
         (*port == ros::ConnectionManager::instance()->getTCPPort() ||
          *port == ros::XMLRPCManager::instance()->getServerPort());
}

bool never_spoke(int fd) {
  tcp_info info{};
  socklen_t size = sizeof(info);
  if (::getsockopt(fd, IPPROTO_TCP, TCP_INFO, &info, &size) != 0) return false;
  return info.tcpi_bytes_received == 0 && info.tcpi_last_data_recv >= kIdleAge;
}

/// Two descriptors are kept for it from the start.
Hand& hand() {
  static Hand the_hand;
  return the_hand;
}

}  // namespace

void raise_descriptor_limit() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  limit.rlim_cur = std::min(limit.rlim_max, kMostDescriptors);
  ::setrlimit(RLIMIT_NOFILE, &limit);
}

std::size_t free_descriptors() {
  const std::vector<pollfd> all = all_descriptors();
  return all.size() - static_cast<std::size_t>(std::count_if(all.begin(), all.end(), is_open));
}

std::size_t shut_down_idle_connections() {
  std::size_t count = 0;
  for (const pollfd& descriptor : all_descriptors()) {
    if (!is_open(descriptor)) continue;
    const int fd = hand().take(descriptor.fd);
    if (!is_of_a_server(fd) || !never_spoke(fd)) continue;
    ::shutdown(fd, SHUT_RDWR);  // roscpp then closes it
    ++count;
  }
  hand().release();
  return count;
}

DescriptorWatch::DescriptorWatch(Scarce scarce) : on_scarce_(std::move(scarce)) {
  hand();
  thread_ = std::thread([this] { watch(); });
}

DescriptorWatch::~DescriptorWatch() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    quit_ = true;
  }
  ended_.notify_all();
  thread_.join();
}

void DescriptorWatch::watch() {
  for (;;) {
    {
      std::unique_lock<std::mutex> lock(mutex_);
      if (ended_.wait_for(lock, kLookPeriod, [this] { return quit_; })) return;
    }
    if (!ros::isShuttingDown()) look();
  }
}

void DescriptorWatch::look() {
  const std::size_t left = free_descriptors();
  const double now = monotonic_now();
  if (left >= kReserve) {
    since_.reset();
    told_ = false;
    return;
  }
  if (!since_) since_ = now;
  const std::size_t idle = shut_down_idle_connections();
  if (idle > 0) {
    ROS_WARN_STREAM("hardly any file descriptors were left: " << idle
                                                              << " idle connections shut down");
  }
  if (told_ || now - *since_ < kScarceTime) return;
  told_ = true;
  on_scarce_("only " + std::to_string(left) + " of " + std::to_string(descriptor_limit()) +
             " file descriptors are free, less than " + std::to_string(kReserve));
}

}  // namespace anthrob
