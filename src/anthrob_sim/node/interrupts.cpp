#include "interrupts.h"

#include <utility>

namespace anthrob {

bool Interrupts::call(std::function<void()> work, std::chrono::milliseconds patience) {
  const auto done = std::make_shared<std::promise<void>>();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    work_.push_back({std::move(work), done});
    waiting_ = true;
  }
  return done->get_future().wait_for(patience) == std::future_status::ready;
}

void Interrupts::serve_all() {
  std::deque<Work> current;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::swap(current, work_);
    waiting_ = false;
  }
  for (const Work& next : current) {
    next.run();
    next.done->set_value();
  }
}

}  // namespace anthrob
