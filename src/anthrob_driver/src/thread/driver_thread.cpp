#include "thread/driver_thread.h"

#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <utility>

namespace anthrob {
namespace driver {

namespace {

constexpr int kPriority = 60;
/// Of frames that are read before anything else has its turn: 0.1 s of a full bus.
constexpr int kMostFrames = 1000;
constexpr std::size_t kMostSamples = 400;  ///< two seconds; whoever reads slower loses the oldest

void watch(int epoll, int fd) {
  epoll_event event{};
  event.events = EPOLLIN;
  event.data.fd = fd;
  epoll_ctl(epoll, EPOLL_CTL_ADD, fd, &event);
}

/// Reads the count of a timer or an event; 0 if there is none.
std::uint64_t take_count(int fd) {
  std::uint64_t count = 0;
  return ::read(fd, &count, sizeof(count)) == sizeof(count) ? count : 0;
}

void start_timer(int timer, double rate) {
  constexpr long kSecond = 1000000000;
  const long nanoseconds = std::lround(kSecond / rate);
  itimerspec period{};
  period.it_interval = {nanoseconds / kSecond, nanoseconds % kSecond};
  period.it_value.tv_nsec = 1;
  timerfd_settime(timer, 0, &period, nullptr);
}

template <class T>
void hand_over(std::deque<T>& from, std::deque<T>& to) {
  // As a rule somebody has taken all: no copy then.
  if (to.empty()) {
    std::swap(from, to);
  } else {
    to.insert(to.end(), from.begin(), from.end());
    from.clear();
  }
  while (to.size() > kMostSamples) to.pop_front();
}

}  // namespace

DriverThread::DriverThread(Hardware hardware, const Options& options, const std::string& interface)
    : bus_(interface),
      driver_(std::move(hardware), options.driver, bus_),
      options_(options),
      epoll_(epoll_create1(EPOLL_CLOEXEC)),
      timer_(timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC)),
      wakeup_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  watch(epoll_, timer_);
  watch(epoll_, wakeup_);
  if (!bus_.descriptor()) {
    notes_.push_back("CAN interface " + interface + " is missing or down; waiting for it");
  }
  thread_ = std::thread([this] {
    if (options_.realtime) {
      if (const auto refused = become_realtime(kPriority)) notes_.push_back(*refused);
    }
    start_timer(timer_, options_.driver.rate * options_.pace);
    loop();
  });
  call([](RobotDriver&, double) {});  // until it runs, and all notes are there
}

DriverThread::~DriverThread() {
  call([](RobotDriver& driver, double) { driver.disable(); });
  quit_ = true;
  const std::uint64_t one = 1;
  (void)!::write(wakeup_, &one, sizeof(one));
  thread_.join();
  ::close(epoll_);
  ::close(timer_);
  ::close(wakeup_);
}

void DriverThread::call(const std::function<void(RobotDriver&, double now)>& work) {
  const auto done = std::make_shared<std::promise<void>>();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    work_.push_back({&work, done});
  }
  // The thread that this wakes may be of a higher priority: it must not find the mutex taken.
  const std::uint64_t one = 1;
  (void)!::write(wakeup_, &one, sizeof(one));
  done->get_future().wait();
}

DriverThread::Batch DriverThread::wait(double seconds) {
  std::unique_lock<std::mutex> lock(mutex_);
  arrived_.wait_for(lock, std::chrono::duration<double>(seconds),
                    [this] { return !batch_.samples.empty() || !batch_.analogs.empty(); });
  Batch batch;
  std::swap(batch, batch_);
  return batch;
}

bool DriverThread::serve_requests() {
  {
    // Whoever has the mutex may be of a lower priority, and held up: the bus does not wait for it.
    const std::unique_lock<std::mutex> lock(mutex_, std::try_to_lock);
    if (!lock) return false;
    std::swap(work_, current_);
  }
  for (const Work& next : current_) {
    (*next.run)(driver_, now());
    halts_ = driver_.halts();
    next.done->set_value();
  }
  current_.clear();
  return true;
}

void DriverThread::collect() {
  Sample sample;
  AnalogSample analog;
  while (driver_.take_sample(sample)) fresh_.samples.push_back(sample);
  while (driver_.take_analog(analog)) fresh_.analogs.push_back(analog);
  if (fresh_.samples.empty() && fresh_.analogs.empty()) return;
  // As above: the next turn will do.
  const std::unique_lock<std::mutex> lock(mutex_, std::try_to_lock);
  if (!lock) return;
  hand_over(fresh_.samples, batch_.samples);
  hand_over(fresh_.analogs, batch_.analogs);
  arrived_.notify_one();
}

void DriverThread::watch_socket() {
  // A recovered interface has a new socket, perhaps with the old number; closing the old one took
  // it out of the set.
  if (!bus_.descriptor() || bus_.openings() == watched_) return;
  watched_ = bus_.openings();
  watch(epoll_, *bus_.descriptor());
}

void DriverThread::loop() {
  bool requests = false;
  while (!quit_) {
    watch_socket();
    epoll_event events[4];
    const int count = epoll_wait(epoll_, events, 4, 100);
    (void)count;
    BusEvent event;
    for (int i = 0; i < kMostFrames && bus_.receive(event); ++i) driver_.receive(event, now());
    if (take_count(wakeup_) > 0) requests = true;
    if (requests) requests = !serve_requests();
    if (take_count(timer_) > 0) driver_.cycle(now());
    halts_ = driver_.halts();
    collect();
  }
}

}  // namespace driver
}  // namespace anthrob
