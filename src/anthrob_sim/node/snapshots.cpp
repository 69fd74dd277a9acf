#include "snapshots.h"

#include <algorithm>

#include "anthrob_core/nearest_name.h"
#include "anthrob_ros/bounded_connection.h"

namespace anthrob {

Snapshots::Snapshots(ros::NodeHandle& nh, const Simulation& sim,
                     std::function<std::string()> failed,
                     std::function<void(const Snapshot&)> restore)
    : sim_(sim), failed_(std::move(failed)), restore_(std::move(restore)) {
  services_ = {
      advertise_bounded<anthrob_msgs::Snapshot>(
          nh, "sim/save",
          [this](auto& request, auto& response) { return on_save(request, response); }),
      advertise_bounded<anthrob_msgs::Snapshot>(
          nh, "sim/restore",
          [this](auto& request, auto& response) { return on_restore(request, response); }),
  };
}

bool Snapshots::on_save(anthrob_msgs::Snapshot::Request& request,
                        anthrob_msgs::Snapshot::Response& response) {
  const auto same = find(request.name);
  const std::string failure = failed_();
  if (request.name.empty()) {
    response.message = "name: expected a name for the snapshot";
  } else if (!failure.empty()) {
    response.message = failure + "; call sim/reset";
  } else if (same == saved_.end() && saved_.size() >= kMost) {
    response.message = "name: '" + request.name + "': there are " + std::to_string(kMost) +
                       " snapshots; expected the name of one of them";
  } else {
    response.success = true;
    response.message = same == saved_.end() ? "saved" : "saved instead of the one before";
    if (same == saved_.end()) {
      saved_.emplace_back(request.name, sim_.snapshot());
    } else {
      same->second = sim_.snapshot();
    }
  }
  response.saved = names();
  return true;
}

bool Snapshots::on_restore(anthrob_msgs::Snapshot::Request& request,
                           anthrob_msgs::Snapshot::Response& response) {
  const auto found = find(request.name);
  response.saved = names();
  if (found == saved_.end()) {
    response.message =
        "name: '" + request.name + "': no such snapshot" + expected_names(request.name, names());
    return true;
  }
  restore_(found->second);
  response.success = true;
  response.message = "restored; simulated time continues";
  return true;
}

std::vector<std::string> Snapshots::names() const {
  std::vector<std::string> all;
  for (const Named& named : saved_) all.push_back(named.first);
  return all;
}

std::vector<Snapshots::Named>::iterator Snapshots::find(const std::string& name) {
  return std::find_if(saved_.begin(), saved_.end(),
                      [&](const Named& named) { return named.first == name; });
}

}  // namespace anthrob
