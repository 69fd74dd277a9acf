#include "simulation/driven_joints.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace anthrob {

namespace {

constexpr auto kEffort = static_cast<std::uint8_t>(ecu::Mode::kForce);

std::vector<ecu::MuscleChannel> channels(const SkeletonModel& skeleton) {
  std::vector<ecu::MuscleChannel> result;
  for (const JointModel& joint : skeleton.joints) {
    if (!joint.driven) continue;
    ecu::MuscleChannel channel;
    channel.name = joint.name;
    channel.modes[kEffort] = true;
    channel.lowest[kEffort] = std::numeric_limits<double>::lowest();
    channel.highest[kEffort] = std::numeric_limits<double>::max();
    result.push_back(channel);
  }
  return result;
}

}  // namespace

DrivenJoints::DrivenJoints(const SkeletonModel& skeleton, const ecu::Supervisor::Options& options)
    : supervisor_(channels(skeleton), options) {
  for (const ecu::MuscleChannel& channel : supervisor_.muscles()) {
    joints_.push_back(skeleton.find_joint(channel.name));
  }
}

bool DrivenJoints::knows(const std::string& name) const {
  const auto& all = supervisor_.muscles();
  return std::any_of(all.begin(), all.end(), [&](const auto& c) { return c.name == name; });
}

std::optional<std::string> DrivenJoints::complaint(const std::vector<std::string>& names,
                                                   const std::vector<double>& efforts) const {
  if (names.empty()) return "expected the name of at least one joint";
  if (efforts.size() != names.size()) {
    return std::to_string(names.size()) + " names, " + std::to_string(efforts.size()) +
           " efforts: expected equal numbers";
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string who = "joint '" + names[i] + "': ";
    const auto here = names.begin() + static_cast<std::ptrdiff_t>(i);
    if (!knows(names[i])) return who + "no driven joint of that name";
    if (std::find(names.begin(), here, names[i]) != here) return who + "named twice";
    if (!std::isfinite(efforts[i])) return who + "expected a finite effort";
  }
  return std::nullopt;
}

ecu::Supervisor::Outcome DrivenJoints::refuse(const std::string& reason) {
  ++rejected_;
  last_rejection_ = reason;
  return {false, reason};
}

ecu::Supervisor::Outcome DrivenJoints::command(const std::vector<std::string>& names,
                                               const std::vector<double>& efforts, Simulation& sim,
                                               const std::string& sender) {
  if (const auto reason = complaint(names, efforts)) return refuse(*reason);
  std::vector<ecu::MuscleReference> accepted;
  const std::vector<std::uint8_t> modes(names.size(), kEffort);
  const auto outcome = supervisor_.command(names, modes, efforts, sim.time(), accepted, sender);
  if (!outcome.accepted) return refuse(outcome.reason);
  for (const ecu::MuscleReference& effort : accepted) {
    sim.apply_effort(joints_[effort.muscle], effort.reference);
  }
  return {true, ""};
}

void DrivenJoints::apply(Simulation& sim) const {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (!supervisor_.follows_references(static_cast<int>(i))) sim.apply_effort(joints_[i], 0.0);
  }
}

}  // namespace anthrob
