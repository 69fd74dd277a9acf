// Faults that only a kernel has, on a real CAN stack: the driver is a process of its own that gets
// killed, the interface goes down or away, ECUs lose power. Needs vcan0, and root to break it:
//   scripts/with_vcan.sh devel/lib/anthrob_driver/vcan_fault_test
// Times are ticks of the emulated ECUs: right on machines of any speed. ANTHROB_PACE below 1: all
// runs slower. Called with --driver this program is that driver.
#include <gtest/gtest.h>
#include <linux/rtnetlink.h>
#include <net/if.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstring>
#include <iostream>
#include <map>
#include <mutex>
#include <set>
#include <thread>

#include "anthrob_core/errors.h"
#include "anthrob_driver/emulation/emulator.h"
#include "anthrob_driver/emulation/tendon_plant.h"
#include "anthrob_driver/realtime.h"
#include "emulation/board.h"
#include "link/ecu_link.h"
#include "thread/driver_thread.h"
#include "watch/bus_watch.h"

namespace anthrob {
namespace driver {
namespace {

const char* const kInterface = "vcan0";
const char* const kHardwareFile = ANTHROB_CONFIG_DIR "/anthrob/hardware.yaml";

double pace() {
  const char* text = std::getenv("ANTHROB_PACE");
  return text ? std::atof(text) : 1.0;
}
void sleep_robot(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds / pace()));
}

// ---- the driver process ----

bool enable(DriverThread& thread) {
  RobotDriver::Outcome outcome;
  thread.call([](RobotDriver& driver, double now) {
    driver.clear_faults(now);
    driver.start_enable(now);
  });
  for (bool waiting = true; waiting;) {
    thread.wait(0.01);
    thread.call([&](RobotDriver& driver, double) {
      waiting = driver.phase() == RobotDriver::Phase::kEnabling;
      outcome = driver.last_outcome();
    });
  }
  return outcome.accepted;
}

/// Commands all muscles for ever; a line on standard input enables; says on standard output what it
/// finds, once until the next enable.
int drive() {
  const Hardware hardware = load_hardware(kHardwareFile, true);
  DriverThread::Options options;
  options.realtime = true;
  options.pace = pace();
  DriverThread thread(hardware, options, kInterface);
  std::vector<std::string> names;
  for (const MuscleHardware& muscle : hardware.muscles) names.push_back(muscle.name);
  std::atomic<bool> wanted{false};
  std::thread([&] {
    for (std::string line; std::getline(std::cin, line);) wanted = true;
    _exit(0);
  }).detach();
  std::map<int, std::uint64_t> seen;
  for (bool first = true;; sleep_robot(0.02), first = false) {
    if (wanted.exchange(false)) {
      for (int i = 0; i < 100 && !enable(thread); ++i) sleep_robot(0.1);
      first = true;
    }
    thread.call([&](RobotDriver& driver, double now) {
      driver.command(names, std::vector<std::uint8_t>(names.size(), 0),
                     std::vector<double>(names.size(), 0.5), now);
      for (const Findings::Entry& entry : driver.findings().entries()) {
        std::uint64_t& count = seen[static_cast<int>(entry.finding)];
        if (!first && entry.count > count) std::cout << info(entry.finding).name << std::endl;
        count = entry.count;
      }
    });
  }
}

/// The driver as a child.
class DriverProcess {
 public:
  DriverProcess() {
    int in[2], out[2];
    if (::pipe(in) != 0 || ::pipe(out) != 0) throw std::runtime_error("no pipe");
    pid_ = ::fork();
    if (pid_ == 0) {
      ::dup2(in[0], 0), ::dup2(out[1], 1);
      for (const int fd : {in[0], in[1], out[0], out[1]}) ::close(fd);
      ::execl("/proc/self/exe", "vcan_fault_test", "--driver", static_cast<char*>(nullptr));
      ::_exit(1);
    }
    ::close(in[0]), ::close(out[1]);
    in_ = in[1];
    listener_ = std::thread([this, fd = out[0]] { listen(fd); });
  }
  ~DriverProcess() {
    signal(SIGCONT), signal(SIGKILL);
    ::waitpid(pid_, nullptr, 0);
    ::close(in_);
    listener_.join();
  }
  void signal(int number) const { ::kill(pid_, number); }
  void enable() const { EXPECT_EQ(::write(in_, "\n", 1), 1); }
  bool found(const std::string& finding) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return findings_.count(finding) > 0;
  }
  void forget() {
    const std::lock_guard<std::mutex> lock(mutex_);
    findings_.clear();
  }

 private:
  void listen(int fd) {
    FILE* file = ::fdopen(fd, "r");
    char line[128];
    while (std::fgets(line, sizeof(line), file)) {
      const std::lock_guard<std::mutex> lock(mutex_);
      findings_.insert(std::string(line, std::strcspn(line, "\n")));
    }
    std::fclose(file);
  }
  pid_t pid_;
  int in_;
  std::thread listener_;
  std::mutex mutex_;
  std::set<std::string> findings_;
};

// ---- the emulated robot ----

class EmulatedRobot {
 public:
  EmulatedRobot()
      : hardware_(load_hardware(kHardwareFile, true)),
        plant_(hardware_),
        bus_(kInterface),
        rack_(hardware_, plant_, bus_),
        thread_([this] {
          become_realtime(Emulator::kPriority);
          Emulator(rack_, bus_, pace()).run([this] { return quit_.load(); }, [this] { look(); });
        }) {}
  ~EmulatedRobot() {
    quit_ = true;
    thread_.join();
  }
  long tick() const { return tick_; }
  long last_volts() const { return last_volts_; }
  bool moves() const { return moving_ == static_cast<int>(hardware_.muscles.size()); }
  bool stands() const { return moving_ == 0; }
  /// Between two ticks. @return the tick
  long call(const std::function<void(Rack&)>& work) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      work_ = work;
    }
    for (;;) {
      {
        const std::lock_guard<std::mutex> lock(mutex_);
        if (!work_) return worked_;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

 private:
  void look() {
    int moving = 0;
    for (std::size_t m = 0; m < hardware_.muscles.size(); ++m) moving += plant_.voltage(m) != 0.0;
    moving_ = moving;
    if (moving > 0) last_volts_ = tick_.load();
    const std::lock_guard<std::mutex> lock(mutex_);
    if (work_) {
      work_(rack_);
      work_ = nullptr;
      worked_ = tick_;
    }
    ++tick_;
  }
  Hardware hardware_;
  TendonPlant plant_;
  SocketCanBus bus_;
  Rack rack_;
  std::atomic<bool> quit_{false};
  std::atomic<long> tick_{0}, last_volts_{-1};
  std::atomic<int> moving_{0};
  std::mutex mutex_;
  std::function<void(Rack&)> work_;
  long worked_ = 0;
  std::thread thread_;
};

// ---- the interface ----

void set_interface(bool up) {
  const int fd = ::socket(AF_INET, SOCK_DGRAM, 0);
  ifreq request{};
  std::strncpy(request.ifr_name, kInterface, IFNAMSIZ - 1);
  ::ioctl(fd, SIOCGIFFLAGS, &request);
  request.ifr_flags = static_cast<short>(up ? request.ifr_flags | IFF_UP
                                            : request.ifr_flags & ~static_cast<short>(IFF_UP));
  EXPECT_EQ(::ioctl(fd, SIOCSIFFLAGS, &request), 0);
  ::close(fd);
}
/// As when an adapter is pulled; ip(8) would take longer than the time that is measured.
void remove_interface() {
  struct {
    nlmsghdr header;
    ifinfomsg interface;
  } request{};
  request.header.nlmsg_len = sizeof(request);
  request.header.nlmsg_type = RTM_DELLINK;
  request.header.nlmsg_flags = NLM_F_REQUEST;
  request.interface.ifi_index = static_cast<int>(::if_nametoindex(kInterface));
  const int fd = ::socket(AF_NETLINK, SOCK_RAW, NETLINK_ROUTE);
  EXPECT_EQ(::send(fd, &request, sizeof(request), 0), static_cast<ssize_t>(sizeof(request)));
  ::close(fd);
}
void plug_in() {
  EXPECT_EQ(std::system("ip link add dev vcan0 type vcan && "
                        "ip link set vcan0 txqueuelen 1000 up"),
            0);
}

// ---- the campaign ----

class VcanFaults : public ::testing::Test {
 protected:
  void SetUp() override {
    if (::if_nametoindex(kInterface) == 0) GTEST_SKIP() << "no vcan0: scripts/with_vcan.sh";
    robot_ = std::make_unique<EmulatedRobot>();
    driver_ = std::make_unique<DriverProcess>();
    start_motion();
  }
  template <class Condition>
  bool wait(double seconds, const Condition& condition) {
    for (const long end = robot_->tick() + std::lround(1000 * seconds); robot_->tick() < end;) {
      if (condition()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return condition();
  }
  void start_motion() {
    driver_->enable();
    ASSERT_TRUE(wait(20.0, [&] { return robot_->moves(); })) << "nothing moves";
    sleep_robot(0.2);
    driver_->forget();
  }
  /// Zero volts within 20 ms of the fault and for 1.5 s after the repair.
  void expect_stop(const char* fault, long begin, const std::string& finding,
                   const std::function<void()>& repair) {
    EXPECT_TRUE(wait(1.0, [&] { return robot_->stands(); })) << fault;
    sleep_robot(0.1);
    const long duration = std::max(0L, robot_->last_volts() - begin);
    EXPECT_LE(duration, 20) << fault;
    if (!finding.empty()) {
      EXPECT_TRUE(wait(2.0, [&] { return driver_->found(finding); })) << fault << ": " << finding;
    }
    repair();
    const long repaired = robot_->tick();
    sleep_robot(1.5);
    EXPECT_LT(robot_->last_volts(), repaired) << fault << ": moved without enable";
    std::printf("| %s | %ld | %s |\n", fault, duration, finding.empty() ? "-" : finding.c_str());
    start_motion();
  }

  std::unique_ptr<EmulatedRobot> robot_;
  std::unique_ptr<DriverProcess> driver_;
};

TEST_F(VcanFaults, DriverKilled) {
  const long begin = robot_->tick();
  driver_->signal(SIGKILL);
  expect_stop("driver killed (-9)", begin, "", [&] {
    driver_.reset();
    driver_ = std::make_unique<DriverProcess>();
  });
}

TEST_F(VcanFaults, DriverFrozen) {
  const long begin = robot_->tick();
  driver_->signal(SIGSTOP);
  expect_stop("driver's process stopped, later continued", begin, "",
              [&] { driver_->signal(SIGCONT); });
}

TEST_F(VcanFaults, InterfaceDown) {
  const long begin = robot_->tick();
  set_interface(false);
  expect_stop("interface set down, later up", begin, "interface_down", [] { set_interface(true); });
}

TEST_F(VcanFaults, InterfaceRemoved) {
  const long begin = robot_->tick();
  remove_interface();
  expect_stop("interface removed, later there again", begin, "interface_down", plug_in);
}

TEST_F(VcanFaults, EcuKilled) {
  const long begin = robot_->call([](Rack& rack) { rack.board(2).set_power(false); });
  expect_stop("ECU loses power", begin, "ecu_lost",
              [&] { robot_->call([](Rack& rack) { rack.board(2).set_power(true); }); });
}

TEST_F(VcanFaults, EcuFrozen) {
  const long begin = robot_->call([](Rack& rack) { rack.board(4).freeze(true); });
  expect_stop("ECU's processor freezes", begin, "ecu_lost",
              [&] { robot_->call([](Rack& rack) { rack.board(4).freeze(false); }); });
}

TEST_F(VcanFaults, StopFromAStranger) {
  SocketCanBus stranger(kInterface);
  const long begin = robot_->tick();
  EXPECT_EQ(stranger.send(ecu::Frame{}), SendResult::kSent);
  expect_stop("STOP frame from a stranger", begin, "stop_latched", [] {});
}

TEST_F(VcanFaults, SecondDriver) {
  auto second = std::make_unique<DriverProcess>();
  ASSERT_TRUE(wait(10.0, [&] { return driver_->found("second_host"); }));
  // It counts from when the first of its frames was heard, which nobody here knows: 0.
  expect_stop("a second driver on the bus", robot_->last_volts(), "second_host",
              [&] { second.reset(); });
}

TEST(SocketCan, TellsOfFramesThatItsQueueCouldNotHold) {
  if (::if_nametoindex(kInterface) == 0) GTEST_SKIP() << "no vcan0: scripts/with_vcan.sh";
  SocketCanBus sleeper(kInterface), talker(kInterface);
  constexpr int kFrames = 20000;
  for (int i = 0; i < kFrames; ++i) {
    talker.send(ecu::encode(ecu::Sync{static_cast<std::uint8_t>(i), 0, false}));
    if (i % 50 == 0) talker.flush();
  }
  int overruns = 0, frames = 0;
  BusEvent event;
  while (sleeper.receive(event)) {
    overruns += event.kind == BusEvent::Kind::kReceiveOverrun;
    frames += event.kind == BusEvent::Kind::kFrame;
  }
  EXPECT_LT(frames, kFrames);
  // What was queued is whole; the first frame after it tells.
  talker.send(ecu::encode(ecu::Sync{1, 0, false}));
  talker.flush();
  while (sleeper.receive(event)) overruns += event.kind == BusEvent::Kind::kReceiveOverrun;
  EXPECT_EQ(overruns, 1);
}

TEST(SocketCan, RefusesAnInterfaceOfAnotherKind) {
  if (::if_nametoindex(kInterface) == 0) GTEST_SKIP() << "no vcan0: scripts/with_vcan.sh";
  EXPECT_THROW(SocketCanBus("lo"), BadInput);
  EXPECT_NO_THROW(SocketCanBus("can99"));  // it may come
}

TEST(SocketCan, ASocketThatIsOpenedAnewIsAnother) {
  if (::if_nametoindex(kInterface) == 0) GTEST_SKIP() << "no vcan0: scripts/with_vcan.sh";
  SocketCanBus bus(kInterface);
  const std::optional<int> number = bus.descriptor();
  EXPECT_EQ(bus.openings(), 1u);
  set_interface(false);
  EXPECT_EQ(bus.send(ecu::Frame{}), SendResult::kDown);
  EXPECT_EQ(bus.descriptor(), std::nullopt);
  set_interface(true);
  bus.recover();
  EXPECT_EQ(bus.descriptor(), number);  // what it can be known by no longer
  EXPECT_EQ(bus.openings(), 2u);
}

class CanCheck : public ::testing::Test {
 protected:
  void SetUp() override {
    if (::if_nametoindex(kInterface) == 0) GTEST_SKIP() << "no vcan0: scripts/with_vcan.sh";
  }
  /// @return its status
  int run(const std::string& options, const std::string& before = "") {
    const std::string call = std::string(ANTHROB_CAN_CHECK) + " " + options + " --can " +
                             kInterface + " --hardware " + kHardwareFile;
    FILE* pipe = ::popen((before + call + " 2>&1").c_str(), "r");
    char line[256];
    said.clear();
    while (std::fgets(line, sizeof(line), pipe)) said += line;
    return WEXITSTATUS(::pclose(pipe));
  }
  std::string said;
};

TEST_F(CanCheck, RefusesARateAtWhichEcusWouldStop) {
  EXPECT_EQ(run("--emulate --rate 50"), 2);
  for (const char* seconds : {"nan", "0", "-1", "inf"}) {
    EXPECT_EQ(run(std::string("--seconds ") + seconds), 2) << seconds;
    EXPECT_NE(said.find("--seconds: "), std::string::npos) << said;
  }
}

TEST_F(CanCheck, NamesUnitsThatAreNotThereAndFails) {
  EXPECT_EQ(run("--seconds 1.5"), 1);
  EXPECT_NE(said.find("ecu_1: ecu_silent"), std::string::npos) << said;
  EXPECT_NE(said.find("ecu_7: ecu_silent"), std::string::npos) << said;
}

TEST_F(CanCheck, SaysThatItWasInterrupted) {
  EXPECT_EQ(run("--seconds 60", "timeout --preserve-status -s INT 3 "), 130);
}

TEST_F(CanCheck, LeavesStopsAndFaultsOfARobotAlone) {
  EmulatedRobot robot;
  sleep_robot(0.1);
  robot.call([](Rack& rack) { rack.board(2).peripherals.supply = 7.0; });
  SocketCanBus stranger(kInterface);
  ASSERT_EQ(stranger.send(ecu::Frame{}), SendResult::kSent);
  sleep_robot(0.1);
  robot.call([](Rack& rack) { rack.board(2).peripherals.supply = 12.0; });
  run("--seconds 0.5");
  EXPECT_NE(said.find("cycles answered by all"), std::string::npos) << said;
  robot.call([](Rack& rack) {
    for (std::size_t e = 0; e < rack.size(); ++e) {
      EXPECT_TRUE(rack.board(e).firmware().stop_latched()) << e;
    }
    EXPECT_EQ(rack.board(2).firmware().fault(), ecu::Fault::kSupplyLow);
  });
}

}  // namespace
}  // namespace driver
}  // namespace anthrob

int main(int argc, char** argv) {
  if (argc > 1 && std::string(argv[1]) == "--driver") return anthrob::driver::drive();
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
