#include "emulation/board.h"

#include <cmath>

namespace anthrob {
namespace driver {

namespace {

ecu::Wiring wiring_of(const EcuHardware& ecu, std::uint8_t session) {
  ecu::Wiring wiring;
  wiring.node = ecu.node;
  wiring.muscles = static_cast<int>(ecu.muscles.size());
  wiring.analogs = ecu.analogs;
  wiring.session = static_cast<std::uint8_t>(17 * ecu.node + session);
  return wiring;
}

}  // namespace

Board::Board(const Hardware& hardware, int ecu, std::uint8_t session)
    : hardware_(hardware),
      ecu_(ecu),
      wiring_(wiring_of(hardware.ecus[static_cast<std::size_t>(ecu)], session)),
      firmware_(wiring_) {}

void Board::receive(const ecu::Frame& frame) {
  if (powered_ && !frozen_ && !peripherals.bus_off) firmware_.receive(frame);
}

bool Board::next_frame(ecu::Frame& frame) {
  return powered_ && !frozen_ && !peripherals.bus_off && firmware_.next_frame(frame);
}

void Board::set_zeros() {
  for (int channel = 0; channel < wiring_.muscles; ++channel) {
    ecu::ParameterMessage zero;
    zero.write = true;
    zero.muscle = static_cast<std::uint8_t>(channel);
    zero.index = ecu::kPresentPosition;
    firmware_.receive(ecu::encode_parameter_request(zero, wiring_.node));
  }
  // Nobody asked: nobody wants the answers.
  ecu::Frame answer;
  while (firmware_.next_frame(answer)) {
  }
}

void Board::boot() {
  ++wiring_.session;
  firmware_ = ecu::Firmware(wiring_);
}

void Board::set_power(bool on) {
  if (on && !powered_) {
    boot();
    frozen_ = false;
  }
  powered_ = on;
}

void Board::freeze(bool frozen) {
  // A processor that did not feed its watchdog was reset by it.
  if (frozen_ && !frozen && unfed_ >= kHardwareWatchdog) boot();
  frozen_ = frozen;
}

std::int32_t Board::count(double position, double scale) {
  using Encoder = Peripherals::Encoder;
  if (peripherals.encoder == Encoder::kCounts) {
    counted_ = static_cast<std::int32_t>(std::lround(position / scale));
  }
  flicker_ = peripherals.encoder == Encoder::kFlickers && !flicker_;
  return counted_ + flicker_;
}

ecu::Readings Board::read(const Plant& plant) {
  ecu::Readings readings;
  const EcuHardware& own = hardware_.ecus[static_cast<std::size_t>(ecu_)];
  for (std::size_t c = 0; c < own.muscles.size(); ++c) {
    const auto index = static_cast<std::size_t>(own.muscles[c]);
    const MuscleHardware& wired = hardware_.muscles[index];
    const Plant::Muscle truth = plant.muscle(index);
    ecu::MuscleReadings& r = readings.muscle[c];
    r.encoder = c == 0
                    ? count(truth.position, wired.encoder_scale)
                    : static_cast<std::int32_t>(std::lround(truth.position / wired.encoder_scale));
    r.current = static_cast<std::uint16_t>(wired.current.count(truth.current));
    if (!peripherals.force_sensor_stuck) {
      force_[c] = static_cast<std::uint16_t>(wired.force.count(truth.force));
    }
    r.force = peripherals.force_sensor_cut ? std::uint16_t{0} : force_[c];
    r.temperature = peripherals.temperature;
  }
  for (std::size_t j = 0; j < hardware_.joints.size(); ++j) {
    const JointSensor& joint = hardware_.joints[j];
    if (joint.ecu != ecu_) continue;
    readings.analog[static_cast<std::size_t>(joint.input)] =
        peripherals.potentiometer_cut
            ? std::uint16_t{0}
            : static_cast<std::uint16_t>(joint.sensor.count(plant.joint(j)));
  }
  for (std::size_t t = 0; t < hardware_.touch.size(); ++t) {
    const TouchSensor& touch = hardware_.touch[t];
    if (touch.ecu != ecu_) continue;
    readings.analog[static_cast<std::size_t>(touch.input)] =
        static_cast<std::uint16_t>(touch.sensor.count(plant.touch(t)));
  }
  readings.supply = peripherals.supply;
  readings.bus_off = peripherals.bus_off;
  return readings;
}

void Board::tick(Plant& plant) {
  const EcuHardware& own = hardware_.ecus[static_cast<std::size_t>(ecu_)];
  const auto drive = [&](std::size_t channel, double volts) {
    plant.drive(static_cast<std::size_t>(own.muscles[channel]), volts);
  };
  if (!powered_ || frozen_) {
    // Without power the stage is off at once; without ticks its hardware watchdog drops it.
    if (!powered_ || ++unfed_ >= kHardwareWatchdog) {
      for (std::size_t c = 0; c < own.muscles.size(); ++c) drive(c, 0.0);
    }
    return;
  }
  unfed_ = 0;
  const auto volts = firmware_.tick(read(plant));
  for (std::size_t c = 0; c < own.muscles.size(); ++c) drive(c, volts[c]);
}

}  // namespace driver
}  // namespace anthrob
