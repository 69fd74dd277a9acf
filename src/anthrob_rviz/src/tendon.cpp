#include "tendon.h"

#include <map>

namespace anthrob {

namespace {

/// Of the tendons' mean length, which depends little on the posture.
constexpr double kThickness = 0.0117;
constexpr double kAnthrobsThickness = 0.003;  // [m]

/// Each link's pose is asked for once, so that all its points are put by the same one.
class AskedPoses {
 public:
  explicit AskedPoses(const LinkPoses& poses) : poses_(poses) {}
  const std::optional<Pose>& of(const std::string& link) {
    const auto found = asked_.find(link);
    if (found != asked_.end()) return found->second;
    return asked_.emplace(link, poses_(link)).first->second;
  }
  const std::map<std::string, std::optional<Pose>>& all() const { return asked_; }

 private:
  const LinkPoses& poses_;
  std::map<std::string, std::optional<Pose>> asked_;
};

std::vector<Vec3> placed_line(const Tendon& tendon, AskedPoses& poses) {
  std::vector<Vec3> line;
  bool whole = true;
  for (const LinkPoint& point : tendon.points) {
    const std::optional<Pose>& pose = poses.of(point.link);
    if (pose) line.push_back(*pose * point.point_L);
    whole = whole && pose.has_value();
  }
  return whole ? line : std::vector<Vec3>();
}

}  // namespace

PlacedTendons place(const std::vector<Tendon>& tendons, const LinkPoses& poses) {
  AskedPoses asked(poses);
  PlacedTendons placed;
  for (const Tendon& tendon : tendons) placed.lines.push_back(placed_line(tendon, asked));
  for (const auto& [link, pose] : asked.all()) {
    placed.links.insert(link);
    if (!pose) placed.lost.insert(link);
  }
  return placed;
}

double line_length(const std::vector<Vec3>& line) {
  double sum = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) sum += (line[i] - line[i - 1]).norm();
  return sum;
}

Vec3 middle_of(const std::vector<Vec3>& line) {
  double left = 0.5 * line_length(line);
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double step = (line[i] - line[i - 1]).norm();
    if (step > 0.0 && step >= left) return line[i - 1] + (line[i] - line[i - 1]) * (left / step);
    left -= step;
  }
  return line.back();
}

double fitting_thickness(const std::vector<std::vector<Vec3>>& lines) {
  double sum = 0.0;
  int count = 0;
  for (const auto& line : lines) {
    if (line.size() < 2) continue;
    sum += line_length(line);
    ++count;
  }
  return count > 0 && sum > 0.0 ? kThickness * sum / count : kAnthrobsThickness;
}

}  // namespace anthrob
