// Checks a CAN bus: how long answers take, which are missing, how loaded the bus is. With --emulate
// the ECUs run in software in this process, so that an adapter or a vcan can be tried without a
// robot. On a real robot this is not read-only: nothing is enabled and nothing is cleared, but ECUs
// that hold another configuration get that of hardware.yaml.
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <iostream>
#include <memory>
#include <thread>

#include "anthrob_core/command_line.h"
#include "anthrob_core/errors.h"
#include "anthrob_core/monotonic_clock.h"
#include "anthrob_driver/emulation/emulator.h"
#include "anthrob_driver/emulation/tendon_plant.h"
#include "anthrob_driver/realtime.h"
#include "bus/bit_count.h"
#include "thread/driver_thread.h"
#include "watch/bus_watch.h"

namespace anthrob {
namespace driver {
namespace {

struct Arguments {
  std::string can = "can0", hardware;
  double seconds = 10.0, rate = 200.0, pace = 1.0;
  bool emulate = false, physical = false, hand = true, realtime = false;
};

/// Bits a second on the wire in a steady, enabled robot.
struct Load {
  double plain = 0.0, worst = 0.0;
};

Load calculated_load(const Hardware& hardware, double rate) {
  Load load;
  const auto add = [&load](const ecu::Frame& frame, double times) {
    const BitCount bits = count_bits(frame);
    load.plain += bits.plain * times;
    load.worst += bits.worst * times;
  };
  add(ecu::encode(ecu::Sync{}), rate);
  for (const EcuHardware& ecu : hardware.ecus) {
    add(ecu::encode(ecu::Reference{}, ecu.node), rate);
    add(ecu::encode(ecu::Motion{}, ecu.node, 0), rate * static_cast<double>(ecu.muscles.size()));
    add(ecu::encode(ecu::Effort{}, ecu.node), rate);
    if (ecu.analogs > 0) add(ecu::encode(ecu::Analog{}, ecu.node), 0.5 * rate);
    add(ecu::encode(ecu::StateReport{}, ecu.node), 10.0);
    add(ecu::encode(ecu::Health{}, ecu.node), 2.0);
  }
  return load;
}

/// Listens to everything on the bus and counts its bits, stuff bits included.
class Listener {
 public:
  explicit Listener(const std::string& can) : bus_(can) {}
  void listen(double seconds) {
    BusEvent event;
    for (const double end = monotonic_now() + seconds;
         monotonic_now() < end && !tool::interrupted();) {
      if (!bus_.receive(event)) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      } else if (event.kind == BusEvent::Kind::kFrame) {
        bits_ += count_bits(event.frame).exact;
        ++frames_;
      }
    }
  }
  double bits() const { return bits_; }
  double frames() const { return frames_; }

 private:
  SocketCanBus bus_;
  double bits_ = 0.0, frames_ = 0.0;
};

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

double processor_time() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

bool enable(DriverThread& thread) {
  RobotDriver::Outcome outcome;
  for (int attempt = 0; attempt < 100 && !tool::interrupted(); ++attempt) {
    bool waiting = true;
    thread.call([](RobotDriver& driver, double now) { driver.start_enable(now); });
    while (waiting) {
      thread.wait(0.01);
      thread.call([&](RobotDriver& driver, double) {
        waiting = driver.phase() == RobotDriver::Phase::kEnabling;
        outcome = driver.last_outcome();
      });
    }
    if (outcome.accepted) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  if (!tool::interrupted()) std::cerr << "anthrob_can_check: " << outcome.reason << "\n";
  return false;
}

/// [s] of the robot, which may be slower than the clock.
double robot_time(const Arguments& arguments) {
  return arguments.pace * monotonic_now();
}

/// Small volts for all muscles, worth a tenth of a newton.
void command(DriverThread& thread, const Hardware& hardware) {
  std::vector<std::string> names;
  for (const MuscleHardware& muscle : hardware.muscles) names.push_back(muscle.name);
  const std::vector<std::uint8_t> modes(names.size(), 0);
  const std::vector<double> volts(names.size(), 0.05);
  thread.call([&](RobotDriver& driver, double now) { driver.command(names, modes, volts, now); });
}

std::string line(const Hardware& hardware, const Findings::Entry& entry) {
  const std::string who =
      entry.ecu ? hardware.ecus[static_cast<std::size_t>(*entry.ecu)].name + ": " : "";
  const std::string detail = entry.detail.empty() ? "" : ": " + entry.detail;
  return "  " + who + info(entry.finding).name + " " + std::to_string(entry.count) + "x" + detail +
         "\n";
}

int measure(const Arguments& arguments, const Hardware& hardware) {
  DriverThread::Options options;
  options.driver.rate = arguments.rate;
  options.realtime = arguments.realtime;
  options.pace = arguments.pace;
  DriverThread thread(hardware, options, arguments.can);
  for (const std::string& note : thread.notes()) std::cerr << "anthrob_can_check: " << note << "\n";
  // On a robot a latched stop, or a fault, is somebody's: it stays.
  if (arguments.emulate) {
    thread.call([](RobotDriver& driver, double now) { driver.clear_faults(now); });
    if (!enable(thread)) return tool::interrupted() ? tool::kInterrupted : 1;
  }
  thread.wait(0.0);

  std::vector<double> round_trips;
  std::uint64_t incomplete = 0, cycles = 0, frames = 0;
  const auto count = [&](std::uint64_t& all_cycles, std::uint64_t& all_frames) {
    thread.call([&](RobotDriver& driver, double) {
      all_cycles = driver.cycles();
      all_frames = driver.bus_watch().frames();
    });
  };
  count(cycles, frames);
  const double start = robot_time(arguments), processor = processor_time();
  while (robot_time(arguments) - start < arguments.seconds && !tool::interrupted()) {
    if (arguments.emulate) command(thread, hardware);
    for (const double end = robot_time(arguments) + 0.1; robot_time(arguments) < end;) {
      for (const Sample& sample : thread.wait(0.02).samples) {
        bool all = true;
        for (const MuscleSample& muscle : sample.muscles) all = all && muscle.measured;
        if (all) round_trips.push_back(sample.round_trip);
        incomplete += !all;
      }
    }
  }
  const double elapsed = robot_time(arguments) - start, busy = processor_time() - processor;
  std::uint64_t last_cycles = 0, last_frames = 0;
  count(last_cycles, last_frames);
  bool stopped = false;
  std::string findings;
  thread.call([&](RobotDriver& driver, double) {
    stopped = arguments.emulate && driver.phase() != RobotDriver::Phase::kEnabled;
    for (const Findings::Entry& entry : driver.findings().entries()) {
      findings += line(hardware, entry);
    }
  });
  constexpr double kListen = 2.0;
  Listener listener(arguments.can);  // here: what came before waits in no socket of its
  const double listen_start = robot_time(arguments);
  std::thread listening([&] { listener.listen(kListen / arguments.pace); });
  while (robot_time(arguments) - listen_start < kListen && !tool::interrupted()) {
    if (arguments.emulate) command(thread, hardware);
    thread.wait(0.1);
  }
  listening.join();
  const double listened = robot_time(arguments) - listen_start;

  const Load load = calculated_load(hardware, arguments.rate);
  const auto answered = static_cast<double>(round_trips.size());
  const double wanted = static_cast<double>(last_cycles - cycles);
  std::printf("%zu ECUs, %zu muscles, %.0f s at %.0f Hz: %.1f cycles/s, %.0f frames/s received\n",
              hardware.ecus.size(), hardware.muscles.size(), elapsed, arguments.rate,
              wanted / elapsed, static_cast<double>(last_frames - frames) / elapsed);
  std::printf("SYNC and references to last answer: median %.2f ms, 99 %% %.2f ms, worst %.2f ms\n",
              1e3 * quantile(round_trips, 0.5), 1e3 * quantile(round_trips, 0.99),
              1e3 * quantile(round_trips, 1.0));
  std::printf("cycles answered by all ECUs: %.0f of %.0f; by only some: %llu\n", answered, wanted,
              static_cast<unsigned long long>(incomplete));
  std::printf(
      "bus load at 1 Mbit/s: calculated %.1f %% without stuff bits, %.1f %% at most;"
      " counted %.1f %% (%.0f frames/s)\n",
      load.plain / 1e4, load.worst / 1e4, listener.bits() / listened / 1e4,
      listener.frames() / listened);
  std::printf("processor time: %.2f ms per second of robot time%s\n", 1e3 * busy / elapsed,
              arguments.emulate ? ", emulated ECUs included" : "");
  if (arguments.pace < 1.0) {
    std::printf("all times are robot time, which runs at %.2f of real time\n", arguments.pace);
  }
  std::printf("%s", findings.empty() ? "no findings\n" : ("findings:\n" + findings).c_str());
  if (tool::interrupted()) return tool::kInterrupted;
  return stopped || incomplete > 0 || round_trips.empty() ? 1 : 0;
}

/// All ECUs in software; they end with this object, also when the measurement throws.
class EmulatedRobot {
 public:
  EmulatedRobot(const Hardware& hardware, const Arguments& arguments)
      : plant_(hardware),
        bus_(arguments.can),
        rack_(hardware, plant_, bus_),
        emulator_(rack_, bus_, arguments.pace),
        ecus_([this, realtime = arguments.realtime] {
          if (realtime) become_realtime(Emulator::kPriority);
          emulator_.run([this] { return quit_.load(); }, [] {});
        }) {}
  ~EmulatedRobot() { stop(); }

  void stop() {
    quit_ = true;
    if (ecus_.joinable()) ecus_.join();
  }
  std::uint64_t late() const { return emulator_.late(); }

 private:
  TendonPlant plant_;
  SocketCanBus bus_;
  Rack rack_;
  Emulator emulator_;
  std::atomic<bool> quit_{false};
  std::thread ecus_;
};

constexpr double kLongest = 1e6;  // [s], eleven days

int run(const Arguments& arguments) {
  if (tool::interrupted()) return tool::kInterrupted;  // listens from here on
  const bool hand = arguments.hand && has_hand(arguments.hardware);
  const Hardware hardware = load_hardware(arguments.hardware, hand);
  if (!(arguments.seconds > 0.0 && arguments.seconds <= kLongest)) {
    throw BadInput("--seconds: " + std::to_string(arguments.seconds) +
                   ": expected more than 0 and no more than " + std::to_string(kLongest));
  }
  if (!arguments.emulate && arguments.pace < 1.0) {
    throw BadInput("--pace: below 1 only with --emulate: a robot runs in real time");
  }
  if (!arguments.emulate) return measure(arguments, hardware);
  refuse_physical_bus(arguments.can, arguments.physical);
  EmulatedRobot robot(hardware, arguments);
  const int status = measure(arguments, hardware);
  robot.stop();
  std::printf("emulated milliseconds that took more than 6 ms: %llu\n",
              static_cast<unsigned long long>(robot.late()));
  return status;
}

}  // namespace
}  // namespace driver
}  // namespace anthrob

int main(int argc, char** argv) {
  using namespace anthrob;
  driver::Arguments arguments;
  CLI::App app(
      "Checks a CAN bus. NOT read-only: WRITES hardware.yaml's parameters to a robot's ECUs.\n"
      "It acts as the host of the bus, so a driver on the same bus stops its motors.\n"
      "On a robot it never enables motors and never clears faults; it passes a latched stop on\n"
      "to all ECUs and disables them at the end. With --emulate it runs and drives ECUs in\n"
      "software instead.",
      "anthrob_can_check");
  app.add_option("--hardware", arguments.hardware, "hardware.yaml of the robot")->required();
  app.add_option("--can", arguments.can, "CAN interface")->capture_default_str();
  app.add_option("--seconds", arguments.seconds, "duration of the measurement [s], in robot time")
      ->capture_default_str();
  app.add_option("--rate", arguments.rate, "cycles (SYNC frames) a second [Hz]")
      ->capture_default_str();
  app.add_option("--pace", arguments.pace, "with --emulate: speed relative to real time")
      ->capture_default_str()
      ->check(tool::within(0.01, 1.0));
  app.add_flag("--emulate", arguments.emulate,
               "run the ECUs in software, on a vcan, and drive them");
  app.add_flag("--physical", arguments.physical,
               "with --emulate: allow a physical interface; no robot may be connected to it");
  app.add_flag("--hand,!--no-hand", arguments.hand,
               "include the hand's ECU, if the robot has a hand (default)");
  app.add_flag("--realtime", arguments.realtime,
               "real-time scheduling (SCHED_FIFO) and locked memory");
  return tool::run(app, argc, argv, [&] { return driver::run(arguments); });
}
