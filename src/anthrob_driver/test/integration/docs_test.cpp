// Every fault, refusal, finding and parameter is in the docs, with what the user should do, in the
// very words of the program. With DOCS_TABLES=1 in the environment the tables are printed, to be
// pasted.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "anthrob_driver/findings.h"
#include "anthrob_driver/robot_driver.h"
#include "anthrob_ecu/fault.h"
#include "anthrob_ecu/parameters.h"
#include "anthrob_ecu/protocol.h"
#include "emulation/board.h"
#include "link/ecu_link.h"
#include "routine/enabling.h"
#include "routine/zeros.h"
#include "watch/bus_watch.h"
#include "watch/encoder_watch.h"

namespace anthrob {
namespace driver {
namespace {

std::string read(const std::string& name) {
  std::ifstream in(std::string(ANTHROB_DOCS_DIR) + "/" + name);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

void expect_row(const std::string& text, const std::string& row) {
  if (std::getenv("DOCS_TABLES") != nullptr) std::printf("%s\n", row.c_str());
  EXPECT_NE(text.find(row), std::string::npos) << "missing: " << row;
}

std::string number(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

TEST(Docs, HaveEveryFaultOfTheEcu) {
  const std::string text = read("ecu_protocol.md");
  for (const ecu::FaultInfo& f : ecu::kFaults) {
    const char* const leads_to = f.fault == ecu::Fault::kNone ? "-"
                                 : ecu::stops_gently(f.fault) ? "STOPPING"
                                                              : "FAULT";
    expect_row(text, "| " + std::to_string(static_cast<int>(f.fault)) + " | `" + f.name + "` | " +
                         f.meaning + " | " + leads_to + " | " + f.remedy + " |");
  }
}

TEST(Docs, HaveEveryParameter) {
  const std::string text = read("ecu_protocol.md");
  for (const ecu::ParameterInfo& p : ecu::kParameters) {
    expect_row(text, "| " + std::to_string(static_cast<int>(p.parameter)) + " | `" + p.name +
                         "` | " + p.unit + " | " + number(p.lowest) + " to " + number(p.highest) +
                         " | " + (p.live ? "any time" : "not while enabled") + " | " + p.meaning +
                         " |");
  }
  const std::string zero = "| " + std::to_string(ecu::kPresentPosition) + " | `present_position` |";
  EXPECT_NE(text.find(zero), std::string::npos) << zero;
  const std::string known = "| " + std::to_string(ecu::kZeroKnown) + " | `zero_known` |";
  EXPECT_NE(text.find(known), std::string::npos) << known;
}

TEST(Docs, HaveEveryRefusal) {
  const std::string text = read("ecu_protocol.md");
  for (int r = 0; r < ecu::kRefusalCount; ++r) {
    const std::string name = ecu::name(static_cast<ecu::Refusal>(r));
    EXPECT_NE(text.find("| " + std::to_string(r) + " | `" + name + "` |"), std::string::npos)
        << name;
  }
}

TEST(Docs, HaveEveryFindingOfTheDriver) {
  const std::string text = read("robot.md");
  for (int i = 0; i < kFindingCount; ++i) {
    const FindingInfo& f = kFindings[i];
    EXPECT_EQ(static_cast<int>(f.finding), i);
    expect_row(text, "| `" + std::string(f.name) + "` | " + f.meaning + " | " +
                         (f.stops ? "stops" : "-") + " | " + f.remedy + " |");
  }
}

TEST(Docs, HaveEveryTimeOut) {
  const std::string text = read("robot.md");
  const auto expect = [&](const std::string& value, const std::string& constant) {
    EXPECT_NE(text.find(" | " + value + " | `" + constant + "` | "), std::string::npos)
        << constant << ": " << value;
  };
  const auto ms = [](double seconds) { return number(1000.0 * seconds) + " ms"; };
  expect(ms(0.001 * Board::kHardwareWatchdog), "Board::kHardwareWatchdog");
  expect(ms(0.001 * ecu::Firmware::kWatchdogTicks), "Firmware::kWatchdogTicks");
  EXPECT_EQ(EcuLink::kLostSyncs, 2);
  expect("two SYNCs", "EcuLink::kLostSyncs");
  expect(ms(Enabling::kTimeout), "Enabling::kTimeout");
  expect(ms(Zeros::kTimeout), "Zeros::kTimeout");
  expect(ms(EncoderWatch::kLasts), "EncoderWatch::kLasts");
  expect(number(RobotDriver::kSilence) + " s", "RobotDriver::kSilence");
  expect(ms(EcuLink::kReplyTimeout), "EcuLink::kReplyTimeout");
  expect(number(EcuLink::kRetryPause) + " s", "EcuLink::kRetryPause");
  expect(ms(BusWatch::kEchoTimeout) + " and two cycles", "BusWatch::kEchoTimeout");
  expect(number(BusWatch::kFullCycles) + " cycles", "BusWatch::kFullCycles");
  expect(number(BusWatch::kFlood), "BusWatch::kFlood");
  EXPECT_EQ(RobotDriver::Options().command_timeout, 0.5);
  EXPECT_NE(text.find("| `command_timeout` | 0.5 s |"), std::string::npos);
}

}  // namespace
}  // namespace driver
}  // namespace anthrob
