// Random and mutated frames against driver and ECUs: no crash, no motion, and after it all both
// still work. FUZZ_FRAMES in the environment says how many frames; scripts/fuzz.sh runs it with
// sanitizers.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "rig.h"

namespace anthrob {
namespace driver {
namespace {

std::uint64_t wanted_frames() {
  const char* text = std::getenv("FUZZ_FRAMES");
  return text != nullptr ? std::strtoull(text, nullptr, 10) : 50000;
}

/// Three kinds: pure noise; noise with a good checksum; true frames with bits turned over.
class Fuzzer {
 public:
  explicit Fuzzer(unsigned seed) : random_(seed) {}

  void learn(const ecu::Frame& frame) {
    if (known_.size() < 512) {
      known_.push_back(frame);
    } else {
      known_[random_() % known_.size()] = frame;
    }
  }

  ecu::Frame next() {
    const auto kind = random_() % 3;
    if (kind == 2 && !known_.empty()) return mutated(known_[random_() % known_.size()]);
    ecu::Frame frame;
    frame.id = static_cast<std::uint16_t>(random_() % 0x800);
    frame.length = static_cast<std::uint8_t>(random_() % 16);
    for (auto& byte : frame.data) byte = static_cast<std::uint8_t>(random_());
    if (kind == 1) seal(frame);
    return frame;
  }

 private:
  ecu::Frame mutated(ecu::Frame frame) {
    for (auto turns = random_() % 4; turns > 0; --turns) {
      frame.data[random_() % 8] ^= static_cast<std::uint8_t>(1u << (random_() % 8));
    }
    if (random_() % 8 == 0) frame.length = static_cast<std::uint8_t>(random_() % 16);
    if (random_() % 8 == 0) frame.id = static_cast<std::uint16_t>(random_() % 0x800);
    if (random_() % 2 == 0) seal(frame);
    return frame;
  }
  /// Makes the frame one that is read beyond its checksum.
  static void seal(ecu::Frame& frame) {
    const int function = ecu::function_of(frame);
    if (function == 0 || function >= ecu::kFunctionCount) return;
    frame.length = static_cast<std::uint8_t>(ecu::kLengths[function]);
    frame.data[static_cast<std::size_t>(frame.length - 1)] = ecu::checksum(frame);
  }

  std::mt19937_64 random_;
  std::vector<ecu::Frame> known_;
};

/// The fuzzer hears what driver and ECUs say to each other.
void let_learn(Fuzzer& fuzzer, Rig& rig) {
  rig.bus.tamper = [&](const ecu::Frame& frame, const MemoryBus::Port& from) {
    if (&from != &rig.stranger) fuzzer.learn(frame);
    return std::vector<ecu::Frame>{frame};
  };
}

/// Noise on the bus of a robot that nobody enabled. ENABLE is the only frame that can start a
/// motor. There is none on this bus to learn from, and noise would have to hit session and
/// configuration by chance: one frame in 2^40. The next test's noise has true ones.
TEST(Fuzz, NothingMovesAndNothingCrashes) {
  Rig rig;
  rig.run(1000);
  Fuzzer fuzzer(7);
  let_learn(fuzzer, rig);
  rig.commander_runs = true;
  const std::uint64_t total = wanted_frames();
  for (std::uint64_t sent = 0; sent < total;) {
    for (int i = 0; i < 20; ++i, ++sent) rig.stranger.send(fuzzer.next());
    rig.step();
    ASSERT_EQ(rig.moving(), 0) << "after " << sent << " frames";
  }
  // The bus is quiet again: everything recovers, disabled.
  rig.bus.tamper = nullptr;
  rig.commander_runs = false;
  rig.run(500);
  EXPECT_EQ(rig.moving(), 0);
  rig.driver().clear_faults(rig.now());
  // Noise may have written parameters: the driver finds out and writes them again.
  rig.run(3000);
  rig.driver().clear_faults(rig.now());
  rig.run(300);
  EXPECT_TRUE(rig.enable()) << rig.driver().last_outcome().reason;
}

/// Enabled and all muscles pulling, on a quiet bus, as a user would do it after noise.
bool set_in_motion(Rig& rig) {
  for (int attempt = 0; attempt < 10; ++attempt) {
    rig.driver().clear_faults(rig.now());
    rig.run(300);
    if (!rig.enable()) continue;
    rig.run(50);
    if (rig.moving() == static_cast<int>(rig.hardware.muscles.size())) return true;
  }
  return false;
}

/// The same at a moving robot: noise may stop it, but must never leave a motor running that the
/// driver believes stopped. Stopped, it is watched for a while and set in motion again.
TEST(Fuzz, InMotionNoiseStopsAtMost) {
  constexpr int kWatched = 40;  // [ms] with noise after a stop
  Rig rig;
  Fuzzer fuzzer(11);
  let_learn(fuzzer, rig);
  ASSERT_TRUE(rig.start());
  const std::uint64_t total = wanted_frames() / 5;
  std::uint64_t in_motion = 0;  // [ms]
  int stopped = 0, ran_on = 0;
  for (std::uint64_t sent = 0; sent < total; ++sent) {
    rig.stranger.send(fuzzer.next());
    rig.step();
    const bool disabled = rig.driver().phase() == RobotDriver::Phase::kDisabled;
    in_motion += !disabled && rig.moving() > 0;
    stopped = disabled ? stopped + 1 : 0;
    ran_on = disabled && rig.moving() > 0 ? ran_on + 1 : 0;
    ASSERT_LE(ran_on, 20) << "after " << sent << " frames";
    if (stopped < kWatched) continue;
    ASSERT_TRUE(set_in_motion(rig)) << rig.driver().last_outcome().reason << ", after " << sent;
    stopped = ran_on = 0;
  }
  RecordProperty("in_motion_ms", std::to_string(in_motion));
  EXPECT_GE(in_motion, total / 10) << "noise met a robot at rest";
}

TEST(Fuzz, DecodersTakeAnything) {
  std::mt19937_64 random(3);
  for (std::uint64_t i = 0; i < wanted_frames(); ++i) {
    ecu::Frame frame;
    frame.id = static_cast<std::uint16_t>(random());
    frame.length = static_cast<std::uint8_t>(random());
    for (auto& byte : frame.data) byte = static_cast<std::uint8_t>(random());
    ecu::inspect(frame);
    EXPECT_LT(static_cast<int>(ecu::decode_motion(frame).state), ecu::kStateCount);
    EXPECT_LT(static_cast<int>(ecu::decode_reference(frame).mode[1]), ecu::kModeCount);
    EXPECT_LE(ecu::decode_analog(frame).count[3], 4095);
    ecu::name(ecu::decode_state(frame).fault);
    ecu::name(ecu::decode_state(frame).refusal);
    ecu::name(ecu::decode_parameter(frame).result);
    ecu::decode_effort(frame), ecu::decode_health(frame), ecu::decode_request(frame);
  }
}

}  // namespace
}  // namespace driver
}  // namespace anthrob
