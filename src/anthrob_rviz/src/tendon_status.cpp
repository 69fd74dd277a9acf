#include "tendon_status.h"

#include <cmath>

namespace anthrob {

namespace {

std::string listed(const std::set<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::string seconds(double time) {
  return std::to_string(std::lround(time)) + " s";
}

}  // namespace

StatusLine feed_status(const TendonFeed& feed) {
  if (feed.wrong) return {Level::kError, feed.topic + ": " + *feed.wrong};
  if (feed.publishers == 0) {
    return {Level::kWarning,
            "nobody publishes " + feed.topic +
                ": start the simulator, or beside a robot the node anthrob_tendons "
                "(tendons:=true of robot.launch)"};
  }
  if (!feed.age) return {Level::kWarning, "no message on " + feed.topic + " yet"};
  if (feed.is_old()) {
    return {Level::kWarning, "no message on " + feed.topic + " for " + seconds(*feed.age) +
                                 ": forces are not shown"};
  }
  return {Level::kOk, std::to_string(feed.tendons) + " tendons"};
}

StatusLine link_status(const std::set<std::string>& links, const std::set<std::string>& lost) {
  if (lost.empty()) return {Level::kOk, "in tf: " + listed(links)};
  return {Level::kError, "not in tf: " + listed(lost) +
                             "; their tendons are not drawn. Does robot_state_publisher run, and "
                             "are ball joints measured?"};
}

}  // namespace anthrob
