#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "anthrob_driver/bus/bus.h"

namespace anthrob {
namespace driver {

/// A Linux CAN interface through PF_CAN raw sockets: kernel time stamps, error frames, echoes of
/// our own frames, many frames a system call. STOP goes out with the highest
/// priority, so that it overtakes what waits in the interface's queue.
class SocketCanBus final : public Bus {
 public:
  /// @param interface such as "can0"; may be down or missing: recover() waits for it
  /// @throws std::runtime_error if this kernel has no CAN sockets; BadInput if the interface is
  ///   not a CAN interface
  explicit SocketCanBus(const std::string& interface);
  ~SocketCanBus() override;
  SocketCanBus(const SocketCanBus&) = delete;
  SocketCanBus& operator=(const SocketCanBus&) = delete;

  SendResult send(const ecu::Frame& frame) override;
  SendResult flush() override;
  bool receive(BusEvent& event) override;
  void recover() override;

  /// To wait on; none while the interface is missing. Changes with recover().
  std::optional<int> descriptor() const {
    if (socket_ < 0) return std::nullopt;
    return socket_;
  }
  /// How often it was opened: a new socket may have the number of the one before.
  std::uint64_t openings() const { return openings_; }

 private:
  static constexpr std::size_t kBatch = 64;  ///< frames in one system call
  struct Batch;

  SendResult send_urgently(const void* raw);
  SendResult give_up_or_wait();
  bool fetch();
  bool open_interface();
  void close_socket();
  void lose();
  bool interface_is_up() const;

  std::string interface_;
  int socket_ = -1;
  std::uint64_t openings_ = 0;
  bool up_ = false, reported_up_ = true;
  bool lost_ = false;          ///< since the last look of receive()
  std::uint32_t dropped_ = 0;  ///< frames that found the socket's queue full, as far as reported
  std::unique_ptr<Batch> out_, in_;
};

}  // namespace driver
}  // namespace anthrob
