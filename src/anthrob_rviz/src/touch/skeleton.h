#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "anthrob_core/pose.h"

namespace anthrob {

/// What is seen of a link.
struct LinkShape {
  enum class Kind { kBox, kCylinder, kSphere, kMesh };
  Kind kind = Kind::kBox;
  Vec3 size = Vec3::Ones();  ///< [m] edges, or diameters and height; of a mesh its scale
  std::string mesh;          ///< URL
  Pose X_LS;                 ///< of the shape in the link
};

enum class JointKind { kFixed, kHinge, kSlide, kBall };

/// How a link hangs on its parent.
struct LinkJoint {
  std::string name;
  JointKind kind = JointKind::kFixed;
  Pose X_PC_rest;
  Vec3 axis = Vec3::UnitX();     ///< of a hinge or slide, in the child's frame
  Vec3 center = Vec3::Zero();    ///< of a ball joint, in the child's frame [m]
  std::optional<double> lo, hi;  ///< stops [rad, m]
};

/// Position of one joint; of a fixed one nothing counts.
struct JointPosition {
  double q = 0.0;             ///< of a hinge or slide [rad, m]
  Quat rotation{1, 0, 0, 0};  ///< of a ball joint: from rest, in the child's axes
};
/// By link: position of the joint on which it hangs.
using Posture = std::vector<JointPosition>;

struct SkeletonLink {
  std::string name;
  std::optional<std::size_t> parent;  ///< none: the root
  LinkJoint joint;                    ///< towards the parent
  bool moves = false;                 ///< against the root
  Vec3 middle = Vec3::Zero();         ///< centre of mass [m]
  std::vector<LinkShape> shapes;
};

/// Links of a URDF, each after its parent.
class Skeleton {
 public:
  /// @param centers of ball joints, which a URDF cannot tell [m], in the child's frame
  /// @throws BadInput if the URDF cannot be read, or has a joint of a kind that robots of this
  /// suite do not have
  Skeleton(const std::string& urdf, const std::map<std::string, Vec3>& centers);

  const std::vector<SkeletonLink>& links() const { return links_; }
  std::optional<std::size_t> find(const std::string& link) const;
  /// The link that hangs on a joint.
  std::optional<std::size_t> child_of(const std::string& joint) const;
  bool has(JointKind kind) const;
  Posture rest() const { return Posture(links_.size()); }
  /// Pose of every link in the root.
  std::vector<Pose> poses(const Posture& posture) const;
  /// Pose of one link in the root.
  Pose pose(std::size_t link, const Posture& posture) const;

 private:
  std::vector<SkeletonLink> links_;
};

/// Pose of the child in the parent.
Pose pose_of(const LinkJoint& joint, const JointPosition& position);

}  // namespace anthrob
