#include "visit_bags.h"

namespace anthrob {

namespace {

constexpr double kLargestGap = 0.05;  // [s] beyond which a recording is broken
constexpr double kUnderWay = 0.05;    // [s] that a measurement may be late

}  // namespace

void VisitBags::begin(const std::vector<std::string>& names) {
  names_ = names;
  bags_.clear();
  bags_.resize(names.size());
  recording_ = 0;
}

void VisitBags::record(int recording, const ros::Time& now) {
  if (recording == recording_) return;
  if (recording_ > 0) current().gaps.finish(now.toSec() - kUnderWay);
  recording_ = recording;
  if (recording == 0) return;
  since_ = now;
  const std::size_t i = static_cast<std::size_t>(recording - 1);
  bags_[i] = std::make_unique<BagFile>(store_.partial_bag(names_[i]), prefix_);
  for (const MuscleModel& muscle : model_->muscles) {
    // Nobody measures a ligament on a robot.
    if (!muscle.actuator->takes_input()) continue;
    current().gaps.expect(muscle.name, since_.toSec());
  }
  for (const JointModel& joint : model_->skeleton->joints) {
    current().gaps.expect(joint.name, since_.toSec());
  }
}

void VisitBags::see(const std::vector<std::string>& names, const std_msgs::Header& header) {
  if (!belongs(header)) return;
  for (const std::string& name : names) current().gaps.see(name, header.stamp.toSec());
}

std::optional<std::string> VisitBags::trouble() const {
  for (const auto& bag : bags_) {
    if (!bag || bag->gaps.largest() <= kLargestGap) continue;
    return bag->gaps.longest() + " was not measured for " + std::to_string(bag->gaps.largest()) +
           " s";
  }
  return std::nullopt;
}

void VisitBags::close() {
  for (auto& bag : bags_) bag->close();
}

void VisitBags::release() {
  for (auto& bag : bags_) bag.reset();
}

void VisitBags::discard() {
  recording_ = 0;
  release();
  for (const std::string& name : names_) store_.discard(name);
}

}  // namespace anthrob
