#include "anthrob_ecu/firmware/firmware.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

namespace anthrob {
namespace ecu {
namespace {

/// A board on a desk, and a host that does everything right.
class Desk : public testing::Test {
 protected:
  Desk() : firmware(wiring()) {
    for (auto& m : readings.muscle) m.force = 400;
    configuration[static_cast<int>(Parameter::kVoltageLimit)] = 12.0f;
    configuration[static_cast<int>(Parameter::kPositionLow)] = -30.0f;
    configuration[static_cast<int>(Parameter::kPositionHigh)] = 30.0f;
    configuration[static_cast<int>(Parameter::kCurrentLimit)] = 10.0f;
    configuration[static_cast<int>(Parameter::kForceLimit)] = 200.0f;
    configuration[static_cast<int>(Parameter::kSpeedLimit)] = 12.0f;
    configuration[static_cast<int>(Parameter::kTemperatureLimit)] = 85.0f;
    configuration[static_cast<int>(Parameter::kForceGain)] = 0.06f;
    configuration[static_cast<int>(Parameter::kForceOffset)] = 400.0f;
    configuration[static_cast<int>(Parameter::kPositionRate)] = 50.0f;
    configuration[static_cast<int>(Parameter::kForceRate)] = 500.0f;
    configuration[static_cast<int>(Parameter::kPositionProportional)] = 5.0f;
  }
  static Wiring wiring() {
    Wiring w;
    w.node = 3;
    w.session = 42;
    return w;
  }

  /// One millisecond; the host speaks every fifth.
  void tick() {
    if (host && ticks % 5 == 0) {
      firmware.receive(encode(Sync{++counter, kProtocolVersion, true}));
      Reference reference;
      reference.counter = counter & 0xF;
      reference.mode[0] = mode;
      reference.reference[0] = volts;
      if (references) firmware.receive(encode(reference, 3));
    }
    output = firmware.tick(readings);
    ++ticks;
    Frame frame;
    while (firmware.next_frame(frame)) {
      ASSERT_EQ(inspect(frame), Reading::kGood);
      sent.push_back(frame);
      if (function_of(frame) == static_cast<int>(Function::kState)) report = decode_state(frame);
    }
  }
  void run(int count) {
    for (int i = 0; i < count; ++i) tick();
  }
  void configure() {
    run(60);
    for (std::uint8_t m = 0; m < 2; ++m) {
      for (const auto& [index, value] : configuration) {
        ParameterMessage message;
        message.write = true;
        message.muscle = m;
        message.index = static_cast<std::uint8_t>(index);
        message.value = value;
        firmware.receive(encode_parameter_request(message, 3));
        tick();
      }
    }
    run(100);
  }
  void request(Operation operation, std::uint8_t session = 42) {
    Request r;
    r.operation = operation;
    r.sequence = ++sequence;
    r.session = session;
    r.configuration = report.configuration;
    firmware.receive(encode(r, 3));
    tick();
  }
  void start() {
    configure();
    request(Operation::kEnable);
    ASSERT_EQ(firmware.state(), State::kEnabled) << name(report.refusal);
    run(20);
    ASSERT_EQ(output[0], 2.0);
  }
  /// Ticks until zero volts, at most `most`.
  int ticks_to_zero(int most) {
    for (int i = 1; i <= most; ++i) {
      tick();
      if (output[0] == 0.0 && output[1] == 0.0) return i;
    }
    return most + 1;
  }
  void expect_fault(Fault fault, int within) {
    EXPECT_LE(ticks_to_zero(within), within);
    EXPECT_EQ(firmware.fault(), fault) << name(firmware.fault());
    EXPECT_EQ(firmware.state(), stops_gently(fault) ? State::kStopping : State::kFault);
  }

  Firmware firmware;
  Readings readings;
  std::map<int, float> configuration;
  std::vector<Frame> sent;
  StateReport report;
  std::array<double, 2> output{};
  bool host = true, references = true;
  double volts = 2.0;
  Mode mode = Mode::kVoltage;
  std::uint8_t counter = 0, sequence = 0;
  int ticks = 0;
};

TEST_F(Desk, IsSilentUntilConfiguredAndEnabled) {
  run(49);
  EXPECT_EQ(firmware.state(), State::kBoot);
  run(11);
  EXPECT_EQ(firmware.state(), State::kIdle);
  EXPECT_EQ(output[0], 0.0);
  report.configuration = 1;
  request(Operation::kEnable);
  EXPECT_EQ(report.refusal, Refusal::kNotConfigured);
  EXPECT_EQ(firmware.state(), State::kIdle);
}

TEST_F(Desk, AnswersEverySyncOnce) {
  run(60);
  sent.clear();
  run(50);
  std::map<int, int> count;
  for (const Frame& frame : sent) ++count[function_of(frame)];
  EXPECT_EQ(count[4], 10);
  EXPECT_EQ(count[5], 10);
  EXPECT_EQ(count[6], 10);
}

TEST_F(Desk, EnableNeedsTheRightSession) {
  configure();
  request(Operation::kEnable, 41);
  EXPECT_EQ(report.refusal, Refusal::kWrongSession);
  EXPECT_EQ(firmware.state(), State::kIdle);
}

TEST_F(Desk, AnEnableSentAgainDoesNotUndoAStop) {
  start();
  host = false;
  expect_fault(Fault::kSyncLost, Firmware::kWatchdogTicks);
  // SYNC is back and nothing is latched: only its number tells this enable from a new one.
  host = true;
  run(50);
  --sequence;
  request(Operation::kEnable);
  run(20);
  EXPECT_EQ(firmware.state(), State::kStopping);
  EXPECT_EQ(output[0], 0.0);
  request(Operation::kEnable);
  EXPECT_EQ(firmware.state(), State::kEnabled);
}

TEST_F(Desk, AClearSentAgainDoesNotUndoALaterStop) {
  start();
  firmware.receive(Frame{});
  tick();
  request(Operation::kClear);
  ASSERT_EQ(firmware.state(), State::kIdle);
  firmware.receive(Frame{});
  tick();
  --sequence;
  request(Operation::kClear);
  EXPECT_TRUE(report.stop_latched);
  EXPECT_EQ(firmware.state(), State::kStopping);
  request(Operation::kClear);
  EXPECT_EQ(firmware.state(), State::kIdle);
}

TEST_F(Desk, SyncLostMeansZeroVoltsWithin15Ms) {
  start();
  host = false;
  expect_fault(Fault::kSyncLost, Firmware::kWatchdogTicks);
  // It does not start again by itself.
  host = true;
  run(200);
  EXPECT_EQ(output[0], 0.0);
  EXPECT_EQ(report.fault, Fault::kSyncLost);
}

TEST_F(Desk, ReferenceLostMeansZeroVoltsWithin15Ms) {
  start();
  references = false;
  expect_fault(Fault::kReferenceLost, Firmware::kWatchdogTicks);
}

TEST_F(Desk, OldSyncsAndReferencesDoNotFeedTheWatchdog) {
  start();
  host = false;
  const Frame old_sync = encode(Sync{counter, kProtocolVersion, true});
  Reference reference;
  reference.counter = counter & 0xF;
  reference.reference[0] = volts;
  const Frame old_reference = encode(reference, 3);
  int zero = 0;
  for (int i = 1; i <= 100 && zero == 0; ++i) {
    firmware.receive(old_sync);
    firmware.receive(old_reference);
    tick();
    if (output[0] == 0.0) zero = i;
  }
  EXPECT_GT(zero, 0);
  EXPECT_LE(zero, Firmware::kWatchdogTicks);
}

TEST_F(Desk, StopIsLatchedAndWinsOverEnable) {
  start();
  firmware.receive(Frame{});
  tick();
  EXPECT_EQ(output[0], 0.0);
  EXPECT_TRUE(report.stop_latched);
  request(Operation::kEnable);
  EXPECT_EQ(report.refusal, Refusal::kStopLatched);
  request(Operation::kClear);
  EXPECT_EQ(firmware.state(), State::kIdle);
  EXPECT_EQ(output[0], 0.0);
  request(Operation::kEnable);
  EXPECT_EQ(report.refusal, Refusal::kAccepted);
}

TEST(Persistence, WhatLastsForLongGoesOnToLast) {
  Persistence persistence;
  for (int tick = 1; tick <= 140000; ++tick) {
    ASSERT_EQ(persistence.lasted(true, 10), tick >= 10) << tick;
  }
  EXPECT_FALSE(persistence.lasted(false, 10));
  EXPECT_FALSE(persistence.lasted(true, 10));
}

TEST_F(Desk, OverCurrent) {
  start();
  readings.muscle[1].current = 2048 + 1100;
  expect_fault(Fault::kOverCurrent, 20);
  EXPECT_EQ(report.muscle, 1);
}
TEST_F(Desk, OverForce) {
  start();
  readings.muscle[0].force = 4000;  // 216 N, through a filter of 61 samples
  expect_fault(Fault::kOverForce, 61 + 5);
}
TEST_F(Desk, OverSpeed) {
  start();
  int within = 0;
  for (; output[0] != 0.0 && within < 50; ++within) {
    readings.muscle[0].encoder += 150;  // 15 rad/s
    tick();
  }
  EXPECT_LE(within, 8 + 5);
  EXPECT_EQ(firmware.fault(), Fault::kOverSpeed);
}
TEST_F(Desk, PositionLimit) {
  start();
  int within = 0;
  for (; output[0] != 0.0 && within < 10000; ++within) {
    readings.muscle[0].encoder += 50;  // 5 rad/s
    tick();
  }
  EXPECT_EQ(firmware.fault(), Fault::kPositionLimit);
  EXPECT_NEAR(readings.muscle[0].encoder * 1e-4, 30.5, 0.02);
}
TEST_F(Desk, OverTemperature) {
  start();
  readings.muscle[0].temperature = 86;
  expect_fault(Fault::kOverTemperature, 1);
}
TEST_F(Desk, SupplyLow) {
  start();
  readings.supply = 8.0;
  expect_fault(Fault::kSupplyLow, 10);
}
TEST_F(Desk, SupplyHigh) {
  start();
  readings.supply = 25.0;
  expect_fault(Fault::kSupplyHigh, 10);
}
TEST_F(Desk, ForceSensorAtItsLowStop) {
  start();
  readings.muscle[0].force = kLowestCount;
  run(100);
  EXPECT_EQ(firmware.fault(), Fault::kNone);
  readings.muscle[0].force = kLowestCount - 1;
  expect_fault(Fault::kForceSensor, 20);
}
TEST_F(Desk, ForceSensorAtItsHighStop) {
  // Else that would be too much force before it lasted long enough for a broken sensor.
  configuration[static_cast<int>(Parameter::kForceLimit)] = 300.0f;
  start();
  readings.muscle[0].force = kHighestCount;
  run(100);
  EXPECT_EQ(firmware.fault(), Fault::kNone);
  readings.muscle[0].force = kHighestCount + 1;
  expect_fault(Fault::kForceSensor, 20);
}
TEST_F(Desk, Encoder) {
  start();
  volts = 8.0;
  expect_fault(Fault::kEncoder, 310);
}
TEST_F(Desk, AnEncoderThatFlickersStandsStill) {
  start();
  volts = 8.0;
  int within = 0;
  for (; output[0] != 0.0 && within < 1000; ++within) {
    readings.muscle[0].encoder = within / 7 % 3;
    tick();
  }
  EXPECT_LE(within, 310);
  EXPECT_EQ(firmware.fault(), Fault::kEncoder);
}
TEST_F(Desk, AnEncoderThatCountsSlowlyMoves) {
  start();
  volts = 8.0;
  for (int i = 0; i < 3000; ++i) {
    readings.muscle[0].encoder -= i % 20 == 0;  // 5 mrad/s
    tick();
  }
  EXPECT_EQ(firmware.fault(), Fault::kNone) << name(firmware.fault());
}
TEST_F(Desk, BusOff) {
  start();
  readings.bus_off = true;
  expect_fault(Fault::kBusOff, 1);
}
TEST_F(Desk, SelfTest) {
  readings.muscle[0].current = 0;
  run(60);
  EXPECT_EQ(firmware.fault(), Fault::kSelfTest);
  EXPECT_EQ(firmware.state(), State::kFault);
}

TEST_F(Desk, AFailedSelfTestCannotBeCleared) {
  readings.muscle[0].current = 0;
  run(60);
  readings.muscle[0].current = 2048;
  request(Operation::kClear);
  EXPECT_EQ(report.refusal, Refusal::kSelfTest);
  EXPECT_EQ(firmware.state(), State::kFault);
  EXPECT_EQ(report.fault, Fault::kSelfTest);
}
TEST_F(Desk, AStopWhileBootingDoesNotSkipTheSelfTest) {
  readings.muscle[1].current = 0;
  run(10);
  firmware.receive(Frame{});
  request(Operation::kClear);
  EXPECT_EQ(report.refusal, Refusal::kSelfTest);
  EXPECT_TRUE(report.stop_latched);
  run(60);
  EXPECT_EQ(firmware.state(), State::kFault);
  EXPECT_EQ(report.fault, Fault::kSelfTest);
  EXPECT_EQ(report.muscle, 1);
  request(Operation::kClear);
  EXPECT_EQ(firmware.state(), State::kFault);
}
TEST_F(Desk, AStopWhileBootingHoldsPastTheSelfTest) {
  run(10);
  firmware.receive(Frame{});
  tick();
  EXPECT_EQ(firmware.state(), State::kBoot);
  EXPECT_TRUE(report.stop_latched);
  configure();
  EXPECT_EQ(firmware.state(), State::kStopping);
  request(Operation::kEnable);
  EXPECT_EQ(report.refusal, Refusal::kStopLatched);
  request(Operation::kClear);
  EXPECT_EQ(firmware.state(), State::kIdle);
  request(Operation::kEnable);
  EXPECT_EQ(firmware.state(), State::kEnabled);
}
TEST_F(Desk, AFaultWhileBootingDoesNotSkipTheSelfTest) {
  readings.muscle[0].current = 0;
  readings.supply = 8.0;
  run(20);
  ASSERT_EQ(firmware.fault(), Fault::kSupplyLow);
  readings.supply = 12.0;
  request(Operation::kClear);
  EXPECT_EQ(report.refusal, Refusal::kSelfTest);
  run(60);
  EXPECT_EQ(report.fault, Fault::kSelfTest);
  request(Operation::kClear);
  EXPECT_EQ(firmware.state(), State::kFault);
}

TEST_F(Desk, AFaultHoldsUntilClearedAndThenIsIdle) {
  start();
  readings.muscle[0].temperature = 86;
  tick();
  readings.muscle[0].temperature = 30;
  run(200);
  EXPECT_EQ(firmware.state(), State::kFault);
  request(Operation::kEnable);
  EXPECT_EQ(report.refusal, Refusal::kInFault);
  request(Operation::kClear);
  EXPECT_EQ(firmware.state(), State::kIdle);
  run(200);
  EXPECT_EQ(output[0], 0.0);
}

TEST_F(Desk, PositionReferencesAreClippedAndRateLimited) {
  start();
  mode = Mode::kPosition;
  volts = 31.0;  // [rad], beyond the limit of 30
  run(5);
  const double early = output[0];
  EXPECT_GT(early, 0.0);
  EXPECT_LT(early, 5.0 * 50.0 * 0.006 + 1e-9);
  run(100);
  EXPECT_EQ(output[0], 12.0);
}

TEST_F(Desk, WithoutForceSensorThereIsNoForceMode) {
  configuration[static_cast<int>(Parameter::kForceGain)] = 0.0f;
  start();
  mode = Mode::kForce;
  expect_fault(Fault::kReferenceLost, Firmware::kWatchdogTicks);
}

TEST_F(Desk, LimitsStandStillWhileEnabledGainsMayChange) {
  start();
  const auto write = [&](Parameter parameter, float value) {
    ParameterMessage message;
    message.write = true;
    message.index = static_cast<std::uint8_t>(parameter);
    message.value = value;
    sent.clear();
    firmware.receive(encode_parameter_request(message, 3));
    tick();
    for (const Frame& frame : sent) {
      if (function_of(frame) == static_cast<int>(Function::kParameterReply)) {
        return decode_parameter(frame);
      }
    }
    return ParameterMessage{};
  };
  EXPECT_EQ(write(Parameter::kCurrentLimit, 19.0f).result, ParameterResult::kNotNow);
  EXPECT_EQ(write(Parameter::kCurrentLimit, 19.0f).value, 10.0f);
  EXPECT_EQ(write(Parameter::kPositionProportional, 7.0f).result, ParameterResult::kOk);
  EXPECT_EQ(write(Parameter::kPositionProportional, 7.0f).value, 7.0f);
  EXPECT_EQ(write(Parameter::kPositionProportional, -7.0f).result, ParameterResult::kOutOfRange);
  EXPECT_EQ(write(Parameter::kPositionProportional, -7.0f).value, 7.0f);
}

/// What the unit answers to index 65 of a muscle.
class ZeroDesk : public Desk {
 protected:
  ParameterMessage tell(bool write, int index, float value, int muscle = 0) {
    ParameterMessage message;
    message.write = write;
    message.muscle = static_cast<std::uint8_t>(muscle);
    message.index = static_cast<std::uint8_t>(index);
    message.value = value;
    sent.clear();
    firmware.receive(encode_parameter_request(message, 3));
    tick();
    for (const Frame& frame : sent) {
      if (function_of(frame) == static_cast<int>(Function::kParameterReply)) {
        return decode_parameter(frame);
      }
    }
    ADD_FAILURE() << "no reply";
    return message;
  }
  float known(int muscle = 0) { return tell(false, kZeroKnown, 0.0f, muscle).value; }
  void set_zeros() {
    for (int m = 0; m < 2; ++m) {
      EXPECT_EQ(tell(true, kPresentPosition, 0.0f, m).result, ParameterResult::kOk);
    }
  }
};

TEST_F(ZeroDesk, AZeroIsKnownFromThePositionOnThatWasWritten) {
  configuration[static_cast<int>(Parameter::kPositionHigh)] = 50.0f;
  configure();
  const std::uint16_t configuration_before = report.configuration;
  EXPECT_EQ(tell(false, kZeroKnown, 7.0f).result, ParameterResult::kOk);
  EXPECT_EQ(known(0), 0.0f);
  tell(true, kPresentPosition, 51.0f);
  EXPECT_EQ(known(0), 0.0f);
  EXPECT_EQ(tell(true, kPresentPosition, 50.0f).result, ParameterResult::kOk);
  EXPECT_EQ(known(0), 1.0f);
  EXPECT_EQ(known(1), 0.0f);
  run(100);
  EXPECT_EQ(report.configuration, configuration_before);
  // It cannot be claimed, only given up.
  EXPECT_EQ(tell(true, kZeroKnown, 1.0f, 1).result, ParameterResult::kOutOfRange);
  EXPECT_EQ(known(1), 0.0f);
  EXPECT_EQ(tell(true, kZeroKnown, 0.0f, 0).result, ParameterResult::kOk);
  EXPECT_EQ(known(0), 0.0f);
}

TEST_F(ZeroDesk, AZeroOutlivesStopsAndFaultsThatLoseNoCounts) {
  start();
  set_zeros();
  readings.muscle[0].temperature = 86;
  run(10);
  ASSERT_EQ(firmware.fault(), Fault::kOverTemperature);
  readings.muscle[0].temperature = 30;
  request(Operation::kClear);
  firmware.receive(Frame{});
  run(10);
  request(Operation::kClear);
  EXPECT_EQ(known(0), 1.0f);
  EXPECT_EQ(known(1), 1.0f);
}

TEST_F(ZeroDesk, AnEncoderThatMayHaveMissedCountsHasNoZero) {
  start();
  set_zeros();
  volts = 8.0;
  run(400);
  ASSERT_EQ(firmware.fault(), Fault::kEncoder);
  request(Operation::kClear);
  EXPECT_EQ(known(0), 0.0f);
}

TEST_F(ZeroDesk, AFaultThatLosesTheZeroDoesNotHideBehindAnother) {
  start();
  set_zeros();
  // In FAULT already, and with the force sensor at its stop.
  readings.muscle[0].force = 0;
  run(25);
  ASSERT_EQ(firmware.fault(), Fault::kForceSensor);
  for (int i = 0; i < 20; ++i) {
    readings.muscle[0].encoder += 150;  // 15 rad/s
    tick();
  }
  EXPECT_EQ(firmware.fault(), Fault::kForceSensor);
  EXPECT_EQ(known(0), 0.0f);
  EXPECT_EQ(known(1), 1.0f);
}

TEST_F(Desk, AnotherProtocolVersionIsNoSync) {
  configure();
  host = false;
  run(20);
  firmware.receive(encode(Sync{++counter, kProtocolVersion + 1, true}));
  request(Operation::kEnable);
  EXPECT_EQ(report.refusal, Refusal::kNoSync);
}

}  // namespace
}  // namespace ecu
}  // namespace anthrob
