// config/anthrob/anthrob_ecu.dbc says the same as the codec: every signal of random good frames,
// read as the .dbc describes it, has the value that the decoder gives.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <random>
#include <regex>
#include <set>

#include "anthrob_ecu/protocol.h"

namespace anthrob {
namespace ecu {
namespace {

struct Signal {
  int start, width;
  bool is_signed;
  double scale;
};
struct Message {
  std::string name;
  int length;
  std::map<std::string, Signal> signals;
};

class Dbc : public testing::Test {
 protected:
  void SetUp() override {
    std::ifstream in(ANTHROB_CONFIG_DIR "/anthrob/anthrob_ecu.dbc");
    ASSERT_TRUE(in);
    const std::regex message(R"(BO_ (\d+) (\w+): (\d+) \w+)");
    const std::regex signal(R"( SG_ (\w+) : (\d+)\|(\d+)@1([+-]) \(([^,]+),0\).*)");
    std::smatch m;
    Message* current = nullptr;
    for (std::string line; std::getline(in, line);) {
      text += line + "\n";
      if (std::regex_match(line, m, message)) {
        current = &messages[std::stoi(m[1])];
        *current = {m[2], std::stoi(m[3]), {}};
      } else if (std::regex_match(line, m, signal)) {
        ASSERT_NE(current, nullptr);
        current->signals[m[1]] = {std::stoi(m[2]), std::stoi(m[3]), m[4] == "-", std::stod(m[5])};
      }
    }
  }

  /// Bit by bit, unlike the codec.
  double read(const Frame& frame, const std::string& name) {
    const Signal s = messages.at(frame.id).signals.at(name);
    double value = 0.0;
    for (int i = 0; i < s.width; ++i) {
      const int bit = s.start + i;
      if ((frame.data[static_cast<std::size_t>(bit / 8)] >> (bit % 8) & 1) == 0) continue;
      value += (s.is_signed && i == s.width - 1 ? -1.0 : 1.0) * std::ldexp(1.0, i);
    }
    return s.scale * value;
  }

  Frame noise(Function function, int node) {
    Frame frame;
    frame.id = identifier(function, node);
    frame.length = static_cast<std::uint8_t>(kLengths[static_cast<int>(function)]);
    for (auto& byte : frame.data) byte = static_cast<std::uint8_t>(random());
    return frame;
  }

  std::string text;
  std::map<int, Message> messages;
  std::mt19937 random{5};
};

TEST_F(Dbc, LengthsAndNoOverlap) {
  EXPECT_EQ(messages.size(), 2u + 8u + 9u * 7u);
  for (const auto& [id, message] : messages) {
    EXPECT_EQ(message.length, kLengths[id >> 7]) << message.name;
    std::set<int> bits;
    for (const auto& [name, s] : message.signals) {
      for (int b = s.start; b < s.start + s.width; ++b) {
        EXPECT_TRUE(bits.insert(b).second) << message.name << " " << name;
        EXPECT_LT(b, 8 * message.length) << message.name << " " << name;
      }
    }
    if (message.length == 0) continue;
    EXPECT_EQ(message.signals.at("crc").start, 8 * (message.length - 1)) << message.name;
  }
}

TEST_F(Dbc, SaysTheSameAsTheCodec) {
  for (int i = 0; i < 2000; ++i) {
    const int node = 1 + i % 7;
    Frame f = noise(i % 2 == 0 ? Function::kMotionA : Function::kMotionB, node);
    const Motion motion = decode_motion(f);
    EXPECT_DOUBLE_EQ(read(f, "counter"), motion.counter);
    EXPECT_NEAR(read(f, "position"), motion.position, 1e-12);
    EXPECT_NEAR(read(f, "velocity"), motion.velocity, 1e-12);
    EXPECT_NEAR(read(f, "current"), motion.current, 1e-12);
    EXPECT_EQ(read(f, "stop_latched") != 0.0, motion.stop_latched);

    f = noise(Function::kEffort, node);
    const Effort effort = decode_effort(f);
    if (!std::isnan(effort.force[0])) {
      EXPECT_NEAR(read(f, "force_a"), effort.force[0], 1e-12);
    }
    if (!std::isnan(effort.force[1])) {
      EXPECT_NEAR(read(f, "force_b"), effort.force[1], 1e-12);
    }
    EXPECT_NEAR(read(f, "voltage_a"), effort.voltage[0], 1e-12);
    EXPECT_NEAR(read(f, "voltage_b"), effort.voltage[1], 1e-12);

    f = noise(Function::kReference, node);
    const Reference reference = decode_reference(f);
    EXPECT_EQ(read(f, "mode_a"), static_cast<int>(reference.mode[0]));
    EXPECT_EQ(read(f, "mode_b"), static_cast<int>(reference.mode[1]));
    const auto scale = [](Mode mode) { return mode == Mode::kForce ? 1e-4 : 1e-5; };
    EXPECT_NEAR(read(f, "reference_a") * scale(reference.mode[0]), reference.reference[0], 1e-9);
    EXPECT_NEAR(read(f, "reference_b") * scale(reference.mode[1]), reference.reference[1], 1e-9);

    f = noise(Function::kState, node);
    const StateReport report = decode_state(f);
    EXPECT_EQ(read(f, "fault"), static_cast<int>(report.fault));
    EXPECT_EQ(read(f, "refusal"), static_cast<int>(report.refusal));
    EXPECT_EQ(read(f, "configuration"), report.configuration);
    EXPECT_EQ(read(f, "session"), report.session);
    EXPECT_EQ(read(f, "sequence"), report.sequence);
    EXPECT_EQ(read(f, "version"), report.version);
    EXPECT_EQ(read(f, "muscle"), report.muscle);

    f = noise(Function::kRequest, node);
    const Request request = decode_request(f);
    EXPECT_EQ(read(f, "operation"), static_cast<int>(request.operation));
    EXPECT_EQ(read(f, "configuration"), request.configuration);

    f = noise(Function::kAnalog, node);
    EXPECT_EQ(read(f, "count_0"), decode_analog(f).count[0]);
    EXPECT_EQ(read(f, "count_3"), decode_analog(f).count[3]);

    f = noise(Function::kHealth, node);
    EXPECT_EQ(read(f, "temperature_b"), decode_health(f).temperature[1]);
    EXPECT_NEAR(read(f, "supply"), decode_health(f).supply, 1e-12);
    EXPECT_EQ(read(f, "refused_frames"), decode_health(f).refused_frames);

    f = noise(Function::kParameterReply, node);
    EXPECT_EQ(read(f, "index"), decode_parameter(f).index);
    EXPECT_EQ(read(f, "muscle"), decode_parameter(f).muscle);
  }
}

TEST_F(Dbc, NamesEveryCode) {
  for (const FaultInfo& fault : kFaults) {
    const std::string entry =
        std::to_string(static_cast<int>(fault.fault)) + " \"" + fault.name + "\"";
    EXPECT_NE(text.find(entry), std::string::npos) << entry;
  }
  for (int r = 0; r < kRefusalCount; ++r) {
    const std::string entry = std::to_string(r) + " \"" + name(static_cast<Refusal>(r)) + "\"";
    EXPECT_NE(text.find(entry), std::string::npos) << entry;
  }
  for (int s = 0; s < kStateCount; ++s) {
    const std::string entry = std::to_string(s) + " \"" + name(static_cast<State>(s)) + "\"";
    EXPECT_NE(text.find(entry), std::string::npos) << entry;
  }
}

}  // namespace
}  // namespace ecu
}  // namespace anthrob
