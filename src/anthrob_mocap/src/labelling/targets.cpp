#include "labelling/targets.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <sstream>

#include "anthrob_core/config_node.h"
#include "anthrob_core/text.h"
#include "core/unit_quaternion.h"

namespace anthrob {
namespace mocap {

namespace {

constexpr double kLeastSpread = 0.005;  // [m] across the line nearest to all markers
constexpr double kLongestEdge = 2.0;    // [m] no link is longer: other units

double edge(const MarkerTarget& target, int i, int j) {
  return (target.markers[static_cast<std::size_t>(i)] - target.markers[static_cast<std::size_t>(j)])
      .norm();
}

std::string edge_text(const MarkerTarget& target, int i, int j) {
  char text[64];
  std::snprintf(text, sizeof(text), " %d-%d (%.1f mm)", i, j, 1e3 * edge(target, i, j));
  return target.name + text;
}

/// Extends `image` (marker of a -> marker of b) by every choice that keeps the edges.
template <typename Found>
bool assign(const MarkerTarget& a, const MarkerTarget& b, double tolerance, std::size_t wanted,
            std::vector<int>& image, const Found& found) {
  if (image.size() == wanted) return found(image);
  const int i = static_cast<int>(image.size());
  for (int candidate = 0; candidate < static_cast<int>(b.markers.size()); ++candidate) {
    if (std::find(image.begin(), image.end(), candidate) != image.end()) continue;
    bool fits = true;
    for (int j = 0; j < i && fits; ++j) {
      fits = std::abs(edge(a, i, j) - edge(b, candidate, image[static_cast<std::size_t>(j)])) <=
             tolerance;
    }
    if (!fits) continue;
    image.push_back(candidate);
    if (assign(a, b, tolerance, wanted, image, found)) return true;
    image.pop_back();
  }
  return false;
}

void require_snake_case(const ConfigNode& node, const std::string& name) {
  if (!is_snake_case(name)) node.fail("'" + name + "': expected a name in lower_snake_case");
}

MarkerTarget read_target(const std::string& name, const ConfigNode& node, double marker_diameter) {
  MarkerTarget target{name, {}};
  for (const ConfigNode& marker : node.at("markers").items()) {
    target.markers.push_back(marker.as_vector3("m"));
  }
  const std::size_t count = target.markers.size();
  if (count < 3 || count > 16) node.at("markers").fail_expected("3 to 16 markers");
  for (int i = 0; i < static_cast<int>(count); ++i) {
    for (int j = 0; j < i; ++j) {
      if (!(edge(target, i, j) < kLongestEdge)) {
        node.at("markers").items()[static_cast<std::size_t>(i)].fail_expected(
            "metres: less than 2 m from marker " + std::to_string(j));
      }
      if (edge(target, i, j) <= marker_diameter) {
        node.at("markers").fail("markers " + edge_text(target, j, i) +
                                " touch: expected more than marker_diameter between them");
      }
    }
  }
  Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i) {
    points.col(static_cast<Eigen::Index>(i)) = target.markers[i];
  }
  points.colwise() -= points.rowwise().mean().eval();
  const Eigen::JacobiSVD<Eigen::Matrix3Xd> svd(points);
  if (svd.singularValues()[1] < kLeastSpread) {
    node.at("markers").fail(
        "the markers are on one line: a rotation about that line cannot be seen");
  }
  return target;
}

BallJoint read_joint(const std::string& name, const ConfigNode& node,
                     const std::vector<MarkerTarget>& targets) {
  BallJoint joint;
  joint.name = name;
  const auto index = [&](const std::string& key) {
    const std::string wanted = node.text(key);
    for (std::size_t i = 0; i < targets.size(); ++i) {
      if (targets[i].name == wanted) return static_cast<int>(i);
    }
    node.at(key).fail_expected("the name of a target");
  };
  joint.parent = index("parent");
  joint.child = index("child");
  if (joint.parent == joint.child) node.at("child").fail("parent and child are the same target");
  if (node.has("rest")) joint.rest = unit_quaternion(node.at("rest"));
  if (node.has("child_mount")) joint.child_mount = unit_quaternion(node.at("child_mount"));
  return joint;
}

TargetSet read(const ConfigNode& file, double edge_tolerance) {
  TargetSet set;
  set.marker_diameter = file.number("marker_diameter", Bounds::between(0.0, 1.0), "m");
  const ConfigNode targets = file.at("targets");
  for (const auto& [name, node] : targets.entries()) {
    require_snake_case(node, name);
    set.targets.push_back(read_target(name, node, set.marker_diameter));
  }
  if (set.targets.empty()) targets.fail_expected("at least one target");
  if (file.has("joints")) {
    for (const auto& [name, node] : file.at("joints").entries()) {
      require_snake_case(node, name);
      for (const MarkerTarget& target : set.targets) {
        if (target.name == name) {
          node.fail(
              "a target has this name: expected another one, because poses.csv has columns of "
              "both");
        }
      }
      set.joints.push_back(read_joint(name, node, set.targets));
    }
  }
  file.refuse_unknown_keys();
  file.refuse_empty_values();
  for (const MarkerTarget& a : set.targets) {
    for (const MarkerTarget& b : set.targets) {
      if (const auto why = find_ambiguity(a, b, edge_tolerance)) targets.at(a.name).fail(*why);
    }
  }
  return set;
}

}  // namespace

Vec3 MarkerTarget::centre() const {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& marker : markers) sum += marker;
  return sum / static_cast<double>(markers.size());
}

TargetSet TargetSet::load(const std::string& file, double edge_tolerance) {
  return read(ConfigNode::load(file), edge_tolerance);
}

TargetSet TargetSet::parse(const std::string& text, const std::string& name,
                           double edge_tolerance) {
  return read(ConfigNode::parse(text, name), edge_tolerance);
}

std::string TargetSet::to_yaml() const {
  std::ostringstream out;
  out.precision(6);
  out << "marker_diameter: " << marker_diameter << "   # [m]\ntargets:\n";
  for (const MarkerTarget& target : targets) {
    out << "  " << target.name << ":\n    markers:   # [m]\n";
    for (const Vec3& m : target.markers) {
      out << "      - [" << m.x() << ", " << m.y() << ", " << m.z() << "]\n";
    }
  }
  if (!joints.empty()) out << "joints:\n";
  out.precision(std::numeric_limits<double>::max_digits10);
  const auto quaternion = [](const Quat& q) {
    std::ostringstream text;
    text.precision(std::numeric_limits<double>::max_digits10);
    text << "[" << q.w() << ", " << q.x() << ", " << q.y() << ", " << q.z() << "]";
    return text.str();
  };
  for (const BallJoint& joint : joints) {
    out << "  " << joint.name
        << ":\n    parent: " << targets[static_cast<std::size_t>(joint.parent)].name
        << "\n    child: " << targets[static_cast<std::size_t>(joint.child)].name
        << "\n    rest: " << quaternion(joint.rest)
        << "\n    child_mount: " << quaternion(joint.child_mount) << "\n";
  }
  return out.str();
}

std::optional<std::string> find_ambiguity(const MarkerTarget& a, const MarkerTarget& b,
                                          double edge_tolerance) {
  if (a.markers.size() > b.markers.size()) return std::nullopt;  // found from the other side
  std::optional<std::string> why;
  std::vector<int> image;
  assign(a, b, edge_tolerance, a.markers.size(), image, [&](const std::vector<int>& map) {
    const int count = static_cast<int>(map.size());
    const bool same = a.name == b.name;
    std::string edges;
    for (int i = 0; i < count; ++i) {
      for (int j = i + 1; j < count; ++j) {
        const auto ends =
            std::minmax(map[static_cast<std::size_t>(i)], map[static_cast<std::size_t>(j)]);
        if (same && ends.first == i && ends.second == j) continue;  // the same edge
        edges += (edges.empty() ? "" : ", ") + edge_text(a, i, j) + " and " +
                 edge_text(b, ends.first, ends.second);
      }
    }
    if (edges.empty()) return false;  // the identity
    why = "ambiguous: its markers can be taken for " +
          std::string(same ? "each other" : "those of " + b.name) + ", equal edges: " + edges;
    return true;
  });
  return why;
}

int count_ambiguous_triples(const std::vector<MarkerTarget>& targets, double edge_tolerance) {
  int ambiguous = 0;
  for (const MarkerTarget& a : targets) {
    const std::size_t n = a.markers.size();
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = i + 1; j < n; ++j) {
        for (std::size_t k = j + 1; k < n; ++k) {
          const MarkerTarget triple{a.name, {a.markers[i], a.markers[j], a.markers[k]}};
          const std::vector<int> self{static_cast<int>(i), static_cast<int>(j),
                                      static_cast<int>(k)};
          const auto other = [&](const MarkerTarget& b) {
            std::vector<int> image;
            return assign(triple, b, edge_tolerance, 3, image, [&](const std::vector<int>& map) {
              return a.name != b.name || map != self;
            });
          };
          ambiguous += std::any_of(targets.begin(), targets.end(), other) ? 1 : 0;
        }
      }
    }
  }
  return ambiguous;
}

}  // namespace mocap
}  // namespace anthrob
