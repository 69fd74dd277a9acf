#include "command_thread.h"

#include <chrono>
#include <utility>

#include "anthrob_core/monotonic_clock.h"

namespace anthrob {
namespace {

constexpr std::chrono::milliseconds kLook(5);  // a tenth of the period of commands

}  // namespace

CommandThread::CommandThread(Send send) : send_(std::move(send)), thread_([this] { run(); }) {}

CommandThread::~CommandThread() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    quit_ = true;
  }
  thread_.join();
}

void CommandThread::set(std::vector<Reference> references, double deadline) {
  const std::lock_guard<std::mutex> lock(mutex_);
  repeater_.set(std::move(references), deadline);
}

void CommandThread::run() {
  while (send_due()) std::this_thread::sleep_for(kLook);
}

/// @return false when it is to end
bool CommandThread::send_due() {
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::vector<Reference> references = repeater_.take_due(monotonic_now());
  if (!references.empty() && !quit_) send_(references);
  return !quit_;
}

}  // namespace anthrob
