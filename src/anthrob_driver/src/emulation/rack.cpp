#include "anthrob_driver/emulation/rack.h"

namespace anthrob {
namespace driver {

Rack::Rack(const Hardware& hardware, Plant& plant, Bus& bus, std::uint8_t session)
    : plant_(plant), bus_(bus) {
  for (std::size_t e = 0; e < hardware.ecus.size(); ++e) {
    boards_.emplace_back(hardware, static_cast<int>(e), session);
  }
}

void Rack::set_zeros() {
  for (Board& board : boards_) board.set_zeros();
}

void Rack::receive() {
  BusEvent event;
  while (bus_.receive(event)) {
    if (event.kind != BusEvent::Kind::kFrame) continue;
    for (Board& board : boards_) board.receive(event.frame);
  }
}

void Rack::tick() {
  for (Board& board : boards_) board.tick(plant_);
  plant_.advance();
  for (Board& board : boards_) {
    ecu::Frame frame;
    while (board.next_frame(frame)) bus_.send(frame);
  }
  bus_.flush();
}

}  // namespace driver
}  // namespace anthrob
