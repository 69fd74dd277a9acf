// Every way a bus, a host or an ECU can go wrong, injected into a moving robot: how long until zero
// volts at the ECU, what the driver calls it, and that nothing moves again before the user says so.
// With FAULT_TABLE=FILE in the environment the table goes to that file (studies/fault_campaign.md).
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <memory>

#include "rig.h"

namespace anthrob {
namespace driver {
namespace {

constexpr std::size_t kVictim = 2;        // ecu_3
constexpr int kVictimMuscles[] = {4, 5};  // its muscles
constexpr std::size_t kElbow = 5;         // ecu_6 reads its potentiometer
constexpr int kNone = -1;

struct FaultKind {
  const char* name;
  /// Zero volts expected at all muscles; kNobody: motion goes on.
  enum Reach { kEverybody, kNobody } reach;
  int finding;  ///< that diagnostics must name; kNone: nothing

  std::function<void(Rig&)> inject;
  std::function<void(Rig&)> repair;
  /// [ms] that the fault's own definition allows beside the 20 ms, such as a time-out.
  int grace = 0;
};

using Frames = std::vector<ecu::Frame>;

/// A tamper for frames from the host to the victim and SYNC.
bool to_victim(const ecu::Frame& frame) {
  return ecu::function_of(frame) == 3 && ecu::node_of(frame) == 3;
}
bool from_victim(const ecu::Frame& frame) {
  return ecu::function_of(frame) >= 4 && ecu::node_of(frame) == 3;
}
void untamper(Rig& rig) {
  rig.bus.tamper = nullptr;
}
void nothing(Rig&) {}

std::function<void(Rig&)> tamper(std::function<Frames(const ecu::Frame&)> change) {
  return [change](Rig& rig) {
    rig.bus.tamper = [change](const ecu::Frame& frame, const MemoryBus::Port&) {
      return change(frame);
    };
  };
}

ecu::Frame corrupted(ecu::Frame frame) {
  frame.data[1] ^= 0x10;
  return frame;
}

/// Until the muscle stands.
void pull(Rig& rig, std::size_t muscle, ecu::Mode mode, double reference) {
  rig.modes[muscle] = static_cast<std::uint8_t>(mode);
  rig.volts[muscle] = reference;
  rig.run(3000);
}
void let_pull_by_volts(Rig& rig) {
  rig.modes[kVictimMuscles[0]] = 0;
  rig.volts[kVictimMuscles[0]] = 0.5;
}

using Encoder = Board::Peripherals::Encoder;
void mend_encoder(Rig& rig) {
  rig.rack.board(kVictim).peripherals.encoder = Encoder::kCounts;
  let_pull_by_volts(rig);
}

std::vector<FaultKind> kinds() {
  using K = FaultKind;
  std::vector<FaultKind> k;
  k.push_back({"ECU loses power", K::kEverybody, int(Finding::kEcuLost),
               [](Rig& r) { r.rack.board(kVictim).set_power(false); },
               [](Rig& r) { r.rack.board(kVictim).set_power(true); }});
  k.push_back({"ECU's processor freezes", K::kEverybody, int(Finding::kEcuLost),
               [](Rig& r) { r.rack.board(kVictim).freeze(true); },
               [](Rig& r) { r.rack.board(kVictim).freeze(false); }});
  k.push_back({"ECU restarts (brown-out)", K::kEverybody, int(Finding::kEcuRestarted),
               [](Rig& r) {
                 r.rack.board(kVictim).set_power(false);
                 r.rack.board(kVictim).set_power(true);
               },
               nothing});
  k.push_back({"all ECUs lose power", K::kEverybody, int(Finding::kBusSilent),
               [](Rig& r) {
                 for (std::size_t e = 0; e < r.rack.size(); ++e) r.rack.board(e).set_power(false);
               },
               [](Rig& r) {
                 for (std::size_t e = 0; e < r.rack.size(); ++e) r.rack.board(e).set_power(true);
               }});
  k.push_back({"all frames dropped", K::kEverybody, int(Finding::kBusSilent),
               tamper([](const ecu::Frame&) { return Frames{}; }), untamper});
  k.push_back(
      {"SYNC dropped", K::kEverybody, int(Finding::kBusSilent),
       tamper([](const ecu::Frame& f) { return ecu::function_of(f) == 1 ? Frames{} : Frames{f}; }),
       untamper});
  k.push_back({"references of one ECU dropped", K::kEverybody, int(Finding::kEcuStopped),
               tamper([](const ecu::Frame& f) { return to_victim(f) ? Frames{} : Frames{f}; }),
               untamper});
  k.push_back({"answers of one ECU dropped", K::kEverybody, int(Finding::kEcuLost),
               tamper([](const ecu::Frame& f) { return from_victim(f) ? Frames{} : Frames{f}; }),
               untamper});
  k.push_back({"every frame twice", K::kNobody, int(Finding::kRepeatedFrame),
               tamper([](const ecu::Frame& f) {
                 return Frames{f, f};
               }),
               untamper});
  k.push_back({"an old SYNC again and again instead of new ones", K::kEverybody,
               int(Finding::kBusSilent),
               [](Rig& r) {
                 auto old = std::make_shared<ecu::Frame>();
                 r.bus.tamper = [old](const ecu::Frame& f, const MemoryBus::Port&) {
                   if (ecu::function_of(f) != 1) return Frames{f};
                   if (old->length == 0) *old = f;
                   return Frames{*old};
                 };
               },
               untamper});
  k.push_back({"an old reference again and again instead of new ones", K::kEverybody,
               int(Finding::kEcuStopped),
               [](Rig& r) {
                 auto old = std::make_shared<ecu::Frame>();
                 r.bus.tamper = [old](const ecu::Frame& f, const MemoryBus::Port&) {
                   if (!to_victim(f)) return Frames{f};
                   if (old->length == 0) *old = f;
                   return Frames{*old};
                 };
               },
               untamper});
  k.push_back({"old answers of one ECU again and again", K::kEverybody,
               int(Finding::kRepeatedFrame),
               [](Rig& r) {
                 auto old = std::make_shared<std::map<int, ecu::Frame>>();
                 r.bus.tamper = [old](const ecu::Frame& f, const MemoryBus::Port&) {
                   if (!from_victim(f)) return Frames{f};
                   return Frames{old->emplace(f.id, f).first->second};
                 };
               },
               untamper});
  k.push_back({"references before their SYNC (reordered)", K::kEverybody,
               int(Finding::kRepeatedFrame),
               [](Rig& r) {
                 auto last = std::make_shared<Frames>();
                 r.bus.tamper = [last](const ecu::Frame& f, const MemoryBus::Port&) {
                   if (ecu::function_of(f) != 1) return Frames{f};
                   Frames late = *last;
                   *last = {f};
                   return late;
                 };
               },
               untamper});
  k.push_back({"all frames to and from one ECU corrupted", K::kEverybody,
               int(Finding::kCorruptFrame), tamper([](const ecu::Frame& f) {
                 return to_victim(f) || from_victim(f) ? Frames{corrupted(f)} : Frames{f};
               }),
               untamper});
  k.push_back({"SYNC corrupted", K::kEverybody, int(Finding::kBusSilent),
               tamper([](const ecu::Frame& f) {
                 return ecu::function_of(f) == 1 ? Frames{corrupted(f)} : Frames{f};
               }),
               untamper});
  k.push_back({"frames of wrong length", K::kEverybody, int(Finding::kWrongLength),
               tamper([](ecu::Frame f) {
                 if (to_victim(f) || from_victim(f)) f.length = 5;
                 return Frames{f};
               }),
               untamper});
  k.push_back({"frames that claim more than eight bytes", K::kEverybody, int(Finding::kWrongLength),
               tamper([](ecu::Frame f) {
                 if (to_victim(f) || from_victim(f)) f.length = 15;
                 return Frames{f};
               }),
               untamper});
  k.push_back({"foreign identifiers on the bus", K::kNobody, int(Finding::kForeignFrame),
               [](Rig& r) {
                 r.bus.tamper = [](const ecu::Frame& f, const MemoryBus::Port&) {
                   ecu::Frame foreign = f;
                   foreign.id = static_cast<std::uint16_t>(0x700 | (f.id & 0x7F));
                   return Frames{f, foreign};
                 };
               },
               untamper});
  k.push_back({"bus flooded by a stranger", K::kNobody, int(Finding::kBusFlooded),
               tamper([](const ecu::Frame& f) {
                 ecu::Frame foreign;
                 foreign.id = 0x7FF;
                 Frames frames(20, foreign);
                 frames.push_back(f);
                 return frames;
               }),
               untamper});
  k.push_back({"a second node with an ECU's number", K::kNobody, int(Finding::kRepeatedFrame),
               tamper([](const ecu::Frame& f) {
                 if (!from_victim(f) || ecu::function_of(f) != 4) return Frames{f};
                 ecu::Motion other = ecu::decode_motion(f);
                 other.position += 1.0;
                 return Frames{f, ecu::encode(other, 3, 0)};
               }),
               untamper});
  k.push_back({"a second node with an ECU's number, of another version", K::kEverybody,
               int(Finding::kWrongVersion), tamper([](const ecu::Frame& f) {
                 if (!from_victim(f) || ecu::function_of(f) != 8) return Frames{f};
                 ecu::StateReport other = ecu::decode_state(f);
                 ++other.version;
                 return Frames{f, ecu::encode(other, 3)};
               }),
               untamper, 100});
  k.push_back({"host's controller goes bus-off", K::kEverybody, int(Finding::kBusOff),
               [](Rig& r) {
                 r.host.report(BusEvent::Kind::kBusOff);
                 r.host.jam(0);
               },
               [](Rig& r) {
                 r.host.release();
                 r.host.report(BusEvent::Kind::kErrorActive);
               }});
  k.push_back({"host's controller goes error-passive", K::kEverybody, int(Finding::kErrorPassive),
               [](Rig& r) { r.host.report(BusEvent::Kind::kErrorPassive); },
               [](Rig& r) { r.host.report(BusEvent::Kind::kErrorActive); }});
  k.push_back({"an ECU's controller goes bus-off", K::kEverybody, int(Finding::kEcuLost),
               [](Rig& r) { r.rack.board(kVictim).peripherals.bus_off = true; },
               [](Rig& r) { r.rack.board(kVictim).peripherals.bus_off = false; }});
  k.push_back({"transmit queue full (ENOBUFS)", K::kEverybody, int(Finding::kQueueFull),
               [](Rig& r) { r.host.jam(0); }, [](Rig& r) { r.host.release(); }});
  k.push_back({"nobody acknowledges (cable off, queue still takes frames)", K::kEverybody,
               int(Finding::kNoAcknowledge), [](Rig& r) { r.host.jam(1000000); },
               [](Rig& r) { r.host.release(); }});
  k.push_back({"error frame: missing acknowledge", K::kEverybody, int(Finding::kNoAcknowledge),
               [](Rig& r) { r.host.report(BusEvent::Kind::kNoAcknowledge); }, nothing});
  k.push_back({"interface down or removed", K::kEverybody, int(Finding::kInterfaceDown),
               [](Rig& r) { r.host.set_up(false); }, [](Rig& r) { r.host.set_up(true); }});
  k.push_back({"driver killed (-9) in motion", K::kEverybody, kNone,
               [](Rig& r) { r.driver_runs = false; }, [](Rig& r) { r.restart_driver(); }});
  k.push_back({"driver late by 60 ms (busy machine)", K::kEverybody, int(Finding::kLateCycle),
               [](Rig& r) { r.driver_runs = false; }, [](Rig& r) { r.driver_runs = true; }});
  k.push_back({"a second driver on the bus", K::kEverybody, int(Finding::kSecondHost),
               [](Rig& r) { r.stranger.send(ecu::encode(ecu::Sync{})); }, nothing});
  k.push_back({"controller dies (no fresh commands)", K::kEverybody, int(Finding::kCommandTimeout),
               [](Rig& r) { r.commander_runs = false; }, nothing, 520});
  k.push_back({"emergency stop", K::kEverybody, int(Finding::kStopLatched),
               [](Rig& r) { r.stranger.send(ecu::Frame{}); }, nothing});
  k.push_back({"spindle jammed", K::kEverybody, int(Finding::kEcuFault),
               [](Rig& r) {
                 r.plant.jam(kVictimMuscles[0]);
                 r.volts[kVictimMuscles[0]] = 8.0;
               },
               [](Rig& r) { r.volts[kVictimMuscles[0]] = 0.5; }, 320});
  k.push_back({"encoder's cable cut, POSITION", K::kEverybody, int(Finding::kEncoderDead),
               [](Rig& r) {
                 const auto muscle = static_cast<std::size_t>(kVictimMuscles[0]);
                 pull(r, muscle, ecu::Mode::kPosition, 1.0);
                 r.rack.board(kVictim).peripherals.encoder = Encoder::kCut;
                 r.volts[muscle] = 1.4;
               },
               mend_encoder, 230});
  k.push_back({"encoder's count flickers, POSITION", K::kEverybody, int(Finding::kEncoderDead),
               [](Rig& r) {
                 const auto muscle = static_cast<std::size_t>(kVictimMuscles[0]);
                 pull(r, muscle, ecu::Mode::kPosition, 1.0);
                 r.rack.board(kVictim).peripherals.encoder = Encoder::kFlickers;
                 r.volts[muscle] = 1.4;
               },
               mend_encoder, 230});
  k.push_back({"tendon cut, POSITION", K::kEverybody, int(Finding::kTendonSlack),
               [](Rig& r) {
                 const auto muscle = static_cast<std::size_t>(kVictimMuscles[0]);
                 pull(r, muscle, ecu::Mode::kPosition, 1.5);
                 r.plant.cut(muscle);
               },
               let_pull_by_volts, 160});
  k.push_back({"tendon cut, FORCE", K::kEverybody, int(Finding::kTendonSlack),
               [](Rig& r) {
                 const auto muscle = static_cast<std::size_t>(kVictimMuscles[0]);
                 pull(r, muscle, ecu::Mode::kForce, 30.0);
                 r.plant.cut(muscle);
               },
               let_pull_by_volts, 160});
  k.push_back({"force sensor's cable cut", K::kEverybody, int(Finding::kEcuFault),
               [](Rig& r) { r.rack.board(kVictim).peripherals.force_sensor_cut = true; },
               [](Rig& r) { r.rack.board(kVictim).peripherals.force_sensor_cut = false; }, 20});
  k.push_back({"force sensor stands still, FORCE", K::kEverybody, int(Finding::kForceImplausible),
               [](Rig& r) {
                 const auto muscle = static_cast<std::size_t>(kVictimMuscles[0]);
                 pull(r, muscle, ecu::Mode::kForce, 30.0);
                 r.rack.board(kVictim).peripherals.force_sensor_stuck = true;
                 r.volts[muscle] = 100.0;
               },
               [](Rig& r) {
                 r.rack.board(kVictim).peripherals.force_sensor_stuck = false;
                 let_pull_by_volts(r);
               },
               1200});
  k.push_back({"elbow potentiometer's cable cut", K::kNobody, int(Finding::kJointSensor),
               [](Rig& r) { r.rack.board(kElbow).peripherals.potentiometer_cut = true; },
               [](Rig& r) { r.rack.board(kElbow).peripherals.potentiometer_cut = false; }});
  k.push_back({"supply breaks down", K::kEverybody, int(Finding::kEcuFault),
               [](Rig& r) { r.rack.board(kVictim).peripherals.supply = 7.0; },
               [](Rig& r) { r.rack.board(kVictim).peripherals.supply = 12.0; }, 10});
  k.push_back({"power stage too hot", K::kEverybody, int(Finding::kEcuFault),
               [](Rig& r) { r.rack.board(kVictim).peripherals.temperature = 90; },
               [](Rig& r) { r.rack.board(kVictim).peripherals.temperature = 40; }});
  k.push_back({"wall clock jumps ten minutes back", K::kNobody, kNone,
               [](Rig& r) { r.clock_offset_s = -600; }, nothing});
  k.push_back({"wall clock jumps an hour ahead", K::kNobody, kNone,
               [](Rig& r) { r.clock_offset_s = 3600; }, nothing});
  return k;
}

struct Result {
  int victim_ms = 0, all_ms = 0;  ///< from the fault to zero volts
  std::string named;              ///< by the driver
};

bool still(const Rig& rig, int muscle) {
  return rig.plant.voltage(static_cast<std::size_t>(muscle)) == 0.0;
}

bool lasts(const FaultKind& kind) {
  return kind.finding != static_cast<int>(Finding::kLateCycle);
}

/// 1.5 s with the fault in.
Result expose(Rig& rig, const FaultKind& kind) {
  Result result;
  kind.inject(rig);
  for (int ms = 1; ms <= 1500; ++ms) {
    rig.step();
    if (!still(rig, kVictimMuscles[0]) || !still(rig, kVictimMuscles[1])) result.victim_ms = ms;
    if (rig.moving() > 0) result.all_ms = ms;
    if (!lasts(kind) && ms == 60) kind.repair(rig);
  }
  for (const Findings::Entry& entry : rig.driver().findings().entries()) {
    const std::string name = info(entry.finding).name;
    if (result.named.find(name) != std::string::npos) continue;
    result.named += (result.named.empty() ? "" : ", ") + name;
    if (entry.finding == Finding::kEcuFault) result.named += " (" + entry.detail + ")";
  }
  return result;
}

class FaultCampaign : public testing::TestWithParam<std::size_t> {};

std::vector<std::string> table_rows(kinds().size());

TEST_P(FaultCampaign, StopsNamesAndStaysDisabled) {
  const FaultKind kind = kinds()[GetParam()];
  Rig rig;
  ASSERT_TRUE(rig.start()) << rig.driver().last_outcome().reason;

  const Result result = expose(rig, kind);
  if (kind.reach == FaultKind::kNobody) {
    EXPECT_EQ(rig.driver().phase(), RobotDriver::Phase::kEnabled) << result.named;
    EXPECT_EQ(rig.moving(), 13);
  } else {
    EXPECT_LE(result.all_ms, 20 + kind.grace);
    EXPECT_LE(result.victim_ms, 20 + kind.grace);
    EXPECT_EQ(rig.moving(), 0);
  }
  if (kind.finding == kNone) {
    EXPECT_EQ(result.named, "");
  } else {
    const auto finding = static_cast<Finding>(kind.finding);
    EXPECT_GT(rig.driver().findings().count(finding), 0u)
        << "named: " << result.named << "; expected " << info(finding).name;
  }

  // The fault goes away; the controller commands on; only the user may start motion again.
  if (lasts(kind)) kind.repair(rig);
  for (int ms = 0; kind.reach != FaultKind::kNobody && ms < 2000; ++ms) {
    rig.step();
    ASSERT_EQ(rig.moving(), 0) << "moves " << ms << " ms after recovery";
  }
  rig.commander_runs = true;
  // Only what the driver itself tells the user to do.
  const bool restarted = rig.driver().findings().count(Finding::kEcuRestarted) > 0;
  if (restarted ||
      rig.driver().stops().last().value_or("").find("clear_faults") != std::string::npos) {
    rig.driver().clear_faults(rig.now());
    rig.run(500);
  }
  EXPECT_TRUE(rig.enable()) << rig.driver().last_outcome().reason;
  rig.run(100);
  EXPECT_EQ(rig.moving(), 13);

  const std::string time =
      kind.reach == FaultKind::kNobody
          ? "motion goes on"
          : std::to_string(result.victim_ms) + " | " + std::to_string(result.all_ms);
  const std::string columns = kind.reach == FaultKind::kNobody ? "- | -" : time;
  table_rows[GetParam()] = "| " + std::string(kind.name) + " | " + columns + " | " +
                           (kind.grace > 0 ? std::to_string(kind.grace) : "-") + " | " +
                           (result.named.empty() ? "-" : result.named) + " | " +
                           (kind.reach == FaultKind::kNobody ? "goes on" : "disabled") + " |";
}

INSTANTIATE_TEST_SUITE_P(Kinds, FaultCampaign, testing::Range(std::size_t{0}, kinds().size()),
                         [](const testing::TestParamInfo<std::size_t>& i) {
                           std::string name;
                           for (const char c : std::string(kinds()[i.param].name)) {
                             if (std::isalnum(static_cast<unsigned char>(c))) name += c;
                           }
                           return name;
                         });

/// The first table of the docs has these kinds, in this order, and no others.
TEST(FaultCampaignTable, IsThatOfTheDocs) {
  std::ifstream in(ANTHROB_DOCS_DIR "/../studies/fault_campaign.md");
  std::vector<std::string> rows;
  for (std::string line; std::getline(in, line) && line.rfind("## ", 0) != 0;) {
    const bool row = line.rfind("| ", 0) == 0 && line.rfind("| fault,", 0) != 0;
    if (row) rows.push_back(line.substr(2, line.find(" |", 2) - 2));
  }
  std::vector<std::string> names;
  for (const FaultKind& kind : kinds()) names.push_back(kind.name);
  EXPECT_EQ(rows, names);
  std::ifstream robot(ANTHROB_DOCS_DIR "/robot.md");
  const std::string text{std::istreambuf_iterator<char>(robot), {}};
  const std::string told = "under " + std::to_string(names.size()) + " kinds of fault";
  EXPECT_NE(text.find(told), std::string::npos) << told;
}

/// Writes the table when all kinds have run.
class TableWriter : public testing::Environment {
  void TearDown() override {
    const char* file = std::getenv("FAULT_TABLE");
    if (file == nullptr) return;
    std::ofstream out(file);
    out << "| fault, injected in motion | unit concerned [ms] | all units [ms] | allowed by "
           "definition [ms] "
           "| named in diagnostics | afterwards |\n|---|---|---|---|---|---|\n";
    for (const std::string& row : table_rows) out << row << "\n";
  }
};
const auto* const writer = testing::AddGlobalTestEnvironment(new TableWriter);

}  // namespace
}  // namespace driver
}  // namespace anthrob
