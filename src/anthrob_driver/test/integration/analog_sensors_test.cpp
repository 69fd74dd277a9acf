// Joint and touch sensors on the units' analogue inputs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "anthrob_driver/robot_driver.h"
#include "rig.h"

namespace anthrob {
namespace driver {
namespace {

TEST(AnalogSensors, AnalogSensorsAreCalibrated) {
  Rig rig;
  rig.plant.set_joint(0, 1.2);
  rig.plant.set_touch(2, 3.0);
  rig.run(1500);
  rig.analogs.clear();
  rig.run(100);
  int joints = 0, pads = 0;
  for (const AnalogSample& a : rig.analogs) {
    if (a.kind == AnalogSample::Kind::kJoint) {
      ++joints;
      EXPECT_NEAR(a.value, 1.2, 0.0007);
      EXPECT_NEAR(a.rate, 0.0, 0.03);
    } else if (a.sensor == 2) {
      ++pads;
      EXPECT_NEAR(a.value, 3.0, 0.01);
    }
  }
  EXPECT_EQ(joints, 10);
  EXPECT_EQ(pads, 10);
}

TEST(AnalogSensors, APotentiometerAtAnEndStopMeasuresNothing) {
  Rig rig;
  rig.plant.set_joint(0, 1.2);
  rig.run(1500);
  const JointSensor& elbow = rig.hardware.joints[0];
  int count = 0;
  rig.bus.tamper = [&](const ecu::Frame& f, const MemoryBus::Port&) {
    if (ecu::function_of(f) != static_cast<int>(ecu::Function::kAnalog)) {
      return std::vector<ecu::Frame>{f};
    }
    ecu::Analog analog = ecu::decode_analog(f);
    analog.count[elbow.input] = static_cast<std::uint16_t>(count);
    return std::vector<ecu::Frame>{ecu::encode(analog, ecu::node_of(f))};
  };
  const auto published = [&](int reading) {
    count = reading;
    rig.run(20);
    rig.analogs.clear();
    rig.run(100);
    return std::count_if(rig.analogs.begin(), rig.analogs.end(), [](const AnalogSample& a) {
      return a.kind == AnalogSample::Kind::kJoint;
    });
  };
  for (const int good : {8, 4087}) EXPECT_EQ(published(good), 10) << good;
  EXPECT_EQ(rig.driver().findings().count(Finding::kJointSensor), 0u);
  for (const int bad : {0, 7, 4088, 4095}) EXPECT_EQ(published(bad), 0) << bad;
  EXPECT_GE(rig.driver().findings().count(Finding::kJointSensor), 40u);
  // Neither shows in what comes after it: no slope leads across the gap.
  EXPECT_EQ(published(1338), 10);
  for (const AnalogSample& a : rig.analogs) EXPECT_EQ(a.rate, 0.0);
}

TEST(AnalogSensors, ASecondNodeWithTheSameNumberDoesNotGetItsValuesIn) {
  Rig rig;
  ASSERT_TRUE(rig.start());
  constexpr std::size_t kEcu = 2;
  const EcuHardware& ecu = rig.hardware.ecus[kEcu];
  rig.bus.tamper = [&](const ecu::Frame& f, const MemoryBus::Port&) {
    const int function = ecu::function_of(f);
    if (ecu::node_of(f) != ecu.node || function < 4 || function > 6) {
      return std::vector<ecu::Frame>{f};
    }
    if (function == static_cast<int>(ecu::Function::kEffort)) {
      ecu::Effort other = ecu::decode_effort(f);
      for (double& force : other.force) force += 50.0;
      return std::vector<ecu::Frame>{f, ecu::encode(other, ecu.node)};
    }
    ecu::Motion other = ecu::decode_motion(f);
    other.position += 1.0;
    return std::vector<ecu::Frame>{f, ecu::encode(other, ecu.node, function - 4)};
  };
  rig.run(1000);
  EXPECT_GT(rig.driver().findings().count(Finding::kRepeatedFrame), 0u);
  const Sample& sample = rig.samples.back();
  for (const int muscle : ecu.muscles) {
    const auto m = static_cast<std::size_t>(muscle);
    EXPECT_NEAR(sample.muscles[m].position, rig.plant.muscle(m).position, 0.01);
    EXPECT_NEAR(sample.muscles[m].force, rig.plant.muscle(m).force, 0.5);
  }
}

/// A sensor whose zero is far from what a unit starts with must not look like a current.
TEST(AnalogSensors, SensorsAreKnownBeforeTheirLimits) {
  Hardware hardware = load_hardware(ANTHROB_CONFIG_DIR "/anthrob/hardware.yaml", true);
  for (MuscleHardware& muscle : hardware.muscles) {
    muscle.current.offset = 1500.0;
    ASSERT_TRUE(muscle.parameters.set(ecu::Parameter::kCurrentOffset, 1500.0));
    ASSERT_TRUE(muscle.parameters.set(ecu::Parameter::kCurrentLimit, 2.0));
  }
  for (EcuHardware& ecu : hardware.ecus) {
    std::vector<ecu::ParameterSet> sets;
    for (const int m : ecu.muscles) {
      sets.push_back(hardware.muscles[static_cast<std::size_t>(m)].parameters);
    }
    ecu.configuration = ecu::configuration_checksum(sets.data(), static_cast<int>(sets.size()));
  }
  Rig rig(hardware);
  rig.run(1500);
  EXPECT_EQ(rig.driver().findings().count(Finding::kEcuFault), 0u);
  EXPECT_TRUE(rig.enable()) << rig.driver().last_outcome().reason;
}

TEST(AnalogSensors, ADoubledAnalogFrameIsOneMeasurement) {
  Rig rig;
  rig.run(1500);
  rig.bus.tamper = [](const ecu::Frame& f, const MemoryBus::Port&) {
    const bool analog = ecu::function_of(f) == static_cast<int>(ecu::Function::kAnalog);
    return analog ? std::vector<ecu::Frame>{f, f} : std::vector<ecu::Frame>{f};
  };
  rig.analogs.clear();
  rig.run(100);
  std::int64_t last = 0;
  int joints = 0;
  for (const AnalogSample& a : rig.analogs) {
    if (a.kind != AnalogSample::Kind::kJoint) continue;
    ++joints;
    EXPECT_GT(a.stamp_ns, last);
    // Both clocks tell of the same SYNC.
    EXPECT_NEAR(a.time, 1e-9 * static_cast<double>(a.stamp_ns) - 1000.0, 0.001);
    EXPECT_FALSE(std::isnan(a.rate));
    last = a.stamp_ns;
  }
  EXPECT_EQ(joints, 10);
}

}  // namespace
}  // namespace driver
}  // namespace anthrob
