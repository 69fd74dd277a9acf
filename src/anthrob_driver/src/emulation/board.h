#pragma once

#include "anthrob_driver/emulation/plant.h"
#include "anthrob_driver/hardware.h"
#include "anthrob_ecu/firmware/firmware.h"

namespace anthrob {
namespace driver {

/// An emulated circuit board: a processor with firmware, converters that turn the plant's values
/// into counts, power stages, and the hardware watchdog that switches these off and resets the
/// processor when ticks stop.
class Board {
 public:
  /// [ticks] the hardware watchdog waits
  static constexpr int kHardwareWatchdog = 5;

  /// @param hardware must outlive the board   @param ecu index in Hardware::ecus
  /// @param session what the first boot draws its session from
  Board(const Hardware& hardware, int ecu, std::uint8_t session = 0);

  /// As Rack::set_zeros.
  void set_zeros();
  /// A frame on the bus.
  void receive(const ecu::Frame& frame);
  /// One millisecond; drives the plant, does not advance it.
  void tick(Plant& plant);
  bool next_frame(ecu::Frame& frame);

  /// The processor stops in the middle of everything: no ticks, no frames.
  void freeze(bool frozen);
  /// Off: as if unplugged. On: boots with another session and without parameters and zero.
  void set_power(bool on);

  const ecu::Firmware& firmware() const { return firmware_; }
  /// What the board's peripherals read besides the plant; tests break things here.
  struct Peripherals {
    /// Of the first muscle. kCut: stands where it was; kFlickers: and toggles by a count
    enum class Encoder { kCounts, kCut, kFlickers } encoder = Encoder::kCounts;
    double supply = 12.0;
    int temperature = 30;
    bool force_sensor_cut = false;
    bool force_sensor_stuck = false;  ///< both muscles' stand where they were
    bool potentiometer_cut = false;
    bool bus_off = false;
  } peripherals;

 private:
  ecu::Readings read(const Plant& plant);
  std::int32_t count(double position, double scale);
  void boot();

  const Hardware& hardware_;
  int ecu_;
  ecu::Wiring wiring_;
  ecu::Firmware firmware_;
  bool powered_ = true, frozen_ = false;
  int unfed_ = 0;
  std::int32_t counted_ = 0;  ///< by the first muscle's encoder, before it was cut
  bool flicker_ = false;
  std::uint16_t force_[ecu::kMusclesPerEcu] = {};  ///< [count] read last
};

}  // namespace driver
}  // namespace anthrob
