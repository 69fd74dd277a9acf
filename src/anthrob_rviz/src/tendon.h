#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "anthrob_core/pose.h"

namespace anthrob {

/// A point of a tendon, which moves with a link.
struct LinkPoint {
  std::string link;
  Vec3 point_L;  ///< in the link's frame [m]
};

/// A muscle's tendon from origin to insertion.
struct Tendon {
  std::string name;
  std::optional<double> force;  ///< [N]; none: not measured
  bool slack = false;
  std::vector<LinkPoint> points;
};

/// Where a link is; none: not known.
using LinkPoses = std::function<std::optional<Pose>(const std::string& link)>;

/// Tendons where the links are.
struct PlacedTendons {
  std::vector<std::vector<Vec3>> lines;  ///< [m] by tendon; empty where a link's pose is not known
  std::set<std::string> links, lost;     ///< that carry points; of these, those without a pose
};
PlacedTendons place(const std::vector<Tendon>& tendons, const LinkPoses& poses);

/// [m]
double line_length(const std::vector<Vec3>& line);

/// Where half of a line lies on either side.
/// @param line of at least one point
Vec3 middle_of(const std::vector<Vec3>& line);

/// A thickness that suits a robot of any size: 3 mm for Anthrob [m].
double fitting_thickness(const std::vector<std::vector<Vec3>>& lines);

}  // namespace anthrob
