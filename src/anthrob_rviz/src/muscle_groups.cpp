#include "muscle_groups.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace anthrob {
namespace {

constexpr double kShare = 0.1;  // of the axis's largest arm: less is no purpose of a muscle

}  // namespace

bool MuscleGroup::has(const std::string& muscle) const {
  return std::find(muscles.begin(), muscles.end(), muscle) != muscles.end();
}

std::vector<MuscleGroup> groups_by_axis(const std::vector<std::string>& muscles,
                                        const std::vector<std::string>& axes,
                                        const std::vector<double>& arms) {
  std::vector<MuscleGroup> groups;
  if (arms.size() != muscles.size() * axes.size()) return groups;
  for (std::size_t a = 0; a < axes.size(); ++a) {
    const auto arm = [&](std::size_t m) { return arms[m * axes.size() + a]; };
    double largest = 0.0;
    for (std::size_t m = 0; m < muscles.size(); ++m) largest = std::max(largest, std::abs(arm(m)));
    for (const double sign : {1.0, -1.0}) {
      MuscleGroup group{axes[a] + (sign > 0.0 ? " +" : " -"), {}};
      for (std::size_t m = 0; m < muscles.size(); ++m) {
        if (sign * arm(m) >= kShare * largest && largest > 0.0) group.muscles.push_back(muscles[m]);
      }
      if (!group.muscles.empty()) groups.push_back(std::move(group));
    }
  }
  return groups;
}

std::vector<MuscleGroup> groups_by_unit(const Diagnostics& diagnostics, const std::string& robot,
                                        const std::vector<std::string>& muscles, double now) {
  std::vector<MuscleGroup> groups;
  for (const Diagnosis& diagnosis : diagnostics.all(now)) {
    const auto [whole, part] = whole_and_part(diagnosis.name);
    if (whole != robot) continue;
    MuscleGroup group{part, {}};
    for (const std::string& muscle : muscles) {
      if (diagnosis.names(muscle)) group.muscles.push_back(muscle);
    }
    if (!group.muscles.empty()) groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace anthrob
