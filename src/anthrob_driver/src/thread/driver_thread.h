#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "anthrob_core/monotonic_clock.h"
#include "anthrob_driver/bus/socketcan_bus.h"
#include "anthrob_driver/link/sample.h"
#include "anthrob_driver/realtime.h"
#include "anthrob_driver/robot_driver.h"

namespace anthrob {
namespace driver {

/// Runs a RobotDriver on a CAN interface in a thread of its own: an epoll loop over frames, the
/// cycle's timer and requests of other threads. Only this thread touches the driver.
class DriverThread {
 public:
  struct Options {
    RobotDriver::Options driver;
    /// Ask for SCHED_FIFO and locked memory. If the system refuses, the thread runs without them,
    /// and notes() says so.
    bool realtime = false;
    /// Below 1, all of the driver's time runs slower, including time-outs: for emulated ECUs of the
    /// same pace on machines that are too slow for real time. Never use it with a robot.
    double pace = 1.0;
  };

  /// @throws std::runtime_error if this kernel has no CAN; BadInput for bad options
  DriverThread(Hardware hardware, const Options& options, const std::string& interface);
  /// Disables first.
  ~DriverThread();

  /// Runs `work` between two events of the loop and waits until it is done.
  void call(const std::function<void(RobotDriver&, double now)>& work);

  /// RobotDriver::halts(), readable by any thread without waiting. It includes the effects of all
  /// calls of call() that have returned.
  std::uint64_t halts() const { return halts_; }

  /// Waits for measurements, at most `seconds`. @return all that came since the last call
  struct Batch {
    std::deque<Sample> samples;
    std::deque<AnalogSample> analogs;
  };
  Batch wait(double seconds);

  /// Requests that the system refused at the start, one line each.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  double now() const { return options_.pace * monotonic_now(); }
  void loop();
  /// @return false if another thread holds the mutex; then to be tried again in the next turn of
  /// the loop
  bool serve_requests();
  void collect();
  void watch_socket();

  SocketCanBus bus_;
  RobotDriver driver_;
  Options options_;
  std::vector<std::string> notes_;
  int epoll_, timer_, wakeup_;
  std::uint64_t watched_ = 0;  ///< SocketCanBus::openings() of the socket that is waited on

  std::mutex mutex_;
  std::condition_variable arrived_;
  struct Work {
    const std::function<void(RobotDriver&, double)>* run;
    std::shared_ptr<std::promise<void>> done;  ///< shared: each thread destroys its own
  };
  std::deque<Work> work_, current_;  ///< current_: of the thread, taken from work_
  Batch batch_, fresh_;              ///< fresh_: of the thread, not handed over yet
  std::atomic<bool> quit_{false};
  std::atomic<std::uint64_t> halts_{0};
  std::thread thread_;
};

}  // namespace driver
}  // namespace anthrob
