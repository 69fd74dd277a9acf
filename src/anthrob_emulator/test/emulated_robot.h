#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "anthrob_driver/emulation/memory_bus.h"
#include "anthrob_driver/emulation/rack.h"
#include "anthrob_driver/robot_driver.h"
#include "simulator_plant.h"

namespace anthrob {
namespace testing_support {

inline const char* const kHardware = ANTHROB_CONFIG_DIR "/anthrob/hardware.yaml";

using References = std::map<std::string, double>;  ///< by muscle [rad]
inline const References kReach = {
    {"lateral_deltoid", 6.0},  {"anterior_deltoid", 3.0}, {"posterior_deltoid", 1.0},
    {"supraspinatus", 3.0},    {"infraspinatus", 0.5},    {"teres_minor", -0.5},
    {"teres_major", -1.0},     {"pectoralis_major", 0.0}, {"biceps_brachii", 4.0},
    {"triceps_brachii", -2.0}, {"brachialis", 3.0},
};

/// Driver, bus and seven emulated ECUs around the simulator's physics, a millisecond at a time. The
/// zero is the model's, and the ECUs know it.
class EmulatedRobot {
 public:
  EmulatedRobot(const std::string& model, const std::string& hardware_file)
      : hardware_(driver::load_hardware(hardware_file, false)),
        plant_(load_robot_model(model), hardware_),
        host_(bus_.attach()),
        ecus_(bus_.attach()),
        rack_(hardware_, plant_, ecus_),
        robot_(hardware_, {}, host_) {
    rack_.set_zeros();
  }

  void step() {
    if (ms_ % kCycle == 0) robot_.cycle(now());
    bus_.deliver(1 + ms_);
    rack_.receive();
    rack_.tick();
    bus_.deliver(1 + ms_);
    driver::BusEvent event;
    while (host_.receive(event)) robot_.receive(event, now());
    driver::Sample sample;
    while (robot_.take_sample(sample)) last_ = sample;
    driver::AnalogSample analog;
    while (robot_.take_analog(analog)) last_analog_ = analog;
    ++ms_;
  }

  /// Configuring and enabling take a second in which the arm hangs still.
  void enable() {
    while (ms_ < 1000) step();
    robot_.start_enable(now());
    while (robot_.phase() == driver::RobotDriver::Phase::kEnabling || ms_ % kCycle != 0) step();
    EXPECT_EQ(robot_.phase(), driver::RobotDriver::Phase::kEnabled) << robot_.last_outcome().reason;
  }

  /// Takes effect with the next cycle of the driver.
  void command(const std::map<std::string, double>& references, ecu::Mode mode) {
    std::vector<std::string> names;
    std::vector<double> values;
    for (const auto& [name, value] : references) names.push_back(name), values.push_back(value);
    const std::vector<std::uint8_t> modes(names.size(), static_cast<std::uint8_t>(mode));
    const auto outcome = robot_.command(names, modes, values, now());
    EXPECT_TRUE(outcome.accepted) << outcome.reason;
  }

  int milliseconds() const { return ms_; }
  /// What came last; measured when the cycle of the driver that asked for it began.
  const driver::Sample& last() const { return last_; }
  /// The same of an analogue input; asked for in every other cycle.
  const driver::AnalogSample& last_analog() const { return last_analog_; }
  /// The true state behind the units.
  const Simulation& truth() const { return plant_.simulation(); }

  static constexpr int kCycle = 5;  ///< [ms] of the driver

 private:
  double now() const { return 0.001 * ms_; }

  driver::Hardware hardware_;
  SimulatorPlant plant_;
  driver::MemoryBus bus_;
  driver::MemoryBus::Port &host_, &ecus_;
  driver::Rack rack_;
  driver::RobotDriver robot_;
  driver::Sample last_;
  driver::AnalogSample last_analog_;
  int ms_ = 0;
};

}  // namespace testing_support
}  // namespace anthrob
