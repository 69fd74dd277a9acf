#include "ros/scope/bag_source.h"

#include <ros/serialization.h>
#include <rosbag/bag.h>
#include <rosbag/query.h>
#include <rosbag/view.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

#include "anthrob_core/errors.h"
#include "anthrob_recording/bag_records.h"
#include "ros/scope/dataset_source.h"
#include "scope/message_reader.h"

namespace anthrob {
namespace {

Nanoseconds nanoseconds_of(const ros::Time& t) {
  return Nanoseconds{t.sec} * 1000000000 + t.nsec;
}

/// What is known of a topic when all of it was read.
struct TopicSpan {
  std::size_t messages = 0, unreadable = 0;
  std::optional<Nanoseconds> first;
};

class BagSource final : public RecordingSource {
 public:
  explicit BagSource(const std::string& file) {
    check_bag_records(file);
    try {
      bag_.open(file, rosbag::bagmode::Read);
      survey();
    } catch (const rosbag::BagException& error) {
      throw BadInput(file + ": " + error.what() +
                     "; expected a bag that was closed (rosbag reindex repairs)");
    } catch (const ros::Exception& error) {
      throw BadInput(file + ": " + error.what());
    }
    if (quantities_.empty())
      throw BadInput(file + ": no message with a number; expected a recording of topics");
  }

  const std::vector<Quantity>& quantities() const override { return quantities_; }
  const std::vector<std::string>& remarks() const override { return remarks_; }
  Nanoseconds begin() const override { return begin_; }

  std::map<std::string, std::vector<Sample>> load(const std::set<std::string>& paths) override {
    std::set<std::string> topics;
    for (const std::string& path : paths) topics.insert(topic_of_.at(path));
    std::map<std::string, std::vector<Sample>> loaded;
    rosbag::View view(bag_,
                      rosbag::TopicQuery(std::vector<std::string>(topics.begin(), topics.end())));
    for (const rosbag::MessageInstance& message : view) {
      const auto numbers = read(message);
      if (!numbers) continue;
      const auto& quantities = numbers->contents->quantities;
      for (std::size_t i = 0; i < quantities.size(); ++i) {
        if (paths.count(quantities[i].path) == 0) continue;
        loaded[quantities[i].path].push_back({time_of(message, *numbers), numbers->values[i]});
      }
    }
    for (auto& [path, samples] : loaded) sort(samples);
    return loaded;
  }

 private:
  static void sort(std::vector<Sample>& samples) {
    std::stable_sort(samples.begin(), samples.end(),
                     [](const Sample& a, const Sample& b) { return a.t < b.t; });
  }

  static Nanoseconds time_of(const rosbag::MessageInstance& message,
                             const MessageNumbers& numbers) {
    return numbers.stamp ? *numbers.stamp : nanoseconds_of(message.getTime());
  }

  /// Of each topic and type; none where the definition cannot be understood.
  MessageReader* reader_of(const rosbag::MessageInstance& message) {
    const auto key = std::make_pair(message.getTopic(), message.getMD5Sum());
    const auto found = readers_.find(key);
    if (found != readers_.end()) return found->second ? &*found->second : nullptr;
    auto& reader = readers_[key];
    try {
      reader.emplace(message.getTopic(),
                     parse_definition(message.getDataType(), message.getMessageDefinition()));
    } catch (const BadInput& error) {
      remarks_.push_back(message.getTopic() + ": " + error.what());
      return nullptr;
    }
    return &*reader;
  }

  std::optional<MessageNumbers> read(const rosbag::MessageInstance& message) {
    MessageReader* reader = reader_of(message);
    if (reader == nullptr) return std::nullopt;
    bytes_.resize(message.size());
    ros::serialization::OStream stream(bytes_.data(), static_cast<std::uint32_t>(bytes_.size()));
    message.write(stream);
    return reader->read(bytes_.data(), bytes_.size());
  }

  void survey() {
    std::map<std::string, TopicSpan> spans;
    std::map<std::string, std::shared_ptr<const MessageContents>> noted;
    rosbag::View view(bag_);
    for (const rosbag::MessageInstance& message : view) {
      TopicSpan& span = spans[message.getTopic()];
      const auto numbers = read(message);
      if (!numbers) {
        ++span.unreadable;
        continue;
      }
      ++span.messages;
      const Nanoseconds t = time_of(message, *numbers);
      span.first = std::min(span.first.value_or(t), t);
      auto& last = noted[message.getTopic()];
      if (last != numbers->contents) note(message.getTopic(), *numbers->contents);
      last = numbers->contents;
    }
    conclude(spans);
  }

  void note(const std::string& topic, const MessageContents& contents) {
    for (const Quantity& quantity : contents.quantities) {
      if (topic_of_.emplace(quantity.path, topic).second) quantities_.push_back(quantity);
    }
    for (const std::string& what : contents.left_out) {
      if (left_out_.insert(what).second) remarks_.push_back("not shown: " + what);
    }
  }

  void conclude(const std::map<std::string, TopicSpan>& spans) {
    std::optional<Nanoseconds> single, several;
    for (const auto& [topic, span] : spans) {
      if (span.unreadable > 0) {
        remarks_.push_back(topic + ": " + std::to_string(span.unreadable) +
                           " messages cannot be read");
      }
      if (!span.first) continue;
      auto& first = span.messages > 1 ? several : single;
      first = std::min(first.value_or(*span.first), *span.first);
    }
    begin_ = several ? *several : single.value_or(0);
  }

  rosbag::Bag bag_;
  std::map<std::pair<std::string, std::string>, std::optional<MessageReader>> readers_;
  std::map<std::string, std::string> topic_of_;
  std::vector<Quantity> quantities_;
  std::set<std::string> left_out_;
  std::vector<std::string> remarks_;
  std::vector<std::uint8_t> bytes_;
  Nanoseconds begin_ = 0;
};

}  // namespace

std::unique_ptr<RecordingSource> open_recording(const std::string& path) {
  if (std::filesystem::is_directory(path)) return open_dataset(path);
  return std::make_unique<BagSource>(path);
}

}  // namespace anthrob
