#include "anthrob_driver/robot_driver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "anthrob_core/errors.h"
#include "rig.h"

namespace anthrob {
namespace driver {
namespace {

using Phase = RobotDriver::Phase;

/// Null if nothing of that kind was found.
const Findings::Entry* found(Rig& rig, Finding finding) {
  const auto& entries = rig.driver().findings().entries();
  const auto entry = std::find_if(entries.begin(), entries.end(),
                                  [finding](const auto& e) { return e.finding == finding; });
  return entry == entries.end() ? nullptr : &*entry;
}

TEST(RobotDriver, ConfiguresEveryEcuAndReadsItBack) {
  Rig rig;
  rig.run(1000);
  ASSERT_EQ(rig.rack.size(), 7u);
  for (std::size_t e = 0; e < 7; ++e) {
    EXPECT_TRUE(rig.driver().link(e).configured()) << e;
    for (std::size_t c = 0; c < rig.hardware.ecus[e].muscles.size(); ++c) {
      const auto muscle = static_cast<std::size_t>(rig.hardware.ecus[e].muscles[c]);
      const auto& held = rig.rack.board(e).firmware().channel(static_cast<int>(c)).parameters;
      for (int i = 0; i < ecu::kParameterCount; ++i) {
        EXPECT_EQ(held.raw(i), rig.hardware.muscles[muscle].parameters.raw(i));
      }
    }
  }
  EXPECT_EQ(rig.moving(), 0);
}

TEST(RobotDriver, NothingMovesBeforeEnable) {
  Rig rig;
  rig.commander_runs = true;
  for (int i = 0; i < 2000; ++i) {
    rig.step();
    ASSERT_EQ(rig.moving(), 0) << "at " << i << " ms";
  }
  const ecu::Supervisor& supervisor = rig.driver().supervisor();
  EXPECT_EQ(supervisor.rejected_count(), 100u);
  EXPECT_EQ(supervisor.last_rejection(), "not enabled: call enable");
  EXPECT_FALSE(supervisor.command_age(rig.now()));
}

TEST(RobotDriver, EnablesAndMovesAllMuscles) {
  Rig rig;
  ASSERT_TRUE(rig.start()) << rig.driver().last_outcome().reason;
  rig.run(3000);
  const Sample& sample = rig.samples.back();
  ASSERT_EQ(sample.muscles.size(), 13u);
  for (std::size_t m = 0; m < 13; ++m) {
    const Plant::Muscle truth = rig.plant.muscle(m);
    EXPECT_TRUE(sample.muscles[m].measured);
    EXPECT_EQ(sample.muscles[m].state, ecu::State::kEnabled);
    EXPECT_EQ(sample.muscles[m].voltage, 0.5);
    EXPECT_EQ(sample.muscles[m].reference, 0.5);
    EXPECT_NEAR(sample.muscles[m].position, truth.position, 0.01);
    EXPECT_NEAR(sample.muscles[m].current, truth.current, 0.05);
    if (rig.hardware.muscles[m].parameters.has_force_sensor()) {
      EXPECT_NEAR(sample.muscles[m].force, truth.force, 0.5);
    } else {
      EXPECT_TRUE(std::isnan(sample.muscles[m].force));
    }
  }
}

TEST(RobotDriver, ACommandThatWasNotSentJustNowIsRefused) {
  Rig rig;
  rig.run(1000);
  ASSERT_TRUE(rig.enable());
  const auto go = [&](double age) {
    return rig.driver().command({"brachialis"}, {0}, {1.0}, rig.now(), age);
  };
  EXPECT_EQ(go(3.14).reason, "sent 3.1 s ago: a recording, or the clocks of two computers differ");
  EXPECT_EQ(go(-0.6).reason,
            "sent 0.6 s ahead of time: a recording, or the clocks of two computers differ");
  EXPECT_EQ(rig.driver().supervisor().rejected_count(), 2u);
  EXPECT_FALSE(rig.driver().supervisor().command_age(rig.now()));  // they feed no watch
  rig.run(50);
  EXPECT_EQ(rig.moving(), 0);
  for (const double age : {0.4, 0.0, -0.4}) EXPECT_TRUE(go(age).accepted) << age;
  // An old one does not keep the motors going either.
  rig.run(300);
  EXPECT_FALSE(go(3.0).accepted);
  rig.run(300);
  EXPECT_EQ(rig.driver().findings().count(Finding::kCommandTimeout), 1u);
}

TEST(RobotDriver, AFirstPositionFarFromWhereTheMuscleIsIsRefused) {
  RobotDriver::Options options;
  options.first_step = 0.5;
  Rig rig(true, options);
  rig.run(1000);
  ASSERT_TRUE(rig.enable());
  const auto go = [&](double to, ecu::Mode mode = ecu::Mode::kPosition) {
    return rig.driver().command({"teres_minor", "brachialis"}, {0, static_cast<std::uint8_t>(mode)},
                                {0.0, to}, rig.now());
  };
  EXPECT_EQ(
      go(3.0).reason,
      "muscle 'brachialis': POSITION 3.00 rad is 3.00 rad from where the muscle is, more than "
      "first_step (0.50 rad): begin near its present position");
  EXPECT_EQ(rig.driver().supervisor().rejected_count(), 1u);
  EXPECT_FALSE(rig.driver().supervisor().command_age(rig.now()));  // it feeds no watch
  rig.run(100);
  EXPECT_EQ(rig.moving(), 0);
  EXPECT_EQ(go(NAN).reason, "muscle 'brachialis': reference is not a finite number");
  // A command that names more muscles than there are is malformed before anything else.
  const std::vector<std::string> names(14, "brachialis");
  EXPECT_EQ(
      rig.driver()
          .command(names, std::vector<std::uint8_t>(14, 1), std::vector<double>(14, 3.0), rig.now())
          .reason,
      "muscle 'brachialis': named twice");
  // From where it stands the way is free.
  ASSERT_TRUE(go(0.4).accepted);
  rig.run(100);
  ASSERT_TRUE(go(3.0).accepted);
  for (int i = 0; i < 30; ++i) {
    rig.run(100);
    ASSERT_TRUE(go(3.0).accepted);
  }
  // What stopped starts again from where it stands.
  rig.driver().disable();
  rig.run(300);
  ASSERT_TRUE(rig.enable());
  EXPECT_FALSE(go(0.4).accepted);
  ASSERT_TRUE(go(0.5, ecu::Mode::kVoltage).accepted);
  EXPECT_FALSE(go(0.4).accepted);
}

TEST(RobotDriver, AFirstStepOutOfRangeIsRefused) {
  for (const double step : {-1.0, 1e9, static_cast<double>(NAN)}) {
    RobotDriver::Options options;
    options.first_step = step;
    EXPECT_THROW(Rig(true, options), BadInput) << step;
  }
}

/// As a driver before this one left it.
TEST(RobotDriver, AnEnableHasANumberThatNoUnitReportedLast) {
  Rig rig;
  rig.run(1000);
  ecu::Request old;
  old.operation = ecu::Operation::kEnable;
  old.sequence = 1;
  rig.rack.board(2).receive(ecu::encode(old, rig.hardware.ecus[2].node));
  rig.run(20);
  ASSERT_EQ(rig.driver().link(2).report().sequence, 1);
  ASSERT_EQ(rig.driver().link(2).report().refusal, ecu::Refusal::kWrongSession);
  EXPECT_TRUE(rig.enable()) << rig.driver().last_outcome().reason;
}

TEST(RobotDriver, OneEcuMissingAndNoneIsEnabled) {
  Rig rig;
  rig.rack.board(5).set_power(false);
  rig.run(1500);
  const auto outcome = rig.driver().start_enable(rig.now());
  EXPECT_FALSE(outcome.accepted);
  EXPECT_NE(outcome.reason.find("ecu_6"), std::string::npos) << outcome.reason;
  rig.commander_runs = true;
  rig.run(500);
  EXPECT_EQ(rig.moving(), 0);
}

TEST(RobotDriver, OneEcuRefusesAndAllAreDisabled) {
  Rig rig;
  rig.run(1000);
  // Its supply fails in the moment of enabling.
  ASSERT_TRUE(rig.driver().start_enable(rig.now()).accepted);
  rig.rack.board(4).set_power(false);
  rig.commander_runs = true;
  for (int ms = 0; ms < 1000; ++ms) {
    rig.step();
    ASSERT_EQ(rig.moving(), 0);
  }
  EXPECT_FALSE(rig.driver().last_outcome().accepted);
  EXPECT_EQ(rig.driver().phase(), Phase::kDisabled);
}

TEST(RobotDriver, StaleDataIsNeverGivenOutAgain) {
  Rig rig;
  ASSERT_TRUE(rig.start());
  rig.rack.board(2).set_power(false);
  rig.samples.clear();
  rig.run(200);
  std::int64_t last = 0;
  for (const Sample& sample : rig.samples) {
    EXPECT_GT(sample.stamp_ns, last);
    last = sample.stamp_ns;
    EXPECT_FALSE(sample.muscles[4].measured);
    EXPECT_TRUE(std::isnan(sample.muscles[4].position));
    EXPECT_TRUE(sample.muscles[0].measured);
  }
  EXPECT_EQ(rig.samples.back().muscles[4].state, ecu::State::kFault);
  // Nobody answers: nothing to give out.
  for (std::size_t e = 0; e < rig.rack.size(); ++e) rig.rack.board(e).set_power(false);
  rig.run(10);
  rig.samples.clear();
  rig.run(200);
  EXPECT_TRUE(rig.samples.empty());
}

TEST(RobotDriver, AnOldAnswerDoesNotPassForTheFirstAfterALoss) {
  Rig rig;
  ASSERT_TRUE(rig.start());
  const int node = rig.hardware.ecus[2].node;
  // What the unit said to a SYNC stays in its controller, which has left the bus; when it is back
  // the four bits of the counter have come round.
  std::vector<ecu::Frame> waiting;
  bool off = false;
  rig.bus.tamper = [&](const ecu::Frame& f, const MemoryBus::Port&) {
    const int function = ecu::function_of(f);
    if (ecu::node_of(f) != node || function < 4 || function > 7) return std::vector<ecu::Frame>{f};
    if (off && waiting.size() < 3) waiting.push_back(f);
    return off ? std::vector<ecu::Frame>{} : std::vector<ecu::Frame>{f};
  };
  while (rig.ms % rig.period_ms != 0) rig.step();
  off = true;
  const std::uint64_t lost = rig.driver().cycles();
  rig.run(rig.period_ms);
  ASSERT_EQ(waiting.size(), 3u);
  const double old = ecu::decode_motion(waiting[0]).position;
  while (rig.driver().cycles() < lost + 1 + 16) rig.step();
  ASSERT_FALSE(rig.driver().link(2).alive());
  rig.samples.clear();
  off = false;
  rig.bus.tamper = nullptr;
  for (const ecu::Frame& frame : waiting) rig.stranger.send(frame);
  rig.run(1);
  EXPECT_FALSE(rig.driver().link(2).alive());
  rig.run(30);
  EXPECT_TRUE(rig.driver().link(2).alive());
  int measured = 0;
  for (const Sample& sample : rig.samples) {
    if (!sample.muscles[4].measured) continue;
    ++measured;
    EXPECT_NE(sample.muscles[4].position, old);
  }
  EXPECT_GE(measured, 4);
}

TEST(RobotDriver, ASampleHasTheReferencesThatWentOutWithItsSync) {
  Rig rig;
  ASSERT_TRUE(rig.start());
  while (rig.ms % 20 != 0) rig.step();
  rig.volts[0] = 0.7;
  rig.step();  // the command comes between SYNC and the answers
  EXPECT_EQ(rig.samples.back().muscles[0].reference, 0.5);
  rig.run(5);
  EXPECT_EQ(rig.samples.back().muscles[0].reference, 0.7);
}

TEST(RobotDriver, AUnitThatSpeaksOnlyAnotherVersionIsNamed) {
  Rig rig;
  rig.rack.board(2).set_power(false);
  rig.run(1500);
  EXPECT_EQ(rig.driver().start_enable(rig.now()).reason,
            "ecu_3: was never heard; is it switched on?");
  EXPECT_EQ(rig.driver().findings().count(Finding::kWrongVersion), 0u);
  ecu::StateReport report;
  report.version = ecu::kProtocolVersion + 1;
  rig.stranger.send(ecu::encode(report, rig.hardware.ecus[2].node));
  rig.run(20);
  const std::uint64_t silences = rig.driver().findings().count(Finding::kEcuSilent);
  rig.run(100);
  EXPECT_EQ(rig.driver().start_enable(rig.now()).reason,
            "ecu_3: speaks another protocol: version " + std::to_string(report.version) +
                ", expected " + std::to_string(ecu::kProtocolVersion));
  EXPECT_GT(rig.driver().findings().count(Finding::kWrongVersion), 0u);
  EXPECT_EQ(rig.driver().findings().count(Finding::kEcuSilent), silences);  // it is not silent
}

TEST(RobotDriver, AUnitThatCannotBeConfiguredIsNamed) {
  Rig rig;
  const int node = rig.hardware.ecus[2].node;
  // As if it had another number of muscles: it takes all parameters, but has others beside them.
  rig.bus.tamper = [node](const ecu::Frame& f, const MemoryBus::Port&) {
    const bool report = ecu::function_of(f) == static_cast<int>(ecu::Function::kState);
    if (!report || ecu::node_of(f) != node) return std::vector<ecu::Frame>{f};
    ecu::StateReport state = ecu::decode_state(f);
    state.configuration = static_cast<std::uint16_t>(state.configuration ^ 1);
    return std::vector<ecu::Frame>{ecu::encode(state, node)};
  };
  rig.run(5000);
  const Findings::Entry* const refused = found(rig, Finding::kConfigurationRefused);
  ASSERT_NE(refused, nullptr);
  EXPECT_EQ(refused->ecu, 2);
  EXPECT_NE(refused->detail.find("another number of muscles"), std::string::npos);
  EXPECT_EQ(rig.driver().start_enable(rig.now()).accepted, false);
}

/// Whatever the n-th ECU sends that has one of these functions is lost.
void drop(Rig& rig, std::size_t ecu, std::vector<ecu::Function> functions) {
  const int node = rig.hardware.ecus[ecu].node;
  rig.bus.tamper = [node, functions](const ecu::Frame& f, const MemoryBus::Port&) {
    const bool one = std::any_of(functions.begin(), functions.end(), [&](ecu::Function function) {
      return ecu::function_of(f) == static_cast<int>(function);
    });
    return ecu::node_of(f) == node && one ? std::vector<ecu::Frame>{} : std::vector<ecu::Frame>{f};
  };
}

TEST(RobotDriver, AUnitThatReportsButDoesNotMeasureIsNamed) {
  Rig rig;
  drop(rig, 2, {ecu::Function::kMotionA, ecu::Function::kMotionB, ecu::Function::kEffort});
  rig.run(500);
  EXPECT_EQ(rig.driver().findings().count(Finding::kEcuLost), 0u);  // it may still begin
  rig.run(1500);
  const Findings::Entry* const lost = found(rig, Finding::kEcuLost);
  ASSERT_NE(lost, nullptr);
  EXPECT_EQ(lost->ecu, 2);
}

TEST(RobotDriver, AUnitWithFewerMusclesIsNamed) {
  Rig rig;
  const int node = rig.hardware.ecus[2].node;
  rig.bus.tamper = [node](const ecu::Frame& f, const MemoryBus::Port&) {
    const bool reply = ecu::function_of(f) == static_cast<int>(ecu::Function::kParameterReply);
    if (!reply || ecu::node_of(f) != node) return std::vector<ecu::Frame>{f};
    ecu::ParameterMessage message = ecu::decode_parameter(f);
    if (message.muscle == 1) message.result = ecu::ParameterResult::kUnknown;
    return std::vector<ecu::Frame>{ecu::encode_parameter_reply(message, node)};
  };
  rig.run(3000);
  const Findings::Entry* const refused = found(rig, Finding::kConfigurationRefused);
  ASSERT_NE(refused, nullptr);
  const auto second = static_cast<std::size_t>(rig.hardware.ecus[2].muscles[1]);
  EXPECT_EQ(refused->detail.find(rig.hardware.muscles[second].name + ": "), 0u) << refused->detail;
  EXPECT_NE(refused->detail.find("has the ECU as many muscles as in hardware.yaml?"),
            std::string::npos)
      << refused->detail;
}

TEST(RobotDriver, OfABusOnWhichNobodyAnswersNoUnitIsBlamed) {
  Rig rig;
  ASSERT_TRUE(rig.start());
  rig.bus.tamper = [](const ecu::Frame&, const MemoryBus::Port&) {
    return std::vector<ecu::Frame>{};
  };
  rig.run(300);
  EXPECT_EQ(rig.moving(), 0);
  EXPECT_EQ(rig.driver().stops().last().value_or("").find("bus_silent: "), 0u)
      << rig.driver().stops().last().value_or("");
  EXPECT_EQ(rig.driver().findings().count(Finding::kEcuLost), 0u);
  rig.bus.tamper = nullptr;
  rig.run(500);
  EXPECT_EQ(rig.moving(), 0);
  EXPECT_TRUE(rig.enable()) << rig.driver().last_outcome().reason;  // without clear_faults
}

TEST(RobotDriver, ABusThatIsCutWithinACycleIsNoUnitsFaultEither) {
  Rig rig;
  ASSERT_TRUE(rig.start());
  int efforts = 0;  // ends an ECU's answer
  rig.bus.tamper = [&efforts](const ecu::Frame& frame, const MemoryBus::Port&) {
    if (efforts == 3) return std::vector<ecu::Frame>{};
    efforts += ecu::function_of(frame) == static_cast<int>(ecu::Function::kEffort);
    return std::vector<ecu::Frame>{frame};
  };
  rig.run(300);
  EXPECT_EQ(rig.moving(), 0);
  EXPECT_EQ(rig.driver().stops().count(), 1u);
  EXPECT_EQ(rig.driver().stops().last().value_or("").find("bus_silent: "), 0u)
      << rig.driver().stops().last().value_or("");
  EXPECT_EQ(rig.driver().findings().count(Finding::kEcuLost), 0u);
}

TEST(RobotDriver, AControllerThatIsNoLongerPassiveIsTrusted) {
  Rig rig;
  ASSERT_TRUE(rig.start());
  rig.host.report(BusEvent::Kind::kErrorPassive);
  rig.run(20);
  EXPECT_EQ(rig.moving(), 0);
  rig.host.report(BusEvent::Kind::kBusError);  // says nothing about its count
  rig.run(20);
  EXPECT_FALSE(rig.enable());
  rig.host.report(BusEvent::Kind::kErrorWarning);
  rig.run(20);
  EXPECT_TRUE(rig.enable()) << rig.driver().last_outcome().reason;
}

TEST(RobotDriver, ADelayedCommandDoesNotBeginTheTimeOutAnew) {
  Rig rig;
  ASSERT_TRUE(rig.start());
  rig.commander_runs = false;
  rig.run(300);
  const std::vector<std::string> names = {rig.hardware.muscles.front().name};
  ASSERT_TRUE(rig.driver().command(names, {0}, {0.5}, rig.now(), 0.4).accepted);
  EXPECT_NEAR(rig.driver().supervisor().command_age(rig.now()).value(), 0.3, 0.021);
  ASSERT_TRUE(rig.driver().command(names, {0}, {0.5}, rig.now(), 0.1).accepted);
  EXPECT_NEAR(rig.driver().supervisor().command_age(rig.now()).value(), 0.1, 1e-9);
  ASSERT_TRUE(rig.driver().command(names, {0}, {0.5}, rig.now(), -0.4).accepted);
  EXPECT_NEAR(rig.driver().supervisor().command_age(rig.now()).value(), 0.0, 1e-9);
}

TEST(RobotDriver, ASecondUploadOfParametersIsNoRefusal) {
  Rig rig;
  rig.run(1000);
  const std::size_t last = rig.hardware.ecus[2].muscles.size() - 1;
  const auto muscle = static_cast<std::size_t>(rig.hardware.ecus[2].muscles[last]);
  int uploads = 0;
  for (int index = 0; index < ecu::kParameterCount; index += 2) {
    // Somebody else writes a parameter, as anthrob_can_check with another hardware.yaml does: early
    // or late in the order of the driver's own upload.
    ecu::ParameterMessage other;
    other.muscle = static_cast<std::uint8_t>(last);
    other.index = static_cast<std::uint8_t>(index);
    other.value = 0.9f * rig.hardware.muscles[muscle].parameters.raw(index);
    other.write = true;
    rig.rack.board(2).receive(ecu::encode_parameter_request(other, rig.hardware.ecus[2].node));
    for (int ms = 0; ms < 200 && rig.driver().link(2).configured(); ++ms) rig.step();
    uploads += !rig.driver().link(2).configured();  // not where it was 0
    rig.run(2000);
    ASSERT_TRUE(rig.driver().link(2).configured()) << index;
  }
  EXPECT_GE(uploads, 3);
  EXPECT_EQ(rig.driver().findings().count(Finding::kConfigurationRefused), 0u);
}

TEST(RobotDriver, BusLoadIsAsCalculated) {
  Rig rig;
  ASSERT_TRUE(rig.start());
  const auto bits = rig.bus.bits(), frames = rig.bus.frames();
  rig.run(5000);
  EXPECT_EQ((rig.bus.frames() - frames) / 5, 5884u);  // docs/ecu_protocol.md
  const double load = static_cast<double>(rig.bus.bits() - bits) / 5.0 / 1e6;
  EXPECT_GT(load, 0.647);
  EXPECT_LT(load, 0.786);
}

}  // namespace
}  // namespace driver
}  // namespace anthrob
