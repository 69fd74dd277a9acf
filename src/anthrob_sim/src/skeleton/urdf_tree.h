#pragma once

#include <map>
#include <string>
#include <vector>

#include "skeleton/urdf_file.h"

namespace anthrob {

/// Links and joints of a URDF as a graph. Only a tree has one way from each link to the root:
/// urdfdom takes the last of two parents, leaves out a loop that hangs on nothing, and follows any
/// other loop until the stack ends.
class UrdfTree {
 public:
  /// @throws BadInput, naming line, joint and link, if a joint has no parent or child among the
  /// links, or if a name is not unique
  explicit UrdfTree(const UrdfFile& file);

  /// @throws BadInput, naming lines, joints and links, if a link has two parents, if joints close a
  /// loop, if there is not one root, or if a chain is longer than any robot's
  void require_tree() const;

 private:
  struct Link {
    std::string name;
    int line;
    std::vector<int> above, below;  ///< joints
  };
  struct Joint {
    std::string name;
    int line;
    int parent, child;  ///< links
  };

  void add_link(const tinyxml2::XMLElement& element);
  void add_joint(const tinyxml2::XMLElement& element);
  int end_of(const tinyxml2::XMLElement& joint, const char* end) const;
  void refuse_joints_of_one_link() const;
  void refuse_two_parents() const;
  void refuse_loop_through(int link) const;
  void refuse_detached_loops() const;
  void refuse_several_roots() const;
  void refuse_long_chains() const;
  std::string loop_text(const std::vector<int>& joints) const;

  const UrdfFile& file_;
  std::vector<Link> links_;
  std::vector<Joint> joints_;
  std::map<std::string, int> link_of_;
  std::map<std::string, int> joint_of_;
};

}  // namespace anthrob
