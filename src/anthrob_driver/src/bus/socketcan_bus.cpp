#include "anthrob_driver/bus/socketcan_bus.h"

#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <net/if_arp.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "anthrob_core/errors.h"
#include "bus/error_frame.h"

namespace anthrob {
namespace driver {

namespace {

/// Bands of the queue of an interface (pfifo_fast): 6 is served before 0, and needs no privilege as
/// 7 would.
constexpr int kOrdinary = 0, kUrgent = 6;

/// To ask the kernel about an interface.
ifreq request_for(const std::string& interface) {
  ifreq request{};
  std::strncpy(request.ifr_name, interface.c_str(), IFNAMSIZ - 1);
  return request;
}

int open_socket(unsigned index) {
  const int fd = ::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW);
  if (fd < 0) return -1;
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(index);
  if (::bind(fd, reinterpret_cast<sockaddr*>(&address), sizeof(address)) != 0) {
    ::close(fd);
    return -1;
  }
  return fd;
}

template <class T>
void option(int fd, int level, int name, const T& value) {
  ::setsockopt(fd, level, name, &value, sizeof(value));
}

/// What the kernel tells beside a frame.
struct Beside {
  std::int64_t stamp_ns = 0;
  std::uint32_t dropped = 0;  ///< frames, since the socket is open, that found its queue full
};

template <class T>
T content_of(const cmsghdr* message) {
  T value;
  std::memcpy(&value, CMSG_DATA(message), sizeof(value));
  return value;
}

Beside beside(msghdr& message) {
  Beside told;
  for (cmsghdr* c = CMSG_FIRSTHDR(&message); c != nullptr; c = CMSG_NXTHDR(&message, c)) {
    if (c->cmsg_level != SOL_SOCKET) continue;
    if (c->cmsg_type == SCM_TIMESTAMPNS) {
      const auto time = content_of<timespec>(c);
      told.stamp_ns = static_cast<std::int64_t>(time.tv_sec) * 1000000000 + time.tv_nsec;
    } else if (c->cmsg_type == SO_RXQ_OVFL) {
      told.dropped = content_of<std::uint32_t>(c);
    }
  }
  return told;
}

}  // namespace

/// Frames that go to or come from the kernel together.
struct SocketCanBus::Batch {
  can_frame frames[kBatch]{};
  iovec vectors[kBatch]{};
  mmsghdr messages[kBatch]{};
  alignas(cmsghdr) char controls[kBatch][CMSG_SPACE(sizeof(timespec)) + 64]{};
  std::size_t count = 0, next = 0;

  Batch() {
    for (std::size_t i = 0; i < kBatch; ++i) {
      vectors[i] = {&frames[i], sizeof(can_frame)};
      messages[i].msg_hdr.msg_iov = &vectors[i];
      messages[i].msg_hdr.msg_iovlen = 1;
    }
  }
  /// The kernel overwrites lengths.
  void rearm() {
    for (std::size_t i = 0; i < kBatch; ++i) {
      messages[i].msg_hdr.msg_control = controls[i];
      messages[i].msg_hdr.msg_controllen = sizeof(controls[i]);
    }
  }
};

SocketCanBus::SocketCanBus(const std::string& interface)
    : interface_(interface), out_(std::make_unique<Batch>()), in_(std::make_unique<Batch>()) {
  if (interface.empty() || interface.size() >= IFNAMSIZ) {
    throw BadInput("CAN interface '" + interface + "': expected a name such as can0");
  }
  const int probe = ::socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC, CAN_RAW);
  if (probe < 0) {
    throw std::runtime_error("CAN sockets: " + std::string(std::strerror(errno)) +
                             "; this kernel lacks can_raw (modprobe can_raw)");
  }
  ifreq request = request_for(interface);
  const bool exists = ::ioctl(probe, SIOCGIFHWADDR, &request) == 0;
  ::close(probe);
  if (exists && request.ifr_hwaddr.sa_family != ARPHRD_CAN) {
    throw BadInput("CAN interface '" + interface +
                   "': expected a CAN interface, not one of another kind");
  }
  recover();
}

SocketCanBus::~SocketCanBus() {
  close_socket();
}

bool SocketCanBus::interface_is_up() const {
  const int probe = ::socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC, CAN_RAW);
  ifreq request = request_for(interface_);
  const bool up = ::ioctl(probe, SIOCGIFFLAGS, &request) == 0 && (request.ifr_flags & IFF_UP) != 0;
  ::close(probe);
  return up;
}

bool SocketCanBus::open_interface() {
  const unsigned index = ::if_nametoindex(interface_.c_str());
  if (index == 0) return false;
  socket_ = open_socket(index);
  if (socket_ < 0) return false;
  ++openings_;
  option(socket_, SOL_SOCKET, SO_TIMESTAMPNS, int{1});
  option(socket_, SOL_CAN_RAW, CAN_RAW_RECV_OWN_MSGS, int{1});
  // That a frame waited for one of higher priority is no error.
  option(socket_, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, can_err_mask_t{CAN_ERR_MASK & ~CAN_ERR_LOSTARB});
  option(socket_, SOL_SOCKET, SO_RXQ_OVFL, int{1});
  dropped_ = 0;
  // Bursts of a whole cycle must fit, whatever the scheduler does.
  option(socket_, SOL_SOCKET, SO_RCVBUF, int{1 << 20});
  option(socket_, SOL_SOCKET, SO_PRIORITY, kOrdinary);
  return true;
}

void SocketCanBus::close_socket() {
  if (socket_ >= 0) ::close(socket_);
  socket_ = -1;
}

void SocketCanBus::lose() {
  close_socket();
  up_ = false;
  lost_ = true;
}

void SocketCanBus::recover() {
  if (up_) return;
  // A socket bound to an interface that was removed stays dead; only a new one helps.
  close_socket();
  up_ = interface_is_up() && open_interface();
}

SendResult SocketCanBus::give_up_or_wait() {
  if (errno == ENOBUFS || errno == EAGAIN || errno == EINTR) return SendResult::kQueueFull;
  lose();
  return SendResult::kDown;
}

SendResult SocketCanBus::send(const ecu::Frame& frame) {
  if (!up_) return SendResult::kDown;
  can_frame raw{};
  raw.can_id = frame.id;
  raw.can_dlc = frame.length;
  std::memcpy(raw.data, frame.data.data(), 8);
  if (frame.id == 0) return send_urgently(&raw);
  out_->frames[out_->count++] = raw;
  return out_->count == kBatch ? flush() : SendResult::kSent;
}

SendResult SocketCanBus::send_urgently(const void* raw) {
  // Not through a second socket: its frames would come in here as somebody else's.
  option(socket_, SOL_SOCKET, SO_PRIORITY, kUrgent);
  const bool sent = ::write(socket_, raw, sizeof(can_frame)) == sizeof(can_frame);
  const SendResult result = sent ? SendResult::kSent : give_up_or_wait();
  if (up_) option(socket_, SOL_SOCKET, SO_PRIORITY, kOrdinary);
  return result;
}

SendResult SocketCanBus::flush() {
  const unsigned count = static_cast<unsigned>(out_->count);
  out_->count = 0;
  if (!up_) return SendResult::kDown;
  for (unsigned done = 0; done < count;) {
    const int sent = ::sendmmsg(socket_, out_->messages + done, count - done, 0);
    // What did not fit is dropped: by the time there is room it would be old.
    if (sent <= 0) return give_up_or_wait();
    done += static_cast<unsigned>(sent);
  }
  return SendResult::kSent;
}

bool SocketCanBus::fetch() {
  in_->next = in_->count = 0;
  in_->rearm();
  const int got = ::recvmmsg(socket_, in_->messages, kBatch, 0, nullptr);
  if (got < 0) {
    if (errno != EAGAIN && errno != EINTR) lose();
    return false;
  }
  in_->count = static_cast<std::size_t>(got);
  return got > 0;
}

bool SocketCanBus::receive(BusEvent& event) {
  using Kind = BusEvent::Kind;
  if (in_->next == in_->count && up_) fetch();
  if (in_->next == in_->count) {
    // One that was lost and is back already was down all the same: sends have failed.
    const bool up = up_ && !std::exchange(lost_, false);
    if (up == reported_up_) return false;
    reported_up_ = up;
    event = {up ? Kind::kUp : Kind::kDown, {}, 0};
    return true;
  }
  const can_frame& raw = in_->frames[in_->next];
  mmsghdr& message = in_->messages[in_->next];
  const Beside told = beside(message.msg_hdr);
  if (told.dropped != dropped_) {
    dropped_ = told.dropped;
    event = {Kind::kReceiveOverrun, {}, told.stamp_ns};
    return true;
  }
  ++in_->next;
  event = {Kind::kFrame, {}, told.stamp_ns};
  if (raw.can_id & CAN_ERR_FLAG) {
    event.kind = kind_of_error(raw.can_id, raw.data[1]);
  } else if (message.msg_len != sizeof(raw) || (raw.can_id & (CAN_EFF_FLAG | CAN_RTR_FLAG)) ||
             raw.can_dlc > 8) {
    event.kind = Kind::kForeign;
  } else {
    event.frame.id = static_cast<std::uint16_t>(raw.can_id & CAN_SFF_MASK);
    event.frame.length = raw.can_dlc;
    std::memcpy(event.frame.data.data(), raw.data, raw.can_dlc);
    if (message.msg_hdr.msg_flags & MSG_CONFIRM) event.kind = Kind::kEcho;
  }
  return true;
}

}  // namespace driver
}  // namespace anthrob
