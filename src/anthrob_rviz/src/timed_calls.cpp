#include "timed_calls.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "anthrob_core/text.h"

namespace anthrob {

struct TimedCalls::Answer {
  std::mutex mutex;
  std::optional<CallResult> result;

  void set(CallResult value) {
    const std::lock_guard<std::mutex> lock(mutex);
    result = std::move(value);
  }
  std::optional<CallResult> get() {
    const std::lock_guard<std::mutex> lock(mutex);
    return result;
  }
};

bool TimedCalls::start(const std::string& service, Call call, double limit, double now) {
  if (under_way(service)) return false;
  const auto answer = std::make_shared<Answer>();
  pending_.push_back({service, now + limit, limit, answer});
  // Detached: nobody can end a call that hangs.
  std::thread([service, answer, call = std::move(call)] {
    try {
      answer->set(call());
    } catch (const std::exception& error) {
      answer->set({service, false, error.what()});
    }
  }).detach();
  return true;
}

bool TimedCalls::under_way(const std::string& service) const {
  return std::any_of(pending_.begin(), pending_.end(),
                     [&](const Pending& pending) { return pending.service == service; });
}

std::vector<CallResult> TimedCalls::finished(double now) {
  std::vector<CallResult> results;
  std::vector<Pending> rest;
  for (const Pending& pending : pending_) {
    if (const auto result = pending.answer->get()) {
      results.push_back(*result);
    } else if (now >= pending.deadline) {
      results.push_back(
          {pending.service, false, "no answer within " + short_number(pending.limit) + " s"});
    } else {
      rest.push_back(pending);
    }
  }
  pending_ = std::move(rest);
  return results;
}

}  // namespace anthrob
