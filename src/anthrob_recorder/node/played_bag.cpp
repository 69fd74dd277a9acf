#include "played_bag.h"

#include <rosbag/query.h>

#include <algorithm>
#include <set>

#include "anthrob_core/errors.h"
#include "anthrob_recording/bag_records.h"

namespace anthrob {
namespace {

const std::set<std::string> kShown = {"muscle_states", "joint_states", "spherical_joint_states",
                                      "touch"};
constexpr std::uint32_t kQueue = 1000;  // messages between two looks at the clock
/// [s] before a time: long enough for each topic of a robot that was measured.
constexpr double kLately = 1.0;

struct Topic {
  std::string space, name;
};

Topic split(const std::string& topic) {
  const std::size_t begin = topic.find_first_not_of('/');
  const std::string bare = begin == std::string::npos ? "" : topic.substr(begin);
  const std::size_t slash = bare.rfind('/');
  if (slash == std::string::npos) return {"", bare};
  return {bare.substr(0, slash), bare.substr(slash + 1)};
}

ros::AdvertiseOptions options_of(const rosbag::ConnectionInfo& connection) {
  ros::AdvertiseOptions options;
  options.topic = split(connection.topic).name;
  options.md5sum = connection.md5sum;
  options.datatype = connection.datatype;
  options.message_definition = connection.msg_def;
  options.queue_size = kQueue;
  return options;
}

}  // namespace

PlayedBag::PlayedBag(const std::string& file, const std::string& robot) : file_(file) {
  check_bag_records(file);
  try {
    bag_.open(file, rosbag::bagmode::Read);
    choose_topics(robot);
  } catch (const rosbag::BagException& error) {
    throw BadInput(file + ": cannot be read as a bag: " + error.what() +
                   " (a recording that was cut off: rosbag reindex)");
  }
}

void PlayedBag::choose_topics(const std::string& robot) {
  std::set<std::string> shown;
  rosbag::View all(bag_);
  for (const rosbag::ConnectionInfo* connection : all.getConnections()) {
    if (kShown.count(split(connection->topic).name) > 0) shown.insert(connection->topic);
  }
  if (shown.empty()) {
    throw BadInput(file_ + ": holds nothing that is shown; expected topics such as /" + robot +
                   "/joint_states");
  }
  std::copy_if(shown.begin(), shown.end(), std::back_inserter(topics_),
               [&](const std::string& topic) {
                 const std::string space = split(topic).space;
                 return space.empty() || space == robot;
               });
  if (topics_.empty()) {
    throw BadInput(file_ + ": is of the robot '" + split(*shown.begin()).space +
                   "'; expected one of '" + robot + "' (robot:=NAME)");
  }
  rosbag::View played(bag_, rosbag::TopicQuery(topics_));
  begin_ = played.getBeginTime(), end_ = played.getEndTime();
}

void PlayedBag::advertise(ros::NodeHandle& nh) {
  rosbag::View played(bag_, rosbag::TopicQuery(topics_));
  for (const rosbag::ConnectionInfo* connection : played.getConnections()) {
    ros::Publisher& publisher = publishers_[connection->topic];
    if (publisher) continue;  // several nodes may have sent one topic
    ros::AdvertiseOptions options = options_of(*connection);
    publisher = nh.advertise(options);
  }
}

void PlayedBag::publish(const rosbag::MessageInstance& message) {
  publishers_.at(message.getTopic()).publish(message);
}

void PlayedBag::publish(ros::Time after, ros::Time until) {
  if (until <= after) return;
  rosbag::View view(bag_, rosbag::TopicQuery(topics_), after + ros::Duration(0, 1), until);
  for (const rosbag::MessageInstance& message : view) publish(message);
}

void PlayedBag::publish_last(ros::Time until) {
  for (const std::string& topic : topics_) {
    const ros::Time lately = std::max(begin_, ros::Time(std::max(0.0, until.toSec() - kLately)));
    for (const ros::Time& from : {lately, begin_}) {
      rosbag::View view(bag_, rosbag::TopicQuery(topic), from, until);
      if (view.size() == 0) continue;
      auto last = view.begin();
      for (auto next = last; next != view.end(); ++next) last = next;
      publish(*last);
      break;
    }
  }
}

}  // namespace anthrob
