#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/types.h"

namespace anthrob {
namespace mocap {

/// A rigid constellation of markers on a link.
struct MarkerTarget {
  std::string name;
  std::vector<Vec3> markers;  ///< in the target's frame [m]

  /// Mean of the markers [m]. The distance of two poses is measured there, because the origin of
  /// the frame may be anywhere.
  Vec3 centre() const;
};

/// A ball joint between two targets: R_parent^-1 R_child = rest R(q) child_mount.
struct BallJoint {
  std::string name;
  int parent = 0, child = 0;            ///< indices of targets
  Quat rest = Quat::Identity();         ///< child bone in the parent's marker frame, at rest
  Quat child_mount = Quat::Identity();  ///< child's marker frame in the axes of its bone
};

/// The content of targets.yaml.
struct TargetSet {
  double marker_diameter = 0.0;  ///< [m]
  std::vector<MarkerTarget> targets;
  std::vector<BallJoint> joints;

  /// Passed as edge_tolerance: does not check whether targets can be told apart.
  static constexpr double kUnchecked = -1.0;

  /// @param edge_tolerance [m] edges closer than this cannot be told apart
  /// @throws BadInput with file, line, key and reason, also for targets that cannot be told apart
  ///   from themselves or from each other
  static TargetSet load(const std::string& file, double edge_tolerance);
  static TargetSet parse(const std::string& text, const std::string& name, double edge_tolerance);
  std::string to_yaml() const;
};

/// Why markers of `a` can be taken for markers of `b` (or for others of the same target, if a and b
/// are the same): another assignment of all of a's markers that keeps every edge within the
/// tolerance. Names the offending edges; none if there are none, or the tolerance is negative.
std::optional<std::string> find_ambiguity(const MarkerTarget& a, const MarkerTarget& b,
                                          double edge_tolerance);

/// Number of triples of markers (each of one target) that can be taken for another triple, or for
/// themselves in another order. Such a triple alone gives no pose.
int count_ambiguous_triples(const std::vector<MarkerTarget>& targets, double edge_tolerance);

}  // namespace mocap
}  // namespace anthrob
