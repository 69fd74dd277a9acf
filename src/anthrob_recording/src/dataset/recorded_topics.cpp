#include "dataset/recorded_topics.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include "anthrob_core/errors.h"

namespace anthrob {

namespace {

const std::pair<const char*, const char*> kTopics[] = {
    {"muscle_command", "commands"},
    {"muscle_states", "muscles"},
    {"joint_states", "joints"},
    {"spherical_joint_states", "spherical_joints"},
    {"external_wrenches", "wrenches"}};

std::string parent(const std::string& topic) {
  const auto slash = topic.rfind('/');
  return slash == std::string::npos || slash == 0 ? "" : topic.substr(0, slash);
}
/// Not all writers of bags begin a topic with a slash.
std::string without_leading_slash(const std::string& topic) {
  return topic.substr(topic.rfind('/', 0) == 0 ? 1 : 0);
}
/// "anthrob" of "/anthrob/joint_states"; empty if there is no namespace.
std::string namespace_of(const std::string& topic) {
  return without_leading_slash(parent(topic));
}
}  // namespace

std::string leaf_of_topic(const std::string& topic) {
  return topic.substr(topic.rfind('/') + 1);
}

bool is_of_a_recording(const std::string& topic) {
  return std::any_of(
      std::begin(kTopics), std::end(kTopics),
      [name = leaf_of_topic(topic)](const auto& known) { return name == known.first; });
}

std::vector<RecordedTopic> choose_topics(const std::map<std::string, std::uint64_t>& counts,
                                         const std::string& file, const std::string& beside,
                                         Dataset& dataset, std::vector<std::string>& not_carried) {
  std::set<std::string> namespaces;
  std::map<std::string, std::vector<std::string>> chosen;
  for (const auto& [topic, count] : counts) {
    if (is_of_a_recording(topic)) namespaces.insert(namespace_of(topic));
  }
  // What stands below a robot's namespace (sim/...) is beside its contract.
  const std::set<std::string> all = namespaces;
  for (const std::string& outer : all) {
    for (const std::string& inner : all) {
      const bool below = inner.compare(0, outer.size() + 1, outer + "/") == 0;
      if (!outer.empty() && below) namespaces.erase(inner);
    }
  }
  for (const auto& [topic, count] : counts) {
    if (is_of_a_recording(topic) && namespaces.count(namespace_of(topic))) {
      chosen[leaf_of_topic(topic)].push_back(topic);
    } else {
      not_carried.push_back(topic + " (" + std::to_string(count) + " messages)");
    }
  }
  if (namespaces.empty()) {
    throw BadInput(file +
                   ": contains no topic of a recording; expected muscle_command, muscle_states, "
                   "joint_states or spherical_joint_states in the namespace of a robot");
  }
  if (namespaces.size() > 1) {
    throw BadInput(file + ": topics of several robots: " + *namespaces.begin() + " and " +
                   *std::next(namespaces.begin()) + "; expected one robot per bag");
  }
  const std::string robot = *namespaces.begin();
  if (std::filesystem::exists(beside)) dataset.meta = load_meta(beside, &dataset.remarks);
  if (!robot.empty()) dataset.meta.robot = robot;
  if (dataset.meta.robot.empty()) {
    dataset.remarks.push_back(
        file +
        ": its topics are in no robot's namespace, so that the robot is not known; give its "
        "name by robot: in meta.yaml, or in " +
        leaf_of_topic(beside) + " beside the bag");
  }
  std::vector<RecordedTopic> topics;
  for (const auto& [topic, table] : kTopics) {
    if (chosen.count(topic)) topics.push_back({topic, table, chosen[topic]});
  }
  return topics;
}

}  // namespace anthrob
