#include "ros/tendon_message.h"

#include <cmath>

namespace anthrob {

namespace {

std::optional<std::string> fault_of(const anthrob_msgs::TendonPath& path) {
  if (path.link.size() != path.point.size()) {
    return path.name + ": " + std::to_string(path.link.size()) + " links and " +
           std::to_string(path.point.size()) + " points, expected as many";
  }
  for (const auto& point : path.point) {
    if (!std::isfinite(point.x + point.y + point.z)) {
      return path.name + ": a point is not finite; the simulation may have broken down";
    }
  }
  return std::nullopt;
}

Tendon tendon_of(const anthrob_msgs::TendonPath& path) {
  Tendon tendon;
  tendon.name = path.name;
  if (!std::isnan(path.force)) tendon.force = path.force;
  tendon.slack = path.slack;
  for (std::size_t i = 0; i < path.point.size(); ++i) {
    const auto& point = path.point[i];
    tendon.points.push_back({path.link[i], Vec3(point.x, point.y, point.z)});
  }
  return tendon;
}

}  // namespace

HeardTendons tendons_of(const anthrob_msgs::TendonPaths& message) {
  HeardTendons heard;
  for (const anthrob_msgs::TendonPath& path : message.muscles) {
    heard.wrong = fault_of(path);
    if (heard.wrong) return {{}, heard.wrong};
    heard.tendons.push_back(tendon_of(path));
  }
  return heard;
}

}  // namespace anthrob
