#include "anthrob_driver/emulation/rack.h"

#include "emulation/board.h"

namespace anthrob {
namespace driver {

Rack::Rack(const Hardware& hardware, Plant& plant, Bus& bus, std::uint8_t session)
    : plant_(plant), bus_(bus) {
  for (std::size_t e = 0; e < hardware.ecus.size(); ++e) {
    boards_.push_back(std::make_unique<Board>(hardware, static_cast<int>(e), session));
  }
}

Rack::~Rack() = default;

bool Rack::sync_seen() const {
  return boards_.front()->firmware().sync_seen();
}

void Rack::set_zeros() {
  for (const auto& board : boards_) board->set_zeros();
}

void Rack::receive() {
  BusEvent event;
  while (bus_.receive(event)) {
    if (event.kind != BusEvent::Kind::kFrame) continue;
    for (const auto& board : boards_) board->receive(event.frame);
  }
}

void Rack::tick() {
  for (const auto& board : boards_) board->tick(plant_);
  plant_.advance();
  for (const auto& board : boards_) {
    ecu::Frame frame;
    while (board->next_frame(frame)) bus_.send(frame);
  }
  bus_.flush();
}

}  // namespace driver
}  // namespace anthrob
