// The driver's watch over tendons says nothing while the emulated robot works as fast as it can,
// and speaks up once a tendon's force is gone.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "anthrob_driver/emulation/memory_bus.h"
#include "anthrob_driver/emulation/rack.h"
#include "anthrob_driver/robot_driver.h"
#include "simulator_plant.h"

namespace anthrob {
namespace {

using driver::Finding;
using Phase = driver::RobotDriver::Phase;

/// By muscle of hardware.yaml [rad].
const std::vector<double> kRest(11, 0.0);
const std::vector<double> kReached = {6.0, 3.0, 1.0, 3.0, 0.5, -0.5, -1.0, 0.0, 4.0, -2.0, 3.0};
const std::vector<double> kTense(11, 1.5);

/// A simulated arm whose force sensors can lose their tendon.
class BreakingPlant final : public driver::Plant {
 public:
  explicit BreakingPlant(const driver::Hardware& hardware)
      : arm_(load_robot_model(ANTHROB_CONFIG_DIR "/anthrob/model_II.yaml"), hardware) {}
  Muscle muscle(std::size_t muscle) const override {
    Muscle seen = arm_.muscle(muscle);
    if (muscle == broken) seen.force = 0.0;
    return seen;
  }
  double joint(std::size_t joint) const override { return arm_.joint(joint); }
  double touch(std::size_t pad) const override { return arm_.touch(pad); }
  void drive(std::size_t muscle, double voltage) override { arm_.drive(muscle, voltage); }
  void advance() override { arm_.advance(); }

  std::size_t broken = std::numeric_limits<std::size_t>::max();

 private:
  SimulatorPlant arm_;
};

/// Driver, bus and ECUs around the simulator's physics.
class OrdinaryMotion : public testing::Test {
 protected:
  void SetUp() override {
    rack.set_zeros();
    run(1000);
    robot.start_enable(now());
    while (robot.phase() == Phase::kEnabling) run(1);
    ASSERT_EQ(robot.phase(), Phase::kEnabled) << robot.last_outcome().reason;
  }
  double now() const { return 0.001 * ms; }
  void run(int milliseconds) {
    for (const int end = ms + milliseconds; ms < end; ++ms) {
      if (ms % 5 == 0) robot.cycle(now());
      bus.deliver(1 + ms);
      rack.receive();
      rack.tick();
      bus.deliver(1 + ms);
      driver::BusEvent event;
      while (host.receive(event)) robot.receive(event, now());
      driver::Sample sample;
      while (robot.take_sample(sample)) look_at(sample);
    }
  }
  void look_at(const driver::Sample& sample) {
    last = sample;
    for (std::size_t m = 0; m < sample.muscles.size(); ++m) {
      const driver::MuscleSample& muscle = sample.muscles[m];
      const bool strong = hardware.muscles[m].limits.highest[3] > 150.0;
      double& speed = highest_speed[strong ? 0 : 1];
      speed = std::max(speed, std::abs(muscle.velocity));
      double& current = highest_current[strong ? 0 : 1];
      current = std::max(current, std::abs(muscle.current));
      highest_force = std::max(highest_force, muscle.force);
    }
  }
  void command(ecu::Mode mode, const std::vector<double>& references, int milliseconds) {
    std::vector<std::string> names;
    for (const auto& muscle : hardware.muscles) names.push_back(muscle.name);
    const std::vector<std::uint8_t> modes(names.size(), static_cast<std::uint8_t>(mode));
    for (const int end = ms + milliseconds; ms < end;) {
      robot.command(names, modes, references, now());
      run(100);
    }
  }

  driver::Hardware hardware =
      driver::load_hardware(ANTHROB_CONFIG_DIR "/anthrob/hardware.yaml", false);
  BreakingPlant plant{hardware};
  driver::MemoryBus bus;
  driver::MemoryBus::Port &host = bus.attach(), &ecus = bus.attach();
  driver::Rack rack{hardware, plant, ecus};
  driver::RobotDriver robot{hardware, {}, host};
  driver::Sample last;
  int ms = 0;
  double highest_speed[2] = {0.0, 0.0}, highest_current[2] = {0.0, 0.0}, highest_force = 0.0;
};

TEST_F(OrdinaryMotion, PosturesAtFullSpeedAreNoBrokenTendons) {
  for (const auto* posture : {&kTense, &kReached, &kRest, &kReached, &kTense, &kRest, &kTense}) {
    command(ecu::Mode::kPosition, *posture, 2500);
    ASSERT_EQ(robot.phase(), Phase::kEnabled) << robot.stops().last().value_or("");
  }
  // Loaded enough for the watch to look at, and moved.
  EXPECT_GT(highest_force, 3.0 * hardware.tendons.loaded);
  EXPECT_GT(highest_speed[0], 4.0);
  std::printf("at most %.1f N, %.1f and %.1f rad/s, %.1f and %.1f A\n", highest_force,
              highest_speed[0], highest_speed[1], highest_current[0], highest_current[1]);
}

TEST_F(OrdinaryMotion, ForcesThatComeAndGoAreNoBrokenTendons) {
  for (const double force : {30.0, 1.0, 60.0, 0.0, 8.0, 2.0}) {
    command(ecu::Mode::kForce, std::vector<double>(11, force), 2500);
    ASSERT_EQ(robot.phase(), Phase::kEnabled) << robot.stops().last().value_or("");
  }
}

TEST_F(OrdinaryMotion, ATendonThatLosesItsForceIsNamed) {
  command(ecu::Mode::kPosition, kReached, 4000);
  std::size_t loaded = 0;
  for (std::size_t m = 0; m < 11; ++m) {
    if (last.muscles[m].force > last.muscles[loaded].force) loaded = m;
  }
  ASSERT_GT(last.muscles[loaded].force, hardware.tendons.loaded);
  plant.broken = loaded;
  command(ecu::Mode::kPosition, kReached, 300);
  EXPECT_EQ(robot.phase(), Phase::kDisabled);
  EXPECT_EQ(robot.findings().count(Finding::kTendonSlack), 1u);
  EXPECT_NE(robot.stops().last().value_or("").find("(" + hardware.muscles[loaded].name + ": held"),
            std::string::npos)
      << robot.stops().last().value_or("");
}

}  // namespace
}  // namespace anthrob
