// Motors that are too hot by what they drew: the estimate against its closed form, and the driver.
#include "watch/winding_temperature_model.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

#include "anthrob_core/errors.h"
#include "rig.h"
#include "watch/period.h"

namespace anthrob {
namespace driver {
namespace {

constexpr double kNominal = 1.5;    // [A]
constexpr double kConstant = 12.0;  // [s]

/// [s] that a current takes to make it too hot; -1: it does not within 200 s.
double time_to_limit(WindingTemperatureModel& motor, double current) {
  for (int i = 0; i < 40000; ++i) {
    motor.step(current, kPeriod * i);
    if (motor.relative_temperature_rise() > WindingTemperatureModel::kLimit) return kPeriod * i;
  }
  return -1.0;
}

TEST(WindingTemperatureModel, FollowsThePowerWithItsTimeConstant) {
  for (const double current : {3.0, -3.0, 15.0}) {
    WindingTemperatureModel motor(kNominal, kConstant);
    const double end = std::pow(current / kNominal, 2);
    EXPECT_NEAR(time_to_limit(motor, current),
                -kConstant * std::log(1.0 - WindingTemperatureModel::kLimit / end), 2.0 * kPeriod)
        << current;
  }
}

TEST(WindingTemperatureModel, TheNominalCurrentIsForEver) {
  WindingTemperatureModel motor(kNominal, kConstant);
  EXPECT_EQ(time_to_limit(motor, kNominal), -1.0);
  EXPECT_NEAR(motor.relative_temperature_rise(), 1.0, 1e-6);
}

TEST(WindingTemperatureModel, CoolsDownInTheTimeThatItSays) {
  WindingTemperatureModel motor(kNominal, kConstant);
  double now = time_to_limit(motor, 6.0);
  const double wait = motor.time_to_cool();
  EXPECT_NEAR(
      wait,
      kConstant * std::log(motor.relative_temperature_rise() / WindingTemperatureModel::kCool),
      1e-9);
  for (double passed = 0.0; passed < wait; passed += kPeriod) motor.step(0.0, now += kPeriod);
  EXPECT_NEAR(motor.relative_temperature_rise(), WindingTemperatureModel::kCool, 1e-3);
  motor.step(0.0, now += kPeriod);
  EXPECT_EQ(motor.time_to_cool(), 0.0);
}

TEST(WindingTemperatureModel, WhatWasNotMeasuredDrewNothing) {
  WindingTemperatureModel motor(kNominal, kConstant);
  const double hot = time_to_limit(motor, 6.0), before = motor.relative_temperature_rise();
  motor.step(6.0, hot + 5.0);
  EXPECT_NEAR(motor.relative_temperature_rise(), before * std::exp(-5.0 / kConstant), 1e-9);
  motor.step(6.0, hot + 4.0);  // time that goes back changes nothing
  EXPECT_NEAR(motor.relative_temperature_rise(), before * std::exp(-5.0 / kConstant), 1e-9);
}

TEST(WindingTemperatureModel, AMotorThatIsNotKnownIsNeverHot) {
  WindingTemperatureModel motor(0.0, 0.0);
  EXPECT_EQ(time_to_limit(motor, 100.0), -1.0);
  EXPECT_EQ(motor.time_to_cool(), 0.0);
}

/// Anthrob, of which one motor is known to stand little.
Hardware with_weak_motor() {
  Hardware robot = load_hardware(ANTHROB_CONFIG_DIR "/anthrob/hardware.yaml", false);
  robot.muscles[4].nominal_current = 0.1;
  robot.muscles[4].thermal_time_constant = 2.0;
  return robot;
}

TEST(HotMotors, StopAllAndWaitUntilTheyAreCool) {
  Rig rig(with_weak_motor());
  ASSERT_TRUE(rig.start());  // 0.5 V: slowly up to 0.63 A, where it stalls
  double heat = 0.0, trip = -1.0;
  for (int i = 0; i < 10000 && rig.driver().findings().count(Finding::kMotorHot) == 0; ++i) {
    rig.step();
  }
  ASSERT_EQ(rig.driver().findings().count(Finding::kMotorHot), 1u);
  // By Euler's steps over what was measured.
  for (const Sample& sample : rig.samples) {
    if (!sample.muscles[4].measured) continue;
    heat += 0.005 / 2.0 * (std::pow(sample.muscles[4].current / 0.1, 2) - heat);
    if (heat > WindingTemperatureModel::kLimit && trip < 0.0) trip = sample.time;
  }
  EXPECT_NEAR(trip, rig.now(), 0.03);
  rig.commander_runs = false;
  rig.run(100);
  EXPECT_EQ(rig.moving(), 0);
  const std::string last = rig.driver().stops().last().value_or("");
  EXPECT_EQ(last.substr(0, 10), "motor_hot:") << last;
  EXPECT_NE(last.find("infraspinatus: the estimated heat of its motor is 1.1"), std::string::npos)
      << last;

  rig.driver().clear_faults(rig.now());
  rig.run(200);
  const RobotDriver::Outcome refused = rig.driver().start_enable(rig.now());
  EXPECT_FALSE(refused.accepted);
  EXPECT_EQ(refused.reason.find(
                "infraspinatus: its motor is too hot, judging by its current; try again in "),
            0u)
      << refused.reason;
  // The tension turns the motor back, which takes current, too.
  int waited = 0;
  for (; waited < 60 && !rig.driver().start_enable(rig.now()).accepted; ++waited) rig.run(1000);
  EXPECT_GT(waited, 0);
  EXPECT_TRUE(rig.enable()) << rig.driver().last_outcome().reason;
  EXPECT_LE(rig.driver().winding(4).relative_temperature_rise(), WindingTemperatureModel::kCool);
}

TEST(HotMotors, AreNoneWhereNobodyKnowsWhatTheyStand) {
  Rig rig(false);
  ASSERT_TRUE(rig.start());
  rig.run(5000);
  EXPECT_EQ(rig.driver().findings().count(Finding::kMotorHot), 0u);
  EXPECT_EQ(rig.moving(), 11);
}

TEST(HotMotors, AreToldOfByBothNumbersOfTheirDataSheet) {
  const std::string folder = ANTHROB_CONFIG_DIR "/anthrob/";
  std::ifstream in(folder + "hardware.yaml");
  std::string text((std::istreambuf_iterator<char>(in)), {});
  const auto load = [&](const std::string& more) {
    std::string changed = text;
    const std::string key = "    current_limit: 16.0 ";
    changed.replace(changed.find(key), key.size(), more + key);
    for (const char* name : {"model_II.yaml", "sensors.yaml"}) {
      const std::size_t at = changed.find(name);
      changed.insert(at, folder);
    }
    const std::string file =
        "/tmp/anthrob_winding_temperature_model_test_" + std::to_string(getpid()) + ".yaml";
    std::ofstream(file) << changed;
    struct Remove {
      const char* file;
      ~Remove() { std::remove(file); }
    } guard{file.c_str()};
    return load_hardware(file, false);
  };
  const Hardware robot = load("    nominal_current: 1.5\n    thermal_time_constant: 12.0\n");
  int known = 0;
  for (const MuscleHardware& muscle : robot.muscles) known += muscle.nominal_current == 1.5;
  EXPECT_GT(known, 0);
  EXPECT_LT(known, 11);
  EXPECT_THROW(load("    nominal_current: 1.5\n"), BadInput);
  EXPECT_THROW(load("    thermal_time_constant: 12.0\n"), BadInput);
  EXPECT_THROW(load("    nominal_current: 0\n    thermal_time_constant: 12.0\n"), BadInput);
}

}  // namespace
}  // namespace driver
}  // namespace anthrob
