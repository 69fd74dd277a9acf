#pragma once

#include <atomic>
#include <chrono>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>

namespace anthrob {

/// Work of other threads, such as a stop, that the simulation's thread does between two steps.
class Interrupts {
 public:
  /// Has `work` done and waits until it is.
  /// @return false if the simulation is busy for longer than `patience`; the work then comes before
  ///   its next step, so what it refers to must live on
  bool call(std::function<void()> work, std::chrono::milliseconds patience);
  /// Does what waits; for the simulation's thread, before every step. No lock if nothing does.
  void serve() {
    if (waiting_) serve_all();
  }

 private:
  struct Work {
    std::function<void()> run;
    std::shared_ptr<std::promise<void>> done;
  };
  void serve_all();

  std::atomic<bool> waiting_{false};
  std::mutex mutex_;
  std::deque<Work> work_;
};

}  // namespace anthrob
