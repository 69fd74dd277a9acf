#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "anthrob_driver/emulation/memory_bus.h"
#include "anthrob_driver/emulation/rack.h"
#include "anthrob_driver/emulation/tendon_plant.h"
#include "anthrob_driver/robot_driver.h"
#include "emulation/board.h"
#include "link/ecu_link.h"
#include "routine/home.h"
#include "routine/live_gains.h"
#include "watch/bus_watch.h"
#include "watch/winding_temperature_model.h"

namespace anthrob {
namespace driver {

/// All motors are the bench's.
inline Hardware with_bench_motors(Hardware robot) {
  const TendonPlant::Parameters bench;
  for (MuscleHardware& muscle : robot.muscles) {
    muscle.resistance = bench.resistance;
    muscle.winch = {bench.constant * bench.ratio, bench.inertia * bench.ratio * bench.ratio,
                    bench.radius};
  }
  return robot;
}

/// A driver and seven emulated ECUs on a bus in memory, in simulated time: one call of step() is
/// one millisecond, the same every time. The ECUs know their zeros, as after a `home`.
class Rig {
 public:
  explicit Rig(bool hand = true, const RobotDriver::Options& options = RobotDriver::Options{})
      : Rig(load_hardware(ANTHROB_CONFIG_DIR "/anthrob/hardware.yaml", hand), options) {}
  explicit Rig(Hardware robot, const RobotDriver::Options& options = RobotDriver::Options{})
      : hardware(with_bench_motors(std::move(robot))),
        host(bus.attach()),
        ecus(bus.attach()),
        stranger(bus.attach()),
        plant(hardware),
        rack(hardware, plant, ecus),
        driver_options(options),
        period_ms(static_cast<int>(std::lround(1000.0 / options.rate))),
        modes(hardware.muscles.size(), 0),
        volts(hardware.muscles.size(), 0.5),
        driver_(std::make_unique<RobotDriver>(hardware, options, host)) {
    rack.set_zeros();
  }

  double now() const { return 0.001 * ms; }
  std::int64_t stamp() const {
    return (1000000 + ms + 1000 * clock_offset_s) * std::int64_t{1000000};
  }

  RobotDriver& driver() { return *driver_; }
  /// As after kill -9 and a new start.
  void restart_driver() {
    driver_ = std::make_unique<RobotDriver>(hardware, driver_options, host);
    driver_runs = true;
  }

  /// All ECUs are switched off and on.
  void power_cycle() {
    for (std::size_t e = 0; e < rack.size(); ++e) {
      rack.board(e).set_power(false);
      rack.board(e).set_power(true);
    }
  }

  /// One millisecond of everybody.
  void step() {
    if (driver_runs) listen();
    if (driver_runs && ms % period_ms == 0) driver().cycle(now());
    if (commander_runs && ms % 20 == 0) command();
    bus.deliver(stamp());
    rack.receive();
    rack.tick();
    bus.deliver(stamp());
    if (driver_runs) listen();
    ++ms;
  }
  void run(int milliseconds) {
    for (int i = 0; i < milliseconds; ++i) step();
  }
  void listen() {
    BusEvent event;
    while (host.receive(event)) driver().receive(event, now());
    Sample sample;
    while (driver().take_sample(sample)) samples.push_back(sample);
    AnalogSample analog;
    while (driver().take_analog(analog)) analogs.push_back(analog);
  }
  /// One command to every muscle, as a controller would send them.
  void command() {
    std::vector<std::string> names;
    for (const MuscleHardware& muscle : hardware.muscles) names.push_back(muscle.name);
    driver().command(names, modes, volts, now());
  }
  /// Until the driver is configured and enabled.
  bool enable() {
    driver().start_enable(now());
    for (int i = 0; i < 300 && driver().phase() == RobotDriver::Phase::kEnabling; ++i) step();
    return driver().phase() == RobotDriver::Phase::kEnabled;
  }
  /// Configured, enabled, all muscles pulling.
  bool start() {
    run(1000);
    if (!enable()) return false;
    commander_runs = true;
    run(200);
    return moving() == static_cast<int>(hardware.muscles.size());
  }
  /// Muscles with volts.
  int moving() const {
    int count = 0;
    for (std::size_t m = 0; m < hardware.muscles.size(); ++m) count += plant.voltage(m) != 0.0;
    return count;
  }

  Hardware hardware;
  MemoryBus bus;
  MemoryBus::Port &host, &ecus, &stranger;
  TendonPlant plant;
  Rack rack;
  RobotDriver::Options driver_options;
  int period_ms;
  std::int64_t ms = 0;
  bool driver_runs = true, commander_runs = false;
  std::vector<std::uint8_t> modes;  ///< by muscle; VOLTAGE
  std::vector<double> volts;        ///< references, by muscle; 0.5 V stall at 143 N
  std::int64_t clock_offset_s = 0;  ///< somebody set the wall clock
  std::vector<Sample> samples;
  std::vector<AnalogSample> analogs;

 private:
  std::unique_ptr<RobotDriver> driver_;
};

}  // namespace driver
}  // namespace anthrob
