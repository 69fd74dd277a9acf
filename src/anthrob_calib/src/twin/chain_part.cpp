#include "twin/chain_part.h"

#include <algorithm>
#include <optional>

namespace anthrob {
namespace twin {

namespace {

/// Largest gaps of one muscle or joint, by feed.
struct OwnerGaps {
  std::string owner;
  bool joint = false;
  double force[kFeedCount] = {}, motion[kFeedCount] = {};
};

std::vector<OwnerGaps> by_owner(const std::vector<Channel>& channels,
                                const std::vector<double>& gap) {
  std::vector<OwnerGaps> owners;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const Channel& channel = channels[c];
    if (owners.empty() || owners.back().owner != channel.owner) {
      owners.emplace_back();
      owners.back().owner = channel.owner;
      owners.back().joint = channel.topic != Topic::kMuscles;
    }
    for (std::size_t f = 0; f < kFeedCount; ++f) {
      double* largest =
          channel.quantity == Quantity::kForce ? owners.back().force : owners.back().motion;
      const double own = gap[c * kFeedCount + f];
      if (own > largest[f]) largest[f] = own;  // false of NaN
    }
  }
  return owners;
}

}  // namespace

const char* words(Part part) {
  constexpr const char* kWords[] = {"controller", "motor or gear", "joint or load",
                                    "spring or tendon"};  // in the order of the parts
  return kWords[static_cast<int>(part)];
}

std::vector<Finding> judge(const std::vector<Channel>& channels, const std::vector<double>& gap,
                           double warn) {
  constexpr int kCommands = index_of(Feed::kCommands), kVoltages = index_of(Feed::kVoltages),
                kPositions = index_of(Feed::kPositions), kPostures = index_of(Feed::kPostures);
  const std::vector<OwnerGaps> owners = by_owner(channels, gap);
  const bool spring = std::any_of(owners.begin(), owners.end(), [&](const OwnerGaps& owner) {
    return owner.force[kPostures] >= warn;
  });
  std::vector<Finding> findings;
  for (const OwnerGaps& owner : owners) {
    if (owner.joint) {
      // A wrong force moves all joints that it reaches.
      if (!spring && owner.motion[kPositions] >= warn) {
        findings.push_back({owner.owner, Part::kJoint, owner.motion[kPositions]});
      }
    } else if (owner.force[kPostures] >= warn) {
      findings.push_back({owner.owner, Part::kSpring, owner.force[kPostures]});
    } else if (owner.force[kPositions] >= warn) {
      continue;  // joints move as the twin's do not: they are named
    } else if (owner.motion[kVoltages] >= warn) {
      findings.push_back({owner.owner, Part::kMotor, owner.motion[kVoltages]});
    } else if (owner.motion[kCommands] >= warn) {
      findings.push_back({owner.owner, Part::kController, owner.motion[kCommands]});
    }
  }
  return findings;
}

}  // namespace twin
}  // namespace anthrob
