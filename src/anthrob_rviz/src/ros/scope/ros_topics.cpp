#include "ros/scope/ros_topics.h"

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <ros/serialization.h>
#include <topic_tools/shape_shifter.h>

#include <atomic>
#include <chrono>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "anthrob_core/errors.h"
#include "anthrob_core/monotonic_clock.h"

namespace anthrob {
namespace {

constexpr std::uint32_t kQueueSize =
    20000;  // 40 s at 500 Hz, should the reading thread have to wait
constexpr std::size_t kMostWaiting = 200000;  // messages, should nobody take them
constexpr auto kAskPeriod = std::chrono::milliseconds(100);
constexpr int kListEvery = 20;        // times of the above
constexpr double kPatience = 1.0;     // [s] with threads that end
constexpr double kReadPeriod = 0.02;  // [s]

Nanoseconds since_epoch(const ros::Time& t) {
  return Nanoseconds{t.sec} * 1000000000 + t.nsec;
}

}  // namespace

/// What the threads share. It outlives the object while a thread waits for a master that is gone.
struct RosTopics::Shared {
  mutable std::mutex mutex;
  MasterView master;
  std::set<std::string> wanted;
  std::vector<LiveMessage> messages;
  std::vector<std::string> remarks;
  std::atomic<bool> ends{false};
  std::atomic<int> threads{2};

  ros::CallbackQueue queue;
  // Of the asking thread:
  std::unique_ptr<ros::NodeHandle> nh;
  std::map<std::string, ros::Subscriber> subscribers;
  // Of the reading thread:
  std::map<std::string, std::optional<MessageReader>> readers;  ///< by topic and type
  std::set<std::string> malformed;

  void ask(int round);
  void list_topics();
  void subscribe();
  void receive(const std::string& topic, const topic_tools::ShapeShifter& message);
  MessageReader* reader_of(const std::string& topic, const topic_tools::ShapeShifter& message);
  void remark(const std::string& text) {
    const std::lock_guard<std::mutex> lock(mutex);
    remarks.push_back(text);
  }
};

void RosTopics::Shared::ask(int round) {
  if (round % kListEvery == 0) list_topics();
  bool there = false;
  {
    const std::lock_guard<std::mutex> lock(mutex);
    there = master.answers;
  }
  // Without a master, a subscription would wait for one.
  if (there) subscribe();
}

void RosTopics::Shared::list_topics() {
  ros::master::V_TopicInfo infos;
  const bool answers = ros::master::check() && ros::master::getTopics(infos);
  const std::lock_guard<std::mutex> lock(mutex);
  master.uri = ros::master::getURI();
  master.answers = answers;
  master.topics.clear();
  for (const auto& info : infos) master.topics.insert(info.name);
}

void RosTopics::Shared::subscribe() {
  std::set<std::string> topics;
  {
    const std::lock_guard<std::mutex> lock(mutex);
    topics = wanted;
  }
  if (!nh) {
    nh = std::make_unique<ros::NodeHandle>();
    nh->setCallbackQueue(&queue);
  }
  for (auto it = subscribers.begin(); it != subscribers.end();) {
    it = topics.count(it->first) > 0 ? std::next(it) : subscribers.erase(it);
  }
  for (const std::string& topic : topics) {
    if (subscribers.count(topic) > 0) continue;
    const boost::function<void(const topic_tools::ShapeShifter::ConstPtr&)> hear =
        [this, topic](const topic_tools::ShapeShifter::ConstPtr& message) {
          receive(topic, *message);
        };
    subscribers[topic] = nh->subscribe<topic_tools::ShapeShifter>(
        topic, kQueueSize, hear, ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
  }
}

MessageReader* RosTopics::Shared::reader_of(const std::string& topic,
                                            const topic_tools::ShapeShifter& message) {
  const std::string key = topic + " " + message.getMD5Sum();
  const auto found = readers.find(key);
  if (found != readers.end()) return found->second ? &*found->second : nullptr;
  auto& reader = readers[key];
  try {
    reader.emplace(topic, parse_definition(message.getDataType(), message.getMessageDefinition()));
  } catch (const BadInput& error) {
    remark(topic + ": " + error.what());
    return nullptr;
  }
  return &*reader;
}

void RosTopics::Shared::receive(const std::string& topic,
                                const topic_tools::ShapeShifter& message) {
  const ros::Time now = ros::Time::now();
  MessageReader* reader = reader_of(topic, message);
  if (reader == nullptr) return;
  std::vector<std::uint8_t> bytes(message.size());
  ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  message.write(stream);
  auto numbers = reader->read(bytes.data(), bytes.size());
  if (!numbers) {
    if (malformed.insert(topic).second)
      remark(topic + ": a malformed message; it and others like it are left out");
    return;
  }
  const Nanoseconds t = numbers->stamp ? *numbers->stamp : since_epoch(now);
  const std::lock_guard<std::mutex> lock(mutex);
  if (messages.size() >= kMostWaiting) {
    messages.clear();
    remarks.push_back("live messages came faster than they could be shown: a gap");
  }
  messages.push_back({topic, t, std::move(*numbers)});
}

RosTopics::RosTopics() : shared_(std::make_shared<Shared>()) {
  shared_->master.uri = ros::master::getURI();
  std::thread([shared = shared_] {
    for (int round = 0; !shared->ends && ros::ok(); ++round) {
      shared->ask(round);
      std::this_thread::sleep_for(kAskPeriod);
    }
    shared->subscribers.clear();
    shared->nh.reset();
    --shared->threads;
  }).detach();
  std::thread([shared = shared_] {
    while (!shared->ends && ros::ok()) shared->queue.callAvailable(ros::WallDuration(kReadPeriod));
    --shared->threads;
  }).detach();
}

RosTopics::~RosTopics() {
  shared_->ends = true;
  shared_->queue.disable();
  // A program that ends takes away what they use; one that waits for a lost master is left behind.
  const double patience = monotonic_now() + kPatience;
  while (shared_->threads > 0 && monotonic_now() < patience)
    std::this_thread::sleep_for(kAskPeriod / 10);
}

MasterView RosTopics::master() const {
  const std::lock_guard<std::mutex> lock(shared_->mutex);
  return shared_->master;
}

void RosTopics::hear(const std::set<std::string>& topics) {
  const std::lock_guard<std::mutex> lock(shared_->mutex);
  shared_->wanted = topics;
}

std::vector<LiveMessage> RosTopics::take() {
  const std::lock_guard<std::mutex> lock(shared_->mutex);
  return std::exchange(shared_->messages, {});
}

std::vector<std::string> RosTopics::take_remarks() {
  const std::lock_guard<std::mutex> lock(shared_->mutex);
  return std::exchange(shared_->remarks, {});
}

}  // namespace anthrob
