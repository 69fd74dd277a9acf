#include "anthrob_ecu/protocol.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "anthrob_ecu/parameters.h"
#include "wire/wire_layout.h"

namespace anthrob {
namespace ecu {
namespace {

TEST(Protocol, ChecksumIsSaeJ1850) {
  // Check value of CRC-8/SAE-J1850 for "123456789": the identifier is its first two bytes.
  Frame frame;
  frame.id = 0x3132;
  frame.length = 8;
  for (int i = 0; i < 7; ++i)
    frame.data[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>('3' + i);
  EXPECT_EQ(checksum(frame), 0x4B);
}

TEST(Protocol, MotionSurvivesTheWire) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> position(-52, 52), velocity(-20, 20), current(-20, 20);
  for (int i = 0; i < 10000; ++i) {
    const Motion in{static_cast<std::uint8_t>(i & 0xF),
                    static_cast<State>(i % kStateCount),
                    (i & 1) != 0,
                    position(random),
                    velocity(random),
                    current(random)};
    const Frame frame = encode(in, 3, i % 2);
    ASSERT_EQ(inspect(frame), Reading::kGood);
    ASSERT_EQ(frame.length, 8);
    const Motion out = decode_motion(frame);
    EXPECT_EQ(out.counter, in.counter);
    EXPECT_EQ(out.state, in.state);
    EXPECT_EQ(out.stop_latched, in.stop_latched);
    // Half a step of rounding.
    EXPECT_LE(std::abs(out.position - in.position), 1.25e-5 + 1e-12);
    EXPECT_LE(std::abs(out.velocity - in.velocity), 1.25e-3 + 1e-12);
    EXPECT_LE(std::abs(out.current - in.current), 5e-3 + 1e-12);
  }
}

TEST(Protocol, ReferenceScalesByMode) {
  for (int mode = 0; mode < kModeCount; ++mode) {
    Reference in;
    in.counter = 9;
    in.mode[0] = in.mode[1] = static_cast<Mode>(mode);
    in.reference[0] = 12.34567, in.reference[1] = mode == 3 ? 345.6789 : -29.87654;
    const Reference out = decode_reference(encode(in, 5));
    EXPECT_EQ(out.mode[0], in.mode[0]);
    EXPECT_NEAR(out.reference[0], in.reference[0], 0.51 * layout::reference::kScale[mode]);
    EXPECT_NEAR(out.reference[1], in.reference[1], 0.51 * layout::reference::kScale[mode]);
  }
}

TEST(Protocol, WhatDoesNotFitIsClippedAndNothingIsZero) {
  Motion motion;
  motion.position = 1e9;
  motion.velocity = -1e9;
  motion.current = std::nan("");
  const Motion out = decode_motion(encode(motion, 1, 0));
  EXPECT_NEAR(out.position, 52.4288, 1e-3);
  EXPECT_NEAR(out.velocity, -20.48, 1e-9);
  EXPECT_EQ(out.current, 0.0);
}

TEST(Protocol, AMissingForceSensorIsNotZeroForce) {
  Effort effort;
  effort.force[0] = std::nan("");
  effort.force[1] = 1e6;
  effort.voltage[0] = -12.0;
  const Effort out = decode_effort(encode(effort, 1));
  EXPECT_TRUE(std::isnan(out.force[0]));
  EXPECT_NEAR(out.force[1], 327.64, 1e-9);
  EXPECT_EQ(out.voltage[0], -12.0);
}

TEST(Protocol, EveryChangedBitIsNoticed) {
  const Frame frame = encode(Motion{5, State::kEnabled, false, 1.0, 2.0, 3.0}, 3, 0);
  for (std::size_t bit = 0; bit < 64; ++bit) {
    Frame changed = frame;
    changed.data[bit / 8] = static_cast<std::uint8_t>(changed.data[bit / 8] ^ (1u << (bit % 8)));
    EXPECT_EQ(inspect(changed), Reading::kCorrupt) << bit;
  }
  Frame moved = frame;
  moved.id = identifier(Function::kMotionA, 4);
  EXPECT_EQ(inspect(moved), Reading::kCorrupt) << "another node's frame";
  Frame shorter = frame;
  shorter.length = 7;
  EXPECT_EQ(inspect(shorter), Reading::kWrongLength);
  Frame foreign = frame;
  foreign.id = 0x700;
  EXPECT_EQ(inspect(foreign), Reading::kForeign);
}

TEST(Protocol, StopIsObeyedWhateverItsData) {
  Frame stop;
  EXPECT_EQ(inspect(stop), Reading::kGood);
  stop.length = 3;
  stop.data = {1, 2, 3};
  EXPECT_EQ(inspect(stop), Reading::kGood);
}

TEST(Protocol, TablesAreInOrderAndNamesDiffer) {
  std::set<std::string> names;
  for (int i = 0; i < kParameterCount; ++i) {
    EXPECT_EQ(static_cast<int>(kParameters[i].parameter), i);
    EXPECT_TRUE(names.insert(kParameters[i].name).second);
  }
  for (int i = 0; i < kFaultCount; ++i) {
    EXPECT_EQ(static_cast<int>(kFaults[i].fault), i);
    EXPECT_TRUE(names.insert(kFaults[i].name).second);
  }
  EXPECT_STREQ(name(static_cast<Fault>(77)), "unknown_fault");
}

TEST(Parameters, RangesAndNumbersThatAreNone) {
  ParameterSet set;
  EXPECT_TRUE(set.set(Parameter::kVoltageLimit, 12.0));
  EXPECT_FALSE(set.set(Parameter::kVoltageLimit, 48.0));
  EXPECT_FALSE(set.set(Parameter::kVoltageLimit, std::nan("")));
  EXPECT_FALSE(set.set(kParameterCount, 1.0f));
  EXPECT_FALSE(set.set(-1, 1.0f));
  EXPECT_EQ(set.get(Parameter::kVoltageLimit), 12.0);
}

TEST(Parameters, ChecksumSeesEveryParameter) {
  ParameterSet sets[2];
  const auto initial = configuration_checksum(sets, 2);
  for (int m = 0; m < 2; ++m) {
    for (int i = 0; i < kParameterCount; ++i) {
      ParameterSet changed[2] = {sets[0], sets[1]};
      const float other = changed[m].raw(i) == 1.0f ? 0.5f : 1.0f;
      ASSERT_TRUE(changed[m].set(i, i == static_cast<int>(Parameter::kForceGain) ? 0.5f : other));
      EXPECT_NE(configuration_checksum(changed, 2), initial) << m << " " << kParameters[i].name;
    }
  }
}

}  // namespace
}  // namespace ecu
}  // namespace anthrob
