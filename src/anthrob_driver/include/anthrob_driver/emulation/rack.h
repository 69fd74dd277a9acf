#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "anthrob_driver/bus/bus.h"
#include "anthrob_driver/emulation/plant.h"
#include "anthrob_driver/hardware.h"

namespace anthrob {
namespace driver {

class Board;

/// All ECUs of a robot in software, on one plant and one bus.
class Rack {
 public:
  /// @param hardware, plant, bus must outlive the rack
  /// @param session what the first boots draw their sessions from
  Rack(const Hardware& hardware, Plant& plant, Bus& bus, std::uint8_t session = 0);
  ~Rack();

  /// Gives every ECU the zero of the plant, as a `home` that found it would: the present positions
  /// count as 0 rad. For comparisons with a simulator; ECUs that were just switched on have no
  /// zero.
  void set_zeros();
  /// Hands out what came in from the bus.
  void receive();
  /// One millisecond: boards tick, the plant moves, what is to be sent is sent.
  void tick();

  /// Whether a driver has ever sent a valid SYNC.
  bool sync_seen() const;
  /// For tests, which break things there.
  Board& board(std::size_t ecu) { return *boards_[ecu]; }
  std::size_t size() const { return boards_.size(); }

 private:
  Plant& plant_;
  Bus& bus_;
  std::vector<std::unique_ptr<Board>> boards_;
};

}  // namespace driver
}  // namespace anthrob
